// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/pose.h"
#include "core/shapes/manifold.h"
#include "core/shapes/shape.h"

#include <cstdint>

// The narrow phase answers for two shapes: do they come closer than a margin, and where? Shapes are round
// where they are round: a cylinder is never a polygon.

namespace carom {

/// A shape where it is; what every pair kernel takes. `shape` must outlive the call.
struct PlacedShape {
    const Shape* shape = nullptr;
    const Pose* pose = nullptr; ///< ignored for walls
};

/// Fills `manifold` with the contact of A and B if their distance is at most `margin` [m] (>= 0; 0 finds only
/// touching and overlapping shapes), and says whether it did; otherwise manifold.count = 0
/// and, for cylinders and cuboids, manifold.normal is a direction along which they are further apart than
/// that. Overlapping shapes always give at least one point; normal from A to B; exchanging A and B gives the
/// same points and the opposite normal, bit for bit. Two walls never collide.
bool collide(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold);

/// The signed distance of two shapes [m] with its witness points: positive apart, negative overlapping (minus
/// the least translation that parts them). The normal runs from A to B.
struct Proximity {
    double distance = 0;
    Vec3 normal = Vec3::UnitY();
    Vec3 onA = Vec3::Zero();
    Vec3 onB = Vec3::Zero();
};
/// Two walls are infinitely far apart.
Proximity proximityOf(const PlacedShape& a, const PlacedShape& b);

/// The same seen from the other side.
inline Proximity flipped(const Proximity& found) {
    return {found.distance, -found.normal, found.onB, found.onA};
}

} // namespace carom
