// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/contact_constraint.h"
#include "core/dynamics/state.h"

#include <limits>
#include <span>
#include <vector>

// Warm starting: the force at a point is the initial guess for the force at the same point a step later.
// Points are matched by their position on body B (on A if B is a wall), within 5 % of the size of the smaller
// body; not by the features of the narrow phase, which alternate where edges are aligned. Tangential forces
// are kept in world coordinates, since tangents turn with the normal.

namespace carom {

/// Rounding error of a gap, relative to the largest coordinate: a gap is computed from several coordinates.
/// At a quarter, bodies far from the origin that rest are taken for apart in some steps; at ten times, gaps
/// near the origin are resolved to a digit less.
inline constexpr double coordinateRounding = 4 * std::numeric_limits<double>::epsilon();

/// The coefficients of the contact law of two bodies: the smaller restitution, the geometric mean of
/// friction, the larger rolling resistance.
ContactPair pairOf(const Bodies& bodies, BodyPair pair, double margin);

/// Finds the contact of `pair` at the bodies' present poses and appends it, with the forces of `memory` where
/// it has the same points. Appends nothing where the bodies are further apart than pair.margin.
void collideInto(const Bodies& bodies, const State& state, ContactPair pair,
                 std::span<const ContactConstraint> memory, ContactSet& set);
/// The same at given poses.
void collideAt(const Bodies& bodies, const Pose& poseA, const Pose& poseB, ContactPair pair,
               std::span<const ContactConstraint> memory, ContactSet& set);

/// Appends further points of a contact, with the frame of the others: those of the rims of the pair's
/// cylinders, where these stand on the other body, towards a place in the world (narrowphase/rim_points.h).
void appendRimPoints(const Bodies& bodies, const State& state, BodyPair pair, const Mat3& frame,
                     const Vec3& towards, std::vector<ContactConstraint>& points);

} // namespace carom
