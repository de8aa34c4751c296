// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom {

namespace {

constexpr double steepest = std::numbers::pi / 2;
/// Distances of the eye from its target [m]. Beyond them coordinates as floats on the graphics card have too
/// few digits, and bodies tremble.
constexpr double smallestDistance = 1e-4;
constexpr double largestDistance = 1e7;
/// Distance of the eye from a framed box, relative to the one at which it fills the picture; at 1 bodies
/// touch the edges.
constexpr double framingMargin = 1.12;

} // namespace

Vec3 Camera::forward() const {
    return {-std::sin(yaw) * std::cos(pitch), -std::sin(pitch), -std::cos(yaw) * std::cos(pitch)};
}

Vec3 Camera::right() const { return {std::cos(yaw), 0, -std::sin(yaw)}; }

Vec3 Camera::up() const { return right().cross(forward()); }

double Camera::pixelSize(const PictureSize& picture) const {
    return 2 * distance * std::tan(fieldOfView / 2) / picture.height;
}

Mat4 viewMatrix(const Camera& camera) {
    const Vec3 eye = camera.eye();
    Mat4 view = Mat4::Identity();
    view.block<1, 3>(0, 0) = camera.right().transpose();
    view.block<1, 3>(1, 0) = camera.up().transpose();
    view.block<1, 3>(2, 0) = -camera.forward().transpose();
    view.block<3, 1>(0, 3) = -view.block<3, 3>(0, 0) * eye;
    return view;
}

Mat4 projectionMatrix(const Camera& camera, const PictureSize& picture, double nearDepth, double farDepth) {
    const double tangent = std::tan(camera.fieldOfView / 2);
    const double depth = farDepth - nearDepth;
    Mat4 clip = Mat4::Zero();
    if (camera.orthographic) {
        const double halfHeight = camera.distance * tangent;
        clip(0, 0) = 1 / (halfHeight * picture.aspect());
        clip(1, 1) = 1 / halfHeight;
        clip(2, 2) = -2 / depth;
        clip(2, 3) = -(farDepth + nearDepth) / depth;
        clip(3, 3) = 1;
    } else {
        clip(0, 0) = 1 / (tangent * picture.aspect());
        clip(1, 1) = 1 / tangent;
        clip(2, 2) = -(farDepth + nearDepth) / depth;
        clip(2, 3) = -2 * farDepth * nearDepth / depth;
        clip(3, 2) = -1;
    }
    return clip;
}

Ray rayThrough(const Camera& camera, const PictureSize& picture, const Eigen::Vector2d& pixel) {
    const double tangent = std::tan(camera.fieldOfView / 2);
    const double x = (2 * pixel.x() / picture.width - 1) * tangent * picture.aspect();
    const double y = (1 - 2 * pixel.y() / picture.height) * tangent;
    const Vec3 across = x * camera.right() + y * camera.up();
    if (camera.orthographic) return {camera.eye() + camera.distance * across, camera.forward()};
    return {camera.eye(), (camera.forward() + across).normalized()};
}

std::optional<Eigen::Vector2d> projected(const Camera& camera, const PictureSize& picture,
                                         const Vec3& point) {
    const Vec3 fromEye = point - camera.eye();
    const double depth = camera.orthographic ? camera.distance : fromEye.dot(camera.forward());
    if (depth <= 0) return std::nullopt;
    const double halfHeight = depth * std::tan(camera.fieldOfView / 2);
    const double x = fromEye.dot(camera.right()) / (halfHeight * picture.aspect());
    const double y = fromEye.dot(camera.up()) / halfHeight;
    return Eigen::Vector2d((x + 1) / 2 * picture.width, (1 - y) / 2 * picture.height);
}

void orbit(Camera& camera, double yaw, double pitch) {
    camera.yaw = std::remainder(camera.yaw + yaw, 2 * std::numbers::pi);
    camera.pitch = std::clamp(camera.pitch + pitch, -steepest, steepest);
}

void pan(Camera& camera, const PictureSize& picture, const Eigen::Vector2d& pixels) {
    camera.target += camera.pixelSize(picture) * (pixels.y() * camera.up() - pixels.x() * camera.right());
}

void zoomAt(Camera& camera, const Vec3& fixedPoint, double factor) {
    const double distance = std::clamp(camera.distance * factor, smallestDistance, largestDistance);
    // Eye and target both move along their lines to the fixed point, so its direction from the eye stays.
    camera.target = fixedPoint + (distance / camera.distance) * (camera.target - fixedPoint);
    camera.distance = distance;
}

void frame(Camera& camera, const PictureSize& picture, const Aabb& box) {
    const double tangentY = std::tan(camera.fieldOfView / 2);
    const double tangentX = tangentY * picture.aspect();
    const Vec3 half = box.size() / 2;
    double distance = smallestDistance;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 offset(corner & 1 ? half.x() : -half.x(), corner & 2 ? half.y() : -half.y(),
                          corner & 4 ? half.z() : -half.z());
        const double towardsEye = camera.orthographic ? 0 : -offset.dot(camera.forward());
        distance = std::max({distance, std::abs(offset.dot(camera.right())) / tangentX + towardsEye,
                             std::abs(offset.dot(camera.up())) / tangentY + towardsEye});
    }
    camera.target = box.centre();
    camera.distance = std::min(distance * framingMargin, largestDistance);
}

void apply(Camera& camera, const CameraSettings& settings) {
    if (settings.fieldOfView) camera.fieldOfView = *settings.fieldOfView;
    if (!settings.position && !settings.target) return;
    const Vec3 eye = settings.position.value_or(camera.eye());
    const Vec3 target = settings.target.value_or(camera.target);
    const Vec3 back = eye - target;
    const double distance = back.norm();
    camera.target = target;
    if (distance < smallestDistance) return;
    camera.distance = distance;
    camera.pitch = std::asin(std::clamp(back.y() / distance, -1.0, 1.0));
    // Straight up or down leaves the yaw open: keep it.
    if (std::hypot(back.x(), back.z()) > 1e-9 * distance) camera.yaw = std::atan2(back.x(), back.z());
}

} // namespace carom
