// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/narrowphase/narrowphase.h"

// Which method answers for which pair of kinds. The table is square and complete, and every cell has a
// method of its own; a new shape can start with the generic one (convex.h) in its whole row and column.

namespace carom {

/// The two questions a pair answers, see narrowphase.h for what they mean. A and B must be of the kinds of
/// the cell, in its order.
struct PairMethods {
    bool (*collide)(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold) = nullptr;
    Proximity (*proximity)(const PlacedShape& a, const PlacedShape& b) = nullptr;
};

const PairMethods& pairMethods(ShapeKind a, ShapeKind b);

/// A deterministic geometric order of two placed shapes of one kind (by size, then position, then
/// orientation). Kernels that are not symmetric by construction work in this order and flip the answer, so
/// exchanging A and B changes no bit. Only identical placements have no order; then true.
bool inOrder(const PlacedShape& a, const PlacedShape& b);

} // namespace carom
