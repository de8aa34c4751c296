// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/compensated.h"
#include "core/math/types.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

// Times of impact in closed form. Each function is a pure function of the origins it is given, never of the
// time it is called, so a time found twice is the same to the bit; and exchanging the two bodies of a pair
// changes the sign of every intermediate and no other bit of it.

namespace carom {

inline constexpr double never = std::numeric_limits<double>::infinity();

/// A body's motion since its last event: x(t) = position + velocity d + acceleration d²/2 with d = t − time.
/// One cache line; the acceleration is kept beside it because nearly all bodies share one.
struct alignas(64) TrajectoryOrigin {
    Vec3 position = Vec3::Zero(); ///< [m] at `time`
    double time = 0;              ///< [s]
    Vec3 velocity = Vec3::Zero(); ///< [m/s] at `time`
    double radius = 0;            ///< [m]
};
static_assert(sizeof(TrajectoryOrigin) == 64);

/// Two neighbouring numbers of an origin in one register: (x, y), (z, time), (vx, vy), (vz, radius).
using HalfOrigin = double __attribute__((vector_size(16)));
inline HalfOrigin halfOf(const TrajectoryOrigin& origin, std::size_t k) {
    HalfOrigin half;
    std::memcpy(&half, reinterpret_cast<const char*>(&origin) + k * sizeof(half), sizeof(half));
    return half;
}

/// The displacement since the origin [m].
inline Vec3 wayTo(const TrajectoryOrigin& origin, const Vec3& acceleration, double time) {
    const double d = time - origin.time;
    return d * (origin.velocity + (0.5 * d) * acceleration);
}

inline Vec3 positionAt(const TrajectoryOrigin& origin, const Vec3& acceleration, double time) {
    return origin.position + wayTo(origin, acceleration, time);
}

inline Vec3 velocityAt(const TrajectoryOrigin& origin, const Vec3& acceleration, double time) {
    return origin.velocity + (time - origin.time) * acceleration;
}

/// How far a ball's surface is above the plane normal·x = offset at its origin [m]. `rest` [m] is what the
/// origin's position rounded off: a gap that is small against the ball has a part in it.
inline double gapTo(const TrajectoryOrigin& origin, const Vec3& rest, const Vec3& normal, double offset) {
    // Of the radius: below, the plain difference loses more than two digits, twice as much at half of it. At
    // twice, the exact gap, which takes longer, is computed more often.
    constexpr double small = 0.01;
    const double gap = normal.dot(origin.position) - offset - origin.radius;
    if (std::abs(gap) > small * origin.radius) return gap;
    return exactGap(normal, offset, origin.radius, origin.position, rest);
}

/// The time from now until a distance s [m] that changes at rate w [m/s] with acceleration a [m/s²] first
/// falls through 0; never, if it does not. 0 if it is not positive now and falling. The roots are written in
/// the form that subtracts no near-equal numbers (W. H. Press et al., "Numerical recipes", 3rd ed.
/// 2007, 5.6).
inline double timeToPlane(double s, double w, double a) {
    if (a < 0) { // comes back sooner or later
        const double root = std::sqrt(std::max(0.0, w * w - 2 * a * s));
        if (w > 0) return (w + root) / -a;
        return s <= 0 ? 0 : 2 * s / (root - w);
    }
    if (w >= 0) return never;
    if (s <= 0) return 0;
    if (a == 0) return s / -w;
    const double discriminant = w * w - 2 * a * s;
    return discriminant < 0 ? never : 2 * s / (std::sqrt(discriminant) - w);
}

/// How fast that distance falls when it does so [m/s], by the energy: the time, which is rounded, has no say.
inline double speedAtPlane(double s, double w, double a) {
    if (a == 0) return std::max(0.0, -w);
    return std::sqrt(std::max(0.0, w * w - 2 * a * std::max(0.0, s)));
}

/// When two balls under one common acceleration g touch while approaching: |D + U t| = R is a quadratic, for
/// g cancels. D, U are relative position and velocity at the later of the two origins, c = D² − R², b = D·U:
///
///     t = c / (sqrt(b² − U² c) − b)      if b < 0 and the root exists
///
/// If they overlap by rounding and approach, it is now. Returns the time itself, not the time until then.
template<bool falling>
inline double pairTimeUnder(const TrajectoryOrigin& a, const TrajectoryOrigin& b, const Vec3& g) {
    const double later = std::max(a.time, b.time);
    const double da = later - a.time;
    const double db = later - b.time;
    const HalfOrigin xyA = halfOf(a, 0), zA = halfOf(a, 1), xyB = halfOf(b, 0), zB = halfOf(b, 1);
    const HalfOrigin vxyA = halfOf(a, 2), vzA = halfOf(a, 3), vxyB = halfOf(b, 2), vzB = halfOf(b, 3);
    HalfOrigin Uxy = vxyB - vxyA, Uz = vzB - vzA; // the second number of z is none of the vector's
    HalfOrigin Dxy = (xyB - xyA) + (db * vxyB - da * vxyA), Dz = (zB - zA) + (db * vzB - da * vzA);
    if constexpr (falling) {
        const HalfOrigin gxy = {g.x(), g.y()}, gz = {g.z(), 0};
        const double lag = db - da, fall = 0.5 * (db * db - da * da);
        Uxy += lag * gxy;
        Uz += lag * gz;
        Dxy += fall * gxy;
        Dz += fall * gz;
    }
    const auto dot = [](const HalfOrigin& xy, const HalfOrigin& z) { return (xy[0] + xy[1]) + z[0]; };
    const double approach = dot(Dxy * Uxy, Dz * Uz);
    const double R = a.radius + b.radius;
    const double c = dot(Dxy * Dxy, Dz * Dz) - R * R;
    const double discriminant = approach * approach - dot(Uxy * Uxy, Uz * Uz) * c;
    // Both at once: the processor can predict neither alone, and most pairs fail one.
    if (static_cast<unsigned>(approach < 0) & static_cast<unsigned>(discriminant >= 0))
        return c <= 0 ? later : later + c / (std::sqrt(discriminant) - approach);
    return never;
}
inline double pairTime(const TrajectoryOrigin& a, const TrajectoryOrigin& b, const Vec3& g) {
    return pairTimeUnder<true>(a, b, g);
}
/// Without gravity: the same to the bit.
inline double pairTime(const TrajectoryOrigin& a, const TrajectoryOrigin& b) {
    return pairTimeUnder<false>(a, b, Vec3::Zero());
}

/// The same for two balls with accelerations of their own (one rests on a wall or is fixed): |D + U t + A
/// t²/2| = R is a quartic, whose first falling root is isolated between the extrema of its derivatives. Times
/// after `until` [s] are of no interest: the answer may be `never` in their place. Most pairs cannot come
/// together until then, |D| − R > |U| t + |A| t²/2, which is found out at a twentieth of the cost.
double pairTime(const TrajectoryOrigin& a, const Vec3& accelerationOfA, const TrajectoryOrigin& b,
                const Vec3& accelerationOfB, double until = never);

/// The least t > 0 at which q0 + q1 t + ... + q4 t⁴ falls through 0; 0 if it is not positive at 0 and falling
/// there; never, if there is none. q4 > 0, or the polynomial ends in a positive lower term.
double firstFallingRoot(const std::array<double, 5>& q);

} // namespace carom
