// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/types.h"

namespace carom {

/// The straight line between two points [m].
struct Segment {
    Vec3 from = Vec3::Zero();
    Vec3 to = Vec3::Zero();

    Vec3 at(double part) const { return from + part * (to - from); }
};

/// The nearest points of two segments; `partA`, `partB` say where on each, 0 at `from`, 1 at `to`.
struct SegmentPair {
    double partA = 0, partB = 0;
    Vec3 onA = Vec3::Zero(), onB = Vec3::Zero();
};
/// V. J. Lumelsky, "On fast computation of distance between line segments", Information Processing Letters 21
/// (1985). Parallel segments, of which many pairs of points are nearest, give one of them; a segment may be a
/// point.
SegmentPair nearestPoints(const Segment& a, const Segment& b);

} // namespace carom
