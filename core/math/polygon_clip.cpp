// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/polygon_clip.h"

#include "core/base/wide.h"

#include <algorithm>

namespace carom {
namespace {

// Two crossing sides name a corner; original corners have names below this.
std::uint32_t crossingName(std::uint32_t sideOfPolygon, std::uint32_t sideOfHalfPlane) {
    return 16 + 8 * sideOfPolygon + sideOfHalfPlane;
}

} // namespace

CAROM_WIDE void clip(ClipPolygon& polygon, const HalfPlane& half, double slack) {
    const std::size_t count = polygon.count;
    std::array<double, ClipPolygon::capacity> depths;
    double least = 0;
    for (std::size_t i = 0; i < count; ++i) {
        depths[i] = half.depthOf(polygon.corners[i].point);
        least = std::min(least, depths[i]);
    }
    if (least >= -slack) return; // the usual case of a face on a larger one
    const ClipPolygon whole = polygon;
    polygon.count = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t k = i + 1 < count ? i + 1 : 0;
        const ClipCorner &here = whole.corners[i], &next = whole.corners[k];
        const bool isInside = depths[i] >= -slack;
        if (isInside) polygon.add(here);
        if (isInside == (depths[k] >= -slack)) continue;
        const double part = std::clamp(depths[i] / (depths[i] - depths[k]), 0.0, 1.0);
        polygon.add({here.point + part * (next.point - here.point), crossingName(here.side, half.side),
                     isInside ? half.side : here.side});
    }
}

} // namespace carom
