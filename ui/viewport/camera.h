// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/aabb.h"
#include "core/scene/scene.h"

#include <Eigen/Core>

#include <optional>

// The camera orbits a target on a turntable: yaw about the world's y axis, pitch above its horizon. Right, up
// and forward follow from the two angles alone, so looking straight down is no special case.
//
//          eye
//           \  distance      pitch: angle of target→eye above the horizon
//            \               yaw:   its angle about y, 0 when the eye stands on the +z side
//           target

namespace carom {

/// A half-line: origin + t direction, t >= 0.
struct Ray {
    Vec3 origin = Vec3::Zero();      ///< [m]
    Vec3 direction = -Vec3::UnitZ(); ///< unit
};

/// The picture's size in pixels; y grows downwards, as in widgets.
struct PictureSize {
    double width = 1;
    double height = 1;

    double aspect() const { return width / height; }
};

struct Camera {
    Vec3 target = Vec3::Zero(); ///< [m]
    double distance = 5;        ///< from the eye to the target [m]
    double yaw = 0.6;           ///< [rad]
    double pitch = 0.45;        ///< [rad], within ±pi/2
    double fieldOfView = 0.7;   ///< vertical [rad]
    bool orthographic = false;  ///< shows the same height at the target as the perspective would

    Vec3 forward() const;
    Vec3 right() const;
    Vec3 up() const;
    Vec3 eye() const { return target - distance * forward(); }
    /// World metres that one pixel covers at the target.
    double pixelSize(const PictureSize& picture) const;
};

using Mat4 = Eigen::Matrix4d;

/// Camera coordinates (x right, y up, looking along -z) from world coordinates.
Mat4 viewMatrix(const Camera& camera);
/// OpenGL clip coordinates from camera coordinates; depths [m] in front of the eye.
Mat4 projectionMatrix(const Camera& camera, const PictureSize& picture, double nearDepth, double farDepth);

/// The ray through a point of the picture [px]. An orthographic ray starts in the plane of the eye.
Ray rayThrough(const Camera& camera, const PictureSize& picture, const Eigen::Vector2d& pixel);
/// Where a world point appears [px]; nothing for points behind a perspective eye.
std::optional<Eigen::Vector2d> projected(const Camera& camera, const PictureSize& picture, const Vec3& point);

void orbit(Camera& camera, double yaw, double pitch);
/// Moves the scene with a cursor that moved by so many pixels, exactly in the plane of the target.
void pan(Camera& camera, const PictureSize& picture, const Eigen::Vector2d& pixels);
/// Scales the distance by `factor` so that `fixedPoint` [m] keeps its place in the picture.
void zoomAt(Camera& camera, const Vec3& fixedPoint, double factor);
/// Keeps the angles, and shows the whole box with a little margin.
void frame(Camera& camera, const PictureSize& picture, const Aabb& box);
/// What a scene's `camera` declaration asks for; what it leaves open stays.
void apply(Camera& camera, const CameraSettings& settings);

} // namespace carom
