// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/narrowphase/solid.h"

#include <cstdint>

// A quick way to the contact of two cylinders or cuboids that overlap by little. The gap along any direction
// is a lower bound of the signed distance (axis_search.h), so the direction of the contact is that of the
// largest. First those are tried that are exact where features meet squarely: across a face, across two
// edges, across the side of a cylinder to the rim of another. One is proven where two points of the shapes
// lie straight across from each other along it; that ends the search, as it does for nine in ten contacts of
// a heap of cylinders.
//
// Otherwise the direction is that in which the cores are nearest: the shapes less a rim of a twentieth of
// their smallest dimension. Cores of bodies that rest on each other are apart, so GJK finds it (G. van den
// Bergen, "Collision Detection in Interactive 3D Environments", 2003, chapter 4.3).
//
// Limits: where a rim meets an edge or another rim the direction is that of the cores. The gap along it is
// too small by (√3 − 1) (rA + rB) at most, with the rims rA and rB, which is .037 of the smallest half
// dimensions of both together; among random near pairs by less than 6e-4 of the size for nine in ten. Cores
// that overlap are left to the exact method.

namespace carom {

/// What a direction of contact is across.
struct DirectionSource {
    enum class Kind : std::uint8_t {
        Other, ///< whatever the cores say
        FaceA, ///< a face of A
        FaceB,
        Edges, ///< an edge of each; of a cylinder its axis
        SideA, ///< the side of cylinder A, where it meets a rim of cylinder B
        SideB
    };
    Kind kind = Kind::Other;
    std::uint8_t edgeA = 0,
                 edgeB = 0; ///< along which axes of the bodies the edges are, or across which the face is
};

/// The direction from A to B that two solids have now for a contact that was across such a source, near
/// `before`, which is unit.
Vec3 followedDirection(const Solid& a, const Solid& b, DirectionSource source, const Vec3& before);

/// Whether both shapes are cylinders or cuboids.
inline bool haveCores(const Shape& a, const Shape& b) { return isSolid(a) && isSolid(b); }

/// As carom::collide, for two solids seen from `origin`, which is best near them: the points are computed
/// there. `guess` is a unit vector from A to B, or any. False, and nothing is found, where it takes the exact
/// method.
bool findByCores(const Solid& a, const Solid& b, const Vec3& origin, const Vec3& guess, double margin,
                 Manifold& manifold, DirectionSource& source);

} // namespace carom
