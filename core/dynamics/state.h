// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/held_bytes.h"
#include "core/base/index.h"
#include "core/dynamics/bodies.h"
#include "core/math/pose.h"
#include "core/scene/scene.h"

#include <array>
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

/// Copies bodies of one state to bodies of another, both of unchanged sizes meanwhile.
class BodyCopy {
  public:
    BodyCopy(const State& from, State& to)
        : m_fromPose(from.pose.data()),
          m_toPose(to.pose.data()), m_vectors{{{from.velocity.data(), to.velocity.data()},
                                               {from.angularVelocity.data(), to.angularVelocity.data()},
                                               {from.positionRest.data(), to.positionRest.data()},
                                               {from.angularMomentum.data(), to.angularMomentum.data()}}} {}

    /// Body i of the one becomes body k of the other.
    void copy(BodyIndex i, BodyIndex k) const {
        m_toPose[k] = m_fromPose[i];
        for (const Vectors& quantity : m_vectors) quantity.to[k] = quantity.from[i];
    }

  private:
    struct Vectors {
        const Vec3* from = nullptr;
        Vec3* to = nullptr;
    };
    // Not read from the states anew for each body, as the compiler would have it: vectors of doubles might
    // overlap them.
    const Pose* m_fromPose;
    Pose* m_toPose;
    std::array<Vectors, 4> m_vectors;
};

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
