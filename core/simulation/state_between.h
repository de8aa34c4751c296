// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/quantities.h"
#include "core/simulation/statistics.h"

#include <vector>

namespace carom {

class World;

/// What is kept of a frame to interpolate between it and the next.
struct FrameBefore {
    std::vector<Pose> pose;
    std::vector<Vec3> velocity, angularVelocity; ///< [m/s], [rad/s]
    FrameStatistics statistics;
    double time = 0; ///< [s]

    void take(const World& world);
    /// The moment of the world's state, with what forces need from this frame.
    Moment momentOf(const World& world) const;
};

/// The state at a time between two frames: positions by the cubic through the positions and velocities of
/// both, which is exact where only gravity acts, everything else linearly.
struct StateBetween {
    StateBetween(const FrameBefore& before, const World& now, double at);
    /// The world and the frame before must outlive it.
    Moment momentOf(const World& world, const FrameBefore& before) const;

    std::vector<Pose> pose;
    std::vector<Vec3> velocity, angularVelocity;
    FrameStatistics statistics;
    double part = 0; ///< of the frame that has passed
};

} // namespace carom
