// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/dynamics/state.h"
#include "core/math/rotation.h"

#include <span>

namespace carom {

/// How bodies move between impacts, under an acceleration that is constant over the substep: what integrators
/// provide and solvers call, without knowing each other. Bodies do not know each other either: a call for two
/// bodies is two calls.
struct SmoothMotion {
    /// Moves the centres of `bodies` through h seconds under the acceleration [m/s²].
    void (*move)(std::span<const BodyIndex> bodies, const Vec3& acceleration, double h,
                 State& state) = nullptr;
    /// Turns `bodies` through h seconds free of torque.
    void (*turn)(std::span<const BodyIndex> bodies, double h, State& state) = nullptr;
};

/// Turns bodies by exactly h|ω| about ω, which stays as it is: the SmoothMotion::turn of every scheme better
/// than the reference's. A body without spin keeps its orientation to the bit.
inline void turnBySpin(std::span<const BodyIndex> bodies, double h, State& state) {
    for (const BodyIndex i : bodies) {
        const Vec3& spin = state.angularVelocity[i];
        if (spin == Vec3::Zero()) continue;
        Quat& q = state.pose[i].orientation;
        q = (fromRotationVector(h * spin) * q).normalized();
    }
}

} // namespace carom
