// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/gizmo.h"

#include "core/math/rotation.h"

#include <QColor>
#include <QPainter>
#include <QPen>
#include <QPolygonF>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace carom {
namespace {

constexpr double axisLength = 80, axisGap = 16;    ///< [px]
constexpr double planeNear = 26, planeFar = 42;    ///< [px] from the centre
constexpr double ringRadius = 100;                 ///< [px]
constexpr double reach = 7;                        ///< [px]
constexpr double leastAxis = 14;                   ///< [px] of an axis that can still be aimed along
constexpr double flattest = 0.15;                  ///< sine of the angle at which a plane can still be used
constexpr int ringSegments = 64;                   ///< of what is drawn of a ring
constexpr double headLength = 11, headWidth = 4.5; ///< [px]

const std::array<QColor, 3> axisColours = {QColor(232, 74, 74), QColor(94, 190, 70), QColor(74, 132, 240)};
const QColor litColour(255, 205, 60);

GizmoPart partOf(GizmoPart first, int axis) { return static_cast<GizmoPart>(static_cast<int>(first) + axis); }

/// From a point to a line from `a` to `b` [px].
double distanceTo(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& point) {
    const Eigen::Vector2d along = b - a;
    const double length2 = along.squaredNorm();
    const double part = length2 > 0 ? std::clamp((point - a).dot(along) / length2, 0.0, 1.0) : 0.0;
    return (a + part * along - point).norm();
}

double distanceTo(const GizmoHandle& handle, const Eigen::Vector2d& point) {
    if (handle.closed) {
        QPolygonF area;
        for (const Eigen::Vector2d& corner : handle.line) area += QPointF(corner.x(), corner.y());
        return area.containsPoint({point.x(), point.y()}, Qt::OddEvenFill) ? 0.0 : 2 * reach;
    }
    double least = 2 * reach;
    for (std::size_t i = 1; i < handle.line.size(); ++i)
        least = std::min(least, distanceTo(handle.line[i - 1], handle.line[i], point));
    return least;
}

/// The half of a ring that is nearer to the eye, from end to end; all of it where it is seen from above.
std::vector<Vec3> nearHalf(const Vec3& centre, const Vec3& axis, double radius, const Camera& camera) {
    const Tangents across = tangentsOf(axis);
    const Vec3 toEye = camera.orthographic ? Vec3(-camera.forward()) : (camera.eye() - centre).normalized();
    const bool whole = std::abs(toEye.dot(axis)) > 0.98;
    const double nearest = std::atan2(toEye.dot(across.second), toEye.dot(across.first)); // [rad] its middle
    const double reaches = whole ? std::numbers::pi : std::numbers::pi / 2; // [rad] to both sides
    std::vector<Vec3> points;
    for (int i = -ringSegments / 2; i <= ringSegments / 2; ++i) {
        const double angle = nearest + reaches * i / (ringSegments / 2.0);
        points.push_back(centre +
                         radius * (std::cos(angle) * across.first + std::sin(angle) * across.second));
    }
    return points;
}

/// World metres of a pixel at a point; not positive behind the eye.
double pixelAt(const Camera& camera, const PictureSize& picture, const Vec3& point) {
    const double depth = camera.orthographic ? camera.distance : (point - camera.eye()).dot(camera.forward());
    return camera.pixelSize(picture) * depth / camera.distance;
}

} // namespace

std::vector<GizmoHandle> gizmoOf(const Camera& camera, const PictureSize& picture, const Vec3& centre,
                                 bool turns) {
    const double pixel = pixelAt(camera, picture, centre); // [m] at the body
    if (!(pixel > 0) || !centre.allFinite()) return {};
    const Vec3 sight = camera.orthographic ? camera.forward() : (centre - camera.eye()).normalized();
    std::vector<GizmoHandle> handles;
    const auto add = [&](GizmoPart part, std::span<const Vec3> points, bool closed) {
        GizmoHandle handle{part, {}, closed};
        for (const Vec3& point : points) {
            const std::optional<Eigen::Vector2d> at = projected(camera, picture, point);
            if (!at || !at->allFinite()) return;
            handle.line.push_back(*at);
        }
        if (handle.line.size() > 1) handles.push_back(std::move(handle));
    };
    for (const int axis : {0, 1, 2}) {
        const Vec3 unit = Vec3::Unit(axis);
        if (axisLength * sight.cross(unit).norm() >= leastAxis) {
            const std::array ends = {Vec3(centre + axisGap * pixel * unit),
                                     Vec3(centre + axisLength * pixel * unit)};
            add(partOf(GizmoPart::AxisX, axis), ends, false);
        }
        if (std::abs(sight.dot(unit)) >= flattest) {
            const Vec3 u = pixel * Vec3::Unit((axis + 1) % 3), v = pixel * Vec3::Unit((axis + 2) % 3);
            const std::array corners = {
                Vec3(centre + planeNear * u + planeNear * v), Vec3(centre + planeFar * u + planeNear * v),
                Vec3(centre + planeFar * u + planeFar * v), Vec3(centre + planeNear * u + planeFar * v)};
            add(partOf(GizmoPart::PlaneX, axis), corners, true);
        }
        if (turns)
            add(partOf(GizmoPart::TurnX, axis), nearHalf(centre, unit, ringRadius * pixel, camera), false);
    }
    return handles;
}

