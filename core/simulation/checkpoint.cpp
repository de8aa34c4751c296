// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/checkpoint.h"

namespace carom {

std::size_t Checkpoint::bytes() const {
    return sizeof(Checkpoint) + state.bytes() + (memory ? memory->bytes() : 0);
}

} // namespace carom
