// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/shapes/sphere.h"

namespace carom {

Aabb boundsOf(const Sphere& sphere, const Pose& worldFromBody) {
    const Vec3 half = Vec3::Constant(sphere.radius);
    return {worldFromBody.position - half, worldFromBody.position + half};
}

Vec3 inertiaOf(const Sphere& sphere, double mass) {
    return Vec3::Constant(0.4 * mass * sphere.radius * sphere.radius);
}

Vec3 supportOf(const Sphere& sphere, const Vec3& direction) {
    return (sphere.radius / direction.norm()) * direction;
}

double halfThicknessOf(const Sphere& sphere) { return sphere.radius; }

double boundingRadiusOf(const Sphere& sphere) { return sphere.radius; }

} // namespace carom
