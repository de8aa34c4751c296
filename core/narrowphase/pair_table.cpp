// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/pair_table.h"

#include "core/base/assert.h"
#include "core/narrowphase/cuboid_cuboid.h"
#include "core/narrowphase/cylinder_cuboid.h"
#include "core/narrowphase/cylinder_cylinder.h"
#include "core/narrowphase/sphere_pairs.h"
#include "core/narrowphase/wall_pairs.h"

#include <algorithm>
#include <array>

namespace carom {
namespace {

// A cell below the diagonal is its mirror image above it, seen from the other side.
template<const PairMethods& methods>
constexpr PairMethods mirrored = {
    [](const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold) {
        const bool found = methods.collide(b, a, margin, manifold);
        flip(manifold);
        return found;
    },
    [](const PlacedShape& a, const PlacedShape& b) { return flipped(methods.proximity(b, a)); }};

// A diagonal cell whose kernel is not symmetric by construction runs in geometric order.
template<const PairMethods& methods>
constexpr PairMethods ordered = {
    [](const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold) {
        return inOrder(a, b) ? methods.collide(a, b, margin, manifold)
                             : mirrored<methods>.collide(a, b, margin, manifold);
    },
    [](const PlacedShape& a, const PlacedShape& b) {
        return inOrder(a, b) ? methods.proximity(a, b) : mirrored<methods>.proximity(a, b);
    }};

constexpr PairMethods sphereSphere = {collideSphereSphere, proximitySphereSphere};
constexpr PairMethods sphereWall = {collideSphereWall, proximitySphereWall};
constexpr PairMethods sphereCylinder = {collideSphereCylinder, proximitySphereCylinder};
constexpr PairMethods sphereCuboid = {collideSphereCuboid, proximitySphereCuboid};
constexpr PairMethods wallCylinder = {collideWallCylinder, proximityWallCylinder};
constexpr PairMethods wallCuboid = {collideWallCuboid, proximityWallCuboid};
constexpr PairMethods wallWall = {collideNever, proximityNever};
constexpr PairMethods cylinderCylinder = {collideCylinderCylinder, proximityCylinderCylinder};
constexpr PairMethods cylinderCuboid = {collideCylinderCuboid, proximityCylinderCuboid};
constexpr PairMethods cuboidCuboid = {collideCuboidCuboid, proximityCuboidCuboid};

// clang-format off
constexpr std::array<std::array<PairMethods, shapeKindCount>, shapeKindCount> table = {{
    //               sphere                    wall                    cylinder                   cuboid
    /* sphere   */ {{sphereSphere,             sphereWall,             sphereCylinder,            sphereCuboid}},
    /* wall     */ {{mirrored<sphereWall>,     wallWall,               wallCylinder,              wallCuboid}},
    /* cylinder */ {{mirrored<sphereCylinder>, mirrored<wallCylinder>, ordered<cylinderCylinder>, cylinderCuboid}},
    /* cuboid   */ {{mirrored<sphereCuboid>,   mirrored<wallCuboid>,   mirrored<cylinderCuboid>,  ordered<cuboidCuboid>}},
}};
// clang-format on

// -1, 0 or 1: the lexicographic order of two rows of numbers.
template<class Row>
int compare(const Row& a, const Row& b) {
    for (Eigen::Index i = 0; i < a.size(); ++i)
        if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
    return 0;
}

Vec3 sizeOf(const Shape& shape) {
    struct Size {
        Vec3 operator()(const Sphere& sphere) const { return {sphere.radius, 0, 0}; }
        Vec3 operator()(const Wall& wall) const { return wall.normal * wall.offset; }
        Vec3 operator()(const Cylinder& cylinder) const { return {cylinder.radius, cylinder.halfHeight, 0}; }
        Vec3 operator()(const Cuboid& cuboid) const { return cuboid.halfSize; }
    };
    return std::visit(Size{}, shape);
}

} // namespace

const PairMethods& pairMethods(ShapeKind a, ShapeKind b) {
    return table[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
}

bool inOrder(const PlacedShape& a, const PlacedShape& b) {
    ASSERT(kindOf(*a.shape) == kindOf(*b.shape));
    if (const int bySize = compare(sizeOf(*a.shape), sizeOf(*b.shape)); bySize != 0) return bySize < 0;
    if (const int byPlace = compare(a.pose->position, b.pose->position); byPlace != 0) return byPlace < 0;
    return compare(a.pose->orientation.coeffs(), b.pose->orientation.coeffs()) <= 0;
}

} // namespace carom
