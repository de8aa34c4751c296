// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/spring_network.h"

#include "core/dynamics/free_rotation.h"
#include "core/math/rotation.h"

#include <algorithm>

namespace carom {
namespace {

void addTerms(const SpringNetwork& network, const State& state) {
    std::vector<ForceSample>& samples = network.scratch.samples;
    std::vector<ForceValue>& values = network.scratch.values;
    samples.clear();
    for (const BodyIndex i : network.moving)
        if (network.bodies.forces.actOn(i))
            samples.push_back({i, state.pose[i], state.velocity[i], state.angularVelocity[i]});
    values.resize(samples.size());
    network.bodies.forces.evaluate(samples, values);
    for (std::size_t k = 0; k < samples.size(); ++k)
        network.scratch.force[samples[k].body] += values[k].force;
}

// Forces and torques of gravity, the terms and the springs, into the scratch. Entries of bodies that do not
// move are written and never read.
void sumLoads(const SpringNetwork& network, const State& state) {
    std::vector<Vec3>& force = network.scratch.force;
    std::vector<Vec3>& torque = network.scratch.torque;
    force.resize(network.bodies.count());
    torque.resize(network.bodies.count());
    for (const BodyIndex i : network.moving) {
        force[i] = network.bodies.mass[i] * network.gravity;
        torque[i].setZero();
    }
    if (!network.bodies.forces.empty()) addTerms(network, state);
    for (const std::uint32_t index : network.springs) {
        const SpringForce& spring = network.bodies.springs[index];
        const SpringPoint from = springPoint(state, spring.from, spring.fromAt),
                          to = springPoint(state, spring.to, spring.toAt);
        const Vec3 pull = forceOf(spring, from, to);
        if (spring.to != noBody) {
            force[spring.to] += pull;
            torque[spring.to] += to.arm.cross(pull);
        }
        if (spring.from != noBody) {
            force[spring.from] -= pull;
            torque[spring.from] -= from.arm.cross(pull);
        }
    }
}

} // namespace

void readMotion(const SpringNetwork& network, const State& state, std::vector<BodyMotion>& motion) {
    motion.resize(network.moving.size());
    for (std::size_t k = 0; k < network.moving.size(); ++k) {
        const BodyIndex i = network.moving[k];
        const Pose& pose = state.pose[i];
        motion[k] = {pose.position, state.velocity[i], pose.orientation.coeffs(),
                     angularMomentumOf(network.bodies, i, state)};
    }
}

void ratesOf(const SpringNetwork& network, const State& state, std::vector<BodyMotion>& rate) {
    sumLoads(network, state);
    rate.resize(network.moving.size());
    for (std::size_t k = 0; k < network.moving.size(); ++k) {
        const BodyIndex i = network.moving[k];
        rate[k] = {state.velocity[i], network.bodies.inverseMass[i] * network.scratch.force[i],
                   orientationRate(state.angularVelocity[i], state.pose[i].orientation),
                   network.scratch.torque[i]};
    }
}

void applyRates(const SpringNetwork& network, const std::vector<BodyMotion>& start,
                const std::vector<BodyMotion>& rate, double h, State& state) {
    for (std::size_t k = 0; k < network.moving.size(); ++k) {
        const BodyIndex i = network.moving[k];
        Pose& pose = state.pose[i];
        pose.position = start[k].position + h * rate[k].position;
        state.velocity[i] = start[k].velocity + h * rate[k].velocity;
        const Vec3 momentum = start[k].angularMomentum + h * rate[k].angularMomentum;
        pose.orientation.coeffs() = start[k].orientation;
        if (rate[k].orientation != Vec4::Zero()) {
            pose.orientation.coeffs() += h * rate[k].orientation;
            pose.orientation.normalize();
        }
        state.angularVelocity[i] = angularVelocityFrom(network.bodies.inertia[i], pose.orientation, momentum);
        state.angularMomentum[i] = momentum;
    }
}

void kick(const SpringNetwork& network, const std::vector<BodyMotion>& rate, double h, State& state) {
    for (std::size_t k = 0; k < network.moving.size(); ++k) {
        const BodyIndex i = network.moving[k];
        state.velocity[i] += h * rate[k].velocity;
        if (rate[k].angularMomentum == Vec3::Zero()) continue;
        state.angularVelocity[i] += angularVelocityFrom(network.bodies.inertia[i], state.pose[i].orientation,
                                                        h * rate[k].angularMomentum);
    }
}

bool isDamped(const SpringNetwork& network) {
    if (!network.bodies.forces.empty()) return true;
    return std::any_of(network.springs.begin(), network.springs.end(),
                       [&](std::uint32_t index) { return network.bodies.springs[index].damping > 0; });
}

} // namespace carom
