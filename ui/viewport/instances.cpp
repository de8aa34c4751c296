// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/instances.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace carom {

namespace {

/// A turn by less than this is rounding, not spin: 1 - |q·q'| of an angle of about 1/4 degree.
constexpr double turnedEnough = 2e-6;

Vec3 halfSizeOf(const Shape& shape) {
    struct Visitor {
        Vec3 operator()(const Sphere& sphere) const { return Vec3::Constant(sphere.radius); }
        Vec3 operator()(const Wall&) const { return Vec3::Zero(); }
        Vec3 operator()(const Cylinder& cylinder) const {
            return {cylinder.radius, cylinder.halfHeight, cylinder.radius};
        }
        Vec3 operator()(const Cuboid& cuboid) const { return cuboid.halfSize; }
    };
    return std::visit(Visitor{}, shape);
}

} // namespace

Aabb boundsOf(const Scene& scene, std::span<const Pose> poses) {
    Aabb bounds{Vec3::Constant(-0.5), Vec3::Constant(0.5)};
    bool any = false;
    for (std::size_t i = 0; i < std::min(scene.bodies.size(), poses.size()); ++i) {
        if (isWall(scene.bodies[i].shape)) continue;
        const Aabb box = boundsOf(scene.bodies[i].shape, poses[i]);
        bounds = any ? united(bounds, box) : box;
        any = true;
    }
    return bounds;
}

void InstanceTable::build(const Scene& scene) {
    m_sources.clear();
    m_indexOf.assign(scene.bodies.size(), -1);
    const auto add = [&](ShapeKind kind) {
        const int first = static_cast<int>(m_sources.size());
        for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
            const Body& body = scene.bodies[i];
            if (kindOf(body.shape) != kind) continue;
            const Vec3 half = halfSizeOf(body.shape);
            Source source{
                static_cast<BodyIndex>(i), {}, body.pose.orientation, boundingRadiusOf(body.shape), 0};
            for (int axis = 0; axis < 3; ++axis) {
                source.instance.halfSize[axis] = static_cast<float>(half[axis]);
                source.instance.colour[axis] = static_cast<float>(body.colour[axis]);
            }
            source.instance.colour[3] = 1;
            source.instance.pattern = body.angularVelocity.isZero(0) ? 0.0F : 1.0F;
            m_sources.push_back(source);
        }
        return InstanceRange{first, static_cast<int>(m_sources.size()) - first};
    };
    m_spheres = add(ShapeKind::Sphere);
    m_cylinders = add(ShapeKind::Cylinder);
    m_cuboids = add(ShapeKind::Cuboid);
    m_instances.resize(m_sources.size());
}

void InstanceTable::place(std::span<const Pose> poses, const Camera& camera, const Camera& light) {
    const Mat3 lightFromWorld = viewMatrix(light).block<3, 3>(0, 0);
    m_bounds = m_lightBounds = {Vec3::Constant(-0.5), Vec3::Constant(0.5)};
    const Vec3 forward = camera.forward();
    bool first = true;
    for (Source& source : m_sources) {
        const Pose& pose = poses[source.body];
        if (!pose.position.allFinite()) continue; // of a run that broke: it stays where it was last seen
        Instance& instance = source.instance;
        for (int axis = 0; axis < 3; ++axis)
            instance.position[axis] = static_cast<float>(pose.position[axis]);
        for (int part = 0; part < 4; ++part)
            instance.orientation[part] = static_cast<float>(pose.orientation.coeffs()[part]);
        if (1 - std::abs(pose.orientation.dot(source.start)) > turnedEnough) instance.pattern = 1;
        source.depth = pose.position.dot(forward);
        const Aabb box = grown({pose.position, pose.position}, source.radius);
        const Vec3 seenByLight = lightFromWorld * pose.position;
        const Aabb lightBox = grown({seenByLight, seenByLight}, source.radius);
        m_bounds = first ? box : united(m_bounds, box);
        m_lightBounds = first ? lightBox : united(m_lightBounds, lightBox);
        first = false;
    }
    std::sort(m_sources.begin() + m_spheres.first, m_sources.begin() + m_spheres.first + m_spheres.count,
              [](const Source& a, const Source& b) { return a.depth > b.depth; });
    for (std::size_t i = 0; i < m_sources.size(); ++i) {
        m_instances[i] = m_sources[i].instance;
        m_indexOf[m_sources[i].body] = static_cast<int>(i);
    }
}

int InstanceTable::indexOf(BodyIndex body) const { return body < m_indexOf.size() ? m_indexOf[body] : -1; }

} // namespace carom
