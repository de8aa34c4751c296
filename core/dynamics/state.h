// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/pose.h"

#include <cstdint>
#include <vector>

namespace carom {

/// What integration changes, one array a quantity, indexed by BodyIndex.
struct State {
    std::vector<Pose> pose;
    std::vector<Vec3> velocity;        ///< [m/s]
    std::vector<Vec3> angularVelocity; ///< [rad/s], world

    std::int64_t frame = 0;
    double time = 0; ///< [s] = frame · step
};

} // namespace carom
