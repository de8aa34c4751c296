// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/shapes/shape.h"

#include "core/base/assert.h"

namespace carom {
namespace {

// Calls `function` with the bounded shape inside; walls are the caller's mistake.
template<class Function>
auto visitBounded(const Shape& shape, const Function& function) {
    return std::visit(
        [&function](const auto& inside) {
            using Inside = std::remove_cvref_t<decltype(inside)>;
            if constexpr (std::is_same_v<Inside, Wall>) {
                ASSERT(false);
                return function(Sphere{});
            } else {
                return function(inside);
            }
        },
        shape);
}

} // namespace

Aabb boundsOf(const Shape& shape, const Pose& worldFromBody) {
    return visitBounded(shape, [&](const auto& s) { return boundsOf(s, worldFromBody); });
}

Aabb boxOf(const Shape& shape, const Pose& worldFromBody, BoxKind kind) {
    if (kind == BoxKind::Cube) return boundsOf(Sphere{boundingRadiusOf(shape)}, worldFromBody);
    return boundsOf(shape, worldFromBody);
}

Vec3 inertiaOf(const Shape& shape, double mass) {
    return visitBounded(shape, [&](const auto& s) { return inertiaOf(s, mass); });
}

Vec3 supportOf(const Shape& shape, const Vec3& direction) {
    return visitBounded(shape, [&](const auto& s) { return supportOf(s, direction); });
}

double halfThicknessOf(const Shape& shape) {
    return visitBounded(shape, [](const auto& s) { return halfThicknessOf(s); });
}

double boundingRadiusOf(const Shape& shape) {
    return visitBounded(shape, [](const auto& s) { return boundingRadiusOf(s); });
}

double projectedArea(const Shape& shape, const Vec3& direction) {
    return visitBounded(shape, [&](const auto& s) { return projectedArea(s, direction); });
}

double largestProjectedArea(const Shape& shape) {
    return visitBounded(shape, [](const auto& s) { return largestProjectedArea(s); });
}

bool hasCentralNormals(const Shape& shape) {
    return visitBounded(shape,
                        [](const auto& s) { return std::remove_cvref_t<decltype(s)>::hasCentralNormals; });
}

std::string_view sizeParameterOf(const Shape& shape) {
    return visitBounded(shape, [](const auto& s) { return std::remove_cvref_t<decltype(s)>::sizeParameter; });
}

} // namespace carom
