// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/viewport/body_grab.h"

#include <QPointF>
#include <QRect>

#include <span>
#include <vector>

class QPainter;

// The handles of a selected body, always of the same size on the screen and over everything:
//
//        y
//        |   ▫        arrows move along an axis of the world, squares in the plane of two,
//        | ▫          rings turn about an axis; only the half of a ring that is nearer
//        o----- x     to the eye is there to be taken

namespace carom {

struct GizmoHandle {
    GizmoPart part = GizmoPart::None;
    std::vector<Eigen::Vector2d> line; ///< on the screen [px]
    bool closed = false;               ///< an area: a square of a plane
};

/// Those that can be used from where the camera stands: no axis that points at the eye, no plane seen from
/// its edge. Rings where the body `turns`.
std::vector<GizmoHandle> gizmoOf(const Camera& camera, const PictureSize& picture, const Vec3& centre,
                                 bool turns);

/// The nearest within reach of a pixel.
GizmoPart partAt(std::span<const GizmoHandle> handles, const Eigen::Vector2d& pixel);

/// The point of the ring about `axis` that is nearest to a pixel [m], world.
Vec3 pointOfRing(const Camera& camera, const PictureSize& picture, const Vec3& centre, const Vec3& axis,
                 const Eigen::Vector2d& pixel);

/// A part of the gizmo of a body, held at a pixel.
BodyGrab grabPart(const Camera& camera, const PictureSize& picture, GizmoPart part, BodyIndex body,
                  const Pose& pose, const Eigen::Vector2d& pixel);

/// `lit` is the one under the mouse, or held.
void paintGizmo(QPainter& painter, std::span<const GizmoHandle> handles, GizmoPart lit);

/// Words in a box beside a point, inside the picture.
void paintBeside(QPainter& painter, const QPointF& point, const QString& words, const QRect& picture,
                 bool dark);

} // namespace carom
