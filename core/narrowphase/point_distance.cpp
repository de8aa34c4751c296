// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/point_distance.h"

#include <cmath>

namespace carom {
namespace {

// Radial direction of a point off the axis; the body's x axis for a point on it.
Vec3 radialOf(const Vec3& point, double rho) {
    return rho > 0 ? Vec3(point.x() / rho, 0, point.z() / rho) : Vec3(Vec3::UnitX());
}

} // namespace

PointDistance signedDistance(const Cylinder& cylinder, const Vec3& point) {
    enum Feature : std::uint32_t { Side, CapBelow, CapAbove, RimBelow, RimAbove };
    const double rho = std::sqrt(point.x() * point.x() + point.z() * point.z());
    const double sign = point.y() < 0 ? -1 : 1;
    const double beyondSide = rho - cylinder.radius;
    const double beyondCap = std::abs(point.y()) - cylinder.halfHeight;
    const Vec3 radial = radialOf(point, rho);
    const Vec3 up(0, sign, 0);
    if (beyondSide > 0 && beyondCap > 0) {
        const double distance = std::sqrt(beyondSide * beyondSide + beyondCap * beyondCap);
        return {distance, (beyondSide * radial + beyondCap * up) / distance,
                cylinder.radius * radial + cylinder.halfHeight * up, sign < 0 ? RimBelow : RimAbove};
    }
    if (beyondSide >= beyondCap) return {beyondSide, radial, point - beyondSide * radial, Side};
    return {beyondCap, up, point - beyondCap * up, sign < 0 ? CapBelow : CapAbove};
}

// Features of a cuboid: for each axis 0 between, 1 below, 2 above; the sum of 3^axis times that.
PointDistance signedDistance(const Cuboid& cuboid, const Vec3& point) {
    constexpr std::uint32_t weight[3] = {1, 3, 9};
    const Vec3 beyond = point.cwiseAbs() - cuboid.halfSize;
    const Vec3 sign(point.x() < 0 ? -1 : 1, point.y() < 0 ? -1 : 1, point.z() < 0 ? -1 : 1);
    PointDistance result;
    if ((beyond.array() <= 0).all()) { // inside: out through the nearest face, the first of equals
        int axis = 0;
        for (int i = 1; i < 3; ++i)
            if (beyond[i] > beyond[axis]) axis = i;
        result.distance = beyond[axis];
        result.outward = Vec3::Zero();
        result.outward[axis] = sign[axis];
        result.nearest = point;
        result.nearest[axis] = sign[axis] * cuboid.halfSize[axis];
        result.feature = weight[axis] * (sign[axis] < 0 ? 1U : 2U);
        return result;
    }
    const Vec3 offset = beyond.cwiseMax(0).cwiseProduct(sign);
    result.distance = offset.norm();
    result.outward = offset / result.distance;
    for (int i = 0; i < 3; ++i) {
        result.nearest[i] = beyond[i] > 0 ? sign[i] * cuboid.halfSize[i] : point[i];
        if (beyond[i] > 0) result.feature += weight[i] * (sign[i] < 0 ? 1U : 2U);
    }
    return result;
}

} // namespace carom
