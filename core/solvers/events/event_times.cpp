// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/events/event_times.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace carom {
namespace {

double valueAt(std::span<const double> q, double t) {
    double value = 0;
    for (std::size_t k = q.size(); k-- > 0;) value = value * t + q[k];
    return value;
}

double slopeAt(std::span<const double> q, double t) {
    double slope = 0;
    for (std::size_t k = q.size(); k-- > 1;) slope = slope * t + static_cast<double>(k) * q[k];
    return slope;
}

/// Ascending.
struct Roots {
    std::array<double, 4> at{};
    std::size_t count = 0;

    void add(double root) { at[count++] = root; }
};

/// The roots of q[0] + q[1] t + q[2] t² in (0, bound), in the form that subtracts no near-equal numbers.
Roots quadraticRoots(std::span<const double> q, double bound) {
    const double c = q[0], half = q.size() > 1 ? 0.5 * q[1] : 0, a = q.size() > 2 ? q[2] : 0;
    const double discriminant = half * half - a * c;
    Roots roots;
    if (!(discriminant >= 0)) return roots;
    const double sum = -(half + std::copysign(std::sqrt(discriminant), half));
    const double one = c / sum, other = sum / a; // not finite, or not a number, where there is none
    for (const double root : {std::min(one, other), std::max(one, other)})
        if (root > 0 && root < bound) roots.add(root);
    return roots;
}

/// The root of q between `low` and `high`, where its sign changes: first that of the parabola that q is near
/// `low`, which may be an extremum, then Newton's steps while they stay in the bracket and shrink by half,
/// halving it else. Ends when a step is no longer than rounding, not when the bracket is as narrow: Newton's
/// steps come from one side.
double bracketedRoot(std::span<const double> q, std::span<const double> derivative, double low, double high) {
    // Of t: the rounding of the value over the slope. At half, steps may not become as short, and the
    // iteration goes on to its limit; at twice, one more bit of t is lost.
    constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
    const double atLow = valueAt(q, low);
    const std::array near{atLow, valueAt(derivative, low), 0.5 * slopeAt(derivative, low)};
    const Roots ofParabola = quadraticRoots(near, high - low);
    double t = ofParabola.count > 0 ? low + ofParabola.at[0] : 0.5 * (low + high);
    double width = high - low;
    for (int round = 0; round < 200; ++round) {
        const double value = valueAt(q, t);
        if (value == 0) return t;
        double next = t - value / valueAt(derivative, t);
        if (std::abs(next - t) <= rounding * t) return next;
        ((value < 0) == (atLow < 0) ? low : high) = t;
        const bool usable = next > low && next < high && std::abs(next - t) < 0.5 * width;
        if (!usable) next = 0.5 * (low + high);
        width = std::abs(next - t);
        if (width <= rounding * next) return next;
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

enum class Wanted : bool { All, FirstThatFalls };

/// The roots of q in (0, bound) by its extrema: between two of them it is monotonic. Extrema of degrees up to
/// three come in closed form.
Roots positiveRoots(std::span<const double> q, double bound, Wanted wanted) {
    Roots roots;
    std::array<double, 4> derivative{};
    for (std::size_t k = 1; k < q.size(); ++k) derivative[k - 1] = static_cast<double>(k) * q[k];
    const std::span<const double> dq(derivative.data(), q.size() - 1);
    const Roots extrema = dq.size() <= 3 ? quadraticRoots(dq, bound) : positiveRoots(dq, bound, Wanted::All);
    double low = 0, atLow = q[0];
    for (std::size_t k = 0; k <= extrema.count; ++k) {
        const double high = k < extrema.count ? extrema.at[k] : bound;
        const double atHigh = valueAt(q, high);
        const bool falls = atLow > 0 && atHigh < 0;
        if (falls || (wanted == Wanted::All && atLow < 0 && atHigh >= 0))
            roots.add(bracketedRoot(q, dq, low, high));
        if (falls && wanted == Wanted::FirstThatFalls) break;
        low = high;
        atLow = atHigh;
    }
    return roots;
}

} // namespace

double pairTime(const TrajectoryOrigin& a, const Vec3& accelerationOfA, const TrajectoryOrigin& b,
                const Vec3& accelerationOfB, double until) {
    // The bound and the distance are rounded by far less. At a thousandth of what is above 1, an impact at
    // the end of the time could be missed; at a thousand times, hardly more pairs are solved for.
    constexpr double rounding = 1 + 1e-12;
    const double later = std::max(a.time, b.time);
    const Vec3 D = positionAt(b, accelerationOfB, later) - positionAt(a, accelerationOfA, later);
    const Vec3 U = velocityAt(b, accelerationOfB, later) - velocityAt(a, accelerationOfA, later);
    const Vec3 A = accelerationOfB - accelerationOfA;
    const double R = a.radius + b.radius, left = until - later;
    if (D.norm() - R > rounding * left * (U.norm() + 0.5 * left * A.norm())) return never;
    // Balls that overlap by rounding touch: one that bounces lower than that would stay in the overlap, so
    // its gap would never fall through 0, and it would sink into the other.
    const double above = std::max(0.0, D.squaredNorm() - R * R);
    return later + firstFallingRoot(
                       {above, 2 * D.dot(U), U.squaredNorm() + D.dot(A), U.dot(A), 0.25 * A.squaredNorm()});
}

double firstFallingRoot(const std::array<double, 5>& q) {
    std::size_t terms = q.size();
    while (terms > 1 && q[terms - 1] == 0) --terms;
    const std::span<const double> polynomial(q.data(), terms);
    if (terms == 1) return never;
    for (std::size_t k = 1; q[0] <= 0 && k < terms; ++k) { // touching: the first term that is not 0 decides
        if (q[k] < 0) return 0;
        if (q[k] > 0) break;
    }
    const double bound = rootBound(polynomial);
    if (!std::isfinite(bound)) return never;
    const Roots roots = positiveRoots(polynomial, bound, Wanted::FirstThatFalls);
    return roots.count > 0 ? roots.at[0] : never;
}

} // namespace carom
