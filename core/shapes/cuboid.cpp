// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/shapes/cuboid.h"

#include "core/base/wide.h"

namespace carom {
namespace {

/// Of the faces whose normals are x, y and z [m²].
Vec3 facesOf(const Cuboid& cuboid) {
    const Vec3& half = cuboid.halfSize;
    return 4 * Vec3(half.y() * half.z(), half.z() * half.x(), half.x() * half.y());
}

} // namespace

CAROM_WIDE Aabb boundsOf(const Cuboid& cuboid, const Pose& worldFromBody) {
    const Mat3 rotation = worldFromBody.orientation.toRotationMatrix();
    const Vec3 half = rotation.cwiseAbs() * cuboid.halfSize;
    return {worldFromBody.position - half, worldFromBody.position + half};
}

Vec3 inertiaOf(const Cuboid& cuboid, double mass) {
    const Vec3 squared = cuboid.halfSize.cwiseAbs2();
    return (mass / 3) * Vec3(squared.y() + squared.z(), squared.z() + squared.x(), squared.x() + squared.y());
}

Vec3 supportOf(const Cuboid& cuboid, const Vec3& direction) {
    Vec3 corner = cuboid.halfSize;
    for (int i = 0; i < 3; ++i)
        if (direction[i] < 0) corner[i] = -corner[i];
    return corner;
}

double halfThicknessOf(const Cuboid& cuboid) { return cuboid.halfSize.minCoeff(); }

double boundingRadiusOf(const Cuboid& cuboid) { return cuboid.halfSize.norm(); }

double projectedArea(const Cuboid& cuboid, const Vec3& direction) {
    return facesOf(cuboid).dot(direction.cwiseAbs());
}

double largestProjectedArea(const Cuboid& cuboid) { return facesOf(cuboid).norm(); }

} // namespace carom
