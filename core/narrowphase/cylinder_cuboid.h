// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/narrowphase/axis_search.h"

// A cylinder (A) and a cuboid (B) in any poses. Derivation in the .cpp.

namespace carom {

bool collideCylinderCuboid(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold);
Proximity proximityCylinderCuboid(const PlacedShape& a, const PlacedShape& b);

} // namespace carom
