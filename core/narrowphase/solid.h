// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/narrowphase/narrowphase.h"

#include <cmath>

namespace carom {

/// A cylinder or a cuboid where it is, as numbers that directions and points are taken to the body with:
/// points are seen from any origin, along the axes of the world.
struct Solid {
    bool isCylinder = false;
    Vec3 half = Vec3::Zero(); ///< of a cuboid; of a cylinder radius, half height, radius [m]
    Mat3 turn = Mat3::Identity();
    Vec3 centre = Vec3::Zero(); ///< [m]

    Vec3 inBody(const Vec3& direction) const { return turn.transpose() * direction; }
    /// The point furthest along `direction`.
    Vec3 support(const Vec3& direction) const {
        const Vec3 along = inBody(direction);
        Vec3 point(along.x() < 0 ? -half.x() : half.x(), along.y() < 0 ? -half.y() : half.y(),
                   along.z() < 0 ? -half.z() : half.z());
        if (isCylinder) {
            const double across = std::sqrt(along.x() * along.x() + along.z() * along.z());
            const double part = across > 0 ? half.x() / across : 0;
            point.x() = part * along.x();
            point.z() = part * along.z();
        }
        return centre + turn * point;
    }
    /// How far it reaches from its centre along unit `direction` [m].
    double extent(const Vec3& direction) const {
        const Vec3 along = inBody(direction);
        if (!isCylinder) return half.dot(along.cwiseAbs());
        return half.x() * std::sqrt(along.x() * along.x() + along.z() * along.z()) +
               half.y() * std::abs(along.y());
    }
    bool contains(const Vec3& point, double tolerance) const {
        const Vec3 from = inBody(point - centre).cwiseAbs();
        if (!isCylinder) return (from.array() <= half.array() + tolerance).all();
        const double most = half.x() + tolerance;
        return from.y() <= half.y() + tolerance && from.x() * from.x() + from.z() * from.z() <= most * most;
    }
    /// visit(axis) for each direction that has faces across it, and edges along it.
    template<class Visit>
    void forEachAxis(const Visit& visit) const {
        if (isCylinder) return visit(Eigen::Index{1});
        for (Eigen::Index axis = 0; axis < 3; ++axis) visit(axis);
    }
};

/// Whether the shape is a cylinder or a cuboid.
inline bool isSolid(const Shape& shape) {
    return std::holds_alternative<Cylinder>(shape) || std::holds_alternative<Cuboid>(shape);
}

/// Of a cylinder or cuboid, seen from `origin` [m].
Solid solidOf(const PlacedShape& placed, const Vec3& origin);

/// The gap between the projections of both on unit `axis` [m]: how far they are apart at least, if the axis
/// points from A to B.
inline double gapAlong(const Vec3& axis, const Solid& a, const Solid& b) {
    return axis.dot(b.centre - a.centre) - a.extent(axis) - b.extent(axis);
}

/// [m], negative inside; exact.
double signedDistance(const Solid& solid, const Vec3& point);

} // namespace carom
