// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/shapes/cylinder.h"

#include "core/base/wide.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom {

CAROM_WIDE Aabb boundsOf(const Cylinder& cylinder, const Pose& worldFromBody) {
    const Vec3 axis = axisOf(worldFromBody);
    Vec3 half;
    for (int i = 0; i < 3; ++i) {
        const double j = axis[(i + 1) % 3];
        const double k = axis[(i + 2) % 3];
        const double across = std::sqrt(j * j + k * k); // 1 - axis[i]² would cancel near an upright axis
        half[i] = cylinder.halfHeight * std::abs(axis[i]) + cylinder.radius * across;
    }
    return {worldFromBody.position - half, worldFromBody.position + half};
}

Vec3 inertiaOf(const Cylinder& cylinder, double mass) {
    const double r2 = cylinder.radius * cylinder.radius;
    const double height = 2 * cylinder.halfHeight;
    const double across = mass * (3 * r2 + height * height) / 12;
    return {across, mass * r2 / 2, across};
}

Vec3 supportOf(const Cylinder& cylinder, const Vec3& direction) {
    const double radial = std::hypot(direction.x(), direction.z());
    const double y = direction.y() < 0 ? -cylinder.halfHeight : cylinder.halfHeight;
    if (radial == 0) return {0, y, 0};
    const double scale = cylinder.radius / radial;
    return {scale * direction.x(), y, scale * direction.z()};
}

double halfThicknessOf(const Cylinder& cylinder) { return std::min(cylinder.radius, cylinder.halfHeight); }

double boundingRadiusOf(const Cylinder& cylinder) { return std::hypot(cylinder.radius, cylinder.halfHeight); }

double projectedArea(const Cylinder& cylinder, const Vec3& direction) {
    const double across = std::hypot(direction.x(), direction.z());
    const double side = 4 * cylinder.radius * cylinder.halfHeight;
    return side * across + std::numbers::pi * cylinder.radius * cylinder.radius * std::abs(direction.y());
}

double largestProjectedArea(const Cylinder& cylinder) {
    const double side = 4 * cylinder.radius * cylinder.halfHeight;
    return std::hypot(side, std::numbers::pi * cylinder.radius * cylinder.radius);
}

} // namespace carom
