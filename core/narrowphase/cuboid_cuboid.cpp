// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/cuboid_cuboid.h"

#include "core/base/wide.h"
#include "core/math/segment.h"
#include "core/narrowphase/contact_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace carom {
namespace {

// Two cuboids in A's frame.
struct CuboidPair {
    Vec3 halfA, halfB;
    Mat3 turnB;  // B's axes as columns
    Vec3 offset; // from A's centre to B's [m]

    CuboidPair(const PlacedShape& a, const PlacedShape& b)
        : halfA(std::get_if<Cuboid>(a.shape)->halfSize), halfB(std::get_if<Cuboid>(b.shape)->halfSize),
          turnB((a.pose->orientation.conjugate() * b.pose->orientation).toRotationMatrix()),
          offset(a.pose->directionToBody(b.pose->position - a.pose->position)) {}

    const Vec3& between() const { return offset; }
    double size() const { return halfA.norm() + halfB.norm(); }
    double separationAlong(const Vec3& n) const {
        return offset.dot(n) - halfA.dot(n.cwiseAbs()) - halfB.dot((turnB.transpose() * n).cwiseAbs());
    }
    Vec3 cornerOfA(const Vec3& sign) const { return sign.cwiseProduct(halfA); }
    Vec3 cornerOfB(const Vec3& sign) const { return offset + turnB * sign.cwiseProduct(halfB); }
};

Vec3 signsOf(unsigned corner) {
    return {(corner & 1U) != 0 ? 1.0 : -1.0, (corner & 2U) != 0 ? 1.0 : -1.0,
            (corner & 4U) != 0 ? 1.0 : -1.0};
}

// The least distance between features so far, as the vector from A to B.
struct Nearest {
    Vec3 between = Vec3::Zero();
    double squared = std::numeric_limits<double>::infinity();

    void consider(const Vec3& candidate) {
        const double candidateSquared = candidate.squaredNorm();
        if (candidateSquared < squared) {
            squared = candidateSquared;
            between = candidate;
        }
    }
};

void considerCorners(const CuboidPair& pair, Nearest& nearest) {
    for (unsigned corner = 0; corner < 8; ++corner) {
        const Vec3 ofB = pair.cornerOfB(signsOf(corner));
        nearest.consider(ofB - ofB.cwiseMin(pair.halfA).cwiseMax(-pair.halfA));
        const Vec3 ofA = pair.turnB.transpose() * (pair.cornerOfA(signsOf(corner)) - pair.offset);
        nearest.consider(pair.turnB * (ofA.cwiseMin(pair.halfB).cwiseMax(-pair.halfB) - ofA));
    }
}

// Corners of edge 0..11: four along each axis.
std::pair<unsigned, unsigned> endsOfEdge(unsigned edge) {
    const unsigned axis = edge / 4;
    const unsigned low = edge % 4;
    const unsigned first = (low & 1U) << ((axis + 1) % 3) | (low >> 1U) << ((axis + 2) % 3);
    return {first, first | 1U << axis};
}

// Edges whose projections on `axis`, which points from A to B, are further apart than the nearest features so
// far are left out.
void considerEdges(const CuboidPair& pair, const Vec3& axis, Nearest& nearest) {
    /// Of the size: far above the rounding of a projection, so that a pair as near as the nearest one is
    /// never left out. Twice or half changes only how many are tried.
    constexpr double rounding = 1e-14;
    const double tolerance = rounding * pair.size();
    std::array<Segment, 12> ofB;
    std::array<double, 12> least; // of the projection [m]
    for (unsigned edge = 0; edge < 12; ++edge) {
        const auto [from, to] = endsOfEdge(edge);
        ofB[edge] = {pair.cornerOfB(signsOf(from)), pair.cornerOfB(signsOf(to))};
        least[edge] = std::min(axis.dot(ofB[edge].from), axis.dot(ofB[edge].to)) - tolerance;
    }
    for (unsigned edge = 0; edge < 12; ++edge) {
        const auto [from, to] = endsOfEdge(edge);
        const Segment ofA = {pair.cornerOfA(signsOf(from)), pair.cornerOfA(signsOf(to))};
        const double largest = std::max(axis.dot(ofA.from), axis.dot(ofA.to));
        for (unsigned other = 0; other < 12; ++other) {
            if (least[other] - largest > std::sqrt(nearest.squared)) continue;
            const SegmentPair points = nearestPoints(ofA, ofB[other]);
            nearest.consider(points.onB - points.onA);
        }
    }
}

// Apart: some face normal or edge product separates, but the direction of the distance may be none of them.
void considerNearestFeatures(AxisSearch<CuboidPair>& search, const CuboidPair& pair) {
    Nearest nearest;
    considerCorners(pair, nearest);
    search.considerEitherWay(nearest.between);
    // Where the gap between projections is as wide as the distance of two points, both are optimal.
    const double enough = search.best().separation * (1 + 1e-14);
    if (nearest.squared <= enough * enough) return;
    considerEdges(pair, search.best().normal, nearest);
    search.considerEitherWay(nearest.between);
}

CAROM_WIDE BestAxis searchAxes(const CuboidPair& pair, double margin) {
    AxisSearch<CuboidPair> search(pair);
    for (int i = 0; i < 3; ++i) search.considerEitherWay(Vec3::Unit(i));
    for (int i = 0; i < 3; ++i) search.considerEitherWay(pair.turnB.col(i));
    if (search.apartBy(margin)) return search.best();
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) search.considerEitherWay(Vec3::Unit(i).cross(pair.turnB.col(j)));
    if (search.best().separation > 0 && !search.apartBy(margin)) considerNearestFeatures(search, pair);
    return search.best();
}

BestAxis inWorld(const PlacedShape& a, const BestAxis& best) {
    return {a.pose->directionToWorld(best.normal), best.separation};
}

} // namespace

bool collideCuboidCuboid(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold) {
    const BestAxis best = inWorld(a, searchAxes(CuboidPair(a, b), margin));
    manifold.normal = best.normal;
    if (!(best.separation <= margin)) return false;
    fillManifold(a, b, best, margin, manifold);
    return true;
}

Proximity proximityCuboidCuboid(const PlacedShape& a, const PlacedShape& b) {
    const BestAxis best = searchAxes(CuboidPair(a, b), std::numeric_limits<double>::infinity());
    return witnessesAlong(a, b, inWorld(a, best));
}

} // namespace carom
