// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/rim_points.h"

#include "core/narrowphase/contact_features.h"

#include <optional>
#include <variant>

namespace carom {
namespace {

constexpr std::uint32_t rimOfA = 32, rimOfB = 33; // names beyond those of contact_region.cpp

bool isOver(const ContactFeature& feature, const Vec3& point) {
    if (feature.kind == ContactFeature::Kind::Disc)
        return (point - feature.centre).squaredNorm() <= feature.radius * feature.radius;
    if (feature.kind == ContactFeature::Kind::Line) return false;
    const auto side = [&](std::size_t k) {
        const Vec3 along = feature.corners[(k + 1) % 4] - feature.corners[k];
        return along.cross(point - feature.corners[k]).dot(feature.normal);
    };
    const bool isLeft = side(0) >= 0;
    for (std::size_t k = 1; k < 4; ++k)
        if ((side(k) >= 0) != isLeft) return false;
    return true;
}

/// Where a line through `point` along `normal` meets the surface of a shape that is turned to it.
std::optional<Vec3> onSurface(const PlacedShape& shape, const Vec3& normal, const Vec3& point) {
    if (const Wall* wall = std::get_if<Wall>(shape.shape))
        return Vec3(point - distanceTo(*wall, point) * wall->normal);
    if (std::holds_alternative<Sphere>(*shape.shape)) return std::nullopt;
    const ContactFeature feature = featureTowards(solidOf(shape, Vec3::Zero()), -normal);
    const Vec3 there =
        point + feature.normal.dot(feature.centre - point) / feature.normal.dot(normal) * normal;
    if (!isOver(feature, there)) return std::nullopt;
    return there;
}

/// A way within this angle of the axis [rad] points to no place of the rim: what is left across is rounding,
/// 1e-16 of the way. At a thousandth it is near that; at a thousand times, places a millionth of the way off
/// the axis are none.
constexpr double alongAxis = 1e-9;

/// The point of the rim of the cap that a shape turns along `normal`.
std::optional<Vec3> onRim(const PlacedShape& shape, const Vec3& normal, const Vec3& towards) {
    if (!std::holds_alternative<Cylinder>(*shape.shape)) return std::nullopt;
    const ContactFeature cap = featureTowards(solidOf(shape, Vec3::Zero()), normal);
    if (cap.kind != ContactFeature::Kind::Disc) return std::nullopt;
    const Vec3 way = towards - cap.centre;
    const Vec3 outward = way - way.dot(cap.normal) * cap.normal;
    if (!(outward.norm() > alongAxis * way.norm())) return std::nullopt;
    return Vec3(cap.centre + cap.radius * outward.normalized());
}

} // namespace

void addRimPoints(const PlacedShape& a, const PlacedShape& b, const Vec3& towards, Manifold& manifold) {
    const Vec3& normal = manifold.normal;
    if (const std::optional<Vec3> onA = onRim(a, normal, towards))
        if (const std::optional<Vec3> onB = onSurface(b, normal, *onA))
            manifold.add({*onA, *onB, normal.dot(*onB - *onA), rimOfA});
    if (const std::optional<Vec3> onB = onRim(b, -normal, towards))
        if (const std::optional<Vec3> onA = onSurface(a, -normal, *onB))
            manifold.add({*onA, *onB, normal.dot(*onB - *onA), rimOfB});
}

} // namespace carom
