// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/types.h"

#include <limits>

namespace carom {

/// Two circles in space, the rims of two caps.
struct RimPair {
    Vec3 axisA, axisB;       ///< unit normals of their planes
    double radiusA, radiusB; ///< [m]
    Vec3 offset;             ///< from A's centre to B's [m]
};

/// A unit direction n with the gap between the projections of both discs along it,
///
///     F(n) = offset·n − rA |n × a| − rB |n × b|
struct RimGap {
    Vec3 normal = Vec3::UnitY();
    double gap = 0; ///< F(n) [m]
};

/// From unit `start` to a local maximum of F, or until F exceeds `enough` [m],
///
/// by Newton's method on the sphere, safeguarded: F never decreases. Gradient: the vector W between the
/// rims' points furthest towards each other, made tangent. Hessian in the tangent plane:
///
///     −(rA / |n × a|) tA tAᵀ − (rB / |n × b|) tB tBᵀ − F 1,     tA, tB tangents of the rims at those points
///
/// If the discs are apart (F > 0 somewhere) F has a single maximum and every start leads to it.
RimGap climb(const RimPair& rims, const Vec3& start, double enough = std::numeric_limits<double>::infinity());

/// F(n) [m].
double gapAlong(const RimPair& rims, const Vec3& n);

/// Whether this is certainly where F is greatest: F(n) > 0 and the rims have points F(n) apart, straight
/// across.
bool isGreatestGap(const RimPair& rims, const RimGap& found);

} // namespace carom
