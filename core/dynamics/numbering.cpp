// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/numbering.h"

#include "core/math/aabb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <string_view>
#include <tuple>

namespace carom {
namespace {

using Place = std::tuple<bool, double, double, double, double, double>;

std::array<double, 3> numbersOf(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

std::vector<std::tuple<std::string_view, std::array<double, 3>>> numbersOf(const EffectValues& values) {
    std::vector<std::tuple<std::string_view, std::array<double, 3>>> numbers;
    for (const auto& [parameter, value] : values.all())
        if (!value.isZero(0)) numbers.emplace_back(parameter, numbersOf(value));
    return numbers;
}

std::array<double, 4> numbersOf(const Shape& shape) {
    struct Numbers {
        std::array<double, 4> operator()(const Sphere& sphere) const { return {sphere.radius}; }
        std::array<double, 4> operator()(const Cylinder& cylinder) const {
            return {cylinder.radius, cylinder.halfHeight};
        }
        std::array<double, 4> operator()(const Cuboid& cuboid) const {
            return {cuboid.halfSize.x(), cuboid.halfSize.y(), cuboid.halfSize.z()};
        }
        std::array<double, 4> operator()(const Wall& wall) const {
            return {wall.normal.x(), wall.normal.y(), wall.normal.z(), wall.offset};
        }
    };
    return std::visit(Numbers{}, shape);
}

// The width of layers is a power of two: the same scene in other units has the same order. It is that of each
// body, so that the order of two depends on no third one.
Place placeOf(const Body& body) {
    const Vec3& at = body.pose.position;
    if (isWall(body.shape)) return {false, at.y(), at.x(), at.z(), 0, 0};
    const double width = std::scalbn(1.0, std::ilogb(2 * boundingRadiusOf(body.shape)));
    const auto floorOf = [width](double value) { return width * std::floor(value / width); };
    return {true, floorOf(at.y()), floorOf(at.x()), at.z(), at.y(), at.x()};
}

auto everythingElseOf(const Body& body) {
    const Quat& q = body.pose.orientation;
    return std::tuple(static_cast<int>(kindOf(body.shape)), numbersOf(body.shape), body.mobile(), body.mass,
                      body.elastic, body.friction, body.rolling, numbersOf(body.values),
                      std::array{q.x(), q.y(), q.z(), q.w()}, numbersOf(body.velocity),
                      numbersOf(body.angularVelocity));
}

Aabb ballAbout(const Vec3& centre, double radius) { return grown({centre, centre}, radius); }

struct Region {
    std::optional<Aabb> box;

    void add(const Aabb& part) { box = box ? united(*box, part) : part; }
};

template<class Value>
std::vector<Value> permuted(const std::vector<Value>& values, std::span<const BodyIndex> order) {
    std::vector<Value> result;
    result.reserve(values.size());
    for (const BodyIndex i : order) result.push_back(values[i]);
    return result;
}

bool springBefore(const SpringForce& a, const SpringForce& b) {
    const auto key = [](const SpringForce& s) {
        return std::tuple(s.from, s.to, numbersOf(s.fromAt), numbersOf(s.toAt), s.stiffness, s.damping,
                          s.length);
    };
    return key(a) < key(b);
}

} // namespace

std::vector<BodyIndex> canonicalOrder(const Scene& scene) {
    struct Placed { // beside each other: bodies are far apart in memory
        Place place;
        BodyIndex body = noBody;
    };
    std::vector<Placed> placed;
    placed.reserve(scene.bodies.size());
    for (BodyIndex i = 0; i < scene.bodies.size(); ++i) placed.push_back({placeOf(scene.bodies[i]), i});
    std::stable_sort(placed.begin(), placed.end(), [&scene](const Placed& a, const Placed& b) {
        if (a.place != b.place) return a.place < b.place;
        return everythingElseOf(scene.bodies[a.body]) < everythingElseOf(scene.bodies[b.body]);
    });
    std::vector<BodyIndex> order;
    order.reserve(placed.size());
    for (const Placed& each : placed) order.push_back(each.body);
    return order;
}

Vec3 originNear(const Scene& scene) {
    Region region;
    for (const Body& body : scene.bodies)
        if (!isWall(body.shape)) region.add(ballAbout(body.pose.position, boundingRadiusOf(body.shape)));
    if (!region.box) return Vec3::Zero();
    const Vec3 among = region.box->centre();
    for (const Body& body : scene.bodies)
        if (const Wall* wall = std::get_if<Wall>(&body.shape))
            region.add(ballAbout(among - distanceTo(*wall, among) * wall->normal, 0));
    for (const Spring& spring : scene.springs) {
        if (spring.from == noBody) region.add(ballAbout(spring.fromAt, 0));
        if (spring.to == noBody) region.add(ballAbout(spring.toAt, 0));
    }
    const double size = region.box->size().maxCoeff();
    const Vec3 middle = region.box->centre();
    if (!(middle.cwiseAbs().maxCoeff() > farAway * size) || !std::isfinite(size)) return Vec3::Zero();
    const double unit = std::ldexp(1.0, std::ilogb(size));
    return unit * (middle / unit).array().round().matrix();
}

bool areInOrder(const std::vector<SpringForce>& springs) {
    return std::is_sorted(springs.begin(), springs.end(), springBefore);
}

Bodies renumbered(const Bodies& bodies, std::span<const BodyIndex> order, const Vec3& origin) {
    Bodies result;
    std::vector<BodyIndex> place(order.size());
    for (BodyIndex k = 0; k < order.size(); ++k) place[order[k]] = k;
    const auto placesOf = [&](const std::vector<BodyIndex>& list) {
        std::vector<BodyIndex> places;
        for (const BodyIndex i : list) places.push_back(place[i]);
        std::sort(places.begin(), places.end());
        return places;
    };
    result.shape = permuted(bodies.shape, order);
    result.mass = permuted(bodies.mass, order);
    result.inverseMass = permuted(bodies.inverseMass, order);
    result.inertia = permuted(bodies.inertia, order);
    result.inverseInertia = permuted(bodies.inverseInertia, order);
    result.boundingRadius = permuted(bodies.boundingRadius, order);
    result.elastic = permuted(bodies.elastic, order);
    result.friction = permuted(bodies.friction, order);
    result.rolling = permuted(bodies.rolling, order);
    result.mobile = permuted(bodies.mobile, order);
    result.turnedByImpacts = permuted(bodies.turnedByImpacts, order);
    result.mobileBodies = placesOf(bodies.mobileBodies);
    result.walls = placesOf(bodies.walls);
    result.bounded = placesOf(bodies.bounded);
    result.rotating = placesOf(bodies.rotating);
    result.boxes = bodies.boxes;
    result.gravity = bodies.gravity;
    result.order.resize(order.size());
    std::iota(result.order.begin(), result.order.end(), BodyIndex{0});

    for (Shape& shape : result.shape)
        if (Wall* wall = std::get_if<Wall>(&shape)) wall->offset = -distanceTo(*wall, origin);
    for (SpringForce spring : bodies.springs) {
        if (spring.from == noBody)
            spring.fromAt -= origin;
        else
            spring.from = place[spring.from];
        if (spring.to == noBody)
            spring.toAt -= origin;
        else
            spring.to = place[spring.to];
        result.springs.push_back(spring);
    }
    std::stable_sort(result.springs.begin(), result.springs.end(), springBefore);
    result.forces = renumbered(bodies.forces, order, origin);
    return result;
}

} // namespace carom
