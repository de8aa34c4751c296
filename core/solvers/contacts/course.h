// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/aabb.h"
#include "core/math/types.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

/// How a body is expected to go on: straight ahead until `ends`, where it then stays. Read by four doubles at
/// a time (meetings.cpp).
struct alignas(32) Course {
    Vec3 place = Vec3::Zero();    ///< when it begins [m]
    Vec3 velocity = Vec3::Zero(); ///< [m/s]
    double begins = 0, ends = 0;  ///< [s]

    Vec3 placeAt(double time) const { return place + (std::min(time, ends) - begins) * velocity; }
    Vec3 velocityAt(double time) const { return time < ends ? velocity : Vec3::Zero(); }
};

/// The first and the last time of something [s].
struct TimeSpan {
    double from = std::numeric_limits<double>::infinity(), until = -std::numeric_limits<double>::infinity();

    bool isEmpty() const { return from > until; }
    void include(double first, double last) {
        from = std::min(from, first);
        until = std::max(until, last);
    }
};

/// When two courses are within `distance` [m] of each other, at `time` [s] or later; in between they may be
/// further apart, as each may end. While neither does, the square of their distance is a convex parabola.
inline TimeSpan meetingOf(const Course& a, const Course& b, double time, double distance) {
    const double within = distance * distance;
    TimeSpan meeting;
    Vec3 between = b.placeAt(time) - a.placeAt(time);
    double excess = between.squaredNorm() - within;
    for (const double end : {std::min(a.ends, b.ends), std::max(a.ends, b.ends)}) {
        if (!(end > time)) continue;
        const Vec3 velocity = b.velocityAt(time) - a.velocityAt(time);
        const Vec3 then = between + (end - time) * velocity;
        const double excessThen = then.squaredNorm() - within;
        const double square = velocity.squaredNorm(), approach = -between.dot(velocity);
        const double discriminant = approach * approach - square * excess;
        const bool isInside = approach > 0 && approach < square * (end - time) && discriminant >= 0;
        if (excess <= 0 || excessThen <= 0 || isInside) {
            const double root = std::sqrt(std::max(0.0, discriminant));
            meeting.include(excess <= 0 ? time : time + (approach - root) / square,
                            excessThen <= 0 ? end : time + (approach + root) / square);
        }
        between = then;
        excess = excessThen;
        time = end;
    }
    if (excess <= 0) meeting.include(time, std::numeric_limits<double>::infinity());
    return meeting;
}

/// The first time within `duration` [s] at which something that is `between` away [m] and moves by `velocity`
/// [m/s] is within `distance` [m]; infinite if there is none.
inline double firstWithin(const Vec3& between, const Vec3& velocity, double duration, double distance) {
    const double excess = between.squaredNorm() - distance * distance;
    if (excess <= 0) return 0;
    const double approach = -between.dot(velocity), square = velocity.squaredNorm();
    const double discriminant = approach * approach - square * excess;
    if (!(approach > 0) || !(discriminant >= 0)) return std::numeric_limits<double>::infinity();
    const double time = excess / (approach + std::sqrt(discriminant)); // without cancellation
    return time <= duration ? time : std::numeric_limits<double>::infinity();
}

/// Whether a box that moves by `shift` [m] touches the other on the way.
inline bool meetOnTheWay(const Aabb& moving, const Aabb& other, const Vec3& shift) {
    double from = 0, until = 1; // parts of the way
    for (int k = 0; k < 3; ++k) {
        const double below = other.lower[k] - moving.upper[k], above = other.upper[k] - moving.lower[k];
        if (shift[k] == 0) {
            if (below > 0 || above < 0) return false;
            continue;
        }
        from = std::max(from, std::min(below / shift[k], above / shift[k]));
        until = std::min(until, std::max(below / shift[k], above / shift[k]));
    }
    return from <= until;
}

/// The box around all places of a box that moves by `shift` [m].
inline Aabb swept(const Aabb& box, const Vec3& shift) {
    return {box.lower + shift.cwiseMin(0), box.upper + shift.cwiseMax(0)};
}

} // namespace carom
