// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/quantities.h"
#include "core/simulation/world.h"

#include <vector>

namespace carom {

/// What is kept of a frame to read moments between it and the next.
struct FrameBefore {
    std::vector<Pose> pose;
    std::vector<Vec3> velocity, angularVelocity; ///< [m/s], [rad/s]
    FrameStatistics statistics;
    double time = 0; ///< [s]

    void take(const World& world);
    /// The world's own moment, with what forces need from this frame.
    Moment momentOf(const World& world) const;
};

/// The state at a moment between two frames: places on the cubic through the places and velocities of both,
/// which is exact where nothing but gravity acts, everything else on the straight line.
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
