// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/line_pen.h"

#include "core/math/rotation.h"

#include <cmath>
#include <numbers>
#include <variant>

namespace carom {

namespace {

constexpr double headShare = 0.2; ///< of an arrow's length
constexpr int circleSegments = 32;

} // namespace

void LinePen::line(const Vec3& from, const Vec3& to, const Vec3& colour) {
    for (const Vec3* end : {&from, &to}) {
        LineVertex vertex{};
        vertex.kind = m_kind;
        for (int axis = 0; axis < 3; ++axis) {
            vertex.position[axis] = static_cast<float>((*end)[axis]);
            vertex.colour[axis] = static_cast<float>(colour[axis]);
        }
        m_lines.push_back(vertex);
    }
}

void LinePen::arrow(const Vec3& from, const Vec3& along, const Vec3& colour) {
    const double length = along.norm();
    if (!(length > 0)) return;
    const Vec3 tip = from + along;
    line(from, tip, colour);
    const Tangents across = tangentsOf(along / length);
    const Vec3 back = tip - headShare * along;
    for (const Vec3& side : {across.first, across.second})
        for (const double sign : {-0.4, 0.4}) line(tip, back + sign * headShare * length * side, colour);
}

void LinePen::box(const Aabb& box, const Vec3& colour) {
    const auto corner = [&](int i) {
        return Vec3(i & 1 ? box.upper.x() : box.lower.x(), i & 2 ? box.upper.y() : box.lower.y(),
                    i & 4 ? box.upper.z() : box.lower.z());
    };
    for (int i = 0; i < 8; ++i)
        for (const int axis : {1, 2, 4})
            if (!(i & axis)) line(corner(i), corner(i | axis), colour);
}

void LinePen::star(const Vec3& centre, double size, const Vec3& colour) {
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 half = 0.5 * size * Vec3::Unit(axis);
        line(centre - half, centre + half, colour);
    }
}

/// Round `centre` in the plane of the first two columns of `axes`, which are the radii, in body coordinates.
void LinePen::circle(const Pose& worldFromBody, const Vec3& centre, const Mat3& axes, const Vec3& colour) {
    Vec3 last = worldFromBody.toWorld(centre + axes.col(0));
    for (int i = 1; i <= circleSegments; ++i) {
        const double angle = 2 * std::numbers::pi * i / circleSegments;
        const Vec3 next =
            worldFromBody.toWorld(centre + std::cos(angle) * axes.col(0) + std::sin(angle) * axes.col(1));
        line(last, next, colour);
        last = next;
    }
}

void LinePen::outline(const Shape& shape, const Pose& worldFromBody, const Vec3& colour) {
    const auto turned = [](int first, int second, double radius) {
        Mat3 axes = Mat3::Zero();
        axes.col(0) = radius * Vec3::Unit(first);
        axes.col(1) = radius * Vec3::Unit(second);
        return axes;
    };
    if (const Sphere* sphere = std::get_if<Sphere>(&shape)) {
        for (int axis = 0; axis < 3; ++axis)
            circle(worldFromBody, Vec3::Zero(), turned(axis, (axis + 1) % 3, sphere->radius), colour);
    } else if (const Cylinder* cylinder = std::get_if<Cylinder>(&shape)) {
        const Vec3 up = cylinder->halfHeight * Vec3::UnitY();
        for (const double end : {-1.0, 1.0})
            circle(worldFromBody, end * up, turned(0, 2, cylinder->radius), colour);
        for (const int axis : {0, 2})
            for (const double side : {-1.0, 1.0}) {
                const Vec3 rim = side * cylinder->radius * Vec3::Unit(axis);
                line(worldFromBody.toWorld(rim - up), worldFromBody.toWorld(rim + up), colour);
            }
    } else if (const Cuboid* cuboid = std::get_if<Cuboid>(&shape)) {
        const auto corner = [&](int i) {
            const Vec3 signs(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
            return worldFromBody.toWorld(cuboid->halfSize.cwiseProduct(signs));
        };
        for (int i = 0; i < 8; ++i)
            for (const int axis : {1, 2, 4})
                if (!(i & axis)) line(corner(i), corner(i | axis), colour);
    }
}

} // namespace carom
