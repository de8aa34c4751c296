// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/core_direction.h"

#include "core/narrowphase/contact_features.h"
#include "core/narrowphase/separating_axis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <variant>

namespace carom {
namespace {

/// The rim, as a part of the smallest dimension.
constexpr double rimPart = 0.05;
/// GJK ends when no point of the difference is nearer by this part of the squared distance: the direction is
/// right to a thousandth of a radian.
constexpr double convergence = 1e-6;
constexpr int mostIterations = 24;
/// Directions that are exact in their places win over the others within this part of the size.
constexpr double tie = 1e-6;

/// A shape less its rim, seen from A.
struct Core {
    bool isCylinder = false;
    Vec3 half = Vec3::Zero(); ///< of a cuboid; of a cylinder radius, half height, radius
    Mat3 turn = Mat3::Identity();
    Vec3 centre = Vec3::Zero();
    double rim = 0;

    Vec3 support(const Vec3& direction) const {
        const Vec3 inBody = turn.transpose() * direction;
        Vec3 point(std::copysign(half.x(), inBody.x()), std::copysign(half.y(), inBody.y()),
                   std::copysign(half.z(), inBody.z()));
        if (isCylinder) {
            const double across = std::sqrt(inBody.x() * inBody.x() + inBody.z() * inBody.z());
            const double part = across > 0 ? half.x() / across : 0;
            point.x() = part * inBody.x();
            point.z() = part * inBody.z();
        }
        return centre + turn * point;
    }
};

Core coreOf(const Shape& shape) {
    Core core;
    if (const Cylinder* cylinder = std::get_if<Cylinder>(&shape)) {
        core.isCylinder = true;
        core.half = {cylinder->radius, cylinder->halfHeight, cylinder->radius};
    } else {
        core.half = std::get_if<Cuboid>(&shape)->halfSize;
    }
    core.rim = rimPart * core.half.minCoeff();
    core.half.array() -= core.rim;
    return core;
}

/// Up to four points of the difference B − A.
struct Simplex {
    std::array<Vec3, 4> points;
    int count = 0;
};

// The point of a segment nearest the origin; the simplex becomes the part it is in.
Vec3 nearestOfSegment(Simplex& simplex) {
    const Vec3 a = simplex.points[0], b = simplex.points[1], along = b - a;
    const double part = -a.dot(along), whole = along.squaredNorm();
    if (part <= 0) {
        simplex.count = 1;
        return a;
    }
    if (part >= whole) {
        simplex.points[0] = b;
        simplex.count = 1;
        return b;
    }
    return a + part / whole * along;
}

// The same of a triangle (C. Ericson, "Real-Time Collision Detection", 2005, chapter 5.1.5).
Vec3 nearestOfTriangle(Simplex& simplex) {
    const Vec3 a = simplex.points[0], b = simplex.points[1], c = simplex.points[2];
    const Vec3 ab = b - a, ac = c - a;
    const auto keep = [&](const Vec3& one) {
        simplex.points[0] = one;
        simplex.count = 1;
        return one;
    };
    const auto keepEdge = [&](const Vec3& one, const Vec3& other, double part) {
        simplex.points[0] = one;
        simplex.points[1] = other;
        simplex.count = 2;
        return Vec3(one + part * (other - one));
    };
    const double d1 = -ab.dot(a), d2 = -ac.dot(a);
    if (d1 <= 0 && d2 <= 0) return keep(a);
    const double d3 = -ab.dot(b), d4 = -ac.dot(b);
    if (d3 >= 0 && d4 <= d3) return keep(b);
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return keepEdge(a, b, d1 / (d1 - d3));
    const double d5 = -ab.dot(c), d6 = -ac.dot(c);
    if (d6 >= 0 && d5 <= d6) return keep(c);
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return keepEdge(a, c, d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return keepEdge(b, c, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
    const double sum = va + vb + vc;
    return a + (vb / sum) * ab + (vc / sum) * ac;
}

// The same of a tetrahedron; zero if the origin is inside.
Vec3 nearestOfTetrahedron(Simplex& simplex) {
    constexpr std::array<std::array<std::size_t, 4>, 4> faces{
        {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}}};
    const Simplex whole = simplex;
    Vec3 nearest = Vec3::Zero();
    double least = std::numeric_limits<double>::infinity();
    for (const std::array<std::size_t, 4>& face : faces) {
        const Vec3 &a = whole.points[face[0]], &b = whole.points[face[1]], &c = whole.points[face[2]];
        const Vec3 normal = (b - a).cross(c - a);
        const double inside = normal.dot(whole.points[face[3]] - a), origin = -normal.dot(a);
        if (inside * origin > 0) continue; // the origin is on the side of the fourth point
        Simplex part{{a, b, c}, 3};
        const Vec3 point = nearestOfTriangle(part);
        if (const double squared = point.squaredNorm(); squared < least) {
            least = squared;
            nearest = point;
            simplex = part;
        }
    }
    return nearest;
}

Vec3 nearestOf(Simplex& simplex) {
    switch (simplex.count) {
    case 1:
        return simplex.points[0];
    case 2:
        return nearestOfSegment(simplex);
    case 3:
        return nearestOfTriangle(simplex);
    default:
        return nearestOfTetrahedron(simplex);
    }
}

/// The vector between the nearest points of two cores, from A to B; zero if they touch or overlap. Where it
/// is known to be longer than `far` the search ends.
Vec3 betweenCores(const Core& a, const Core& b, const Vec3& guess, double far) {
    const double small = 1e-6 * (a.half.maxCoeff() + b.half.maxCoeff());
    Simplex simplex;
    Vec3 v = guess;
    simplex.points[0] = b.support(-v) - a.support(v);
    simplex.count = 1;
    v = simplex.points[0];
    for (int i = 0; i < mostIterations; ++i) {
        const double squared = v.squaredNorm();
        if (squared <= small * small) return Vec3::Zero();
        const Vec3 w = b.support(-v) - a.support(v);
        const double bound = v.dot(w);
        if (squared - bound <= convergence * squared || bound > far * std::sqrt(squared)) return v;
        const auto same = [&](const Vec3& point) { return point == w; };
        if (std::any_of(simplex.points.begin(), simplex.points.begin() + simplex.count, same)) return v;
        simplex.points[static_cast<std::size_t>(simplex.count++)] = w;
        const Vec3 next = nearestOf(simplex);
        if (!(next.squaredNorm() < squared)) return next == Vec3::Zero() ? next : v;
        v = next;
    }
    return v;
}

} // namespace

bool haveCores(const Shape& a, const Shape& b) {
    const auto has = [](const Shape& shape) {
        return std::holds_alternative<Cylinder>(shape) || std::holds_alternative<Cuboid>(shape);
    };
    return has(a) && has(b);
}

bool collideCores(const PlacedShape& a, const PlacedShape& b, const Vec3& guess, double margin,
                  Manifold& manifold) {
    const Core coreA = coreOf(*a.shape);
    Core coreB = coreOf(*b.shape);
    const Mat3 turnA = a.pose->orientation.toRotationMatrix(), turnB = b.pose->orientation.toRotationMatrix();
    const Vec3 offset = b.pose->position - a.pose->position;
    coreB.turn = turnA.transpose() * turnB;
    coreB.centre = turnA.transpose() * offset;
    const double far = margin + std::sqrt(3.0) * (coreA.rim + coreB.rim); // so far at a corner
    const Vec3 between = betweenCores(coreA, coreB, turnA.transpose() * guess, far);
    const double distance = between.norm();
    if (!(distance > 0)) return collide(a, b, margin, manifold);
    const Vec3 found = turnA * between / distance;

    // The best of the directions that are exact somewhere, and of the one that was found.
    const double within = tie * (coreA.half.maxCoeff() + coreB.half.maxCoeff());
    BestAxis best;
    const auto consider = [&](const Vec3& direction) {
        const double separation = gapAlong(direction, a, b);
        if (separation > best.separation + within) best = {direction, separation};
    };
    const auto nearestAxis = [&](const Core& core, const Mat3& turn) {
        const Vec3 inBody = turn.transpose() * found;
        Eigen::Index axis = 1;
        if (!core.isCylinder) inBody.cwiseAbs().maxCoeff(&axis);
        consider(inBody[axis] < 0 ? Vec3(-turn.col(axis)) : Vec3(turn.col(axis)));
    };
    nearestAxis(coreA, turnA);
    nearestAxis(coreB, turnB);
    const auto considerTowards = [&](const Vec3& direction) {
        const double length = direction.norm();
        if (length > 1e-9)
            consider(direction.dot(found) < 0 ? Vec3(direction / -length) : Vec3(direction / length));
    };
    if (coreA.isCylinder) considerTowards(turnA.col(1).cross(offset).cross(turnA.col(1)) / offset.norm());
    if (coreB.isCylinder) considerTowards(turnB.col(1).cross(offset).cross(turnB.col(1)) / offset.norm());
    if (coreA.isCylinder && coreB.isCylinder) considerTowards(turnA.col(1).cross(turnB.col(1)));
    consider(found);

    manifold.normal = best.normal;
    manifold.count = 0;
    if (!(best.separation <= margin)) return false;
    fillManifold(a, b, best, margin, manifold);
    return true;
}

} // namespace carom
