// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/shapes/sphere.h"

#include <numbers>

namespace carom {

Vec3 inertiaOf(const Sphere& sphere, double mass) {
    return Vec3::Constant(0.4 * mass * sphere.radius * sphere.radius);
}

Vec3 supportOf(const Sphere& sphere, const Vec3& direction) {
    return (sphere.radius / direction.norm()) * direction;
}

double halfThicknessOf(const Sphere& sphere) { return sphere.radius; }

double boundingRadiusOf(const Sphere& sphere) { return sphere.radius; }

double projectedArea(const Sphere& sphere, const Vec3&) {
    return std::numbers::pi * sphere.radius * sphere.radius;
}

double largestProjectedArea(const Sphere& sphere) { return projectedArea(sphere, Vec3::UnitY()); }

} // namespace carom
