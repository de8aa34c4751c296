// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/room.h"

#include "core/math/rotation.h"

#include <algorithm>
#include <limits>

namespace carom {

namespace {

/// An unbounded face reaches this many radii of the scene: beyond the edge of most views; at half its end is
/// seen.
constexpr double extentInRadii = 14;
/// Walls that are drawn at most. Every wall clips every other, so twice as many take four times the time.
constexpr std::size_t mostWalls = 400;

bool holds(const std::vector<Vec3>& polygon, const Vec3& normal, const Vec3& point) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3& here = polygon[i];
        const Vec3& next = polygon[(i + 1) % polygon.size()];
        if ((next - here).cross(point - here).dot(normal) < 0) return false;
    }
    return true;
}

} // namespace

std::vector<Vec3> cut(const std::vector<Vec3>& polygon, const Wall& wall, double tolerance) {
    std::vector<Vec3> inside;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3& here = polygon[i];
        const Vec3& next = polygon[(i + 1) % polygon.size()];
        const double a = distanceTo(wall, here) + tolerance;
        const double b = distanceTo(wall, next) + tolerance;
        if (a >= 0) inside.push_back(here);
        if ((a >= 0) != (b >= 0)) inside.push_back(here + a / (a - b) * (next - here));
    }
    return inside;
}

Room roomOf(const Scene& scene, const Aabb& around) {
    Room room;
    room.centre = around.centre();
    const double radius = std::max(around.size().norm() / 2, 1e-3);

    std::vector<BodyIndex> walls;
    for (std::size_t i = 0; i < scene.bodies.size() && walls.size() < mostWalls; ++i)
        if (isWall(scene.bodies[i].shape)) walls.push_back(static_cast<BodyIndex>(i));

    double furthest = 0;
    for (const BodyIndex body : walls)
        furthest =
            std::max(furthest, std::abs(distanceTo(std::get<Wall>(scene.bodies[body].shape), room.centre)));
    room.extent = std::max(extentInRadii * radius, 2 * furthest);

    for (const BodyIndex body : walls) {
        const Wall& wall = std::get<Wall>(scene.bodies[body].shape);
        const Vec3 middle = room.centre - distanceTo(wall, room.centre) * wall.normal;
        const Tangents across = tangentsOf(wall.normal);
        const Vec3 x = room.extent * across.first;
        const Vec3 y = room.extent * across.second;
        std::vector<Vec3> polygon = {middle - x - y, middle + x - y, middle + x + y, middle - x + y};
        for (const BodyIndex other : walls)
            if (other != body && polygon.size() >= 3)
                polygon = cut(polygon, std::get<Wall>(scene.bodies[other].shape), 1e-9 * room.extent);
        if (polygon.size() >= 3) room.faces.push_back({body, wall, std::move(polygon)});
    }
    return room;
}

FaceHit firstFace(const Room& room, const Ray& ray) {
    FaceHit nearest{noBody, std::numeric_limits<double>::infinity()};
    for (const RoomFace& face : room.faces) {
        const double approach = ray.direction.dot(face.wall.normal);
        if (approach >= 0) continue;
        const double distance = -distanceTo(face.wall, ray.origin) / approach;
        if (distance < 0 || distance >= nearest.distance) continue;
        const Vec3 point = ray.origin + distance * ray.direction;
        if ((point - room.centre).norm() > room.extent || !holds(face.polygon, face.wall.normal, point))
            continue;
        nearest = {face.body, distance};
    }
    return nearest;
}

} // namespace carom
