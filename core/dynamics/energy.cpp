// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/energy.h"

namespace carom {

Invariants invariantsOf(const Bodies& bodies, const State& state, const Vec3& gravity) {
    Invariants sum;
    for (const BodyIndex i : bodies.mobileBodies) {
        const double mass = bodies.mass[i];
        const Vec3& velocity = state.velocity[i];
        sum.kinetic += 0.5 * mass * velocity.squaredNorm();
        sum.potential -= mass * gravity.dot(state.pose[i].position);
        sum.momentum += mass * velocity;
    }
    for (const BodyIndex i : bodies.rotating) {
        const Vec3 spin = state.pose[i].directionToBody(state.angularVelocity[i]);
        sum.kinetic += 0.5 * spin.dot(bodies.inertia[i].cwiseProduct(spin));
    }
    return sum;
}

Vec3 angularMomentumOf(const Bodies& bodies, const State& state) {
    Vec3 sum = Vec3::Zero();
    for (const BodyIndex i : bodies.mobileBodies) {
        const Pose& pose = state.pose[i];
        const Vec3 spin = pose.directionToBody(state.angularVelocity[i]);
        sum += pose.position.cross(bodies.mass[i] * state.velocity[i]);
        sum += pose.directionToWorld(bodies.inertia[i].cwiseProduct(spin));
    }
    return sum;
}

} // namespace carom
