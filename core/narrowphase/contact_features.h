// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/narrowphase/axis_search.h"
#include "core/narrowphase/solid.h"

#include <array>

// From the normal of a contact to its points. Each shape has a flat or straight feature towards the other: a
// cuboid one of its faces, a cylinder a cap or a line of its side. Projected along the normal the two overlap
// in a region; its corners are the contact's points, and their separations are measured along the normal
// between the two features:
//
//               n ^     ____________
//                 |    |     B      |          feature of B: its lower face
//                 |    '------------'
//                 |         o-------o          the region, seen from the side, and its corners
//                      ____________
//                     |     A      |           feature of A: its upper face
//
// Neither feature is the reference face, so the points do not change abruptly where two features are equally
// good, and the least separation in the region is the distance along the normal itself. Where rounding
// excludes the nearest points from the region (a corner on an edge, two rims) they are added.

namespace carom {

/// The feature of a shape towards a direction.
struct ContactFeature {
    enum class Kind { Line, Face, Disc };
    Kind kind = Kind::Line;
    std::array<Vec3, 4> corners{}; ///< of a face, in order round it; the ends of a line first [m]
    Vec3 centre = Vec3::Zero();    ///< of a face or disc; of the cylinder a line belongs to [m]
    Vec3 normal = Vec3::UnitY();   ///< unit, outward: of a face or disc
    double radius = 0;             ///< of a disc, or of the cylinder a line belongs to [m]
    std::uint32_t name = 0;        ///< which of the shape's features of that kind
};

/// The feature that is flattest across `n`.
ContactFeature featureTowards(const Solid& solid, const Vec3& n);

/// The contact of A and B (each a cylinder or a cuboid), given the direction in which they are furthest apart
/// or overlap least. At least one point; those further apart than `margin` [m] are left out. The solids are
/// seen from `origin`, which is best near them: the points are computed there.
void fillManifold(const Solid& a, const Solid& b, const Vec3& origin, const BestAxis& axis, double margin,
                  Manifold& manifold);
void fillManifold(const PlacedShape& a, const PlacedShape& b, const BestAxis& axis, double margin,
                  Manifold& manifold);

/// The same direction with one pair of nearest points (of deepest points, if they overlap).
Proximity witnessesAlong(const PlacedShape& a, const PlacedShape& b, const BestAxis& axis);

} // namespace carom
