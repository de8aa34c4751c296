// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/energy_limit.h"

#include "core/base/wide.h"
#include "core/solvers/contacts/wide_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace carom {
namespace {

/// Bodies of which one thread computes the energy at least, or what they have gained.
constexpr std::size_t fewProducts = Workers::enoughOf(20), fewGains = Workers::enoughOf(10);
/// And whose velocities it copies.
constexpr std::size_t fewCopied = Workers::enoughOf(3);

/// ½ v · M v' for two motions of a body, one body in each lane. For bodies that do not turn the spin's part
/// is 0.
CAROM_INLINE Wide halfProduct(const Motion& one, const Motion& other) {
    const Wide zero{}, half = wideOf(0.5);
    // Cofactors of the inverse inertia: its inverse times its determinant.
    const Wide xx = one.yy * one.zz - one.yz * one.yz, xy = one.xz * one.yz - one.xy * one.zz,
               xz = one.xy * one.yz - one.xz * one.yy, yy = one.xx * one.zz - one.xz * one.xz,
               yz = one.xy * one.xz - one.xx * one.yz, zz = one.xx * one.yy - one.xy * one.xy;
    const Wide determinant = one.xx * xx + one.xy * xy + one.xz * xz;
    const Wide3 turned{xx * other.spin.x + xy * other.spin.y + xz * other.spin.z,
                       xy * other.spin.x + yy * other.spin.y + yz * other.spin.z,
                       xz * other.spin.x + yz * other.spin.y + zz * other.spin.z};
    const Wide moving = one.inverseMass != zero ? dot(one.velocity, other.velocity) / one.inverseMass : zero;
    const Wide turning = determinant != zero ? dot(one.spin, turned) / determinant : zero;
    return half * (moving + turning);
}

using Four = std::array<std::uint32_t, wideLanes>;

using List = std::span<const std::uint32_t>;

CAROM_INLINE void put(const Wide& four, std::size_t count, double* to) {
    if (count >= wideLanes) return storeUnaligned(to, four);
    for (std::size_t lane = 0; lane < count; ++lane) to[lane] = four[static_cast<int>(lane)];
}

/// ½ v · M v' of a list of bodies, with the velocities v of `one` and v' of `other`.
template<class One, class Other>
CAROM_INLINE void halfProducts(const SolverBody* bodies, const One* one, const Other* other, List list,
                               double* to) {
    for (std::size_t i = 0; i < list.size(); i += wideLanes) {
        const Four four = fourOf(list, i);
        Motion a;
        gather(bodies, four, a);
        Motion b = a;
        gatherVelocity(one, four, a);
        gatherVelocity(other, four, b);
        put(halfProduct(a, b), list.size() - i, to + i);
    }
}

CAROM_WIDE void productsNow(const SolverBody* bodies, List list, double* to) {
    halfProducts(bodies, bodies, bodies, list, to);
}

CAROM_WIDE void productsBefore(const SolverBody* bodies, const BodyVelocity* before, List list, double* to) {
    halfProducts(bodies, before, before, list, to);
}

CAROM_WIDE void productsBetween(const SolverBody* bodies, const BodyVelocity* before, List list, double* to) {
    halfProducts(bodies, before, bodies, list, to);
}

CAROM_WIDE void gains(const SolverBody* bodies, const BodyVelocity* before, List list, double resting,
                      double* to) {
    const Wide zero{}, three = wideOf(3);
    for (std::size_t i = 0; i < list.size(); i += wideLanes) {
        const Four four = fourOf(list, i);
        Motion then, now;
        gatherVelocity(before, four, then);
        gather(bodies, four, now);
        const Wide moving = dot(now.velocity, now.velocity) - dot(then.velocity, then.velocity);
        const Wide turning = dot(now.spin, now.spin) - dot(then.spin, then.spin);
        const Wide inverse = now.xx + now.yy + now.zz;
        const Wide gain = (moving - wideOf(resting)) / now.inverseMass +
                          (inverse > zero ? three / inverse * turning : zero);
        put(gain, list.size() - i, to + i);
    }
}

CAROM_WIDE void copyAll(const SolverBody* bodies, List list, BodyVelocity* to) {
    for (const std::uint32_t i : list) {
        storeWide(to[i].velocity.data(), loadWide(recordOf(bodies[i]))); // with what is beside them
        storeWide(to[i].spin.data(), loadWide(recordOf(bodies[i]) + 4));
    }
}

} // namespace

