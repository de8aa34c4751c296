// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/narrowphase/fcl_oracle.h"

#include "core/math/rotation.h"

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <memory>
#include <numbers>

namespace carom::testing {
namespace {

std::shared_ptr<fcl::CollisionGeometryd> geometryOf(const Shape& shape) {
    if (const Sphere* sphere = std::get_if<Sphere>(&shape))
        return std::make_shared<fcl::Sphered>(sphere->radius);
    if (const Cylinder* cylinder = std::get_if<Cylinder>(&shape))
        return std::make_shared<fcl::Cylinderd>(cylinder->radius, 2 * cylinder->halfHeight);
    const Vec3 sides = 2 * std::get_if<Cuboid>(&shape)->halfSize;
    return std::make_shared<fcl::Boxd>(sides.x(), sides.y(), sides.z());
}

fcl::CollisionObjectd placed(const Shape& shape, const Pose& pose) {
    Quat turn = pose.orientation; // FCL's cylinders stand along z
    if (std::holds_alternative<Cylinder>(shape))
        turn = turn * fromRotationVector(Vec3(-std::numbers::pi / 2, 0, 0));
    return {geometryOf(shape), turn.toRotationMatrix(), pose.position};
}

} // namespace

double distanceByFcl(const ShapePair& pair) {
    const fcl::CollisionObjectd a = placed(pair.shapeA, pair.poseA);
    const fcl::CollisionObjectd b = placed(pair.shapeB, pair.poseB);
    fcl::DistanceRequestd request;
    request.enable_nearest_points = true;
    request.gjk_solver_type = fcl::GST_LIBCCD;
    request.distance_tolerance = 1e-9;
    fcl::DistanceResultd result;
    fcl::distance(&a, &b, request, result);
    return result.min_distance;
}

std::optional<double> depthByFcl(const ShapePair& pair) {
    const fcl::CollisionObjectd a = placed(pair.shapeA, pair.poseA);
    const fcl::CollisionObjectd b = placed(pair.shapeB, pair.poseB);
    fcl::CollisionRequestd request(8, true);
    request.gjk_solver_type = fcl::GST_LIBCCD;
    fcl::CollisionResultd result;
    if (fcl::collide(&a, &b, request, result) == 0) return std::nullopt;
    double deepest = 0;
    for (std::size_t i = 0; i < result.numContacts(); ++i)
        deepest = std::max(deepest, result.getContact(i).penetration_depth);
    return deepest;
}

} // namespace carom::testing
