// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/narrowphase/narrowphase.h"

// A wall (A) against a cylinder or a cuboid (B), in closed form. The normal is the wall's, and the least
// translation that parts them is along it, so the deepest point is the support point against the normal.

namespace carom {

/// A standing cylinder gives four points of its lower rim that lie in directions fixed to the wall, so they
/// stay where they are while the cylinder spins, and its lowest rim point besides if it leans; a lying one
/// the two ends of its lowest line.
bool collideWallCylinder(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold);
/// The corners, within the margin, of the face that looks most towards the wall.
bool collideWallCuboid(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold);

Proximity proximityWallCylinder(const PlacedShape& a, const PlacedShape& b);
Proximity proximityWallCuboid(const PlacedShape& a, const PlacedShape& b);

/// Two walls: immobile both, never a contact.
bool collideNever(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold);
Proximity proximityNever(const PlacedShape& a, const PlacedShape& b);

} // namespace carom
