// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/narrowphase/axis_search.h"

// Two cuboids: the fifteen separating axes of S. Gottschalk, M. C. Lin, D. Manocha, "OBBTree" (SIGGRAPH 1996)
// give the depth; apart, the nearest corner and face or edge and edge give the distance.

namespace carom {

bool collideCuboidCuboid(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold);
Proximity proximityCuboidCuboid(const PlacedShape& a, const PlacedShape& b);

} // namespace carom
