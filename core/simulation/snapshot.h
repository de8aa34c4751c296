// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/math/pose.h"
#include "core/simulation/health.h"
#include "core/simulation/statistics.h"

#include <cstdint>
#include <vector>

namespace carom {

/// What a contact does, where the method solves for contact forces.
struct ContactForce {
    Vec3 at = Vec3::Zero();    ///< [m]
    Vec3 force = Vec3::Zero(); ///< on the second body, or on the first where the second is a wall [N]
    BodyPair pair = {};
    Vec3 normal = Vec3::Zero(); ///< unit, towards the body that the force is on
    double friction = 0;        ///< coefficient of the pair

    /// Whether friction bears all it can, so that the surfaces slide.
    bool slides() const;
};

/// The state of a world at a frame, to be shown or written. A value: it shares nothing with the world.
struct Snapshot {
    std::int64_t frame = 0;
    double time = 0;        ///< [s]
    std::vector<Pose> pose; ///< by BodyIndex, walls included
    std::vector<Vec3> velocity, angularVelocity;
    std::vector<ContactForce> contactForces; ///< of the last substep
    FrameStatistics statistics;              ///< of the step that led here; all zero at frame 0
    Health health;
};

} // namespace carom
