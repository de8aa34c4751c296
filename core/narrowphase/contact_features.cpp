// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/contact_features.h"

#include "core/base/assert.h"
#include "core/narrowphase/contact_region.h"
#include "core/narrowphase/point_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
namespace {

// Features that miss each other by less than this part of the size touch, and a region whose least separation
// is this near the true one holds the nearest points. Rounding is 1e-15; below 1e-12 sides on one line would
// come and go, above 1e-8 it would show.
constexpr double slack = 1e-10;

double signedDistanceFrom(const PlacedShape& shape, const Vec3& origin, const Vec3& point) {
    const Vec3 inBody = shape.pose->directionToBody(point - (shape.pose->position - origin));
    if (const Cylinder* cylinder = std::get_if<Cylinder>(shape.shape))
        return signedDistance(*cylinder, inBody).distance;
    return signedDistance(*std::get_if<Cuboid>(shape.shape), inBody).distance;
}

Vec3 supportTowards(const PlacedShape& shape, const Vec3& origin, const Vec3& direction) {
    const Vec3 inBody = supportOf(*shape.shape, shape.pose->directionToBody(direction));
    return (shape.pose->position - origin) + shape.pose->directionToWorld(inBody);
}

ContactFeature featureOf(const Cylinder& cylinder, const Pose& pose, const Vec3& n) {
    ContactFeature feature;
    const Vec3 axis = axisOf(pose);
    const double cosine = n.dot(axis);
    const Vec3 lateral = axis.cross(n).cross(axis);
    const double sine = lateral.norm();
    feature.radius = cylinder.radius;
    if (cylinder.radius * sine < cylinder.halfHeight * std::abs(cosine)) {
        feature.kind = ContactFeature::Kind::Disc;
        feature.normal = cosine < 0 ? Vec3(-axis) : axis;
        feature.centre = cylinder.halfHeight * feature.normal;
        feature.name = cosine < 0 ? 0 : 1;
        return feature;
    }
    feature.kind = ContactFeature::Kind::Line;
    feature.name = 2;
    const Vec3 line = (cylinder.radius / sine) * lateral;
    feature.corners[0] = line - cylinder.halfHeight * axis;
    feature.corners[1] = line + cylinder.halfHeight * axis;
    return feature;
}

ContactFeature featureOf(const Cuboid& cuboid, const Pose& pose, const Vec3& n) {
    ContactFeature feature;
    const Mat3 turn = pose.orientation.toRotationMatrix();
    const Vec3 inBody = turn.transpose() * n;
    int across = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(inBody[i]) > std::abs(inBody[across])) across = i;
    const double sign = inBody[across] < 0 ? -1 : 1;
    const Vec3 first = turn.col((across + 1) % 3) * cuboid.halfSize[(across + 1) % 3];
    const Vec3 second = turn.col((across + 2) % 3) * cuboid.halfSize[(across + 2) % 3];
    feature.kind = ContactFeature::Kind::Face;
    feature.normal = sign * turn.col(across);
    feature.centre = cuboid.halfSize[across] * feature.normal;
    feature.corners = {feature.centre + first + second, feature.centre - first + second,
                       feature.centre - first - second, feature.centre + first - second};
    feature.name = static_cast<std::uint32_t>(2 * across + (sign < 0 ? 0 : 1));
    return feature;
}

double sizeOf(const PlacedShape& a, const PlacedShape& b) {
    return boundingRadiusOf(*a.shape) + boundingRadiusOf(*b.shape);
}

// The nearest points where one of the two is the only point of its shape furthest along the normal; the other
// is then straight across, on its shape's surface. If neither is, `isExact` is false.
struct Witnesses {
    ContactPoint point;
    bool isExact = false;
};
Witnesses straightAcross(const PlacedShape& a, const PlacedShape& b, const BestAxis& axis, double tolerance) {
    constexpr std::uint32_t name = 255; // no corner of a region has it
    const Vec3& origin = a.pose->position;
    const Vec3 step = axis.separation * axis.normal;
    const Vec3 onA = supportTowards(a, origin, axis.normal);
    const Vec3 onB = supportTowards(b, origin, -axis.normal);
    const double missA = signedDistanceFrom(b, origin, onA + step);
    const double missB = signedDistanceFrom(a, origin, onB - step);
    const bool isExact = std::min(missA, missB) <= tolerance;
    if (missA <= missB) return {{onA, onA + step, axis.separation, name}, isExact};
    return {{onB - step, onB, axis.separation, name}, isExact};
}

