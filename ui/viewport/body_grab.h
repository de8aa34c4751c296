// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/pose.h"
#include "core/scene/scene.h"
#include "ui/viewport/camera.h"

#include <QString>

#include <Eigen/Core>

#include <optional>
#include <span>

// Where a body can be taken hold of in the picture, and what it becomes as the mouse moves. Figures only, no
// widgets.

namespace carom {

enum class BodyHandle : std::uint8_t {
    Centre,   ///< the body itself, an axis or a plane of its gizmo
    Velocity, ///< the tip of its velocity arrow
    Turn      ///< a ring of its gizmo
};

/// What of the gizmo is held: an axis to move along, a plane to move in (by its normal), a ring to turn about
/// an axis of the world.
enum class GizmoPart : std::uint8_t {
    None,
    AxisX,
    AxisY,
    AxisZ,
    PlaneX,
    PlaneY,
    PlaneZ,
    TurnX,
    TurnY,
    TurnZ
};

/// 0, 1, 2 of the axis that a part is of; not for None.
constexpr int axisOf(GizmoPart part) { return (static_cast<int>(part) - 1) % 3; }
constexpr bool isAxis(GizmoPart part) { return part >= GizmoPart::AxisX && part <= GizmoPart::AxisZ; }
constexpr bool isPlane(GizmoPart part) { return part >= GizmoPart::PlaneX && part <= GizmoPart::PlaneZ; }
constexpr bool isTurn(GizmoPart part) { return part >= GizmoPart::TurnX; }

/// What a drag changes of a body.
struct DraggedBody {
    Pose pose;
    Vec3 velocity = Vec3::Zero(); ///< [m/s]
};

struct BodyGrab {
    BodyIndex body = noBody;
    BodyHandle handle = BodyHandle::Centre;
    GizmoPart part = GizmoPart::None;
    DraggedBody start;                               ///< of the body, at the beginning
    Vec3 point = Vec3::Zero();                       ///< what follows the mouse [m], world
    Vec3 normal = Vec3::UnitY();                     ///< of the plane in which it does
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero(); ///< where the mouse was
    double arrowTime = 0;                            ///< of velocities: an arrow is the way of this time [s]
};

/// The nearest velocity arrow's tip within reach of a pixel, to be moved parallel to the picture. Arrows are
/// `arrowTime` long: the way of that time [s].
std::optional<BodyGrab> grabTip(const Camera& camera, const PictureSize& picture,
                                const Eigen::Vector2d& pixel, std::span<const Pose> poses,
                                std::span<const Vec3> velocities, double arrowTime);

/// A body itself, to be moved in the plane of dragNormal() through its centre.
BodyGrab grabCentre(const Camera& camera, BodyIndex body, const Pose& pose, const Eigen::Vector2d& pixel);

/// The normal of the plane in which a plain drag moves a body: the level plane, or the picture's where that
/// is seen from its edge.
Vec3 dragNormal(const Camera& camera);

/// What the body becomes for a mouse that has moved to `pixel`. With `snaps`, coordinates that move are whole
/// multiples of snapStep(), and turns of 15 degrees; else turns are of whole degrees.
DraggedBody draggedTo(const BodyGrab& grab, const Camera& camera, const PictureSize& picture,
                      const Eigen::Vector2d& pixel, bool snaps);

/// 1, 2 or 5 times a power of ten [m], at least ten pixels.
double snapStep(double pixelSize);

/// What a drag has come to, to be written beside the mouse: "x 1.25 m", "30°".
QString tellOf(const BodyGrab& grab, const DraggedBody& now, double pixelSize);

} // namespace carom
