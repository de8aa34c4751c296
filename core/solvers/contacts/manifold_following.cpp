// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/manifold_following.h"

#include "core/base/wide.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace carom {
namespace {

using Point = PersistentManifold::Point;
using Kind = DirectionSource::Kind;

/// Relative poses within this part of the smaller body's size and this angle [rad] keep their points. At
/// three times as much falling heaps overlap by half as much again.
constexpr double followedWithin = 0.003, followedAngle = 0.005;
/// Sine of the least angle between the cap of a cylinder and the contact's plane at which its lowest point is
/// followed: below, that point moves round the rim ever faster. At half, points are carried along that move
/// too fast; at twice, more of them are found anew.
constexpr double leastLean = 0.05;

/// Whether a point of a solid, in its frame, is where the side or the rim of a cylinder is furthest along the
/// normal or against it, so that it rolls on when the cylinder turns.
bool doesRoll(const Solid& solid, const Vec3& point, const Vec3& normal) {
    // Of the radius: points of the rim and of the side are this near to it. Twice or half is as far above
    // rounding (1e-16).
    constexpr double rounding = 1e-6;
    // A cosine, of 11 degrees: lines that are nearly parallel touch beside the lowest line. At half the angle
    // more points are found anew; at twice, points are taken to roll that do not.
    constexpr double sameDirection = 0.98;
    if (!solid.isCylinder) return false;
    const double lean = std::sqrt(normal.x() * normal.x() + normal.z() * normal.z());
    const double radius = std::sqrt(point.x() * point.x() + point.z() * point.z());
    const double along = std::abs(point.x() * normal.x() + point.z() * normal.z());
    return lean > leastLean && radius >= (1 - rounding) * solid.half.x() &&
           along >= sameDirection * radius * lean;
}

/// The rotation about y that turns one vector into the direction of another, both projected on the plane
/// across y.
struct TurnAboutY {
    double cosine = 1, sine = 0;

    TurnAboutY(const Vec3& from, const Vec3& to) {
        const double size =
            std::sqrt((from.x() * from.x() + from.z() * from.z()) * (to.x() * to.x() + to.z() * to.z()));
        if (!(size > 0)) return;
        cosine = (from.x() * to.x() + from.z() * to.z()) / size;
        sine = (from.z() * to.x() - from.x() * to.z()) / size;
    }
    Vec3 operator()(const Vec3& v) const {
        return {cosine * v.x() + sine * v.z(), v.y(), cosine * v.z() - sine * v.x()};
    }
};

} // namespace

CAROM_WIDE void beginFollowing(const Solids& solids, const Vec3& place, PersistentManifold& manifold) {
    const auto& [a, b] = solids;
    manifold.position = a.inBody(place);
    manifold.positionInB = b.inBody(place - b.centre);
    unsigned rollsA = 0, rollsB = 0;
    for (unsigned k = 0; k < static_cast<unsigned>(manifold.count); ++k) {
        const Point& point = manifold.points[k];
        rollsA |= doesRoll(a, point.onA, manifold.normal) ? 1U << k : 0U;
        rollsB |= doesRoll(b, point.onB, manifold.normalInB) ? 1U << k : 0U;
    }
    if (manifold.source.kind == Kind::SideA) rollsA &= ~rollsB; // the side's point follows that of the rim
    if (manifold.source.kind == Kind::SideB) rollsB &= ~rollsA;
    manifold.rollsA = static_cast<std::uint8_t>(rollsA);
    manifold.rollsB = static_cast<std::uint8_t>(rollsB);
}

CAROM_WIDE void follow(const Solids& solids, PersistentManifold& manifold) {
    const auto& [a, b] = solids;
    const Vec3 normal = followedDirection(a, b, manifold.source, a.turn * manifold.normal);
    const Vec3 inA = a.inBody(normal), inB = b.inBody(normal);
    if ((manifold.rollsA | manifold.rollsB) != 0) {
        const TurnAboutY turnA(manifold.normal, inA), turnB(manifold.normalInB, inB);
        for (unsigned k = 0; k < static_cast<unsigned>(manifold.count); ++k) {
            Point& point = manifold.points[k];
            const bool rollsA = (manifold.rollsA >> k & 1U) != 0, rollsB = (manifold.rollsB >> k & 1U) != 0;
            if (rollsA) point.onA = turnA(point.onA);
            if (rollsB) point.onB = turnB(point.onB);
            if (rollsA == rollsB) continue;
            const Vec3 onA = a.turn * point.onA, onB = b.centre + b.turn * point.onB;
            const Vec3 across = normal.dot(onB - onA) * normal;
            if (rollsA)
                point.onB = b.inBody(onA + across - b.centre);
            else
                point.onA = a.inBody(onB - across);
        }
    }
    manifold.normal = inA;
    manifold.normalInB = inB;
}

bool staysInPlace(const Bodies& bodies, const PersistentManifold& manifold, double turned) {
    const Shape &a = bodies.shape[manifold.pair.a], &b = bodies.shape[manifold.pair.b];
    if (isWall(a) || isWall(b)) return std::holds_alternative<Cuboid>(isWall(a) ? b : a);
    if (manifold.source.kind == Kind::Other || (manifold.rollsA | manifold.rollsB) != 0) return false;
    const bool isCylinder = std::holds_alternative<Cylinder>(a) || std::holds_alternative<Cylinder>(b);
    return !(isCylinder && manifold.count > 2) || turned <= rowsCapAngle;
}

// Compares the places at the contact, not the centres: the centre of a large body moves far when it turns a
// little.
CAROM_WIDE bool holds(const Solids& solids, const PersistentManifold& manifold, const Quat& orientation,
                      double size) {
    const bool follows = manifold.source.kind != Kind::Other;
    const double within = (follows ? followedWithin : PersistentManifold::keptWithin) * size;
    const auto& [a, b] = solids;
    const Vec3 slid = b.centre + b.turn * manifold.positionInB - a.turn * manifold.position;
    return slid.squaredNorm() <= within * within &&
           !isTurned(manifold, orientation, follows ? followedAngle : PersistentManifold::keptAngle);
}

bool isTurned(const PersistentManifold& manifold, const Quat& orientation, double angle) {
    const double cosine = std::abs(orientation.dot(manifold.orientation)); // of half the angle
    return !(1 - cosine < 0.5 * 0.25 * angle * angle);
}

} // namespace carom
