// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/narrowphase/narrowphase.h"

// The region in which a cylinder stands on a plane surface is bounded by an arc, of which a manifold holds a
// few points. A body that would turn about the chord between two of them is held by the arc beyond it:
//
//            .--'''--.
//          .'         '.        o  points of the manifold
//         o             o       x  another of the arc
//          \           /
//           '.       .x
//             '--o--'

namespace carom {

/// Adds to `manifold` the points of the rims of A's and B's caps that lie from the cap's centre towards a
/// place (in world), where the caps are turned to each other's shape along the manifold's normal and the
/// points lie over a cap, a face or a wall.
void addRimPoints(const PlacedShape& a, const PlacedShape& b, const Vec3& towards, Manifold& manifold);

} // namespace carom
