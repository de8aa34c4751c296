// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/instances.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace carom {

namespace {

/// A smaller turn counts as rounding, not spin: 1 - |q·q'| of an angle of about 1/4 degree, at a hundred
/// times of 2.3 degrees, so that a slow spin would not be seen.
constexpr double turnedEnough = 2e-6;
/// Radii [px] up to which 16 and 36 corners are true to a quarter of a pixel: r (1 - cos(pi / n)).
constexpr double coarseUpTo = 13;
constexpr double mediumUpTo = 65;

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
    m_spheres = add(kindOf<Sphere>());
    m_cylinders = add(kindOf<Cylinder>());
    m_cuboids = add(kindOf<Cuboid>());
    m_instances.resize(m_sources.size());
}

std::span<InstanceTable::Source> InstanceTable::part(InstanceRange range) {
    return std::span(m_sources).subspan(static_cast<std::size_t>(range.first),
                                        static_cast<std::size_t>(range.count));
}

void InstanceTable::place(std::span<const Pose> poses, const Camera& camera, const PictureSize& size,
                          const Camera& light) {
    const Mat3 lightFromWorld = viewMatrix(light).block<3, 3>(0, 0);
    m_bounds = m_lightBounds = {Vec3::Constant(-0.5), Vec3::Constant(0.5)};
    const Vec3 forward = camera.forward(), eye = camera.eye();
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
        source.depth = (pose.position - eye).dot(forward);
        const Aabb box = grown({pose.position, pose.position}, source.radius);
        const Vec3 seenByLight = lightFromWorld * pose.position;
        const Aabb lightBox = grown({seenByLight, seenByLight}, source.radius);
        m_bounds = first ? box : united(m_bounds, box);
        m_lightBounds = first ? lightBox : united(m_lightBounds, lightBox);
        first = false;
    }
    orderSpheres();
    orderCylinders(camera, camera.pixelSize(size));
    for (std::size_t i = 0; i < m_sources.size(); ++i) {
        m_instances[i] = m_sources[i].instance;
        m_indexOf[m_sources[i].body] = static_cast<int>(i);
    }
}

void InstanceTable::orderSpheres() {
    const std::span<Source> spheres = part(m_spheres);
    std::sort(spheres.begin(), spheres.end(),
              [](const Source& a, const Source& b) { return a.depth > b.depth; });
    m_anySpins = std::any_of(spheres.begin(), spheres.end(),
                             [](const Source& source) { return source.instance.pattern > 0; });
}

/// `pixel`: what one covers at the camera's target [m].
void InstanceTable::orderCylinders(const Camera& camera, double pixel) {
    const std::span<Source> cylinders = part(m_cylinders);
    for (Source& source : cylinders) {
        const double nearest = source.depth - source.radius;
        const double covers = camera.orthographic ? pixel : pixel / camera.distance * nearest;
        const double radius = source.instance.halfSize[0] / covers; // [px]
        source.detail = covers <= 0 || radius > mediumUpTo ? Detail::Fine
                        : radius > coarseUpTo              ? Detail::Medium
                                                           : Detail::Coarse;
    }
    // Within one detail front to back: what lies behind is not shaded.
    std::sort(cylinders.begin(), cylinders.end(), [](const Source& a, const Source& b) {
        return a.detail != b.detail ? a.detail < b.detail : a.depth < b.depth;
    });
    int first = m_cylinders.first;
    for (std::size_t detail = 0; detail < detailCount; ++detail) {
        const int count = static_cast<int>(
            std::count_if(cylinders.begin(), cylinders.end(), [detail](const Source& source) {
                return source.detail == static_cast<Detail>(detail);
            }));
        m_byDetail[detail] = {first, count};
        first += count;
    }
}

int InstanceTable::indexOf(BodyIndex body) const { return body < m_indexOf.size() ? m_indexOf[body] : -1; }

} // namespace carom
