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

Vec3 velocityNow(const State& state, BodyIndex body, const Vec3& at) {
    if (body == noBody) return Vec3::Zero();
    return state.velocity[body] + state.angularVelocity[body].cross(state.pose[body].orientation * at);
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

Vec3 apartOf(const SpringForce& spring, const State& state) {
    return pointNow(state, spring.to, spring.toAt) - pointNow(state, spring.from, spring.fromAt);
}

Vec3 forceOf(const SpringForce& spring, const State& state) {
    const Vec3 apart = apartOf(spring, state);
    const double length = apart.norm();
    if (!(length > 0)) return Vec3::Zero();
    const Vec3 along = apart / length;
    const Vec3 speed =
        velocityNow(state, spring.to, spring.toAt) - velocityNow(state, spring.from, spring.fromAt);
    return -(spring.stiffness * (length - spring.length) + spring.damping * along.dot(speed)) * along;
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
