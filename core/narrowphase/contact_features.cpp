// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/contact_features.h"

#include "core/base/wide.h"
#include "core/narrowphase/contact_region.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace carom {
namespace {

// Features that miss each other by less than this part of the size touch, and a region whose least separation
// is this near the true one holds the nearest points. Rounding is 1e-15; below 1e-12 sides on one line would
// come and go, above 1e-8 it would show.
constexpr double slack = 1e-10;

CAROM_INLINE ContactFeature ofCylinder(const Solid& cylinder, const Vec3& n) {
    ContactFeature feature;
    const Vec3 axis = cylinder.turn.col(1);
    const double radius = cylinder.half.x(), halfHeight = cylinder.half.y(), cosine = n.dot(axis);
    const Vec3 lateral = axis.cross(n).cross(axis);
    const double sine = lateral.norm();
    feature.radius = radius;
    feature.centre = cylinder.centre;
    if (radius * sine < halfHeight * std::abs(cosine)) {
        feature.kind = ContactFeature::Kind::Disc;
        feature.normal = cosine < 0 ? Vec3(-axis) : axis;
        feature.centre += halfHeight * feature.normal;
        feature.name = cosine < 0 ? 0 : 1;
        return feature;
    }
    feature.kind = ContactFeature::Kind::Line;
    feature.name = 2;
    const Vec3 line = cylinder.centre + (radius / sine) * lateral;
    feature.corners[0] = line - halfHeight * axis;
    feature.corners[1] = line + halfHeight * axis;
    return feature;
}

CAROM_INLINE ContactFeature ofCuboid(const Solid& cuboid, const Vec3& n) {
    ContactFeature feature;
    const Vec3 inBody = cuboid.inBody(n);
    Eigen::Index across = 0;
    for (Eigen::Index i = 1; i < 3; ++i)
        if (std::abs(inBody[i]) > std::abs(inBody[across])) across = i;
    const double sign = inBody[across] < 0 ? -1 : 1;
    const Eigen::Index one = (across + 1) % 3, other = (across + 2) % 3;
    const Vec3 first = cuboid.turn.col(one) * cuboid.half[one];
    const Vec3 second = cuboid.turn.col(other) * cuboid.half[other];
    feature.kind = ContactFeature::Kind::Face;
    feature.normal = sign * cuboid.turn.col(across);
    feature.centre = cuboid.centre + cuboid.half[across] * feature.normal;
    feature.corners = {feature.centre + first + second, feature.centre - first + second,
                       feature.centre - first - second, feature.centre + first - second};
    feature.name = static_cast<std::uint32_t>(2 * across + (sign < 0 ? 0 : 1));
    return feature;
}

double toleranceFor(const Solid& a, const Solid& b) { return slack * (a.half.sum() + b.half.sum()); }

// The nearest points where one of the two is the only point of its shape furthest along the normal; the other
// is then straight across, on its shape's surface. If neither is, `isExact` is false.
struct Witnesses {
    ContactPoint point;
    bool isExact = false;
};
CAROM_INLINE Witnesses straightAcross(const Solid& a, const Solid& b, const BestAxis& axis,
                                      double tolerance) {
    constexpr std::uint32_t name = 255; // no corner of a region has it
    const Vec3 step = axis.separation * axis.normal;
    const Vec3 onA = a.support(axis.normal), onB = b.support(-axis.normal);
    const double missA = signedDistance(b, onA + step), missB = signedDistance(a, onB - step);
    const bool isExact = std::min(missA, missB) <= tolerance;
    if (missA <= missB) return {{onA, onA + step, axis.separation, name}, isExact};
    return {{onB - step, onB, axis.separation, name}, isExact};
}

// Keeps at most `room` points: the deepest, then always the one furthest from those kept.
void thinOut(ContactRegion::Points& points, std::size_t room) {
    const std::size_t count = points.size();
    if (count <= room) return;
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
    points.shrink(room);
}

} // namespace

CAROM_WIDE ContactFeature featureTowards(const Solid& solid, const Vec3& n) {
    return solid.isCylinder ? ofCylinder(solid, n) : ofCuboid(solid, n);
}

CAROM_WIDE void fillManifold(const Solid& a, const Solid& b, const Vec3& origin, const BestAxis& axis,
                             double margin, Manifold& manifold) {
    const double tolerance = toleranceFor(a, b);
    const ContactFeature featureA = featureTowards(a, axis.normal),
                         featureB = featureTowards(b, -axis.normal);
    ContactRegion region(featureA, featureB, axis.normal, tolerance);
    ContactRegion::Points& points = region.points();
    double least = std::numeric_limits<double>::infinity();
    std::size_t count = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        least = std::min(least, points[i].separation);
        if (!(points[i].separation <= margin)) continue;
        if (count < i) points[count] = points[i];
        ++count;
    }
    points.shrink(count);
    const bool isWhole = std::abs(least - axis.separation) <= tolerance && count > 0;
    thinOut(points, isWhole ? Manifold::capacity : Manifold::capacity - 1);
    if (!isWhole) points.push_back(straightAcross(a, b, axis, tolerance).point);
    manifold.normal = axis.normal;
    manifold.count = 0;
    const std::uint32_t names = featureA.name << 8U | featureB.name << 12U;
    for (const ContactPoint& point : points)
        manifold.add({point.onA + origin, point.onB + origin, point.separation, point.feature | names});
}

void fillManifold(const PlacedShape& a, const PlacedShape& b, const BestAxis& axis, double margin,
                  Manifold& manifold) {
    const Vec3& origin = a.pose->position;
    fillManifold(solidOf(a, origin), solidOf(b, origin), origin, axis, margin, manifold);
}

Proximity witnessesAlong(const PlacedShape& placedA, const PlacedShape& placedB, const BestAxis& axis) {
    const Vec3& origin = placedA.pose->position;
    const Solid a = solidOf(placedA, origin), b = solidOf(placedB, origin);
    const double tolerance = toleranceFor(a, b);
    const Witnesses witnesses = straightAcross(a, b, axis, 1e-3 * tolerance);
    ContactPoint best = witnesses.point;
    if (!witnesses.isExact) { // flat on flat: any corner of the common region at the right separation
        const ContactRegion region(featureTowards(a, axis.normal), featureTowards(b, -axis.normal),
                                   axis.normal, tolerance);
        double leastError = tolerance;
        for (const ContactPoint& point : region.points()) {
            const double error = std::abs(point.separation - axis.separation);
            if (error >= leastError) continue;
            leastError = error;
            best = point;
        }
    }
    return {axis.separation, axis.normal, origin + best.onA, origin + best.onB};
}

} // namespace carom
