// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/energy_limit.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

/// ½ v · M v' of a body with two motions.
double halfProduct(const SolverBody& one, const SolverBody& other) {
    if (one.inverseMass == 0) return 0;
    const Vec3 spin = vectorOf(one.spin), otherSpin = vectorOf(other.spin);
    const double moving = vectorOf(one.velocity).dot(vectorOf(other.velocity)) / one.inverseMass;
    if (one.roundInverse > 0) return 0.5 * (moving + spin.dot(otherSpin) / one.roundInverse);
    if (spin == Vec3::Zero()) return 0.5 * moving;
    return 0.5 * (moving + spin.dot(inverseInertiaOf(one).inverse() * otherSpin));
}

} // namespace

double kineticEnergyOf(const SolverBody& body) { return halfProduct(body, body); }

double kineticEnergyOf(std::span<const SolverBody> bodies) {
    double sum = 0;
    for (const SolverBody& body : bodies) sum += halfProduct(body, body);
    return sum;
}

void EnergyLimit::remember(std::span<const SolverBody> bodies, std::span<const std::uint32_t> islandOf,
                           std::size_t islands) {
    m_sums.assign(islands, {});
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (bodies[i].inverseMass > 0) m_sums[islandOf[i]].limit += halfProduct(bodies[i], bodies[i]);
}

bool EnergyLimit::keep(std::span<const SolverBody> before, std::span<const std::uint32_t> islandOf,
                       std::span<SolverBody> bodies) {
    for (Sums& sums : m_sums) sums = {.limit = sums.limit};
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (bodies[i].inverseMass > 0) m_sums[islandOf[i]].after += halfProduct(bodies[i], bodies[i]);
    const auto isBeyond = [](const Sums& sums) { return sums.after > sums.limit; };
    if (std::none_of(m_sums.begin(), m_sums.end(), isBeyond)) return false;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies[i].inverseMass == 0 || !isBeyond(m_sums[islandOf[i]])) continue;
        Sums& sums = m_sums[islandOf[i]];
        sums.before += halfProduct(before[i], before[i]);
        sums.between += halfProduct(before[i], bodies[i]);
    }
    for (Sums& sums : m_sums) {
        if (!isBeyond(sums)) continue; // T(s) = T(0) + b s + c s²
        const double b = 2 * (sums.between - sums.before), c = sums.after - sums.before - b;
        const double root = std::sqrt(std::max(0.0, b * b - 4 * c * (sums.before - sums.limit)));
        sums.part = c > 0 ? std::clamp((root - b) / (2 * c), 0.0, 1.0) : 0.0;
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const double part = bodies[i].inverseMass > 0 ? m_sums[islandOf[i]].part : 1;
        if (part == 1) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            bodies[i].velocity[k] = std::lerp(before[i].velocity[k], bodies[i].velocity[k], part);
            bodies[i].spin[k] = std::lerp(before[i].spin[k], bodies[i].spin[k], part);
        }
    }
    return true;
}

} // namespace carom
