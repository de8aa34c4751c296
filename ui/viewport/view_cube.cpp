// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/view_cube.h"

#include <QColor>
#include <QCoreApplication>
#include <QFont>
#include <QPainter>
#include <QPolygonF>

#include <array>
#include <cmath>
#include <numbers>

namespace carom {
namespace {

constexpr double cubeSize = 76, cubeMargin = 10;      ///< [px]
constexpr double leastWidth = 320, leastHeight = 220; ///< [px] of a picture that has room for it
constexpr double facing = 0.08; ///< cosine to the eye of a side that can be clicked; at a tenth it is a line
constexpr double named = 0.62;  ///< the same of a side whose name can be read
constexpr double quarter = std::numbers::pi / 2; ///< [rad]
constexpr int nameHeight = 10;                   ///< [px]

struct SideRow {
    const char* name;
    double yaw, pitch; ///< [rad]; the yaw of top and bottom is the camera's
};

const std::array<SideRow, 6> sides = {{{QT_TRANSLATE_NOOP("carom::ViewCube", "Right"), quarter, 0},
                                       {QT_TRANSLATE_NOOP("carom::ViewCube", "Top"), 0, quarter},
                                       {QT_TRANSLATE_NOOP("carom::ViewCube", "Front"), 0, 0},
                                       {QT_TRANSLATE_NOOP("carom::ViewCube", "Left"), -quarter, 0},
                                       {QT_TRANSLATE_NOOP("carom::ViewCube", "Bottom"), 0, -quarter},
                                       {QT_TRANSLATE_NOOP("carom::ViewCube", "Back"), 2 * quarter, 0}}};

Vec3 normalOf(std::size_t side) { return (side < 3 ? 1.0 : -1.0) * Vec3::Unit(static_cast<int>(side % 3)); }

double towardsEye(const Camera& camera, std::size_t side) { return -camera.forward().dot(normalOf(side)); }

QPointF at(const Camera& camera, const QRectF& place, const Vec3& point) {
    const double scale = place.width() / (2 * std::numbers::sqrt3);
    return place.center() + scale * QPointF(point.dot(camera.right()), -point.dot(camera.up()));
}

QPolygonF outlineOf(const Camera& camera, const QRectF& place, std::size_t side) {
    const Vec3 normal = normalOf(side);
    const Vec3 u = Vec3::Unit(static_cast<int>((side + 1) % 3)),
               v = Vec3::Unit(static_cast<int>((side + 2) % 3));
    return {at(camera, place, normal + u + v), at(camera, place, normal - u + v),
            at(camera, place, normal - u - v), at(camera, place, normal + u - v)};
}

} // namespace

void lookFrom(Camera& camera, ViewSide side) {
    const SideRow& row = sides[static_cast<std::size_t>(side)];
    camera.yaw = row.yaw;
    camera.pitch = row.pitch;
}

QRectF cubePlace(const PictureSize& picture) {
    if (picture.width < leastWidth || picture.height < leastHeight) return {};
    return {picture.width - cubeSize - cubeMargin, cubeMargin, cubeSize, cubeSize};
}

std::optional<ViewSide> cubeSideAt(const Camera& camera, const QRectF& place, const QPointF& position) {
    if (!place.contains(position)) return std::nullopt;
    for (std::size_t side = 0; side < sides.size(); ++side)
        if (towardsEye(camera, side) > facing &&
            outlineOf(camera, place, side).containsPoint(position, Qt::OddEvenFill))
            return static_cast<ViewSide>(side);
    return std::nullopt;
}

void paintViewCube(QPainter& painter, const Camera& camera, const QRectF& place, bool dark,
                   std::optional<ViewSide> lit) {
    if (place.isEmpty()) return;
    painter.setRenderHint(QPainter::Antialiasing);
    const QColor text = dark ? QColor(226, 230, 236) : QColor(40, 46, 54);
    const QColor edge = dark ? QColor(20, 24, 30, 200) : QColor(110, 120, 130, 220);
    QFont font = painter.font();
    font.setPixelSize(nameHeight);
    painter.setFont(font);
    for (std::size_t side = 0; side < sides.size(); ++side) {
        const double cosine = towardsEye(camera, side);
        if (cosine <= facing) continue;
        const int light = static_cast<int>((dark ? 70 : 205) + 35 * cosine);
        QColor ground(light, light, light + 6, 215);
        if (lit && static_cast<std::size_t>(*lit) == side) ground = QColor(255, 196, 70, 235);
        painter.setPen(QPen(edge, 1));
        painter.setBrush(ground);
        const QPolygonF outline = outlineOf(camera, place, side);
        painter.drawPolygon(outline);
        if (cosine < named) continue;
        painter.setPen(lit && static_cast<std::size_t>(*lit) == side ? QColor(30, 30, 30) : text);
        painter.drawText(outline.boundingRect(), Qt::AlignCenter,
                         QCoreApplication::translate("carom::ViewCube", sides[side].name));
    }
}

} // namespace carom
