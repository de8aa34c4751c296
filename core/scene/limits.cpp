// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/limits.h"

#include <cmath>

namespace carom {
namespace {

// Usable as a divisor: neither it nor its inverse overflows.
bool invertible(double x) { return x > 0 && std::isfinite(x) && std::isfinite(1 / x); }

bool invertible(const Vec3& v) { return invertible(v.x()) && invertible(v.y()) && invertible(v.z()); }

} // namespace

std::optional<LimitFault> limitFaultOf(const Body& body) {
    if (isWall(body.shape)) return std::nullopt;
    const std::string_view size = sizeParameterOf(body.shape);
    const std::string named = std::string("`").append(size).append("`");
    const double reach = boundingRadiusOf(body.shape);
    if (!invertible(reach * reach) || !invertible(halfThicknessOf(body.shape)))
        return LimitFault{size, "its size is beyond double precision; choose " + named + " nearer to 1"};
    if (!body.pose.orientation.coeffs().allFinite())
        return LimitFault{"rotation", "its angle overflows; choose an angle of at most a turn"};
    if (!std::isfinite(body.pose.position.squaredNorm()))
        return LimitFault{"centre", "its distance from the origin overflows when squared; place it nearer"};
    if (body.mass == 0) return std::nullopt;
    if (!invertible(body.mass))
        return LimitFault{"mass", "its inverse overflows; choose a `mass` nearer to 1"};
    const Vec3 inertia = inertiaOf(body.shape, body.mass);
    if (!invertible(inertia))
        return LimitFault{"mass", "its moment of inertia is beyond double precision; choose `mass` and " +
                                      named + " nearer to 1"};
    if (!std::isfinite(body.mass * body.velocity.squaredNorm()))
        return LimitFault{"vel", "its kinetic energy overflows; choose a smaller velocity"};
    if (!std::isfinite(inertia.maxCoeff() * body.angularVelocity.squaredNorm()))
        return LimitFault{"angvel", "its kinetic energy overflows; choose a smaller angular velocity"};
    return std::nullopt;
}

} // namespace carom
