// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/narrowphase/narrowphase.h"

// The generic method: any two bounded convex shapes that can say which of their points lies furthest along a
// direction. Distance by GJK, depth by an expanding polytope; one contact point. It fills every cell of the
// pair table that has no method of its own, and checks those that have in the tests.
//
//   E. G. Gilbert, D. W. Johnson, S. S. Keerthi, "A fast procedure for computing the distance between complex
//   objects in three-dimensional space", IEEE Journal of Robotics and Automation 4 (1988);
//   G. van den Bergen, "Proximity queries and penetration depth computation on 3D game objects", GDC 2001.
//
// Deviation: the distance sub-algorithm tries every face of the simplex and keeps the nearest valid one,
// slower than Johnson's recursion but without its wrong turns in degenerate simplices. Limits: polyhedra to
// rounding; round shapes to about 1e-7 of the size, deep inside each other 1e-4 of it at worst. The special
// pairs give 1e-12.

namespace carom {

bool collideConvex(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold);
Proximity proximityConvex(const PlacedShape& a, const PlacedShape& b);

} // namespace carom
