// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/contacts/manifolds.h"

#include <span>

// What becomes of the forces of a contact whose points are found anew.

namespace carom {

/// Gives new points of a contact of `pair` the forces of the old ones: each that of the nearest, and where
/// one is left, all together in another distribution. Places on B are in its frame, or in the world on a
/// wall; forces and the normal, from A to B, in the world.
void takeOver(const ManifoldInput& input, BodyPair pair, std::span<const CarriedPoint> old,
              const Vec3& normal, std::span<CarriedPoint> fresh);
/// Distributes the force of the old points among the new ones, so that the pair's force and moment stay the
/// same.
void shareOut(const ManifoldInput& input, BodyPair pair, std::span<const CarriedPoint> old,
              const Vec3& normal, std::span<CarriedPoint> fresh);

} // namespace carom
