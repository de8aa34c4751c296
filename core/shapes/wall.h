// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/types.h"

#include <string_view>

namespace carom {

/// An immobile half-space in world coordinates: the surface is { x : normal·x = offset }, the solid lies
/// behind it (normal·x < offset). In the scene language offset = -toOrig. A wall has no box, no mass and no
/// inertia, and never enters the broad-phase; its body's pose is the identity.
///
///     normal ^
///            |
///     -------+------- surface
///     ///////////////  solid
struct Wall {
    static constexpr std::string_view name = "wall"; ///< the word of the scene language

    Vec3 normal = Vec3::UnitY(); ///< unit
    double offset = 0;           ///< [m]
};

/// Signed distance of a point from the surface [m], positive on the free side.
inline double distanceTo(const Wall& wall, const Vec3& point) { return wall.normal.dot(point) - wall.offset; }

} // namespace carom
