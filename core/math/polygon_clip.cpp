// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/polygon_clip.h"

#include <algorithm>

namespace carom {
namespace {

// Two crossing sides name a corner; original corners have names below this.
std::uint32_t crossingName(std::uint32_t sideOfPolygon, std::uint32_t sideOfHalfPlane) {
    return 16 + 8 * sideOfPolygon + sideOfHalfPlane;
}

} // namespace

ClipPolygon clipped(const ClipPolygon& polygon, const HalfPlane& half, double slack) {
    ClipPolygon result;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const ClipCorner& here = polygon.corners[i];
        const ClipCorner& next = polygon.corners[(i + 1) % polygon.count];
        const double depthHere = half.depthOf(here.point);
        const double depthNext = half.depthOf(next.point);
        const bool isInside = depthHere >= -slack;
        const bool nextInside = depthNext >= -slack;
        if (isInside) result.add(here);
        if (isInside == nextInside) continue;
        const double part = std::clamp(depthHere / (depthHere - depthNext), 0.0, 1.0);
        result.add({here.point + part * (next.point - here.point), crossingName(here.side, half.side),
                    isInside ? half.side : here.side});
    }
    return result;
}

} // namespace carom
