// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/spring_limit.h"

#include "core/math/rotation.h"
#include "core/solvers/contacts/energy_limit.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

/// Bisections for s, which is then found to 2⁻²⁰, a millionth. At half, to a thousandth, and an island may
/// lose that part of its energy; at twice, each costs another sum over the island for nothing.
constexpr int halvings = 20;
/// Sums of energies are rounded by less than this part of them. At a thousandth, rounding would slow islands
/// down; at a thousand times, an island may gain a billionth of its energy in each step.
constexpr double rounding = 1e-12;

} // namespace

void SpringLimit::remember(const SpringIslands& input, std::span<const SolverBody> bodies) {
    m_sums.assign(input.islands, {});
    for (const std::uint32_t index : input.springs) {
        const SpringForce& spring = input.bodies.springs[index];
        for (const BodyIndex end : {spring.from, spring.to}) {
            const bool moves = end != noBody && input.local[end] != 0;
            const BodyIndex other = end == spring.from ? spring.to : spring.from;
            if (moves)
                m_sums[input.islandOf[input.local[end]]].hasSprings = true;
            else
                hold(input.islandOf[input.local[other]]);
        }
    }
    for (Sums& sums : m_sums) sums.part = 1;
    findEnergies(input, 0, bodies);
    for (Sums& sums : m_sums) sums.limit = sums.energy;
}

void SpringLimit::allow(const SpringIslands& input, std::span<const double> added) {
    for (std::size_t i = 1; i < added.size(); ++i) m_sums[input.islandOf[i]].limit += added[i];
}

SolverBody SpringLimit::slowed(const SpringIslands& input, std::span<const SolverBody> bodies,
                               std::size_t body) const {
    SolverBody slow = bodies[body];
    if (body == 0) return slow;
    const Sums& sums = m_sums[input.islandOf[body]];
    if (sums.part == 1) return slow;
    slow.velocity = arrayOf(sums.drift + sums.part * (vectorOf(slow.velocity) - sums.drift));
    slow.spin = arrayOf(sums.part * vectorOf(slow.spin));
    return slow;
}

// Computes the energies that islands have at their present part of the motion.
void SpringLimit::findEnergies(const SpringIslands& input, double duration,
                               std::span<const SolverBody> bodies) {
    for (Sums& sums : m_sums) sums.energy = 0;
    for (std::size_t i = 1; i < bodies.size(); ++i)
        if (Sums& sums = m_sums[input.islandOf[i]]; sums.hasSprings)
            sums.energy += kineticEnergyOf(slowed(input, bodies, i));
    for (const std::uint32_t index : input.springs) {
        const SpringForce& spring = input.bodies.springs[index];
        std::uint32_t island = 0;
        const auto endOf = [&](BodyIndex i, const Vec3& point) -> Vec3 {
            if (i == noBody) return point;
            const Pose& pose = input.state.pose[i];
            if (input.local[i] == 0) return pose.toWorld(point);
            island = input.islandOf[input.local[i]];
            const SolverBody body = slowed(input, bodies, input.local[i]);
            const Vec3 arm = pose.orientation * point;
            return pose.position + duration * vectorOf(body.velocity) +
                   fromRotationVector(duration * vectorOf(body.spin)) * arm;
        };
        const Vec3 from = endOf(spring.from, spring.fromAt), to = endOf(spring.to, spring.toAt);
        m_sums[island].energy += springEnergy(spring, (to - from).norm());
    }
}

bool SpringLimit::isExceeded(const SpringIslands& input, double duration,
                             std::span<const SolverBody> bodies) {
    for (Sums& sums : m_sums) sums.part = 1;
    findEnergies(input, duration, bodies);
    bool any = false;
    for (Sums& sums : m_sums) {
        sums.exceeds = sums.hasSprings && sums.energy > (1 + rounding) * sums.limit;
        any = any || sums.exceeds;
    }
    return any;
}

void SpringLimit::keep(const SpringIslands& input, double duration, std::span<SolverBody> bodies) {
    if (!isExceeded(input, duration, bodies)) return;
    for (Sums& sums : m_sums) {
        sums.mass = sums.least = 0;
        sums.most = 1;
        sums.drift.setZero();
    }
    for (std::size_t i = 1; i < bodies.size(); ++i) {
        Sums& sums = m_sums[input.islandOf[i]];
        if (!sums.exceeds || sums.isHeld) continue;
        sums.mass += 1 / bodies[i].inverseMass;
        sums.drift += vectorOf(bodies[i].velocity) / bodies[i].inverseMass;
    }
    for (Sums& sums : m_sums)
        if (sums.mass > 0) sums.drift /= sums.mass;
    for (int round = 0; round < halvings; ++round) {
        for (Sums& sums : m_sums)
            if (sums.exceeds) sums.part = 0.5 * (sums.least + sums.most);
        findEnergies(input, duration, bodies);
        for (Sums& sums : m_sums)
            if (sums.exceeds) (sums.energy > sums.limit ? sums.most : sums.least) = sums.part;
    }
    for (Sums& sums : m_sums)
        if (sums.exceeds) sums.part = sums.least;
    for (std::size_t i = 1; i < bodies.size(); ++i)
        if (m_sums[input.islandOf[i]].exceeds) bodies[i] = slowed(input, bodies, i);
}

} // namespace carom
