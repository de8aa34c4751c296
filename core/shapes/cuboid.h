// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/aabb.h"
#include "core/math/pose.h"

#include <string_view>

namespace carom {

/// A solid box of uniform density, edges along the body's axes, centre at the body's origin.
struct Cuboid {
    static constexpr std::string_view name = "cuboid"; ///< the word of the scene language
    static constexpr std::string_view sizeParameter =
        "size"; ///< what in the language makes it larger or smaller
    /// Whether every normal of the surface passes through the centre, so that no frictionless impulse turns
    /// it.
    static constexpr bool hasCentralNormals = false;

    Vec3 halfSize = Vec3::Zero(); ///< half the edge lengths [m], each > 0
};

/// Tight box: half-widths |R| halfSize, with |R| the rotation matrix in absolute values.
Aabb boundsOf(const Cuboid& cuboid, const Pose& worldFromBody);
/// Principal moments about the centre [kg m²]: m (b² + c²)/3 with b, c the other two half sizes.
Vec3 inertiaOf(const Cuboid& cuboid, double mass);
Vec3 supportOf(const Cuboid& cuboid, const Vec3& direction);
double halfThicknessOf(const Cuboid& cuboid);
double boundingRadiusOf(const Cuboid& cuboid);
/// Σ |n · direction| area over the three faces.
double projectedArea(const Cuboid& cuboid, const Vec3& direction);
double largestProjectedArea(const Cuboid& cuboid);

} // namespace carom
