// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/picking.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace carom {

namespace {

/// The part of a ray inside something convex: from entry to exit, empty where from > to.
struct Span {
    double from = -std::numeric_limits<double>::infinity();
    double to = std::numeric_limits<double>::infinity();
};

/// Where |coordinate| <= half along one axis of the ray.
Span slab(double origin, double direction, double half) {
    if (direction == 0) return std::abs(origin) <= half ? Span{} : Span{1, 0};
    double first = (-half - origin) / direction;
    double second = (half - origin) / direction;
    if (first > second) std::swap(first, second);
    return {first, second};
}

/// Where a t² + 2 b t + c <= 0, for a > 0.
Span between(double a, double b, double c) {
    const double discriminant = b * b - a * c;
    if (discriminant < 0) return {1, 0};
    const double root = std::sqrt(discriminant);
    return {(-b - root) / a, (-b + root) / a};
}

Span common(const Span& a, const Span& b) { return {std::max(a.from, b.from), std::min(a.to, b.to)}; }

/// One overload a shape; the ray is in the body's own frame.
struct Inside {
    const Ray& ray;

    Span operator()(const Sphere& sphere) const {
        // About the point of the ray nearest the centre: far from small spheres c would lose its digits.
        const double closest = -ray.origin.dot(ray.direction);
        const double gap = (ray.origin + closest * ray.direction).squaredNorm();
        const Span span = between(1, 0, gap - sphere.radius * sphere.radius);
        return {span.from + closest, span.to + closest};
    }
    Span operator()(const Wall& wall) const {
        const double approach = ray.direction.dot(wall.normal);
        if (approach >= 0) return {1, 0};
        return {-distanceTo(wall, ray.origin) / approach, std::numeric_limits<double>::infinity()};
    }
    Span operator()(const Cylinder& cylinder) const {
        const Span height = slab(ray.origin.y(), ray.direction.y(), cylinder.halfHeight);
        const Eigen::Vector2d origin(ray.origin.x(), ray.origin.z());
        const Eigen::Vector2d direction(ray.direction.x(), ray.direction.z());
        const double c = origin.squaredNorm() - cylinder.radius * cylinder.radius;
        if (direction.isZero(0)) return c <= 0 ? height : Span{1, 0};
        return common(height, between(direction.squaredNorm(), origin.dot(direction), c));
    }
    Span operator()(const Cuboid& cuboid) const {
        Span inside;
        for (int axis = 0; axis < 3; ++axis)
            inside = common(inside, slab(ray.origin[axis], ray.direction[axis], cuboid.halfSize[axis]));
        return inside;
    }
};

} // namespace

std::optional<double> entry(const Ray& ray, const Shape& shape, const Pose& worldFromBody) {
    const Ray inBody{worldFromBody.toBody(ray.origin), worldFromBody.directionToBody(ray.direction)};
    const Span span = std::visit(Inside{inBody}, shape);
    if (span.from > span.to || span.from < 0) return std::nullopt;
    return span.from;
}

Hit pick(const Ray& ray, const Scene& scene, std::span<const Pose> poses, const Room& room) {
    Hit nearest{noBody, std::numeric_limits<double>::infinity()};
    const std::size_t count = std::min(scene.bodies.size(), poses.size());
    for (std::size_t i = 0; i < count; ++i) {
        if (isWall(scene.bodies[i].shape)) continue;
        const std::optional<double> distance = entry(ray, scene.bodies[i].shape, poses[i]);
        if (distance && *distance < nearest.distance) nearest = {static_cast<BodyIndex>(i), *distance};
    }
    const FaceHit face = firstFace(room, ray);
    if (face.body != noBody && face.distance < nearest.distance) nearest = {face.body, face.distance};
    return nearest;
}

} // namespace carom
