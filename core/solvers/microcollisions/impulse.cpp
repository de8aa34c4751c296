// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/microcollisions/impulse.h"

namespace carom {
namespace {

// I⁻¹ is diagonal in the body's axes only: there, and back.
Vec3 turnedByUnitTorque(const Bodies& bodies, const State& state, BodyIndex body, const Vec3& torque) {
    const Pose& pose = state.pose[body];
    return pose.directionToWorld(bodies.inverseInertia[body].cwiseProduct(pose.directionToBody(torque)));
}

} // namespace

PairImpact impactAt(const Bodies& bodies, const State& state, BodyPair pair, const Vec3& normal,
                    const Vec3& point) {
    PairImpact impact;
    impact.a = pair.a;
    impact.b = pair.b;
    impact.normal = normal;
    impact.inverseMass = bodies.inverseMass[pair.a] + bodies.inverseMass[pair.b];
    if (bodies.turnedByImpacts[pair.a] != 0) {
        impact.turns = true;
        impact.armA = (point - state.pose[pair.a].position).cross(normal);
        impact.spinA = turnedByUnitTorque(bodies, state, pair.a, impact.armA);
        impact.inverseMass += impact.armA.dot(impact.spinA);
    }
    if (bodies.turnedByImpacts[pair.b] != 0) {
        impact.turns = true;
        impact.armB = (point - state.pose[pair.b].position).cross(normal);
        impact.spinB = turnedByUnitTorque(bodies, state, pair.b, impact.armB);
        impact.inverseMass += impact.armB.dot(impact.spinB);
    }
    return impact;
}

} // namespace carom
