// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/events/event_times.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace carom {
namespace {

double valueAt(std::span<const double> q, double t) {
    double value = 0;
    for (std::size_t k = q.size(); k-- > 0;) value = value * t + q[k];
    return value;
}

/// The root of q between `low` and `high`, where its sign changes: Newton's steps while they stay in the
/// bracket and halve it, bisection else. Ends when the bracket is two neighbouring numbers wide or hit.
double bracketedRoot(std::span<const double> q, std::span<const double> derivative, double low, double high) {
    const bool risesThere = valueAt(q, low) < 0;
    double t = 0.5 * (low + high);
    double width = high - low;
    for (int round = 0; round < 200; ++round) {
        const double value = valueAt(q, t);
        if (value == 0) return t;
        ((value < 0) == risesThere ? low : high) = t;
        const double slope = valueAt(derivative, t);
        double next = slope != 0 ? t - value / slope : low;
        const bool usable = next > low && next < high && std::abs(next - t) < 0.5 * width;
        if (!usable) next = 0.5 * (low + high);
        if (next == t || next <= low || next >= high) return next;
        width = std::abs(next - t);
        t = next;
    }
    return t;
}

/// A power of two that no root of q exceeds: M. Fujiwara's bound 2 max |q[n−k]/q[n]|^(1/k) (1916) with every
/// term rounded up. Unlike Cauchy's, 1 + max |q[k]/q[n]|, it does not add a second to a time. Infinite where
/// the leading coefficient vanishes against the rest, 0 where there is no rest.
double rootBound(std::span<const double> q) {
    double bound = 0;
    for (std::size_t k = 1; k < q.size(); ++k) {
        const double ratio = std::abs(q[q.size() - 1 - k] / q.back());
        if (ratio == 0) continue;
        if (!std::isfinite(ratio)) return never;
        const double exponent = (std::ilogb(ratio) + 1) / static_cast<double>(k);
        bound = std::max(bound, std::ldexp(1.0, 1 + static_cast<int>(std::ceil(exponent))));
    }
    return bound;
}

/// The roots of q in (0, bound), ascending, by those of its derivative: between two extrema q is monotonic.
struct Roots {
    std::array<double, 4> at{};
    std::size_t count = 0;
};

Roots positiveRoots(std::span<const double> q, double bound) {
    Roots roots;
    if (q.size() < 2) return roots;
    std::array<double, 4> derivative{};
    for (std::size_t k = 1; k < q.size(); ++k) derivative[k - 1] = static_cast<double>(k) * q[k];
    const std::span<const double> dq(derivative.data(), q.size() - 1);
    const Roots extrema = positiveRoots(dq, bound);
    double low = 0;
    for (std::size_t k = 0; k <= extrema.count; ++k) {
        const double high = k < extrema.count ? extrema.at[k] : bound;
        const double atLow = valueAt(q, low), atHigh = valueAt(q, high);
        if ((atLow < 0) != (atHigh < 0) && atLow != 0 && roots.count < roots.at.size())
            roots.at[roots.count++] = bracketedRoot(q, dq, low, high);
        low = high;
    }
    return roots;
}

} // namespace

double pairTime(const TrajectoryOrigin& a, const Vec3& accelerationOfA, const TrajectoryOrigin& b,
                const Vec3& accelerationOfB, double until) {
    constexpr double rounding = 1 + 1e-12;
    const double later = std::max(a.time, b.time);
    const Vec3 D = positionAt(b, accelerationOfB, later) - positionAt(a, accelerationOfA, later);
    const Vec3 U = velocityAt(b, accelerationOfB, later) - velocityAt(a, accelerationOfA, later);
    const Vec3 A = accelerationOfB - accelerationOfA;
    const double R = a.radius + b.radius, left = until - later;
    if (D.norm() - R > rounding * left * (U.norm() + 0.5 * left * A.norm())) return never;
    // Balls that overlap by rounding touch: one that hops lower than that would never come out, so its path
    // would never fall through 0, and it would sink into the other.
    const double above = std::max(0.0, D.squaredNorm() - R * R);
    return later + firstFallingRoot(
                       {above, 2 * D.dot(U), U.squaredNorm() + D.dot(A), U.dot(A), 0.25 * A.squaredNorm()});
}

double firstFallingRoot(const std::array<double, 5>& q) {
    std::size_t terms = q.size();
    while (terms > 1 && q[terms - 1] == 0) --terms;
    const std::span<const double> polynomial(q.data(), terms);
    if (terms == 1) return never;
    for (std::size_t k = 1; q[0] <= 0 && k < terms; ++k) { // touching: the first term that speaks decides
        if (q[k] < 0) return 0;
        if (q[k] > 0) break;
    }
    const double bound = rootBound(polynomial);
    if (!std::isfinite(bound)) return never;
    const Roots roots = positiveRoots(polynomial, bound);
    std::array<double, 4> slope{};
    for (std::size_t k = 1; k < terms; ++k) slope[k - 1] = static_cast<double>(k) * q[k];
    for (std::size_t k = 0; k < roots.count; ++k)
        if (valueAt(slope, roots.at[k]) < 0) return roots.at[k];
    return never;
}

} // namespace carom
