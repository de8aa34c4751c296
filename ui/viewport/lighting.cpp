// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/lighting.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom {

namespace {

/// Shadows reach this many times the distance of the camera around its target. At half they end within the
/// picture; at twice their edges are twice as coarse.
constexpr double shadowReach = 2;
/// Lines of the grid across a room, about; at twice they merge in the distance.
constexpr double gridLines = 180;
constexpr float leastLight = 0.05F; ///< that reaches every surface

Vec3 fillDirection() { return Vec3(0.72, 0.35, -0.45).normalized(); }

Eigen::Vector4f four(const Vec3& v, double w) {
    const Eigen::Vector3f f = v.cast<float>();
    return {f.x(), f.y(), f.z(), static_cast<float>(w)};
}

Eigen::Vector4f four(const Eigen::Vector3f& v, float w = 0) { return {v.x(), v.y(), v.z(), w}; }

/// As the shaders' function of this name.
Eigen::Vector4f linear(const Eigen::Vector3f& displayed) { return four(displayed.cwiseProduct(displayed)); }

/// 1, 2 or 5 times a power of ten, near x.
double roundNumber(double x) {
    const double power = std::pow(10, std::floor(std::log10(x)));
    const double digit = x / power;
    return power * (digit < 1.5 ? 1 : digit < 3.5 ? 2 : digit < 7.5 ? 5 : 10);
}

} // namespace

Vec3 keyDirection() { return Vec3(-0.38, 0.80, 0.46).normalized(); }

Camera lightCamera() {
    Camera light;
    light.orthographic = true;
    light.fieldOfView = std::numbers::pi / 2;
    light.pitch = std::asin(keyDirection().y());
    light.yaw = std::atan2(keyDirection().x(), keyDirection().z());
    return light;
}

ShadowView shadowView(const Aabb& lightBounds, const Camera& camera, const Room& room) {
    ShadowView view;
    view.camera = lightCamera();
    const Mat3 lightFromWorld = viewMatrix(view.camera).block<3, 3>(0, 0);
    const double radius = std::min(room.extent, shadowReach * camera.distance);
    const Vec3 seen = lightFromWorld * camera.target;
    Aabb reach = grown({seen, seen}, radius);
    // Along the light a far body may still throw its shadow into the picture.
    reach.lower.z() = std::max(lightBounds.lower.z(), seen.z() - 2 * room.extent);
    reach.upper.z() = std::min(lightBounds.upper.z(), seen.z() + 2 * room.extent);
    const Vec3 lower = lightBounds.lower.cwiseMax(reach.lower).cwiseMin(reach.upper);
    const Vec3 upper = lightBounds.upper.cwiseMin(reach.upper).cwiseMax(lower);
    const Vec3 middle = (lower + upper) / 2;
    const Vec3 half = (upper - lower).cwiseMax(1e-6) * (0.5 + 4.0 / shadowMapSize);

    view.texel = 2 * std::max(half.x(), half.y()) / shadowMapSize;
    view.size = {shadowMapSize * half.x() / half.y(), shadowMapSize};
    view.camera.target = lightFromWorld.transpose() * middle;
    view.camera.distance = half.y();
    view.clipFromWorld = projectionMatrix(view.camera, view.size, half.y() - half.z(), half.y() + half.z()) *
                         viewMatrix(view.camera);
    const Vec3 right = view.camera.right();
    const Vec3 up = view.camera.up();
    view.sides = {Wall{right, middle.x() - half.x()}, Wall{-right, -middle.x() - half.x()},
                  Wall{up, middle.y() - half.y()}, Wall{-up, -middle.y() - half.y()}};
    return view;
}

FrameUniforms frameUniforms(const PictureOptions& options, const Mat4& clipFromWorld,
                            const ShadowView& shadow, const Room& room) {
    const Camera& camera = options.camera;
    const ViewTheme& theme = options.theme;
    const double pixel = camera.pixelSize(options.size) / (camera.orthographic ? 1 : camera.distance);
    Mat4 textureFromClip = Mat4::Identity();
    textureFromClip.block<3, 3>(0, 0) *= 0.5;
    textureFromClip.block<3, 1>(0, 3).setConstant(0.5);

    FrameUniforms frame;
    frame.clipFromWorld = clipFromWorld.cast<float>();
    frame.shadowFromWorld = (textureFromClip * shadow.clipFromWorld).cast<float>();
    frame.eye = four(camera.eye(), camera.orthographic ? 1 : 0);
    frame.forward = four(camera.forward(), pixel);
    frame.up = four(camera.up(), static_cast<double>(theme.shadow));
    frame.keyDirection = four(keyDirection(), shadow.texel);
    frame.keyColour = four(theme.keyLight);
    frame.fillDirection = four(fillDirection(), 0);
    frame.fillColour = four(theme.fillLight, theme.vignette);
    frame.skyTop = four(theme.skyTop);
    frame.skyHorizon = four(theme.skyHorizon);
    frame.ground = four(theme.ground);
    frame.floorTint = four(theme.floorTint, theme.grid);
    frame.roomCentre = four(room.centre, room.extent);
    frame.picture = {static_cast<float>(options.size.width), static_cast<float>(options.size.height),
                     static_cast<float>(roundNumber(2 * room.extent / gridLines)),
                     options.dimmed ? 0.75F : 0.0F};
    frame.mirrorTop = linear(theme.skyTop);
    frame.mirrorHorizon = linear(theme.skyHorizon);
    frame.mirrorGround = linear(theme.ground);
    const Eigen::Vector4f anywhere = Eigen::Vector4f::Constant(leastLight);
    frame.lightAbove = theme.ambient * (frame.mirrorTop + frame.mirrorHorizon) / 2 + anywhere;
    frame.lightBelow = theme.ambient * frame.mirrorGround + anywhere;
    return frame;
}

} // namespace carom
