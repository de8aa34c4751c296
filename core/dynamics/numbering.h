// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"

#include <span>
#include <vector>

// Two properties of a text that have no physical meaning: the numbers of bodies, and the origin. A method
// whose sums and sweeps depend on an order uses a canonical one, so that the order of declarations does not
// change a bit; and a scene far from the origin is computed in coordinates about an origin of its own, so
// that they have the digits that its bodies need.

namespace carom {

/// Every body once, in an order that follows from what the bodies are and where they start: walls first, then
/// from below upwards in layers, rows of these along x, and along z within a row, then by all that a
/// declaration says. Layers and rows are at most as wide as the body itself, so that those near each other
/// have numbers, and places in memory, near each other though heights differ by little. Only bodies that are
/// alike in everything, place included, are left in the order of the text.
std::vector<BodyIndex> canonicalOrder(const Scene& scene);

/// The origin that coordinates should have [m]: zero, unless everything, springs and the near parts of walls
/// included, lies within a region that is further away than `farAway` times its size. Then its middle,
/// rounded to a power of two of that size, so that subtracting it is exact.
Vec3 originNear(const Scene& scene);
/// A distance of 64 sizes takes 6 of the 53 bits of a coordinate. At twice that 7 would be lost; at half,
/// scenes whose text begins at an origin somewhat beside them would be moved for one bit.
inline constexpr double farAway = 64;

/// Whether springs stand in an order that does not depend on that of their declarations.
bool areInOrder(const std::vector<SpringForce>& springs);

/// The same bodies under new numbers (body order[k] becomes k; springs come in a canonical order, too) with
/// coordinates from `origin` on. Its own `order` ascends and its `origin` is zero.
Bodies renumbered(const Bodies& bodies, std::span<const BodyIndex> order, const Vec3& origin);

} // namespace carom
