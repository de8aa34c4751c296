// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"

#include <cstdint>
#include <string_view>

namespace carom {

/// A run is healthy until its state is not finite; then it stops and reports where. Nothing is clamped or
/// reset.
struct Health {
    bool finite = true;
    BodyIndex body = noBody;
    std::int64_t frame = 0;
    std::string_view quantity; ///< "position", "velocity", "orientation", "angular velocity"
};

} // namespace carom
