// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/pipeline.h"
#include "core/simulation/snapshot.h"

#include <memory>

namespace carom {

/// Another run beside the one on screen, at the time of the snapshot it comes with: the one that an exchanged
/// scene took the place of, or one that was asked for. Both null where there is none, or where it did not
/// reach this time.
struct Ghost {
    std::shared_ptr<const Pipeline> pipeline;
    std::shared_ptr<const Snapshot> snapshot;
};

} // namespace carom
