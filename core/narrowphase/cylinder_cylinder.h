// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/narrowphase/axis_search.h"

// Two cylinders at any angle. Sources and derivation in the .cpp.

namespace carom {

bool collideCylinderCylinder(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold);
Proximity proximityCylinderCylinder(const PlacedShape& a, const PlacedShape& b);

struct AxisOfCylinder {
    const Cylinder& cylinder;
    const Vec3& axis; ///< unit
};
/// The direction across the axis `side` of one cylinder along which it is furthest from a rim of the other,
/// or overlaps it least. `offset` [m] from A's centre to B's, whichever of them the one is; unit x across
/// both axes.
Vec3 sideToRim(const Vec3& side, const AxisOfCylinder& other, const Vec3& offset, const Vec3& x);

} // namespace carom
