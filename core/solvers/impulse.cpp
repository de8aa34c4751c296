// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/impulse.h"

namespace carom {
namespace {

// I⁻¹ is diagonal in the body's axes only: there, and back.
Vec3 turnedByUnitTorque(const Bodies& bodies, const State& state, BodyIndex body, const Vec3& torque) {
    const Pose& pose = state.pose[body];
    return pose.directionToWorld(bodies.inverseInertia[body].cwiseProduct(pose.directionToBody(torque)));
}

bool turnsByImpulses(const Bodies& bodies, BodyIndex body) {
    return bodies.mobile[body] != 0 && kindOf(bodies.shape[body]) != ShapeKind::Sphere;
}

} // namespace

Impact impactAt(const Bodies& bodies, const State& state, BodyPair pair, const Vec3& normal,
                const Vec3& point) {
    Impact impact;
    impact.a = pair.a;
    impact.b = pair.b;
    impact.normal = normal;
    impact.inverseMassAlongNormal = bodies.inverseMass[pair.a] + bodies.inverseMass[pair.b];
    if (turnsByImpulses(bodies, pair.a)) {
        impact.armA = (point - state.pose[pair.a].position).cross(normal);
        impact.spinA = turnedByUnitTorque(bodies, state, pair.a, impact.armA);
        impact.inverseMassAlongNormal += impact.armA.dot(impact.spinA);
    }
    if (turnsByImpulses(bodies, pair.b)) {
        impact.armB = (point - state.pose[pair.b].position).cross(normal);
        impact.spinB = turnedByUnitTorque(bodies, state, pair.b, impact.armB);
        impact.inverseMassAlongNormal += impact.armB.dot(impact.spinB);
    }
    return impact;
}

double partingSpeed(const Impact& impact, const State& state) {
    // n·(ω×r) = ω·(r×n)
    return impact.normal.dot(state.velocity[impact.b] - state.velocity[impact.a]) +
           impact.armB.dot(state.angularVelocity[impact.b]) -
           impact.armA.dot(state.angularVelocity[impact.a]);
}

void apply(const Impact& impact, double restitution, const Bodies& bodies, State& state) {
    const double j = -(1 + restitution) * partingSpeed(impact, state) / impact.inverseMassAlongNormal;
    state.velocity[impact.a] -= (j * bodies.inverseMass[impact.a]) * impact.normal;
    state.velocity[impact.b] += (j * bodies.inverseMass[impact.b]) * impact.normal;
    state.angularVelocity[impact.a] -= j * impact.spinA;
    state.angularVelocity[impact.b] += j * impact.spinB;
}

} // namespace carom
