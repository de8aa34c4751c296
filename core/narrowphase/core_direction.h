// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/narrowphase/narrowphase.h"

// A quick way to the contact of two cylinders or cuboids that overlap by little. The direction of the contact
// is that in which their cores are nearest: the shapes less a rim of a twentieth of their smallest dimension.
// Cores of bodies that rest on each other are apart, so GJK finds it, in a step or two from a direction that
// was right a moment ago (G. van den Bergen, "Collision Detection in Interactive 3D Environments", 2003,
// chapter 4.3). Directions that are exact where features meet squarely (a face, an axis, across both axes)
// are tried beside it, and the one with the largest gap is taken: the gap along any direction is a lower
// bound of the signed distance (axis_search.h).
//
// Limits: where a rim meets an edge or a rim the direction is that of the cores. The gap along it is too
// small by (√3 − 1) (rA + rB) at most, with the rims rA and rB, which is .037 of the smallest half dimensions
// of both together; among random near pairs by less than 6e-4 of the size for nine in ten. Cores that overlap
// are left to the exact method.

namespace carom {

/// Whether both shapes are cylinders or cuboids.
bool haveCores(const Shape& a, const Shape& b);

/// As carom::collide, for shapes that have cores. `guess` is a unit vector from A to B, or any.
bool collideCores(const PlacedShape& a, const PlacedShape& b, const Vec3& guess, double margin,
                  Manifold& manifold);

} // namespace carom
