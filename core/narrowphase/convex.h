// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/narrowphase/narrowphase.h"

// The generic method, for any two bounded convex shapes that have a support function. Distance by GJK, depth
// by an expanding polytope; one contact point. It serves every pair of shapes without a method of its own,
// and in the tests checks those that have one.
//
//   E. G. Gilbert, D. W. Johnson, S. S. Keerthi, "A fast procedure for computing the distance between complex
//   objects in three-dimensional space", IEEE Journal of Robotics and Automation 4 (1988);
//   G. van den Bergen, "Proximity queries and penetration depth computation on 3D game objects", GDC 2001.
//
// Deviation: the distance sub-algorithm tries every face of the simplex and keeps the nearest valid one,
// slower than Johnson's recursion but not subject to its errors in degenerate simplices. Limits: polyhedra to
// rounding; round shapes to about 1e-7 of the size, deep inside each other 1e-4 of it at worst. The special
// pairs give 1e-12.

namespace carom {

bool collideConvex(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold);
Proximity proximityConvex(const PlacedShape& a, const PlacedShape& b);

} // namespace carom
