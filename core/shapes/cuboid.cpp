// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/shapes/cuboid.h"

namespace carom {

Aabb boundsOf(const Cuboid& cuboid, const Pose& worldFromBody) {
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

} // namespace carom
