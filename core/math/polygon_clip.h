// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>

namespace carom {

using Vec2 = Eigen::Vector2d;

/// A corner of a convex polygon that is clipped, with identifiers that clipping keeps.
struct ClipCorner {
    Vec2 point = Vec2::Zero();
    std::uint32_t name = 0; ///< of the corner: which corner it was, or which two sides cross there
    std::uint32_t side = 0; ///< of the side from this corner to the next
};

/// A convex polygon of at most eight corners: what two quadrilaterals can share.
struct ClipPolygon {
    static constexpr std::size_t capacity = 8;
    std::array<ClipCorner, capacity> corners;
    std::size_t count = 0;

    void add(const ClipCorner& corner) {
        if (count < capacity) corners[count++] = corner;
    }
};

/// The half-plane { x : inward·x >= offset }, inward a unit vector, with the name of its boundary.
struct HalfPlane {
    Vec2 inward = Vec2::UnitX();
    double offset = 0;
    std::uint32_t side = 0;

    double depthOf(const Vec2& point) const { return inward.dot(point) - offset; }
};

/// Leaves the part of the polygon inside the half-plane: I. E. Sutherland, G. W. Hodgman, "Reentrant polygon
/// clipping", Communications of the ACM 17 (1974). Corners outside by no more than `slack` [m] count as
/// inside, so polygons with sides on one line do not gain and lose corners by rounding.
void clip(ClipPolygon& polygon, const HalfPlane& half, double slack);

} // namespace carom
