// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/wall_pairs.h"

#include "core/base/wide.h"
#include "core/math/rotation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
namespace {

// A lean that lowers the rim by less than this part of the radius counts as standing flat: far above rounding
// (1e-16), far below any lean that matters, and the four fixed points are then as deep as the lowest. At a
// millionth, rounding lets a cylinder that stands seem to lean; at a million times, the points of one that
// leans visibly would not be its lowest.
constexpr double flatLean = 1e-10;

// A cylinder above a wall. Heights are signed distances from the wall.
struct CylinderOverWall {
    Vec3 axis;      // unit, turned so that it does not point into the wall
    Vec3 down;      // unit, in the cap plane towards the wall; any such where the cap is parallel to it
    double cosine;  // of the angle between axis and wall normal, >= 0
    double sine;    // of the same angle
    double low;     // height of the lowest rim point [m]
    double lowCap;  // height of the centre of the lower cap [m]
    Vec3 capCentre; // of the lower cap
    bool turned;    // the axis is minus the body's own
};

CAROM_INLINE CylinderOverWall measure(const Wall& wall, const Cylinder& cylinder, const Pose& pose) {
    CylinderOverWall result;
    result.axis = axisOf(pose);
    result.cosine = wall.normal.dot(result.axis);
    result.turned = result.cosine < 0;
    if (result.turned) {
        result.axis = -result.axis;
        result.cosine = -result.cosine;
    }
    // normal − (normal·axis) axis, by the cross product: its length keeps full precision near zero.
    const Vec3 inCap = result.axis.cross(wall.normal).cross(result.axis);
    result.sine = inCap.norm();
    result.down = result.sine > 0 ? Vec3(-inCap / result.sine) : tangentsOf(result.axis).first;
    result.capCentre = pose.position - cylinder.halfHeight * result.axis;
    result.lowCap = distanceTo(wall, pose.position) - cylinder.halfHeight * result.cosine;
    result.low = result.lowCap - cylinder.radius * result.sine;
    return result;
}

// Adds the point of B at `height` above the wall.
void addAbove(const Wall& wall, const Vec3& onB, double height, std::uint32_t feature, Manifold& manifold) {
    manifold.add({onB - height * wall.normal, onB, height, feature});
}

std::array<Vec3, 4> restingDirections(const Wall& wall, const Vec3& axis) {
    const Vec3 along = tangentsOf(wall.normal).first;
    const Vec3 first = (along - along.dot(axis) * axis).normalized();
    const Vec3 second = axis.cross(first);
    return {first, second, -first, -second};
}

int mostAlignedAxis(const Vec3& direction) {
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(direction[i]) > std::abs(direction[axis])) axis = i;
    return axis;
}

} // namespace

CAROM_WIDE bool collideWallCylinder(const PlacedShape& a, const PlacedShape& b, double margin,
                                    Manifold& manifold) {
    const Wall& wall = *std::get_if<Wall>(a.shape);
    const Cylinder& cylinder = *std::get_if<Cylinder>(b.shape);
    const CylinderOverWall over = measure(wall, cylinder, *b.pose);
    if (!(over.low <= margin)) return false;
    manifold.normal = wall.normal;

    enum Feature : std::uint32_t { Resting = 0, Lowest = 4, Line = 5, AboveCap = 8 };
    const std::uint32_t cap = over.turned ? AboveCap : 0U;
    const Vec3 lowest = over.capCentre + cylinder.radius * over.down;
    const bool standing = cylinder.radius * over.sine < cylinder.halfHeight * over.cosine;
    if (!standing) {
        addAbove(wall, lowest, over.low, Line | cap, manifold);
        const double height = over.low + 2 * cylinder.halfHeight * over.cosine;
        if (height <= margin)
            addAbove(wall, lowest + 2 * cylinder.halfHeight * over.axis, height, Line | (cap ^ AboveCap),
                     manifold);
        return true;
    }
    double deepest = std::numeric_limits<double>::infinity();
    const std::array<Vec3, 4> directions = restingDirections(wall, over.axis);
    for (std::uint32_t i = 0; i < 4; ++i) {
        const double height = over.lowCap + cylinder.radius * wall.normal.dot(directions[i]);
        if (height > margin) continue;
        addAbove(wall, over.capCentre + cylinder.radius * directions[i], height, (Resting + i) | cap,
                 manifold);
        deepest = std::min(deepest, height);
    }
    if (over.low < deepest - flatLean * cylinder.radius)
        addAbove(wall, lowest, over.low, Lowest | cap, manifold);
    return true;
}

CAROM_WIDE bool collideWallCuboid(const PlacedShape& a, const PlacedShape& b, double margin,
                                  Manifold& manifold) {
    const Wall& wall = *std::get_if<Wall>(a.shape);
    const Cuboid& cuboid = *std::get_if<Cuboid>(b.shape);
    const Vec3 normalInBody = b.pose->directionToBody(wall.normal);
    const Vec3 heights = cuboid.halfSize.cwiseProduct(normalInBody); // what a step to a face adds
    const double centre = distanceTo(wall, b.pose->position);
    if (!(centre - heights.cwiseAbs().sum() <= margin)) return false;
    manifold.normal = wall.normal;

    const int across = mostAlignedAxis(normalInBody);
    const bool lowIsAbove = normalInBody[across] < 0; // which end of that axis is near the wall
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const Vec3 sign((corner & 1U) != 0 ? 1 : -1, (corner & 2U) != 0 ? 1 : -1,
                        (corner & 4U) != 0 ? 1 : -1);
        if ((sign[across] > 0) != lowIsAbove) continue;
        const double height = centre + sign.dot(heights);
        if (height <= margin)
            addAbove(wall, b.pose->toWorld(sign.cwiseProduct(cuboid.halfSize)), height, corner, manifold);
    }
    return manifold.count > 0;
}

Proximity proximityWallCylinder(const PlacedShape& a, const PlacedShape& b) {
    const Wall& wall = *std::get_if<Wall>(a.shape);
    const Cylinder& cylinder = *std::get_if<Cylinder>(b.shape);
    const CylinderOverWall over = measure(wall, cylinder, *b.pose);
    const Vec3 lowest = over.capCentre + cylinder.radius * over.down;
    return {over.low, wall.normal, lowest - over.low * wall.normal, lowest};
}

Proximity proximityWallCuboid(const PlacedShape& a, const PlacedShape& b) {
    const Wall& wall = *std::get_if<Wall>(a.shape);
    const Cuboid& cuboid = *std::get_if<Cuboid>(b.shape);
    const Vec3 normalInBody = b.pose->directionToBody(wall.normal);
    const double low =
        distanceTo(wall, b.pose->position) - cuboid.halfSize.cwiseProduct(normalInBody).cwiseAbs().sum();
    const Vec3 lowest = b.pose->toWorld(supportOf(cuboid, -normalInBody));
    return {low, wall.normal, lowest - low * wall.normal, lowest};
}

bool collideNever(const PlacedShape& /*a*/, const PlacedShape& /*b*/, double /*margin*/, Manifold& manifold) {
    manifold.count = 0;
    return false;
}

Proximity proximityNever(const PlacedShape& /*a*/, const PlacedShape& /*b*/) {
    Proximity apart;
    apart.distance = std::numeric_limits<double>::infinity();
    return apart;
}

} // namespace carom
