// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/body_grab.h"

#include "core/math/rotation.h"
#include "ui/base/numbers.h"

#include <QStringList>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom {
namespace {

/// [px] around a tip; at half it is hard to hit, at twice it covers its neighbours.
constexpr double reach = 9;
/// Sine of the least angle of a ray to a plane; at a tenth a pixel is far on it.
constexpr double steepest = 0.02;
constexpr double levelSeen = 0.12; ///< sine of the angle from which on a level plane is seen from above
constexpr double ringSeen = 0.3;   ///< the same of a ring that follows the mouse around
constexpr double snapPixels = 10;  ///< [px] of a step that snaps, at least
constexpr double degree = std::numbers::pi / 180; ///< [rad]
constexpr double snapDegrees = 15;

/// Where the ray through a pixel meets a plane; nothing where they are nearly parallel.
std::optional<Vec3> meet(const Camera& camera, const PictureSize& picture, const Eigen::Vector2d& pixel,
                         const Vec3& point, const Vec3& normal) {
    const Ray ray = rayThrough(camera, picture, pixel);
    const double slope = ray.direction.dot(normal);
    if (std::abs(slope) < steepest) return std::nullopt;
    return ray.origin + (point - ray.origin).dot(normal) / slope * ray.direction;
}

/// How far along an axis the point nearest to the ray through a pixel is [m]; nothing where the ray is nearly
/// parallel to it.
std::optional<double> along(const Camera& camera, const PictureSize& picture, const Eigen::Vector2d& pixel,
                            const Vec3& point, const Vec3& axis) {
    const Ray ray = rayThrough(camera, picture, pixel);
    const double cosine = ray.direction.dot(axis), sine2 = 1 - cosine * cosine;
    if (sine2 < steepest * steepest) return std::nullopt;
    const Vec3 between = ray.origin - point;
    return (between.dot(axis) - cosine * between.dot(ray.direction)) / sine2;
}

/// How far the mouse has turned about an axis through the body's centre [rad].
double turnedBy(const BodyGrab& grab, const Camera& camera, const PictureSize& picture,
                const Eigen::Vector2d& pixel, const Vec3& axis) {
    const Vec3& centre = grab.start.pose.position;
    if (std::abs(camera.forward().dot(axis)) > ringSeen) {
        const std::optional<Vec3> from = meet(camera, picture, grab.pixel, centre, axis);
        const std::optional<Vec3> to = meet(camera, picture, pixel, centre, axis);
        if (!from || !to) return 0;
        const Vec3 before = *from - centre, now = *to - centre;
        return std::atan2(before.cross(now).dot(axis), before.dot(now));
    }
    // A ring seen from its edge: along its tangent at the place that is held.
    constexpr double small = 1e-3; // [rad]
    const Vec3 arm = grab.point - centre;
    const std::optional<Eigen::Vector2d> here = projected(camera, picture, grab.point);
    const std::optional<Eigen::Vector2d> there =
        projected(camera, picture, centre + fromRotationVector(small * axis) * arm);
    if (!here || !there) return 0;
    const Eigen::Vector2d tangent = (*there - *here) / small;
    return tangent.squaredNorm() > 0 ? (pixel - grab.pixel).dot(tangent) / tangent.squaredNorm() : 0;
}

/// Whether a coordinate changes at all in this drag.
bool moves(const BodyGrab& grab, int axis) {
    if (isAxis(grab.part)) return axis == axisOf(grab.part);
    return 1 - grab.normal[axis] * grab.normal[axis] > 1e-6;
}

Vec3 moved(const BodyGrab& grab, const Camera& camera, const PictureSize& picture,
           const Eigen::Vector2d& pixel) {
    if (isAxis(grab.part)) {
        const Vec3 axis = Vec3::Unit(axisOf(grab.part));
        const std::optional<double> from = along(camera, picture, grab.pixel, grab.point, axis);
        const std::optional<double> to = along(camera, picture, pixel, grab.point, axis);
        return from && to ? Vec3((*to - *from) * axis) : Vec3(Vec3::Zero());
    }
    const std::optional<Vec3> from = meet(camera, picture, grab.pixel, grab.point, grab.normal);
    const std::optional<Vec3> to = meet(camera, picture, pixel, grab.point, grab.normal);
    return from && to ? Vec3(*to - *from) : Vec3(Vec3::Zero());
}

} // namespace

