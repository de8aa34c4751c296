// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/bodies.h"

#include "core/dynamics/free_rotation.h"
#include "core/dynamics/numbering.h"

#include <algorithm>

namespace carom {
namespace {

void reserve(Bodies& bodies, std::size_t count) {
    bodies.shape.reserve(count);
    for (std::vector<double>* each : {&bodies.mass, &bodies.inverseMass, &bodies.boundingRadius})
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
    bodies.mobile.push_back(mobile ? 1 : 0);
    bodies.turnedByImpacts.push_back(mobile && !hasCentralNormals(body.shape) ? 1 : 0);

    (wall ? bodies.walls : bodies.bounded).push_back(index);
    if (!mobile) return;
    bodies.mobileBodies.push_back(index);
    if (rotates) bodies.rotating.push_back(index);
}

} // namespace

Bodies bareBodiesOf(const Scene& scene) {
    Bodies bodies;
    reserve(bodies, scene.bodies.size());
    for (const Body& body : scene.bodies) append(bodies, body, canRotate(scene, body));
    for (std::vector<double>* each : {&bodies.elastic, &bodies.friction, &bodies.rolling})
        each->assign(scene.bodies.size(), 0);
    bodies.order = canonicalOrder(scene);
    bodies.origin = originNear(scene);
    return bodies;
}

bool canRotate(const Scene& scene, const Body& body) {
    if (!body.mobile() || isWall(body.shape)) return false;
    if (body.angularVelocity != Vec3::Zero()) return true;
    return scene.bodies.size() > 1 && !hasCentralNormals(body.shape);
}

bool anyCanMeet(const Bodies& bodies) { return bodies.count() > 1 && !bodies.mobileBodies.empty(); }

bool anyPrecesses(const Bodies& bodies) {
    return std::ranges::any_of(bodies.rotating,
                               [&](BodyIndex i) { return !hasEqualMoments(bodies.inertia[i]); });
}

} // namespace carom
