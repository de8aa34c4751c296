// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/sphere_pairs.h"

#include "core/narrowphase/point_distance.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

template<class Other>
PointDistance measure(const PlacedShape& a, const PlacedShape& b) {
    return signedDistance(*std::get_if<Other>(b.shape), b.pose->toBody(a.pose->position));
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
