// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/scene.h"
#include "ui/viewport/camera.h"

#include <Eigen/Core>

#include <optional>
#include <span>
#include <string_view>

// Where a body can be taken hold of in the picture, and what it becomes as the mouse moves. Figures only, no
// widgets.

namespace carom {

enum class BodyHandle : std::uint8_t {
    Centre,  ///< the body itself
    Velocity ///< the tip of its velocity arrow
};

/// The parameter of the declaration that a handle stands for.
constexpr std::string_view nameOf(BodyHandle handle) {
    return handle == BodyHandle::Centre ? "centre" : "vel";
}

struct BodyGrab {
    BodyIndex body = noBody;
    BodyHandle handle = BodyHandle::Centre;
    Vec3 value = Vec3::Zero();                       ///< at the beginning [m] or [m/s]
    Vec3 point = Vec3::Zero();                       ///< what follows the mouse [m], world
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero(); ///< where the mouse was
};

/// The nearest velocity arrow's tip within reach of a pixel.
std::optional<BodyGrab> grabTip(const Camera& camera, const PictureSize& picture,
                                const Eigen::Vector2d& pixel, std::span<const Pose> poses,
                                std::span<const Vec3> velocities);

/// The value for a mouse that has moved to `pixel`: the point follows it in the plane parallel to the
/// picture, or at its own height if `level`.
Vec3 draggedValue(const BodyGrab& grab, const Camera& camera, const PictureSize& picture,
                  const Eigen::Vector2d& pixel, bool level);

} // namespace carom