// Keeps at most `room` points: the deepest, then always the one furthest from those kept.
std::size_t thinOut(std::array<ContactPoint, ContactRegion::capacity>& points, std::size_t count,
                    std::size_t room) {
    if (count <= room) return count;
    std::array<double, ContactRegion::capacity> away;
    away.fill(std::numeric_limits<double>::infinity());
    std::size_t next = 0;
    for (std::size_t i = 1; i < count; ++i)
        if (points[i].separation < points[next].separation) next = i;
    for (std::size_t kept = 0; kept < room; ++kept) {
        std::swap(points[kept], points[next]);
        std::swap(away[kept], away[next]);
        next = kept + 1;
        for (std::size_t i = kept + 1; i < count; ++i) {
            away[i] = std::min(away[i], (points[i].onA - points[kept].onA).squaredNorm());
            if (away[i] > away[next]) next = i;
        }
    }
    return room;
}

} // namespace

ContactFeature featureTowards(const PlacedShape& shape, const Vec3& n, const Vec3& origin) {
    const Cylinder* cylinder = std::get_if<Cylinder>(shape.shape);
    const Cuboid* cuboid = std::get_if<Cuboid>(shape.shape);
    ASSERT(cylinder != nullptr || cuboid != nullptr);
    ContactFeature feature =
        cylinder != nullptr ? featureOf(*cylinder, *shape.pose, n) : featureOf(*cuboid, *shape.pose, n);
    const Vec3 centre = shape.pose->position - origin;
    feature.centre += centre;
    for (Vec3& corner : feature.corners) corner += centre;
    return feature;
}

void fillManifold(const PlacedShape& a, const PlacedShape& b, const BestAxis& axis, double margin,
                  Manifold& manifold) {
    const Vec3& origin = a.pose->position;
    const double tolerance = slack * sizeOf(a, b);
    const ContactFeature featureA = featureTowards(a, axis.normal, origin);
    const ContactFeature featureB = featureTowards(b, -axis.normal, origin);
    const ContactRegion region(featureA, featureB, axis.normal, tolerance);

    std::array<ContactPoint, ContactRegion::capacity> points;
    std::size_t count = 0;
    double least = std::numeric_limits<double>::infinity();
    for (const ContactPoint& point : region) {
        least = std::min(least, point.separation);
        if (point.separation <= margin) points[count++] = point;
    }
    const bool isWhole = std::abs(least - axis.separation) <= tolerance && count > 0;
    count = thinOut(points, count, isWhole ? Manifold::capacity : Manifold::capacity - 1);
    if (!isWhole) points[count++] = straightAcross(a, b, axis, tolerance).point;
    manifold.normal = axis.normal;
    manifold.count = 0;
    for (std::size_t i = 0; i < count; ++i) {
        ContactPoint point = points[i];
        point.onA += origin;
        point.onB += origin;
        point.feature |= featureA.name << 8U | featureB.name << 12U;
        manifold.add(point);
    }
}

Proximity witnessesAlong(const PlacedShape& a, const PlacedShape& b, const BestAxis& axis) {
    const Vec3& origin = a.pose->position;
    const double tolerance = slack * sizeOf(a, b);
    ContactPoint best;
    const Witnesses witnesses = straightAcross(a, b, axis, 1e-3 * tolerance);
    best = witnesses.point;
    if (!witnesses.isExact) { // flat on flat: any corner of the common region at the right separation
        const ContactRegion region(featureTowards(a, axis.normal, origin),
                                   featureTowards(b, -axis.normal, origin), axis.normal, tolerance);
        double leastError = tolerance;
        for (const ContactPoint& point : region) {
            const double error = std::abs(point.separation - axis.separation);
            if (error >= leastError) continue;
            leastError = error;
            best = point;
        }
    }
    return {axis.separation, axis.normal, origin + best.onA, origin + best.onB};
}

} // namespace carom
