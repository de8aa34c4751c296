// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/narrowphase/narrowphase.h"

#include <cmath>

// A sphere against every kind. A ball only adds its radius to a point, so each pair is the signed distance
// from the sphere's centre to the other shape, less the radius:
//
//     separation(S, X) = signedDistance(centre, X) − radius
//
// In closed form, exact to rounding, inside as well as outside. Sphere–sphere and sphere–wall are in the
// header because they dominate most scenes.

namespace carom {

namespace sphere_pairs {

/// The only point of a manifold.
inline void setSingle(Manifold& manifold, const Vec3& normal, const ContactPoint& point) {
    manifold.normal = normal;
    manifold.points[0] = point;
    manifold.count = 1;
}

/// The direction between two spheres with one centre: up from the smaller, so that exchanging them reverses
/// it.
inline Vec3 directionAtOneCentre(const Sphere& a, const Sphere& b) {
    return a.radius <= b.radius ? Vec3(Vec3::UnitY()) : Vec3(-Vec3::UnitY());
}

} // namespace sphere_pairs

inline bool collideSphereSphere(const PlacedShape& a, const PlacedShape& b, double margin,
                                Manifold& manifold) {
    const Sphere& sphereA = *std::get_if<Sphere>(a.shape);
    const Sphere& sphereB = *std::get_if<Sphere>(b.shape);
    const Vec3 between = b.pose->position - a.pose->position;
    const double radii = sphereA.radius + sphereB.radius;
    const double reach = radii + margin;
    const double squared = between.squaredNorm();
    if (!(squared <= reach * reach)) {
        manifold.count = 0;
        return false;
    }
    const double distance = std::sqrt(squared);
    const Vec3 normal =
        distance > 0 ? Vec3(between / distance) : sphere_pairs::directionAtOneCentre(sphereA, sphereB);
    sphere_pairs::setSingle(manifold, normal,
                            {a.pose->position + sphereA.radius * normal,
                             b.pose->position - sphereB.radius * normal, distance - radii, 0});
    return true;
}

inline bool collideSphereWall(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold) {
    const Sphere& sphere = *std::get_if<Sphere>(a.shape);
    const Wall& wall = *std::get_if<Wall>(b.shape);
    const double height = distanceTo(wall, a.pose->position);
    const double separation = height - sphere.radius;
    if (!(separation <= margin)) {
        manifold.count = 0;
        return false;
    }
    sphere_pairs::setSingle(manifold, -wall.normal,
                            {a.pose->position - sphere.radius * wall.normal,
                             a.pose->position - height * wall.normal, separation, 0});
    return true;
}

bool collideSphereCylinder(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold);
bool collideSphereCuboid(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold);

Proximity proximitySphereSphere(const PlacedShape& a, const PlacedShape& b);
Proximity proximitySphereWall(const PlacedShape& a, const PlacedShape& b);
Proximity proximitySphereCylinder(const PlacedShape& a, const PlacedShape& b);
Proximity proximitySphereCuboid(const PlacedShape& a, const PlacedShape& b);

} // namespace carom
