// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/aabb.h"
#include "core/math/pose.h"

#include <string_view>

namespace carom {

/// A solid cylinder of uniform density; its axis is the body's y axis, its centre the body's origin.
///
///            y
///        .---|---.
///        |   |   |  halfHeight
///        |   o---|--> x
///        |       |
///        '-------'  radius
struct Cylinder {
    static constexpr std::string_view name = "cylinder"; ///< the word of the scene language
    static constexpr std::string_view sizeParameter =
        "radius"; ///< what in the language makes it larger or smaller
    /// Whether every normal of the surface passes through the centre, so that no frictionless impulse turns
    /// it.
    static constexpr bool hasCentralNormals = false;

    double radius = 0;     ///< [m] > 0
    double halfHeight = 0; ///< from the centre to a cap [m] > 0
};

/// Tight box: along each world axis e the half-width is halfHeight |a·e| + radius sqrt(1 - (a·e)²), a the
/// axis.
Aabb boundsOf(const Cylinder& cylinder, const Pose& worldFromBody);
/// Principal moments about the centre [kg m²]: m (3 r² + h²)/12 across, m r²/2 about the axis, h the whole
/// height.
Vec3 inertiaOf(const Cylinder& cylinder, double mass);
Vec3 supportOf(const Cylinder& cylinder, const Vec3& direction);
double halfThicknessOf(const Cylinder& cylinder);
double boundingRadiusOf(const Cylinder& cylinder);
/// 2 r h sqrt(1 − c²) + π r² |c| with c the cosine between direction and axis, h the whole height.
double projectedArea(const Cylinder& cylinder, const Vec3& direction);
double largestProjectedArea(const Cylinder& cylinder);

/// The axis in world coordinates, a unit vector.
inline Vec3 axisOf(const Pose& worldFromBody) { return worldFromBody.orientation * Vec3::UnitY(); }

} // namespace carom
