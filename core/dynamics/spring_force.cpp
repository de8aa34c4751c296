// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/spring_force.h"

#include "core/dynamics/state.h"

namespace carom {
namespace {

bool moves(const Scene& scene, BodyIndex body) { return body != noBody && scene.bodies[body].mobile(); }

Vec3 pointAtStart(const Scene& scene, BodyIndex body, const Vec3& at) {
    return body == noBody ? at : scene.bodies[body].pose.toWorld(at);
}

Vec3 pointNow(const State& state, BodyIndex body, const Vec3& at) {
    return body == noBody ? at : state.pose[body].toWorld(at);
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

double springEnergy(const SpringForce& spring, double length) {
    const double stretch = length - spring.length;
    return 0.5 * spring.stiffness * stretch * stretch;
}

double springEnergy(const SpringForce& spring, const State& state) {
    const Vec3 apart = pointNow(state, spring.to, spring.toAt) - pointNow(state, spring.from, spring.fromAt);
    return springEnergy(spring, apart.norm());
}

double springEnergy(const std::vector<SpringForce>& springs, const State& state) {
    double energy = 0;
    for (const SpringForce& spring : springs) energy += springEnergy(spring, state);
    return energy;
}

} // namespace carom
