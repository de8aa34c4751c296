// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/convex.h"

#include "core/narrowphase/expanding_polytope.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace carom {
namespace {

// GJK ends when no point of the difference is nearer than the best by this part of the squared distance. Some
// tens of rounding errors: at a hundredth it may not end; at a hundred times, distances lose two digits.
constexpr double convergence = 1e-14;
// Shapes nearer than this part of the size touch; the polytope is used then. At a hundredth, the direction
// between the nearest points would be rounding; at a hundred times nothing changes.
constexpr double touching = 1e-14;
// A search that has not ended by then gives the best points so far. Twice or half changes only how near these
// are, and what such a search costs.
constexpr int maxIterations = 128;

// Up to four points and the weights of the point of their hull nearest the origin.
struct Simplex {
    std::array<DifferencePoint, 4> points;
    std::array<double, 4> weights{};
    std::size_t count = 0;

    Vec3 combine(Vec3 DifferencePoint::*member) const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < count; ++i) sum += weights[i] * (points[i].*member);
        return sum;
    }
};

// The point of the affine hull of `points` nearest the origin, if all its weights are positive.
std::optional<Simplex> project(Simplex simplex) {
    const auto edge = [&](std::size_t i) -> Vec3 {
        return simplex.points[i].value - simplex.points[0].value;
    };
    const Vec3& origin = simplex.points[0].value;
    std::array<double, 4>& weights = simplex.weights;
    if (simplex.count == 2) {
        weights[1] = -origin.dot(edge(1)) / edge(1).squaredNorm();
    } else if (simplex.count == 3) {
        const Vec3 normal = edge(1).cross(edge(2));
        weights[1] = -normal.dot(origin.cross(edge(2))) / normal.squaredNorm();
        weights[2] = -normal.dot(edge(1).cross(origin)) / normal.squaredNorm();
    } else if (simplex.count == 4) {
        const double volume = edge(1).dot(edge(2).cross(edge(3)));
        weights[1] = -origin.dot(edge(2).cross(edge(3))) / volume;
        weights[2] = -edge(1).dot(origin.cross(edge(3))) / volume;
        weights[3] = -edge(1).dot(edge(2).cross(origin)) / volume;
    }
    weights[0] = 1;
    for (std::size_t i = 1; i < simplex.count; ++i) weights[0] -= weights[i];
    for (std::size_t i = 0; i < simplex.count; ++i)
        if (!(weights[i] > 0 && weights[i] <= 1)) return std::nullopt; // also a degenerate face's NaN
    return simplex;
}

// The nearest valid face of the simplex: its 1, 3, 7 or 15 non-empty subsets of points, all tried.
Simplex nearestFaceOf(const Simplex& whole) {
    Simplex best;
    double least = std::numeric_limits<double>::infinity();
    for (unsigned subset = 1; subset < (1U << whole.count); ++subset) {
        Simplex face;
        for (std::size_t i = 0; i < whole.count; ++i)
            if ((subset >> i & 1U) != 0) face.points[face.count++] = whole.points[i];
        const std::optional<Simplex> projected = project(face);
        if (!projected) continue;
        const double squared =
            projected->count == 4 ? 0 : projected->combine(&DifferencePoint::value).squaredNorm();
        if (squared < least) {
            least = squared;
            best = *projected;
        }
    }
    return best;
}

Proximity inWorld(const Vec3& centreOfA, const Proximity& relative) {
    return {relative.distance, relative.normal, centreOfA + relative.onA, centreOfA + relative.onB};
}

} // namespace

Proximity proximityConvex(const PlacedShape& a, const PlacedShape& b) {
    const MinkowskiDifference difference(a, b);
    const double size = difference.size();
    const Vec3 start = difference.between().squaredNorm() > 0 ? difference.between() : Vec3(Vec3::UnitX());
    Simplex simplex;
    simplex.points[0] = difference.furthest(-start);
    simplex.weights[0] = 1;
    simplex.count = 1;
    Vec3 nearest = simplex.points[0].value;
    for (int i = 0; i < maxIterations; ++i) {
        const double squared = nearest.squaredNorm();
        if (squared <= touching * touching * size * size) break;
        const DifferencePoint next = difference.furthest(-nearest);
        if (squared - nearest.dot(next.value) <= convergence * squared) break;
        Simplex larger = simplex;
        larger.points[larger.count++] = next;
        larger = nearestFaceOf(larger);
        const Vec3 moved = larger.count == 4 ? Vec3(Vec3::Zero()) : larger.combine(&DifferencePoint::value);
        if (!(moved.squaredNorm() < squared)) break; // no improvement but rounding
        simplex = larger;
        nearest = moved;
    }
    const double distance = nearest.norm();
    if (distance > touching * size)
        return inWorld(a.pose->position,
                       {distance, nearest / distance, simplex.combine(&DifferencePoint::onA),
                        simplex.combine(&DifferencePoint::onB)});
    const PolytopeFace face = nearestFace(difference, {simplex.points.data(), simplex.count});
    return inWorld(a.pose->position, {-face.distance, -face.outward, face.onA, face.onB});
}

bool collideConvex(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold) {
    const Proximity found = proximityConvex(a, b);
    if (!(found.distance <= margin)) return false;
    manifold.normal = found.normal;
    manifold.add({found.onA, found.onB, found.distance, 0});
    return true;
}

} // namespace carom
