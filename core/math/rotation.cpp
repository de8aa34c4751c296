// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/rotation.h"

#include <cmath>

namespace carom {
namespace {

Vec3 leastAlignedAxis(const Vec3& n) {
    const Vec3 size = n.cwiseAbs();
    if (size.x() <= size.y() && size.x() <= size.z()) return Vec3::UnitX();
    return size.y() <= size.z() ? Vec3::UnitY() : Vec3::UnitZ();
}

} // namespace

Quat fromRotationVector(const Vec3& v) {
    const double angle = v.norm();
    const double half = 0.5 * angle;
    // sin(half)/angle = 1/2 - angle^2/48 + angle^4/3840 - ...; below 1e-2 the next term is under 2e-17 of it.
    const double angleSquared = angle * angle;
    const double scale = angle < 1e-2 ? 0.5 - angleSquared / 48.0 + angleSquared * angleSquared / 3840.0
                                      : std::sin(half) / angle;
    return {std::cos(half), scale * v.x(), scale * v.y(), scale * v.z()};
}

Vec3 toRotationVector(const Quat& q) {
    const double sign = q.w() < 0 ? -1.0 : 1.0;
    const double sine = q.vec().norm();
    if (sine == 0) return Vec3::Zero();
    const double angle = 2.0 * std::atan2(sine, sign * q.w());
    return (sign * angle / sine) * q.vec();
}

Quat shortestRotation(const Vec3& from, const Vec3& to) {
    const double cosine = from.dot(to);
    const Vec3 cross = from.cross(to);
    if (cosine >= 0) return Quat(1 + cosine, cross.x(), cross.y(), cross.z()).normalized();
    // Beyond a right angle 1 + cosine loses its digits, and the cross product its direction. So the axis is
    // made orthogonal to `from` once more, and cos(half) = sine / (2 sin(half)).
    constexpr double noSine =
        1e-15; // rounding: any axis orthogonal to `from` will do, but always the same one
    const double sine = cross.norm();
    const Vec3 rough = sine > noSine ? Vec3(cross / sine) : from.cross(leastAlignedAxis(from)).normalized();
    const Vec3 axis = (rough - from.dot(rough) * from).normalized();
    const double sinHalf = std::sqrt(0.5 * (1 - cosine));
    const double cosHalf = sine > noSine ? sine / (2 * sinHalf) : 0;
    return Quat(cosHalf, sinHalf * axis.x(), sinHalf * axis.y(), sinHalf * axis.z()).normalized();
}

Vec4 orientationRate(const Vec3& angularVelocity, const Quat& q) {
    const Vec3 half = 0.5 * angularVelocity;
    return (Quat(0, half.x(), half.y(), half.z()) * q).coeffs();
}

Tangents tangentsOf(const Vec3& n) {
    const Vec3 first = n.cross(leastAlignedAxis(n)).normalized();
    return {first, n.cross(first)};
}

} // namespace carom
