// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/cylinder_cylinder.h"

#include "core/base/wide.h"
#include "core/math/rotation.h"
#include "core/narrowphase/contact_features.h"
#include "core/narrowphase/rim_climb.h"
#include "core/narrowphase/rim_line.h"

#include <algorithm>
#include <array>
#include <cmath>

// The features of a cylinder are its two caps, its side and its two rims; in direction n one of nine pairs of
// features is nearest. With axes a, b at an angle whose sine is s, x = a × b / s:
//
//     cap  – any     n = ±a or ±b
//     side – side    n = ±x
//     side – rim     n across the one axis: one root of a concave function (rim_line.h)
//     rim  – rim     both free: Newton's method on the sphere of directions (rim_climb.h)
//
// Apart, s(n) has one local maximum only, and two points as far apart as the projections prove that it is
// found. Overlapping, there can be several rim – rim maxima, and the search starts from several directions.

namespace carom {
namespace {

// Axes whose angle [rad] is below this are parallel: some tens of the rounding errors of unit vectors. At a
// hundredth, the direction across both axes would be rounding; at a hundred times nothing changes.
constexpr double parallel = 1e-14;
// Below this angle [rad] the lowest point of a cap is a poor estimate of where it is nearest to the other
// cap, and another direction is tried as well. At half, some pairs have only the poor estimate; at twice,
// more pairs try both.
constexpr double nearlyParallel = 0.2;
// A point outside of a cylinder by this part of the size still proves a distance: some tens of rounding
// errors, and less than what another direction would have to be better by (axis_search.h). At a hundredth, no
// pair is proven and every search is complete; at ten times, a search may end at a smaller gap.
constexpr double proof = 4e-15;

struct CylinderPair {
    Cylinder shapeA, shapeB;
    Vec3 axisA, axisB;
    Vec3 offset; // from A's centre to B's [m]

    CylinderPair(const PlacedShape& a, const PlacedShape& b)
        : shapeA(*std::get_if<Cylinder>(a.shape)), shapeB(*std::get_if<Cylinder>(b.shape)),
          axisA(axisOf(*a.pose)), axisB(axisOf(*b.pose)), offset(b.pose->position - a.pose->position) {}

