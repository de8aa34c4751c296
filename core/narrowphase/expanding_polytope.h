// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/narrowphase/minkowski.h"

#include <span>

namespace carom {

/// The boundary point nearest the origin of a Minkowski difference that contains the origin (or touches it):
/// a polytope inside the difference grows, each time by the furthest point beyond its face nearest the
/// origin, until that face cannot move outwards any more.
struct PolytopeFace {
    Vec3 outward = Vec3::UnitY(); ///< unit
    double distance = 0;          ///< of the face from the origin [m], the depth
    Vec3 onA = Vec3::Zero();      ///< relative to A's centre [m]
    Vec3 onB = Vec3::Zero();
};
/// `simplex`: up to four points of the difference near the origin, where GJK ended.
PolytopeFace nearestFace(const MinkowskiDifference& difference, std::span<const DifferencePoint> simplex);

} // namespace carom
