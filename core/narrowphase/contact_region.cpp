// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/contact_region.h"

#include "core/base/wide.h"
#include "core/math/polygon_clip.h"
#include "core/math/rotation.h"
#include "core/math/segment.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
namespace {

// Discs whose centres are nearer than this part of the smaller radius are treated as concentric: otherwise
// the four points of a stack of equal cylinders would turn with the rounding of its offset. At twice, the
// points of discs that are visibly offset are a tenth of the radius beside the rim; at a hundredth, those of
// a stack that vibrates turn.
constexpr double nearlyConcentric = 0.05;
// Lines at a smaller angle than this [rad] touch along their length, others at their crossing. At half, a
// cylinder that lies on another turns about one point sooner; at twice, points are up to a fifth of their
// distance from the crossing beside the other line.
constexpr double nearlyParallel = 0.1;
// The cosine of the largest turn of the local normal along two such lines (0.2 rad); beyond, one normal is
// wrong by more than that at one of the ends.
constexpr double sameDirection = 0.98;

// Coordinates in a plane.
struct Plane {
    Vec3 origin, first, second;

    Vec2 flatten(const Vec3& point) const { return {first.dot(point - origin), second.dot(point - origin)}; }
    Vec3 lift(const Vec2& point) const { return origin + point.x() * first + point.y() * second; }
};

// The plane across `normal` through `origin`, its first direction along the side of a face that fits best.
CAROM_INLINE Plane planeAlong(const ContactFeature& face, const Vec3& normal, const Vec3& origin) {
    const auto across = [&](std::size_t corner) -> Vec3 {
        const Vec3 side = (face.corners[corner + 1] - face.corners[corner]).normalized();
        return side - side.dot(normal) * normal;
    };
    const Vec3 side = across(0);
    const Vec3 other = across(1);
    const bool takeSide = side.squaredNorm() >= 0.25;
    const Vec3 first = (takeSide ? side : Vec3(other.cross(normal))).normalized();
    return {origin, first, normal.cross(first)};
}

// The sides of a flattened face as half-planes; side k runs from corner k and is called `firstSide` + k.
CAROM_INLINE std::array<HalfPlane, 4> sidesOf(const std::array<Vec2, 4>& corners, std::uint32_t firstSide) {
    const auto cross = [](const Vec2& u, const Vec2& v) { return u.x() * v.y() - u.y() * v.x(); };
    const double turn = cross(corners[1] - corners[0], corners[2] - corners[1]) < 0 ? -1 : 1;
    std::array<HalfPlane, 4> sides;
    for (std::uint32_t k = 0; k < 4; ++k) {
        const Vec2 along = corners[(k + 1) % 4] - corners[k];
        const Vec2 inward = turn * Vec2(-along.y(), along.x()).normalized();
        sides[k] = {inward, inward.dot(corners[k]), firstSide + k};
    }
    return sides;
}

double leastDepth(const std::array<HalfPlane, 4>& sides, const Vec2& point) {
    double least = sides[0].depthOf(point);
    for (const HalfPlane& side : sides) least = std::min(least, side.depthOf(point));
    return least;
}

// The parts of the line from + part·along that lie in the disc |x| <= radius; first > second if none.
std::pair<double, double> partsInDisc(const Vec2& from, const Vec2& along, double radius) {
    const double a = along.squaredNorm();
    const double b = from.dot(along);
    const double c = from.squaredNorm() - radius * radius;
    const double discriminant = b * b - a * c;
    if (!(a > 0) || discriminant < 0) return {1, 0};
    const double root = std::sqrt(discriminant);
    return {(-b - root) / a, (-b + root) / a};
}

} // namespace

ContactRegion::ContactRegion(const ContactFeature& a, const ContactFeature& b, const Vec3& normal,
                             double slack)
    : m_normal(normal), m_slack(slack) {
    if (a.kind <= b.kind)
        meet({a, b, false});
    else
        meet({b, a, true});
}