    const Vec3& between() const { return offset; }
    double size() const { return boundingRadiusOf(shapeA) + boundingRadiusOf(shapeB); }
    double separationAlong(const Vec3& n) const {
        return offset.dot(n) - extentAlong(shapeA, axisA, n) - extentAlong(shapeB, axisB, n);
    }
};

// The point of a cylinder furthest along unit n, from its centre.
Vec3 furthestPoint(const Cylinder& cylinder, const Vec3& axis, const Vec3& n) {
    const Vec3 lateral = axis.cross(n).cross(axis);
    const double sine = lateral.norm();
    const Vec3 cap = std::copysign(cylinder.halfHeight, n.dot(axis)) * axis;
    return sine > 0 ? Vec3(cap + (cylinder.radius / sine) * lateral) : cap;
}

// The unit normal of both axes. The cross product of nearly parallel axes is mostly rounding, part of it
// along the axes; without that part it is across both to rounding, whatever its direction.
Vec3 acrossBoth(const CylinderPair& pair) {
    const Vec3 cross = pair.axisA.cross(pair.axisB);
    const Vec3 across = cross - cross.dot(pair.axisA) * pair.axisA;
    const double sine = across.norm();
    return sine > parallel ? Vec3(across / sine) : tangentsOf(pair.axisA).first;
}

// Starting directions beside cap A's normal, tilted over the rim of A by the angle at which the gap is
// greatest in that plane.
Vec3 leaningOut(const RimPair& rims, const Vec3& cap, const Vec3& outward) {
    const Vec3 fromRim = rims.offset - rims.radiusA * outward;
    const Vec3 tangent = cap.cross(outward);
    Vec3 along = rims.axisB - rims.axisB.dot(tangent) * tangent;
    const double k = along.norm();
    along = k > 0 ? Vec3(along / k) : cap;
    const Vec3 beside = tangent.cross(along);
    const double alongRim = fromRim.dot(along);
    const double besideRim = fromRim.dot(beside);
    const PlaneAngle angle = steepestAngle(
        {std::abs(besideRim), std::abs(alongRim), rims.radiusB, k, std::abs(rims.axisB.dot(tangent))});
    const Vec3 start =
        std::copysign(angle.cosine, besideRim) * beside + std::copysign(angle.sine, alongRim) * along;
    if (start.dot(outward) > 0 && start.dot(cap) > 0) return start;
    // The greatest gap of that plane is on another side of A; stay near the cap, by a step of Newton's
    // method.
    const double sine = cap.cross(rims.axisB).norm();
    const double slope = fromRim.dot(outward);
    const double bend = std::abs(rims.offset.dot(cap)) + rims.radiusB * sine + rims.radiusB * k * k;
    return (cap + std::min(0.1, std::abs(slope) / bend) * outward).normalized();
}

// Where B extends beyond cap A, the cap's normal is not a maximum. Two other starts: towards the point of B's
// rim nearest to the plane of the cap, and, where the caps are nearly parallel and that point is arbitrary,
// towards B's centre.
void considerOverhang(AxisSearch<CylinderPair>& search, const RimPair& rims, const Vec3& cap) {
    const auto tryTowards = [&](const Vec3& target) {
        const Vec3 lateral = target - target.dot(cap) * cap;
        const double reach = lateral.norm();
        if (reach > 0) search.consider(climb(rims, leaningOut(rims, cap, lateral / reach)).normal);
    };
    const Vec3 across = cap - cap.dot(rims.axisB) * rims.axisB;
    const double sine = across.norm();
    if (sine < nearlyParallel) tryTowards(rims.offset);
    if (sine < parallel) return;
    const Vec3 nearest = rims.offset - (rims.radiusB / sine) * across;
    const Vec3 lateral = nearest - nearest.dot(cap) * cap;
    if (lateral.squaredNorm() > rims.radiusA * rims.radiusA) tryTowards(nearest);
}

// Inside, or outside by no more than `tolerance` [m].
bool isInside(const Cylinder& shape, const Vec3& axis, const Vec3& fromCentre, double tolerance = 0) {
    return std::abs(fromCentre.dot(axis)) <= shape.halfHeight + tolerance &&
           fromCentre.cross(axis).norm() <= shape.radius + tolerance;
}

// The point of A, from A's centre, that is nearest to B's axis among those at this distance [m] from A's axis
// towards n, which is across both. Not finite where the axes are parallel.
Vec3 besideAxes(const CylinderPair& pair, const Vec3& n, double radius) {
    const double cosine = pair.axisA.dot(pair.axisB);
    const double height = pair.offset.dot(pair.axisA - cosine * pair.axisB) / (1 - cosine * cosine);
    return height * pair.axisA + radius * n;
}

// The furthest point of one cylinder along the best direction lies in the other, or a point between their
// axes lies in both: they do overlap.
bool overlapIsCertain(const CylinderPair& pair, const BestAxis& best) {
    if (!(best.separation < 0)) return false;
    if (isInside(pair.shapeB, pair.axisB,
                 furthestPoint(pair.shapeA, pair.axisA, best.normal) - pair.offset) ||
        isInside(pair.shapeA, pair.axisA, furthestPoint(pair.shapeB, pair.axisB, -best.normal) + pair.offset))
        return true;
    const Vec3 middle = besideAxes(pair, best.normal, pair.shapeA.radius + 0.5 * best.separation);
    return isInside(pair.shapeA, pair.axisA, middle) &&
           isInside(pair.shapeB, pair.axisB, middle - pair.offset);
}

// For each pair of rims the gap F of the discs they bound is concave, F >= s everywhere, and F = s for
// directions that show these two rims. So
//   - a certified positive maximum of F is the only one, and no other start is needed;
//   - if the cylinders overlap with depth δ and F(m) > δ for any m, no direction n that shows these rims is a
//     local maximum with s(n) > −δ: from n towards m the gap still grows. Then no search is needed.
void considerRims(AxisSearch<CylinderPair>& search, const CylinderPair& pair, const Vec3& x) {
    const bool overlap = overlapIsCertain(pair, search.best());
    // Nearly parallel, the climbs of several pairs end within a tie of each other, and all are needed.
    const bool endsEarly = overlap && pair.axisA.cross(pair.axisB).norm() > nearlyParallel;
    for (const double signA : {1.0, -1.0}) {
        for (const double signB : {1.0, -1.0}) {
            const Vec3 capA = signA * pair.axisA;
            const Vec3 capB = signB * pair.axisB;
            const RimPair rims = {pair.axisA, pair.axisB, pair.shapeA.radius, pair.shapeB.radius,
                                  pair.offset - pair.shapeA.halfHeight * capA -
                                      pair.shapeB.halfHeight * capB};
            const double apart = rims.offset.norm();
            const double depth = -search.best().separation;
            if (overlap && apart > 0 && gapAlong(rims, rims.offset / apart) > depth) continue;
            const Vec3 between = 0.5 * (capA + capB) + 0.5 * (capA - capB).norm() * x;
            const double enough = endsEarly ? depth : std::numeric_limits<double>::infinity();
            const RimGap first = climb(rims, between.normalized(), enough);
            if (first.gap > enough) continue;
            search.consider(first.normal);
            if (isGreatestGap(rims, first)) continue;
            considerOverhang(search, rims, capA);
            considerOverhang(search, {rims.axisB, rims.axisA, rims.radiusB, rims.radiusA, rims.offset}, capB);
        }
    }
}

// Apart, two points as far apart as the projections prove that there is no better direction.
bool isProven(const CylinderPair& pair, const BestAxis& best) {
    const double tolerance = proof * pair.size();
    if (!(best.separation > -tolerance)) return false;
    const Vec3 step = best.separation * best.normal;
    const auto reachesB = [&](const Vec3& onA) {
        return isInside(pair.shapeB, pair.axisB, onA + step - pair.offset, tolerance);
    };
    const Vec3 side = besideAxes(pair, best.normal, pair.shapeA.radius);
    return reachesB(furthestPoint(pair.shapeA, pair.axisA, best.normal)) ||
           isInside(pair.shapeA, pair.axisA,
                    furthestPoint(pair.shapeB, pair.axisB, -best.normal) - step + pair.offset, tolerance) ||
           (isInside(pair.shapeA, pair.axisA, side, tolerance) && reachesB(side));
}

BestAxis searchAxes(const CylinderPair& pair, double margin) {
    AxisSearch<CylinderPair> search(pair);
    search.considerEitherWay(pair.axisA);
    search.considerEitherWay(pair.axisB);
    if (search.apartBy(margin)) return search.best();
    const Vec3 x = acrossBoth(pair);
    search.considerEitherWay(x);
    search.consider(sideToRim(pair.axisA, {pair.shapeB, pair.axisB}, pair.offset, x));
    search.consider(sideToRim(pair.axisB, {pair.shapeA, pair.axisA}, pair.offset, x));
    if (search.apartBy(margin) || isProven(pair, search.best())) return search.best();
    considerRims(search, pair, pair.offset.dot(x) < 0 ? Vec3(-x) : x);
    return search.best();
}

} // namespace

CAROM_WIDE Vec3 sideToRim(const Vec3& side, const AxisOfCylinder& other, const Vec3& offset, const Vec3& x) {
    const Vec3 y = x.cross(side); // with x a basis of the plane across the side
    const double k = std::abs(y.dot(other.axis));
    const double alongX = offset.dot(x);
    const double alongY = offset.dot(y);
    const PlaneAngle angle =
        steepestAngle({std::abs(alongX), std::abs(alongY) - other.cylinder.halfHeight * k,
                       other.cylinder.radius, k, std::abs(side.dot(other.axis))});
    return std::copysign(angle.cosine, alongX) * x + std::copysign(angle.sine, alongY) * y;
}

bool collideCylinderCylinder(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold) {
    const BestAxis best = searchAxes(CylinderPair(a, b), margin);
    manifold.normal = best.normal;
    if (!(best.separation <= margin)) return false;
    fillManifold(a, b, best, margin, manifold);
    return true;
}

Proximity proximityCylinderCylinder(const PlacedShape& a, const PlacedShape& b) {
    const BestAxis best = searchAxes(CylinderPair(a, b), std::numeric_limits<double>::infinity());
    return witnessesAlong(a, b, best);
}

} // namespace carom
