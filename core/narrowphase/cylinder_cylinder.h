// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/narrowphase/axis_search.h"

// Two cylinders at any angle. Sources and derivation in the .cpp.

namespace carom {

bool collideCylinderCylinder(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold);
Proximity proximityCylinderCylinder(const PlacedShape& a, const PlacedShape& b);

} // namespace carom
