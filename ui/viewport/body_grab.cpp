// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/body_grab.h"

#include "ui/viewport/overlays.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

constexpr double reach = 9;       ///< [px] around a tip
constexpr double steepest = 0.02; ///< sine of the angle at which a ray still meets a plane in a useful place

/// Where the ray through a pixel meets a plane; nothing where they are nearly parallel.
std::optional<Vec3> meet(const Camera& camera, const PictureSize& picture, const Eigen::Vector2d& pixel,
                         const Vec3& point, const Vec3& normal) {
    const Ray ray = rayThrough(camera, picture, pixel);
    const double slope = ray.direction.dot(normal);
    if (std::abs(slope) < steepest) return std::nullopt;
    return ray.origin + (point - ray.origin).dot(normal) / slope * ray.direction;
}

} // namespace

std::optional<BodyGrab> grabTip(const Camera& camera, const PictureSize& picture,
                                const Eigen::Vector2d& pixel, std::span<const Pose> poses,
                                std::span<const Vec3> velocities) {
    std::optional<BodyGrab> nearest;
    double least = reach;
    for (std::size_t i = 0; i < std::min(poses.size(), velocities.size()); ++i) {
        if (velocities[i] == Vec3::Zero()) continue;
        const Vec3 tip = poses[i].position + velocityTime * velocities[i];
        const std::optional<Eigen::Vector2d> at = projected(camera, picture, tip);
        if (!at || !((*at - pixel).norm() < least)) continue;
        least = (*at - pixel).norm();
        nearest = {static_cast<BodyIndex>(i), BodyHandle::Velocity, velocities[i], tip, pixel};
    }
    return nearest;
}

Vec3 draggedValue(const BodyGrab& grab, const Camera& camera, const PictureSize& picture,
                  const Eigen::Vector2d& pixel, bool level) {
    const Vec3 normal = level ? Vec3(Vec3::UnitY()) : camera.forward();
    const std::optional<Vec3> from = meet(camera, picture, grab.pixel, grab.point, normal);
    const std::optional<Vec3> to = meet(camera, picture, pixel, grab.point, normal);
    if (!from || !to) return grab.value;
    const Vec3 moved = *to - *from;
    return grab.value + (grab.handle == BodyHandle::Velocity ? Vec3(moved / velocityTime) : moved);
}

} // namespace carom
