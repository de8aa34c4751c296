// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/energy.h"

#include "core/base/wide.h"
#include "core/dynamics/free_rotation.h"
#include "core/dynamics/ledger.h"

namespace carom {
namespace {

/// Without rotation.
Invariants moved(const Bodies& bodies, std::span<const BodyIndex> list, const State& state,
                 const Vec3& gravity) {
    Invariants sum;
    for (const BodyIndex i : list) {
        const double mass = bodies.mass[i];
        const Vec3& velocity = state.velocity[i];
        sum.kinetic += 0.5 * mass * velocity.squaredNorm();
        sum.potential -= mass * gravity.dot(state.pose[i].position);
        sum.momentum += mass * velocity;
    }
    return sum;
}

} // namespace

MotionTotals motionTotalsOf(const Bodies& bodies, const State& state) {
    MotionTotals sum;
    for (const BodyIndex i : bodies.mobileBodies) {
        sum.kinetic += 0.5 * bodies.mass[i] * state.velocity[i].squaredNorm();
        sum.momentum += bodies.mass[i] * state.velocity[i];
    }
    for (const BodyIndex i : bodies.rotating) sum.kinetic += spinEnergy(bodies, i, state);
    return sum;
}

Invariants invariantsOf(const Bodies& bodies, const State& state, const Vec3& gravity) {
    Invariants sum = moved(bodies, bodies.mobileBodies, state, gravity);
    for (const BodyIndex i : bodies.rotating) sum.kinetic += spinEnergy(bodies, i, state);
    return sum;
}

CAROM_WIDE Invariants invariantsOf(const Bodies& bodies, std::span<const BodyIndex> list, const State& state,
                                   const Vec3& gravity) {
    Invariants sum = moved(bodies, list, state, gravity);
    for (const BodyIndex i : list) sum.kinetic += spinEnergy(bodies, i, state);
    return sum;
}

Vec3 angularMomentumOf(const Bodies& bodies, const State& state) {
    Vec3 sum = Vec3::Zero();
    for (const BodyIndex i : bodies.mobileBodies) {
        const Pose& pose = state.pose[i];
        sum += pose.position.cross(bodies.mass[i] * state.velocity[i]);
        sum += angularMomentumOf(bodies, i, state);
    }
    return sum;
}

} // namespace carom
