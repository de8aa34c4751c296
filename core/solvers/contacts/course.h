// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/aabb.h"
#include "core/math/types.h"

#include <algorithm>

namespace carom {

/// How a body is expected to go on: straight ahead until `ends`, where it then stays.
struct Course {
    Vec3 place = Vec3::Zero();    ///< when it begins [m]
    Vec3 velocity = Vec3::Zero(); ///< [m/s]
    double begins = 0, ends = 0;  ///< [s]

    Vec3 placeAt(double time) const { return place + (std::min(time, ends) - begins) * velocity; }
    Vec3 velocityAt(double time) const { return time < ends ? velocity : Vec3::Zero(); }
};

/// Whether two courses come within `distance` [m] of each other at `time` [s] or later.
inline bool doMeet(const Course& a, const Course& b, double time, double distance) {
    const double within = distance * distance;
    Vec3 between = b.placeAt(time) - a.placeAt(time);
    if (between.squaredNorm() <= within) return true;
    for (const double end : {std::min(a.ends, b.ends), std::max(a.ends, b.ends)}) {
        if (!(end > time)) continue;
        const Vec3 velocity = b.velocityAt(time) - a.velocityAt(time);
        const double square = velocity.squaredNorm(), approach = -between.dot(velocity);
        if (approach > 0) {
            const Vec3 nearest = between + std::min(approach / square, end - time) * velocity;
            if (nearest.squaredNorm() <= within) return true;
        }
        between += (end - time) * velocity;
        time = end;
    }
    return false;
}

/// The box around all places of a box that moves by `shift` [m].
inline Aabb swept(const Aabb& box, const Vec3& shift) {
    return {box.lower + shift.cwiseMin(0), box.upper + shift.cwiseMax(0)};
}

} // namespace carom
