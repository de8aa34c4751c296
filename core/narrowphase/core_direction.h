// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/narrowphase/solid.h"

#include <cstdint>

// A fast method for the contact of two cylinders or cuboids that overlap by little. The gap along any
// direction is a lower bound of the signed distance (axis_search.h), so the contact normal is the direction
// of the largest gap. First the directions are tried that are exact for flat contacts: perpendicular to a
// face, to two edges, or to the side of a cylinder and the rim of another. A direction is proven where two
// points of the shapes are opposite each other along it; that ends the search for nine in ten contacts of a
// heap of cylinders.
//
// Otherwise the normal is the direction in which the cores are nearest: the shapes reduced by a margin of a
// twentieth of their smallest dimension. Cores of bodies that rest on each other are apart, so GJK finds it
// (G. van den Bergen, "Collision Detection in Interactive 3D Environments", 2003, chapter 4.3).
//
// Limits: where a rim meets an edge or another rim the direction is that of the cores. The gap along it is
// too small by (√3 − 1) (mA + mB) at most, with the margins mA and mB, which is 0.037 of the smallest half
// dimensions of both together; among random near pairs by less than 6e-4 of the size for nine in ten. Cores
// that overlap are left to the exact method.

namespace carom {

/// The features to which a contact normal is perpendicular.
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