GizmoPart partAt(std::span<const GizmoHandle> handles, const Eigen::Vector2d& pixel) {
    GizmoPart nearest = GizmoPart::None;
    double least = reach;
    for (const GizmoHandle& handle : handles) {
        const double distance = distanceTo(handle, pixel);
        if (distance >= least) continue;
        least = distance;
        nearest = handle.part;
    }
    return nearest;
}

Vec3 pointOfRing(const Camera& camera, const PictureSize& picture, const Vec3& centre, const Vec3& axis,
                 const Eigen::Vector2d& pixel) {
    Vec3 nearest = centre;
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& point : nearHalf(centre, axis, ringRadius * pixelAt(camera, picture, centre), camera)) {
        const std::optional<Eigen::Vector2d> at = projected(camera, picture, point);
        if (!at || !((*at - pixel).norm() < least)) continue;
        least = (*at - pixel).norm();
        nearest = point;
    }
    return nearest;
}

BodyGrab grabPart(const Camera& camera, const PictureSize& picture, GizmoPart part, BodyIndex body,
                  const Pose& pose, const Eigen::Vector2d& pixel) {
    BodyGrab grab{.body = body,
                  .handle = isTurn(part) ? BodyHandle::Turn : BodyHandle::Centre,
                  .part = part,
                  .start = {pose, {}},
                  .point = pose.position,
                  .normal = Vec3::Unit(axisOf(part)),
                  .pixel = pixel};
    // A ring follows the mouse at the place that is held: its point nearest to the ray.
    if (isTurn(part)) grab.point = pointOfRing(camera, picture, pose.position, grab.normal, pixel);
    return grab;
}

void paintGizmo(QPainter& painter, std::span<const GizmoHandle> handles, GizmoPart lit) {
    painter.setRenderHint(QPainter::Antialiasing);
    for (const GizmoHandle& handle : handles) {
        const QColor colour =
            handle.part == lit ? litColour : axisColours[static_cast<std::size_t>(axisOf(handle.part))];
        QPolygonF line;
        for (const Eigen::Vector2d& point : handle.line) line += QPointF(point.x(), point.y());
        painter.setPen(QPen(colour, isTurn(handle.part) ? 1.8 : 2.6, Qt::SolidLine, Qt::RoundCap));
        if (handle.closed) {
            QColor inside = colour;
            inside.setAlpha(110);
            painter.setBrush(inside);
            painter.drawPolygon(line);
            continue;
        }
        painter.setBrush(Qt::NoBrush);
        painter.drawPolyline(line);
        if (!isAxis(handle.part)) continue;
        const Eigen::Vector2d tip = handle.line.back(), along = (tip - handle.line.front()).normalized();
        const Eigen::Vector2d across(-along.y(), along.x()), back = tip - headLength * along;
        const Eigen::Vector2d left = back + headWidth * across, right = back - headWidth * across;
        painter.setBrush(colour);
        painter.drawPolygon(QPolygonF{{tip.x(), tip.y()}, {left.x(), left.y()}, {right.x(), right.y()}});
    }
}

void paintBeside(QPainter& painter, const QPointF& point, const QString& words, const QRect& picture,
                 bool dark) {
    if (words.isEmpty()) return;
    constexpr double aside = 16; // [px]
    QRectF box(painter.fontMetrics()
                   .boundingRect(QRect(0, 0, 1000, 1000), Qt::AlignLeft, words)
                   .adjusted(-6, -3, 6, 3));
    box.moveTopLeft(point + QPointF(aside, -aside - box.height()));
    if (box.right() > picture.right()) box.moveRight(point.x() - aside);
    if (box.top() < picture.top()) box.moveTop(point.y() + aside);
    QColor ground = dark ? QColor(20, 22, 28) : QColor(255, 255, 255);
    ground.setAlpha(225);
    painter.setPen(Qt::NoPen);
    painter.setBrush(ground);
    painter.drawRoundedRect(box, 3, 3);
    painter.setPen(dark ? QColor(235, 238, 242) : QColor(20, 24, 28));
    painter.drawText(box.adjusted(6, 3, -6, -3), Qt::AlignLeft, words);
}

} // namespace carom
