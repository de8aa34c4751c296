// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/random.h"
#include "core/math/rotation.h"
#include "tests/support/scenes.h"

#include <cmath>

namespace carom::test {

inline Vec3 randomVector(Random& random, double deviation) {
    const double x = random.gaussian(), y = random.gaussian();
    return deviation * Vec3(x, y, random.gaussian());
}

/// Any body but a wall: mobile or fixed, elastic or not, turned and turning.
inline Body randomBody(Random& random, double spread) {
    const double mass = std::exp(random.uniform(-2, 2));
    const Vec3 centre = randomVector(random, spread) + Vec3(0, 2 * spread, 0);
    Body body = sphere(random.uniform(0.1, 0.5), mass, centre);
    const std::uint64_t kind = random.below(6);
    if (kind == 4) body = cylinder(random.uniform(0.1, 0.5), random.uniform(0.2, 1), mass, centre);
    if (kind == 5) {
        const double x = random.uniform(0.2, 1), y = random.uniform(0.2, 1);
        body = cuboid(Vec3(x, y, random.uniform(0.2, 1)), mass, centre);
    }
    body.pose.orientation = fromRotationVector(randomVector(random, 1));
    body.velocity = randomVector(random, 2);
    if (random.below(2) == 0) body.angularVelocity = randomVector(random, 2);
    if (random.below(2) == 0) body.elastic = random.uniform();
    body.fixed = random.below(12) == 0;
    return body;
}

/// Up to sixty bodies that fall into a corner of walls, in any order of declaration.
inline Scene randomScene(Random& random) {
    Scene scene = sceneOf({}, Vec3(0, -9.8, 0));
    const std::uint64_t count = 2 + random.below(60);
    const double spread = random.uniform(0.5, 3);
    const std::uint64_t wallEvery = 1 + count / 4;
    for (std::uint64_t i = 0; i < count; ++i) {
        scene.bodies.push_back(randomBody(random, spread));
        if (i % wallEvery == 0) {
            const Vec3 inward = (Vec3::UnitY() + randomVector(random, 0.5)).normalized();
            scene.bodies.push_back(wall(inward, -0.1 * random.uniform()));
        }
    }
    return scene;
}

/// The same, every other body with friction and every fourth with rolling resistance.
inline Scene randomRoughScene(Random& random) {
    Scene scene = randomScene(random);
    for (Body& body : scene.bodies) {
        body.friction = random.below(2) == 0 ? random.uniform() : 0;
        body.rolling = random.below(4) == 0 ? 0.01 : 0;
    }
    return scene;
}

} // namespace carom::test