std::optional<BodyGrab> grabTip(const Camera& camera, const PictureSize& picture,
                                const Eigen::Vector2d& pixel, std::span<const Pose> poses,
                                std::span<const Vec3> velocities, double arrowTime) {
    std::optional<BodyGrab> nearest;
    double least = reach;
    for (std::size_t i = 0; i < std::min(poses.size(), velocities.size()); ++i) {
        if (velocities[i] == Vec3::Zero()) continue;
        const Vec3 tip = poses[i].position + arrowTime * velocities[i];
        const std::optional<Eigen::Vector2d> at = projected(camera, picture, tip);
        if (!at || !((*at - pixel).norm() < least)) continue;
        least = (*at - pixel).norm();
        nearest = BodyGrab{.body = static_cast<BodyIndex>(i),
                           .handle = BodyHandle::Velocity,
                           .start = {poses[i], velocities[i]},
                           .point = tip,
                           .normal = camera.forward(),
                           .pixel = pixel,
                           .arrowTime = arrowTime};
    }
    return nearest;
}

BodyGrab grabCentre(const Camera& camera, BodyIndex body, const Pose& pose, const Eigen::Vector2d& pixel) {
    return {.body = body,
            .handle = BodyHandle::Centre,
            .start = {pose, {}},
            .point = pose.position,
            .normal = dragNormal(camera),
            .pixel = pixel};
}

Vec3 dragNormal(const Camera& camera) {
    return std::abs(camera.forward().y()) > levelSeen ? Vec3(Vec3::UnitY()) : camera.forward();
}

DraggedBody draggedTo(const BodyGrab& grab, const Camera& camera, const PictureSize& picture,
                      const Eigen::Vector2d& pixel, bool snaps) {
    DraggedBody now = grab.start;
    if (grab.handle == BodyHandle::Turn) {
        const Vec3 axis = Vec3::Unit(axisOf(grab.part));
        const double step = (snaps ? snapDegrees : 1) * degree;
        const double angle = step * std::round(turnedBy(grab, camera, picture, pixel, axis) / step);
        now.pose.orientation = (fromRotationVector(angle * axis) * grab.start.pose.orientation).normalized();
        return now;
    }
    const bool velocity = grab.handle == BodyHandle::Velocity;
    const double scale = velocity ? 1 / grab.arrowTime : 1;
    const double step = scale * snapStep(camera.pixelSize(picture));
    const Vec3 way = scale * moved(grab, camera, picture, pixel);
    Vec3& value = velocity ? now.velocity : now.pose.position;
    for (const int axis : {0, 1, 2}) {
        if (!moves(grab, axis)) continue;
        value[axis] += way[axis];
        if (snaps) value[axis] = step * std::round(value[axis] / step);
    }
    return now;
}

double snapStep(double pixelSize) {
    const double least = snapPixels * pixelSize, power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double times : {1.0, 2.0, 5.0})
        if (times * power >= least) return times * power;
    return 10 * power;
}

QString tellOf(const BodyGrab& grab, const DraggedBody& now, double pixelSize) {
    if (grab.handle == BodyHandle::Turn) {
        const Quat by = now.pose.orientation * grab.start.pose.orientation.conjugate();
        const double angle = toRotationVector(by)[axisOf(grab.part)] / degree;
        return QStringLiteral("%1°").arg(std::round(angle) + 0.0);
    }
    const bool velocity = grab.handle == BodyHandle::Velocity;
    const Vec3& value = velocity ? now.velocity : now.pose.position;
    const double visible = velocity ? pixelSize / grab.arrowTime : pixelSize;
    const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(visible))), 0, 6);
    QStringList parts;
    for (const int axis : {0, 1, 2})
        if (moves(grab, axis))
            parts +=
                QChar(u'x' + axis) + u' ' + withoutLastZeros(QString::number(value[axis], 'f', decimals));
    return parts.join(QStringLiteral(", ")) + (velocity ? QStringLiteral(" m/s") : QStringLiteral(" m"));
}

} // namespace carom
