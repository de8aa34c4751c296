// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/viewport/camera.h"

#include <QPointF>
#include <QRectF>

#include <cstdint>
#include <optional>

class QPainter;

// A cube in the corner of the picture that turns with the scene; its sides are the views along the axes.

namespace carom {

/// From where one looks: Front is from +z, Right from +x, Top from +y.
enum class ViewSide : std::uint8_t { Right, Top, Front, Left, Bottom, Back };

/// Turns the camera to that side; what it looks at and from how far stays.
void lookFrom(Camera& camera, ViewSide side);

/// Where the cube stands in a picture of that size [px]; empty where the picture is too small for it.
QRectF cubePlace(const PictureSize& picture);
std::optional<ViewSide> cubeSideAt(const Camera& camera, const QRectF& place, const QPointF& position);
void paintViewCube(QPainter& painter, const Camera& camera, const QRectF& place, bool dark,
                   std::optional<ViewSide> lit);

} // namespace carom