double kineticEnergyOf(const SolverBody& body) {
    constexpr std::array<std::uint32_t, 1> first{0};
    double energy = 0;
    productsNow(&body, first, &energy);
    return energy;
}

void copyVelocities(std::span<const SolverBody> bodies, std::span<const std::uint32_t> list,
                    std::vector<BodyVelocity>& to, Workers& workers) {
    to.resize(bodies.size());
    workers.forRanges(list.size(), fewCopied, [&](std::size_t begin, std::size_t end) {
        copyAll(bodies.data(), list.subspan(begin, end - begin), to.data());
    });
}

void findGains(std::span<const SolverBody> bodies, std::span<const BodyVelocity> before,
               std::span<const std::uint32_t> list, double resting, std::vector<double>& to,
               Workers& workers) {
    to.resize(list.size());
    workers.forRanges(list.size(), fewGains, [&](std::size_t begin, std::size_t end) {
        gains(bodies.data(), before.data(), list.subspan(begin, end - begin), resting, to.data() + begin);
    });
}

void EnergyLimit::addUp(Times times, std::span<const SolverBody> bodies, std::span<const BodyVelocity> before,
                        const Members& of, Workers& workers, double Sums::*to) {
    m_products.resize(of.list.size());
    workers.forRanges(of.list.size(), fewProducts, [&](std::size_t begin, std::size_t end) {
        const List list = of.list.subspan(begin, end - begin);
        double* const products = m_products.data() + begin;
        switch (times) {
        case Times::Now:
            return productsNow(bodies.data(), list, products);
        case Times::Before:
            return productsBefore(bodies.data(), before.data(), list, products);
        case Times::Between:
            return productsBetween(bodies.data(), before.data(), list, products);
        }
    });
    for (std::size_t k = 0; k < of.list.size(); ++k) m_sums[of.islandOf[of.list[k]]].*to += m_products[k];
}

void EnergyLimit::remember(std::span<const SolverBody> bodies, const Members& of, std::size_t islands,
                           Workers& workers) {
    m_sums.assign(islands, {});
    addUp(Times::Now, bodies, {}, of, workers, &Sums::limit);
}

void EnergyLimit::remember(std::span<const SolverBody> bodies, std::span<const BodyVelocity> before,
                           const Members& of, std::size_t islands, Workers& workers) {
    m_sums.assign(islands, {});
    addUp(Times::Before, bodies, before, of, workers, &Sums::limit);
}

bool EnergyLimit::keep(std::span<const BodyVelocity> before, const Members& of, std::span<SolverBody> bodies,
                       Workers& workers) {
    for (Sums& sums : m_sums) sums = {.limit = sums.limit};
    addUp(Times::Now, bodies, before, of, workers, &Sums::after);
    const auto isBeyond = [](const Sums& sums) { return sums.after > sums.limit; };
    if (std::none_of(m_sums.begin(), m_sums.end(), isBeyond)) return false;
    addUp(Times::Before, bodies, before, of, workers, &Sums::before);
    addUp(Times::Between, bodies, before, of, workers, &Sums::between);
    for (Sums& sums : m_sums) {
        if (!isBeyond(sums)) continue; // T(s) = T(0) + b s + c s²
        const double b = 2 * (sums.between - sums.before), c = sums.after - sums.before - b;
        const double root = std::sqrt(std::max(0.0, b * b - 4 * c * (sums.before - sums.limit)));
        sums.part = c > 0 ? std::clamp((root - b) / (2 * c), 0.0, 1.0) : 0.0;
    }
    for (const std::uint32_t i : of.list) {
        const double part = m_sums[of.islandOf[i]].part;
        if (part == 1) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            bodies[i].velocity[k] = std::lerp(before[i].velocity[k], bodies[i].velocity[k], part);
            bodies[i].spin[k] = std::lerp(before[i].spin[k], bodies[i].spin[k], part);
        }
    }
    return true;
}

} // namespace carom
