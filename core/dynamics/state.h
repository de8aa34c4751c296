// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/held_bytes.h"
#include "core/base/index.h"
#include "core/dynamics/bodies.h"
#include "core/math/pose.h"
#include "core/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace carom {

/// What integration changes, one array a quantity, indexed by BodyIndex.
struct State {
    std::vector<Pose> pose;
    std::vector<Vec3> velocity;        ///< [m/s]
    std::vector<Vec3> angularVelocity; ///< [rad/s], world
    std::vector<Vec3> positionRest;    ///< rounding error of `pose.position` [m]: the body is at their sum
    /// [kg m²/s], world, from which the angular velocity was computed; valid for bodies that turned freely,
    /// and undefined for others. Read it by angularMomentumOf (free_rotation.h) only, which checks that it is
    /// valid.
    std::vector<Vec3> angularMomentum;

    std::int64_t frame = 0;
    double time = 0; ///< [s] = frame · step

    /// Memory of the arrays.
    std::size_t bytes() const {
        return heldBytes(pose, velocity, angularVelocity, positionRest, angularMomentum);
    }
};

/// Copies body i of one state to body k of another.
void copyBody(const State& from, BodyIndex i, State& to, BodyIndex k);

/// The state a scene begins in. What cannot move has no velocity, whatever the scene says.
State initialStateOf(const Scene& scene);

/// A quantity that is no longer finite. No body is named while the state is finite.
struct Loss {
    BodyIndex body = noBody;
    std::string_view quantity; ///< "position", "velocity", "orientation", "angular velocity"

    explicit operator bool() const { return body != noBody; }
};

/// The first of some mobile bodies, ascending, with a quantity that is infinite or not a number; of what
/// integration and impacts can change: position and velocity, and of rotating bodies orientation and angular
/// velocity.
Loss findLoss(const Bodies& bodies, std::span<const BodyIndex> list, const State& state);
/// The same of all mobile bodies.
inline Loss findLoss(const Bodies& bodies, const State& state) {
    return findLoss(bodies, bodies.mobileBodies, state);
}

} // namespace carom
