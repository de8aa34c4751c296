// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/types.h"

namespace carom {

/// Two circles in space, the rims of two caps.
struct RimPair {
    Vec3 axisA, axisB;       ///< unit normals of their planes
    double radiusA, radiusB; ///< [m]
    Vec3 offset;             ///< from A's centre to B's [m]
};

/// From unit `start` to a local maximum, over unit n, of the gap between the projections of two discs,
///
///     F(n) = offset·n − rA |n × a| − rB |n × b|
///
/// by Newton's method on the sphere, safeguarded: F never decreases. Gradient: the vector W between the
/// rims' points furthest towards each other, made tangent. Hessian in the tangent plane:
///
///     −(rA / |n × a|) tA tAᵀ − (rB / |n × b|) tB tBᵀ − F 1,     tA, tB tangents of the rims at those points
///
/// If the discs are apart (F > 0 somewhere) F has a single maximum and every start leads to it.
Vec3 climb(const RimPair& rims, const Vec3& start);

/// F(n), see above [m].
double gapAlong(const RimPair& rims, const Vec3& n);

/// Whether n is certainly where F is greatest: F(n) > 0 and the rims have points F(n) apart, straight across.
bool isGreatestGap(const RimPair& rims, const Vec3& n);

} // namespace carom
