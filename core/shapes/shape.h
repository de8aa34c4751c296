// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/shapes/cuboid.h"
#include "core/shapes/cylinder.h"
#include "core/shapes/sphere.h"
#include "core/shapes/wall.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <variant>

// All shapes. A shape is registered by its place in this variant and nowhere else; code that treats each kind
// uses std::visit or a table with one row a kind, so a forgotten kind does not compile.

namespace carom {

using Shape = std::variant<Sphere, Wall, Cylinder, Cuboid>;

/// Which of them a shape is: its place in the variant.
enum class ShapeKind : std::uint8_t {};
inline constexpr std::size_t shapeKindCount = std::variant_size_v<Shape>;

inline ShapeKind kindOf(const Shape& shape) { return static_cast<ShapeKind>(shape.index()); }

template<class S>
constexpr ShapeKind kindOf() {
    return []<class... Each>(const std::variant<Each...>*) {
        std::size_t place = 0;
        static_cast<void>(((std::is_same_v<S, Each> || (++place, false)) || ...));
        return static_cast<ShapeKind>(place);
    }(static_cast<const Shape*>(nullptr));
}

/// The word of the scene language: "sphere", "wall", "cylinder", "cuboid".
constexpr std::string_view nameOf(ShapeKind kind) {
    return [kind]<class... Each>(const std::variant<Each...>*) {
        constexpr std::array<std::string_view, shapeKindCount> names = {Each::name...};
        return names[static_cast<std::size_t>(kind)];
    }(static_cast<const Shape*>(nullptr));
}

inline bool isWall(const Shape& shape) { return std::holds_alternative<Wall>(shape); }

/// The boxes a broad-phase is given.
enum class BoxKind : std::uint8_t {
    Tight, ///< the smallest of the body as it lies
    Cube,  ///< the reference's (its section 3.7.1): of the ball that holds the body however it lies
};

/// The functions below treat every bounded shape; asking them of a Wall is a programmer's mistake.
Aabb boundsOf(const Shape& shape, const Pose& worldFromBody);
Aabb boxOf(const Shape& shape, const Pose& worldFromBody, BoxKind kind);
Vec3 inertiaOf(const Shape& shape, double mass);
Vec3 supportOf(const Shape& shape, const Vec3& direction);
double halfThicknessOf(const Shape& shape);
double boundingRadiusOf(const Shape& shape);
double projectedArea(const Shape& shape, const Vec3& direction);
double largestProjectedArea(const Shape& shape);
bool hasCentralNormals(const Shape& shape);
std::string_view sizeParameterOf(const Shape& shape);

} // namespace carom