void ContactRegion::meet(const Sides& sides) {
    using Kind = ContactFeature::Kind;
    if (sides.first.kind == Kind::Line) {
        if (sides.second.kind == Kind::Line) return meetLines(sides);
        if (sides.second.kind == Kind::Face) return meetLineAndFace(sides);
        return meetLineAndDisc(sides);
    }
    if (sides.first.kind == Kind::Disc) return meetDiscs(sides);
    if (sides.second.kind == Kind::Face) return meetFaces(sides);
    meetDiscAndFace({sides.second, sides.first, !sides.isSwapped});
}

void ContactRegion::add(const Sides& sides, const Vec3& onFirst, const Vec3& onSecond, std::uint32_t name) {
    if (m_points.isFull()) return;
    const Vec3& onA = sides.isSwapped ? onSecond : onFirst;
    const Vec3& onB = sides.isSwapped ? onFirst : onSecond;
    m_points.push_back({onA, onB, m_normal.dot(onB - onA), name});
}

CAROM_WIDE void ContactRegion::meetFaces(const Sides& sides) {
    const Plane plane = planeAlong(sides.first, m_normal, Vec3::Zero());
    std::array<Vec2, 4> corners;
    ClipPolygon polygon;
    for (std::uint32_t k = 0; k < 4; ++k) {
        corners[k] = plane.flatten(sides.first.corners[k]);
        polygon.add({plane.flatten(sides.second.corners[k]), k, k});
    }
    for (const HalfPlane& side : sidesOf(corners, 4)) clip(polygon, side, m_slack);
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const Vec3 point = plane.lift(polygon.corners[i].point);
        add(sides, alongNormalOnto(sides.first, point), alongNormalOnto(sides.second, point),
            polygon.corners[i].name);
    }
}

// In the disc's plane, where it is round; the face is seen there along the normal.
void ContactRegion::meetDiscAndFace(const Sides& sides) {
    const ContactFeature& disc = sides.first;
    const Plane plane = planeAlong(sides.second, disc.normal, disc.centre);
    const auto addAt = [&](const Vec2& point, std::uint32_t name) {
        const Vec3 onDisc = plane.lift(point);
        add(sides, onDisc, alongNormalOnto(sides.second, onDisc), name);
    };
    std::array<Vec2, 4> corners;
    for (std::uint32_t k = 0; k < 4; ++k)
        corners[k] = plane.flatten(alongNormalOnto(disc, sides.second.corners[k]));
    const std::array<HalfPlane, 4> faceSides = sidesOf(corners, 4);
    constexpr std::uint32_t corner = 0, crossing = 8, rim = 16;
    for (std::uint32_t k = 0; k < 4; ++k) {
        if (corners[k].norm() <= disc.radius + m_slack) addAt(corners[k], corner + k);
        const Vec2 along = corners[(k + 1) % 4] - corners[k];
        const auto [enter, leave] = partsInDisc(corners[k], along, disc.radius);
        if (enter > 0 && enter < 1 && enter <= leave) addAt(corners[k] + enter * along, crossing + 2 * k);
        if (leave > 0 && leave < 1 && enter <= leave) addAt(corners[k] + leave * along, crossing + 2 * k + 1);
        const double sign = k < 2 ? 1 : -1; // rim points in directions that do not turn with the cylinder
        const Vec2 onRim = disc.radius * sign * (k % 2 == 0 ? Vec2::UnitX() : Vec2::UnitY());
        if (leastDepth(faceSides, onRim) >= -m_slack) addAt(onRim, rim + k);
    }
}

