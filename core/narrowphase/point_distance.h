// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/shapes/cuboid.h"
#include "core/shapes/cylinder.h"

#include <cstdint>

// How far a point is from a shape, by the region of the surface nearest to it. Exact to rounding, inside and
// out.

namespace carom {

/// Where a point lies with respect to a shape, in the shape's own frame.
struct PointDistance {
    double distance = 0;          ///< [m], negative inside
    Vec3 outward = Vec3::UnitY(); ///< unit, away from the shape
    Vec3 nearest = Vec3::Zero();  ///< on the surface [m]
    std::uint32_t feature = 0;    ///< the region of the surface; the same while the nearest point stays in it
};

PointDistance signedDistance(const Cylinder& cylinder, const Vec3& point);
PointDistance signedDistance(const Cuboid& cuboid, const Vec3& point);

} // namespace carom
