// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/smooth_motion.h"

#include "core/math/rotation.h"

namespace carom {

void moveOnParabola(std::span<const BodyIndex> bodies, const Vec3& acceleration, double h, State& state) {
    const Vec3 change = h * acceleration;
    for (const BodyIndex i : bodies) {
        state.pose[i].position += h * (state.velocity[i] + 0.5 * change);
        state.velocity[i] += change;
    }
}

void turnBySpin(std::span<const BodyIndex> bodies, double h, State& state) {
    for (const BodyIndex i : bodies) {
        const Vec3& spin = state.angularVelocity[i];
        if (spin == Vec3::Zero()) continue;
        Quat& q = state.pose[i].orientation;
        q = (fromRotationVector(h * spin) * q).normalized();
    }
}

} // namespace carom