// In the first disc's plane, along rays from a point in both discs to where they leave the first of them. The
// rays' directions take the second for round there; where they end is exact at any angle between the two.
CAROM_WIDE void ContactRegion::meetDiscs(const Sides& sides) {
    const ContactFeature& first = sides.first;
    const ContactFeature& second = sides.second;
    const auto planeOf = [&](const ContactFeature& disc) -> Plane {
        const Vec3 fixed = tangentsOf(m_normal).first;
        const Vec3 along = (fixed - fixed.dot(disc.normal) * disc.normal).normalized();
        return {disc.centre, along, disc.normal.cross(along)};
    };
    const Plane plane = planeOf(first);
    const Plane otherPlane = planeOf(second);
    const auto inOther = [&](const Vec2& point) -> Vec2 {
        return otherPlane.flatten(alongNormalOnto(second, plane.lift(point)));
    };
    const auto shootRay = [&](const Vec2& from, const Vec2& along, std::uint32_t name) {
        const Vec2 otherFrom = inOther(from);
        const auto [enterFirst, leaveFirst] = partsInDisc(from, along, first.radius);
        const auto [enterOther, leaveOther] =
            partsInDisc(otherFrom, inOther(from + along) - otherFrom, second.radius);
        const double leave = std::min(leaveFirst, leaveOther);
        if (std::max(enterFirst, enterOther) > leave || leave < 0) return;
        const Vec3 onFirst = plane.lift(from + leave * along);
        add(sides, onFirst, alongNormalOnto(second, onFirst), name);
    };
    const Vec2 centre = plane.flatten(alongNormalOnto(first, second.centre));
    const double distance = centre.norm();
    const Vec2 towards = distance > 0 ? Vec2(centre / distance) : Vec2(Vec2::UnitX());
    const double low = std::max(-first.radius, distance - second.radius);
    const double high = std::min(first.radius, distance + second.radius);
    const double smaller = std::min(first.radius, second.radius);
    const Vec2 middle = 0.5 * (low + high) * towards;
    if (distance > std::abs(first.radius - second.radius) + nearlyConcentric * smaller) { // a lens
        const double x = (distance * distance + first.radius * first.radius - second.radius * second.radius) /
                         (2 * distance);
        const double y = std::sqrt(std::max(0.0, first.radius * first.radius - x * x));
        const Vec2 sideways(-towards.y(), towards.x());
        shootRay(middle, -smaller * towards, 4);
        shootRay(middle, x * towards + y * sideways - middle, 5);
        shootRay(middle, smaller * towards, 6);
        shootRay(middle, x * towards - y * sideways - middle, 7);
        return;
    }
    shootRay(middle, Vec2(smaller, 0), 0);
    shootRay(middle, Vec2(0, smaller), 1);
    shootRay(middle, Vec2(-smaller, 0), 2);
    shootRay(middle, Vec2(0, -smaller), 3);
}

CAROM_WIDE void ContactRegion::meetLineAndFace(const Sides& sides) {
    const Plane plane = planeAlong(sides.second, m_normal, Vec3::Zero());
    std::array<Vec2, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = plane.flatten(sides.second.corners[k]);
    const Segment line = {sides.first.corners[0], sides.first.corners[1]};
    const Vec2 from = plane.flatten(line.from);
    const Vec2 to = plane.flatten(line.to);
    double enter = 0;
    double leave = 1;
    std::uint32_t enterName = 0;
    std::uint32_t leaveName = 1;
    for (const HalfPlane& side : sidesOf(corners, 4)) {
        const double depthFrom = side.depthOf(from);
        const double depthTo = side.depthOf(to);
        if (depthFrom < -m_slack && depthTo < -m_slack) return;
        if (depthFrom < -m_slack && depthFrom / (depthFrom - depthTo) > enter) {
            enter = depthFrom / (depthFrom - depthTo);
            enterName = 2 * side.side;
        } else if (depthTo < -m_slack && depthFrom / (depthFrom - depthTo) < leave) {
            leave = depthFrom / (depthFrom - depthTo);
            leaveName = 2 * side.side + 1;
        }
    }
    if (enter > leave) return;
    add(sides, line.at(enter), alongNormalOnto(sides.second, line.at(enter)), enterName);
    add(sides, line.at(leave), alongNormalOnto(sides.second, line.at(leave)), leaveName);
}

