// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/types.h"

namespace carom {

/// The rotation by |v| radians about v (exponential map); exact near zero, where sin(x)/x is a series.
Quat fromRotationVector(const Vec3& v);

/// The shortest rotation vector [rad] that gives q; |result| <= pi.
Vec3 toRotationVector(const Quat& q);

/// The shortest rotation that takes unit vector `from` to unit vector `to`. Where they are opposite the axis
/// is the coordinate axis least aligned with `from`, made orthogonal to it: the same on every machine.
Quat shortestRotation(const Vec3& from, const Vec3& to);

/// q' = ½ ω q [1/s] as x, y, z, w, of a body that turns at ω [rad/s], world.
Vec4 orientationRate(const Vec3& angularVelocity, const Quat& q);

/// Two unit vectors that with unit `n` make a right-handed orthonormal frame (n, first, second).
struct Tangents {
    Vec3 first, second;
};
Tangents tangentsOf(const Vec3& n);

} // namespace carom
