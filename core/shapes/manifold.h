// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/types.h"

#include <array>
#include <cstdint>

// The sign conventions of contact, in one place:
//
//     the normal is a unit vector that points from A to B
//     separation = normal · (onB − onA); negative separation is overlap, depth = −separation
//
//        A ___                 ___ B            A ________
//             \ onA --n--> onB /                    onB<--|--.onA      overlap: onA lies inside B,
//          ___/   separation   \___             _________|__|  B                  onB inside A

namespace carom {

struct ContactPoint {
    Vec3 onA = Vec3::Zero();   ///< witness point on A's surface [m], world
    Vec3 onB = Vec3::Zero();   ///< witness point on B's surface [m], world
    double separation = 0;     ///< [m], negative where they overlap
    std::uint32_t feature = 0; ///< which features touch; equal in two frames if it is the same contact
};

/// Where two convex bodies touch or nearly touch: one normal, up to eight points.
struct Manifold {
    static constexpr int capacity = 8;

    Vec3 normal = Vec3::UnitY(); ///< unit, from A to B, world
    std::array<ContactPoint, capacity> points;
    int count = 0;

    void add(const ContactPoint& point) {
        if (count < capacity) points[static_cast<std::size_t>(count++)] = point;
    }
    const ContactPoint* begin() const { return points.data(); }
    const ContactPoint* end() const { return points.data() + count; }
    /// The point with the least separation (the first of equals); count > 0.
    const ContactPoint& deepest() const {
        const ContactPoint* deepest = begin();
        for (const ContactPoint& point : *this)
            if (point.separation < deepest->separation) deepest = &point;
        return *deepest;
    }
};

/// The same contact seen from the other side: A and B exchanged.
inline void flip(Manifold& manifold) {
    manifold.normal = -manifold.normal;
    for (int i = 0; i < manifold.count; ++i) {
        ContactPoint& point = manifold.points[static_cast<std::size_t>(i)];
        point.onA.swap(point.onB);
    }
}

} // namespace carom
