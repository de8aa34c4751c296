// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/aabb.h"
#include "core/math/pose.h"

#include <string_view>

namespace carom {

/// A solid ball of uniform density around the body's origin.
struct Sphere {
    static constexpr std::string_view name = "sphere"; ///< the word of the scene language
    static constexpr std::string_view sizeParameter =
        "radius"; ///< what in the language makes it larger or smaller
    /// Whether every normal of the surface passes through the centre, so that no frictionless impulse turns
    /// it.
    static constexpr bool hasCentralNormals = true;

    double radius = 0; ///< [m] > 0
};

inline Aabb boundsOf(const Sphere& sphere, const Pose& worldFromBody) {
    const Vec3 half = Vec3::Constant(sphere.radius);
    return {worldFromBody.position - half, worldFromBody.position + half};
}
/// Principal moments of inertia about the centre [kg m²], body axes: 2/5 m r².
Vec3 inertiaOf(const Sphere& sphere, double mass);
/// The point of the shape furthest along `direction` (body coordinates, any length but zero).
Vec3 supportOf(const Sphere& sphere, const Vec3& direction);
/// Half the thinnest way through the shape [m].
double halfThicknessOf(const Sphere& sphere);
/// Radius of the smallest ball about the origin that contains the shape [m].
double boundingRadiusOf(const Sphere& sphere);
/// Area of the projection along `direction` (body coordinates, a unit vector) [m²]: π r².
double projectedArea(const Sphere& sphere, const Vec3& direction);
/// The largest of any direction [m²].
double largestProjectedArea(const Sphere& sphere);

} // namespace carom