CAROM_WIDE void ContactRegion::meetLineAndDisc(const Sides& sides) {
    const ContactFeature& disc = sides.second;
    const Segment line = {sides.first.corners[0], sides.first.corners[1]};
    const Vec3 from = alongNormalOnto(disc, line.from) - disc.centre;
    const Vec3 to = alongNormalOnto(disc, line.to) - disc.centre;
    const Vec3 first = tangentsOf(disc.normal).first;
    const Plane plane = {Vec3::Zero(), first, disc.normal.cross(first)};
    const Vec2 along = plane.flatten(to - from);
    const auto [enter, leave] = partsInDisc(plane.flatten(from), along, disc.radius + m_slack);
    const double low = std::max(enter, 0.0);
    const double high = std::min(leave, 1.0);
    if (low > high) return;
    add(sides, line.at(low), alongNormalOnto(disc, line.at(low)), enter > 0 ? 2U : 0U);
    add(sides, line.at(high), alongNormalOnto(disc, line.at(high)), leave < 1 ? 3U : 1U);
}

// Two cylinders side by side: the ends of the stretch along which they lie together, each with the separation
// found there, and their crossing where it is deeper.
CAROM_WIDE void ContactRegion::meetLines(const Sides& sides) {
    const ContactFeature& first = sides.first;
    const ContactFeature& second = sides.second;
    const auto axisOfLine = [](const ContactFeature& line) -> Segment {
        const Vec3 half = 0.5 * (line.corners[1] - line.corners[0]);
        return {line.centre - half, line.centre + half};
    };
    const Segment axisA = axisOfLine(first);
    const Segment axisB = axisOfLine(second);
    const double sign = sides.isSwapped ? -1 : 1; // the normal runs from A to B
    const Vec3 alongA = axisA.to - axisA.from;
    const Vec3 alongB = axisB.to - axisB.from;
    // From a point on the axis `along` out to the surface, towards `target`.
    const auto outwards = [](const Vec3& along, const Vec3& target) -> Vec3 {
        return (target - target.dot(along) / along.squaredNorm() * along).normalized();
    };
    const auto addBetween = [&](const Vec3& onAxisA, const Vec3& onAxisB, std::uint32_t name) {
        Vec3 between = onAxisB - onAxisA;
        if (between.norm() <= m_slack) between = sign * m_normal;
        const Vec3 fromA = outwards(alongA, between);
        const Vec3 fromB = outwards(alongB, -between);
        if (sign * fromA.dot(m_normal) < sameDirection || sign * fromB.dot(m_normal) > -sameDirection) return;
        add(sides, onAxisA + first.radius * fromA, onAxisB + second.radius * fromB, name);
    };
    const SegmentPair crossing = nearestPoints(axisA, axisB);
    const bool isParallel = alongA.cross(alongB).norm() <= nearlyParallel * alongA.norm() * alongB.norm();
    if (isParallel) {
        const auto partOnA = [&](const Vec3& point) {
            return alongA.dot(point - axisA.from) / alongA.squaredNorm();
        };
        const auto partOnB = [&](const Vec3& point) {
            return alongB.dot(point - axisB.from) / alongB.squaredNorm();
        };
        const double ends[2] = {partOnA(axisB.from), partOnA(axisB.to)};
        const double low = std::max(0.0, std::min(ends[0], ends[1]));
        const double high = std::min(1.0, std::max(ends[0], ends[1]));
        std::uint32_t name = 0;
        for (const double part : {low, high}) {
            if (low > high) break;
            const Vec3 onAxisA = axisA.at(part);
            addBetween(onAxisA, axisB.at(std::clamp(partOnB(onAxisA), 0.0, 1.0)), name++);
        }
    }
    double least = std::numeric_limits<double>::infinity();
    for (const ContactPoint& point : m_points) least = std::min(least, point.separation);
    const double there = sign * m_normal.dot(crossing.onB - crossing.onA) - first.radius - second.radius;
    if (there < least - m_slack) addBetween(crossing.onA, crossing.onB, 2);
}

} // namespace carom
