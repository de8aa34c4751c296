// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/spring_force.h"

#include "core/dynamics/state.h"

namespace carom {
namespace {

bool moves(const Scene& scene, BodyIndex body) { return body != noBody && scene.bodies[body].mobile(); }

Vec3 pointAtStart(const Scene& scene, BodyIndex body, const Vec3& at) {
    return body == noBody ? at : scene.bodies[body].pose.toWorld(at);
}

} // namespace

std::vector<SpringForce> springsOf(const Scene& scene) {
    std::vector<SpringForce> springs;
    for (const Spring& spring : scene.springs) {
        if (!moves(scene, spring.from) && !moves(scene, spring.to)) continue;
        const Vec3 apart =
            pointAtStart(scene, spring.to, spring.toAt) - pointAtStart(scene, spring.from, spring.fromAt);
        springs.push_back({.from = spring.from,
                           .to = spring.to,
                           .fromAt = spring.fromAt,
                           .toAt = spring.toAt,
                           .stiffness = spring.stiffness,
                           .damping = spring.damping,
                           .length = spring.length.value_or(apart.norm())});
    }
    return springs;
}

SpringPoint springPoint(const State& state, BodyIndex body, const Vec3& at) {
    if (body == noBody) return {.place = at};
    const Vec3 arm = state.pose[body].directionToWorld(at);
    return {state.pose[body].position + arm, state.velocity[body] + state.angularVelocity[body].cross(arm),
            arm};
}

double lengthOf(const SpringForce& spring, const State& state) {
    return (springPoint(state, spring.to, spring.toAt).place -
            springPoint(state, spring.from, spring.fromAt).place)
        .norm();
}

Vec3 forceOf(const SpringForce& spring, const State& state) {
    return forceOf(spring, springPoint(state, spring.from, spring.fromAt),
                   springPoint(state, spring.to, spring.toAt));
}

double springEnergy(const SpringForce& spring, double length) {
    const double stretch = length - spring.length;
    return 0.5 * spring.stiffness * stretch * stretch;
}

double springEnergy(const SpringForce& spring, const State& state) {
    return springEnergy(spring, lengthOf(spring, state));
}

double springEnergy(const std::vector<SpringForce>& springs, const State& state) {
    double energy = 0;
    for (const SpringForce& spring : springs) energy += springEnergy(spring, state);
    return energy;
}

} // namespace carom
