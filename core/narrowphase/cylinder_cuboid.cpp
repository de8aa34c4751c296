// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/cylinder_cuboid.h"

#include "core/base/wide.h"
#include "core/math/polygon_clip.h"
#include "core/narrowphase/contact_features.h"
#include "core/narrowphase/rim_line.h"

#include <cmath>
#include <limits>

// The pairs of features of a cylinder and a cuboid, in the cuboid's frame, a the cylinder's axis:
//
//     face – any       n = ±e_i
//     cap – any        n = ±a
//     side – edge      n = ±a × e_i
//     side – corner    n across a, from the axis to the corner
//     rim – corner     n from the rim to the corner; only for bodies that are apart: a corner inside a rim
//                      never gives the least overlap
//     rim – edge       n across e_i: one root of a concave function (rim_line.h) for each edge and rim
//
// All are closed forms or single roots, so all are tried.

namespace carom {
namespace {

struct CylinderCuboidPair {
    Cylinder cylinder;
    Cuboid cuboid;
    Vec3 axis;   // of the cylinder, in the cuboid's frame
    Vec3 offset; // from the cylinder's centre to the cuboid's, in the cuboid's frame [m]

    CylinderCuboidPair(const PlacedShape& a, const PlacedShape& b)
        : cylinder(*std::get_if<Cylinder>(a.shape)), cuboid(*std::get_if<Cuboid>(b.shape)),
          axis(b.pose->directionToBody(axisOf(*a.pose))),
          offset(b.pose->directionToBody(b.pose->position - a.pose->position)) {}

    const Vec3& between() const { return offset; }
    double size() const { return boundingRadiusOf(cylinder) + boundingRadiusOf(cuboid); }
    double separationAlong(const Vec3& n) const {
        return offset.dot(n) - extentAlong(cylinder, axis, n) - cuboid.halfSize.dot(n.cwiseAbs());
    }
};
using Search = AxisSearch<CylinderCuboidPair>;

double signOf(unsigned corner, int axis) { return (corner >> axis & 1U) != 0 ? 1.0 : -1.0; }

// The corner nearest the cylinder's axis line, and the one nearest a rim from the region beyond it.
void considerCorners(Search& search, const CylinderCuboidPair& pair) {
    double leastLateral = std::numeric_limits<double>::infinity();
    double leastBeyond = std::numeric_limits<double>::infinity();
    Vec3 towardsLateral = Vec3::Zero();
    Vec3 towardsBeyond = Vec3::Zero();
    for (unsigned corner = 0; corner < 8; ++corner) {
        const Vec3 sign(signOf(corner, 0), signOf(corner, 1), signOf(corner, 2));
        const Vec3 point =
            pair.offset + sign.cwiseProduct(pair.cuboid.halfSize); // from the cylinder's centre
        const double along = point.dot(pair.axis);
        const Vec3 lateral = point - along * pair.axis;
        const double rho = lateral.norm();
        if (rho < leastLateral) {
            leastLateral = rho;
            towardsLateral = lateral;
        }
        const double beyondSide = rho - pair.cylinder.radius;
        const double beyondCap = std::abs(along) - pair.cylinder.halfHeight;
        if (!(beyondSide > 0 && beyondCap > 0)) continue;
        const double squared = beyondSide * beyondSide + beyondCap * beyondCap;
        if (squared < leastBeyond) {
            leastBeyond = squared;
            towardsBeyond = (beyondSide / rho) * lateral + std::copysign(beyondCap, along) * pair.axis;
        }
    }
    search.considerEitherWay(towardsLateral);
    search.considerEitherWay(towardsBeyond);
}

// The four edges along e_i against both rims. Directions here run from the cuboid to the cylinder, in the
// plane across e_i; the rim's circle is shortest there along `steep`, the axis' projection.
void considerEdges(Search& search, const CylinderCuboidPair& pair, int i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    Vec2 steep(pair.axis[j], pair.axis[k]);
    const double shadow = steep.norm();
    if (!(shadow > 0)) return;
    steep /= shadow;
    const Vec2 flat(-steep.y(), steep.x());
    const Vec2 centre(-pair.offset[j], -pair.offset[k]);
    for (unsigned corner = 0; corner < 4; ++corner) {
        const Vec2 edge(signOf(corner, 0) * pair.cuboid.halfSize[j],
                        signOf(corner, 1) * pair.cuboid.halfSize[k]);
        for (const double cap : {1.0, -1.0}) {
            const Vec2 toRim = centre - edge - cap * pair.cylinder.halfHeight * shadow * steep;
            const double alongFlat = toRim.dot(flat);
            const PlaneAngle angle = steepestAngle({std::abs(alongFlat), cap * toRim.dot(steep),
                                                    pair.cylinder.radius, shadow, std::abs(pair.axis[i])});
            const Vec2 found = std::copysign(angle.cosine, alongFlat) * flat + cap * angle.sine * steep;
            Vec3 n = Vec3::Zero();
            n[j] = -found.x();
            n[k] = -found.y();
            search.consider(n);
        }
    }
}

CAROM_WIDE BestAxis searchAxes(const CylinderCuboidPair& pair, double margin) {
    Search search(pair);
    for (int i = 0; i < 3; ++i) search.considerEitherWay(Vec3::Unit(i));
    search.considerEitherWay(pair.axis);
    if (search.apartBy(margin)) return search.best();
    for (int i = 0; i < 3; ++i) search.considerEitherWay(pair.axis.cross(Vec3::Unit(i)));
    considerCorners(search, pair);
    if (search.apartBy(margin)) return search.best();
    for (int i = 0; i < 3; ++i) considerEdges(search, pair, i);
    return search.best();
}

BestAxis inWorld(const PlacedShape& cuboid, const BestAxis& best) {
    return {cuboid.pose->directionToWorld(best.normal), best.separation};
}

} // namespace

bool collideCylinderCuboid(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold) {
    const BestAxis best = inWorld(b, searchAxes(CylinderCuboidPair(a, b), margin));
    manifold.normal = best.normal;
    if (!(best.separation <= margin)) return false;
    fillManifold(a, b, best, margin, manifold);
    return true;
}

Proximity proximityCylinderCuboid(const PlacedShape& a, const PlacedShape& b) {
    const BestAxis best = searchAxes(CylinderCuboidPair(a, b), std::numeric_limits<double>::infinity());
    return witnessesAlong(a, b, inWorld(b, best));
}

} // namespace carom
