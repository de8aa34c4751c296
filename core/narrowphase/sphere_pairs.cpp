// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/sphere_pairs.h"

#include <algorithm>
#include <cmath>

// Distances from a point to a cylinder and to a cuboid, by the regions of the surface nearest to it. The
// features are numbered so that a contact keeps its number while the sphere rolls within one region.

namespace carom {
namespace {

// Where a point lies with respect to a shape, in the shape's own frame.
struct PointDistance {
    double distance = 0; // [m], negative inside
    Vec3 outward;        // unit, away from the shape
    Vec3 nearest;        // on the surface [m]
    std::uint32_t feature = 0;
};

// Radial direction of a point off the axis; the body's x axis for a point on it.
Vec3 radialOf(const Vec3& point, double rho) {
    return rho > 0 ? Vec3(point.x() / rho, 0, point.z() / rho) : Vec3(Vec3::UnitX());
}

PointDistance distanceTo(const Cylinder& cylinder, const Vec3& point) {
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
PointDistance distanceTo(const Cuboid& cuboid, const Vec3& point) {
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

template<class Other>
PointDistance measure(const PlacedShape& a, const PlacedShape& b) {
    return distanceTo(*std::get_if<Other>(b.shape), b.pose->toBody(a.pose->position));
}

template<class Other>
Proximity proximity(const PlacedShape& a, const PlacedShape& b) {
    const Sphere& sphere = *std::get_if<Sphere>(a.shape);
    const PointDistance found = measure<Other>(a, b);
    const Vec3 normal = -b.pose->directionToWorld(found.outward);
    return {found.distance - sphere.radius, normal, a.pose->position + sphere.radius * normal,
            b.pose->toWorld(found.nearest)};
}

template<class Other>
bool collideWith(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold) {
    const Sphere& sphere = *std::get_if<Sphere>(a.shape);
    const PointDistance found = measure<Other>(a, b);
    const double separation = found.distance - sphere.radius;
    if (!(separation <= margin)) return false;
    const Vec3 normal = -b.pose->directionToWorld(found.outward);
    sphere_pairs::setSingle(manifold, normal,
                            {a.pose->position + sphere.radius * normal, b.pose->toWorld(found.nearest),
                             separation, found.feature});
    return true;
}

} // namespace

bool collideSphereCylinder(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold) {
    return collideWith<Cylinder>(a, b, margin, manifold);
}

bool collideSphereCuboid(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold) {
    return collideWith<Cuboid>(a, b, margin, manifold);
}

Proximity proximitySphereSphere(const PlacedShape& a, const PlacedShape& b) {
    const Sphere& sphereA = *std::get_if<Sphere>(a.shape);
    const Sphere& sphereB = *std::get_if<Sphere>(b.shape);
    const Vec3 between = b.pose->position - a.pose->position;
    const double distance = between.norm();
    const Vec3 normal =
        distance > 0 ? Vec3(between / distance) : sphere_pairs::directionAtOneCentre(sphereA, sphereB);
    return {distance - (sphereA.radius + sphereB.radius), normal, a.pose->position + sphereA.radius * normal,
            b.pose->position - sphereB.radius * normal};
}

Proximity proximitySphereWall(const PlacedShape& a, const PlacedShape& b) {
    const Sphere& sphere = *std::get_if<Sphere>(a.shape);
    const Wall& wall = *std::get_if<Wall>(b.shape);
    const double height = distanceTo(wall, a.pose->position);
    return {height - sphere.radius, -wall.normal, a.pose->position - sphere.radius * wall.normal,
            a.pose->position - height * wall.normal};
}

Proximity proximitySphereCylinder(const PlacedShape& a, const PlacedShape& b) {
    return proximity<Cylinder>(a, b);
}

Proximity proximitySphereCuboid(const PlacedShape& a, const PlacedShape& b) {
    return proximity<Cuboid>(a, b);
}

} // namespace carom
