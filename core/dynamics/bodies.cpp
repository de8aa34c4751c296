// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/bodies.h"

#include "core/dynamics/numbering.h"

#include <algorithm>

namespace carom {
namespace {

void reserve(Bodies& bodies, std::size_t count) {
    bodies.shape.reserve(count);
    for (std::vector<double>* each : {&bodies.mass, &bodies.inverseMass, &bodies.boundingRadius,
                                      &bodies.elastic, &bodies.friction, &bodies.rolling})
        each->reserve(count);
    for (std::vector<Vec3>* each : {&bodies.inertia, &bodies.inverseInertia}) each->reserve(count);
    for (std::vector<std::uint8_t>* each : {&bodies.mobile, &bodies.turnedByImpacts}) each->reserve(count);
    for (std::vector<BodyIndex>* each : {&bodies.mobileBodies, &bodies.bounded}) each->reserve(count);
}

void append(Bodies& bodies, const Body& body, bool rotates) {
    const BodyIndex index = static_cast<BodyIndex>(bodies.count());
    const bool wall = isWall(body.shape);
    const bool mobile = body.mobile() && !wall;
    const Vec3 inertia = mobile ? inertiaOf(body.shape, body.mass) : Vec3::Zero();

    bodies.shape.push_back(body.shape);
    bodies.mass.push_back(mobile ? body.mass : 0);
    bodies.inverseMass.push_back(mobile ? 1 / body.mass : 0);
    bodies.inertia.push_back(inertia);
    bodies.inverseInertia.push_back(mobile ? Vec3(inertia.cwiseInverse()) : Vec3::Zero());
    bodies.boundingRadius.push_back(wall ? 0 : boundingRadiusOf(body.shape));
    bodies.elastic.push_back(body.elastic);
    bodies.friction.push_back(body.friction);
    bodies.rolling.push_back(body.rolling);
    bodies.mobile.push_back(mobile ? 1 : 0);
    bodies.turnedByImpacts.push_back(mobile && !hasCentralNormals(body.shape) ? 1 : 0);

    (wall ? bodies.walls : bodies.bounded).push_back(index);
    if (!mobile) return;
    bodies.mobileBodies.push_back(index);
    if (rotates) bodies.rotating.push_back(index);
}

// Friction of a pair is the mean of its two: one body's own is none.
bool anyPairRubs(const Scene& scene) {
    const auto isRough = [](const Body& body) { return body.friction > 0; };
    const auto canSlip = [](const Body& body) { return body.friction > 0 && body.mobile(); };
    return std::count_if(scene.bodies.begin(), scene.bodies.end(), isRough) > 1 &&
           std::any_of(scene.bodies.begin(), scene.bodies.end(), canSlip);
}

} // namespace

Bodies bodiesOf(const Scene& scene) {
    Bodies bodies;
    std::vector<std::uint8_t> pulledAside(scene.bodies.size(), 0);
    for (const Spring& spring : scene.springs) {
        if (spring.from != noBody && spring.fromAt != Vec3::Zero()) pulledAside[spring.from] = 1;
        if (spring.to != noBody && spring.toAt != Vec3::Zero()) pulledAside[spring.to] = 1;
    }
    const bool rubs = anyPairRubs(scene);
    const bool resists =
        scene.bodies.size() > 1 && std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                               [](const Body& body) { return body.rolling > 0; });
    reserve(bodies, scene.bodies.size());
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const Body& body = scene.bodies[i];
        append(bodies, body,
               resists || (rubs && body.friction > 0) || pulledAside[i] != 0 || canRotate(scene, body));
    }
    bodies.order = canonicalOrder(scene);
    bodies.origin = originNear(scene);
    return bodies;
}

bool canRotate(const Scene& scene, const Body& body) {
    if (!body.mobile() || isWall(body.shape)) return false;
    if (body.angularVelocity != Vec3::Zero()) return true;
    return scene.bodies.size() > 1 && !hasCentralNormals(body.shape);
}

} // namespace carom
