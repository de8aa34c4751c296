// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/effects/effect.h"
#include "core/scene/scene.h"

#include <initializer_list>
#include <string_view>

// A small vocabulary for tests: scenes without a text.

namespace carom {

/// The bodies as a stage of a solver takes them: with the coefficients of the contact laws. Gravity and
/// springs are handed to it apart.
inline Bodies bodiesOf(const Scene& scene) {
    Bodies bodies = bareBodiesOf(scene);
    for (const std::string_view effect : {"restitution", "friction", "rolling_resistance"})
        if (findEffect(effect)
                ->decide(scene, {.method = {.friction = true, .rollingResistance = true}})
                .status == EffectStatus::On)
            contribute(*findEffect(effect), scene, bodies);
    return bodies;
}

} // namespace carom

namespace carom::test {

inline Body sphere(double radius, double mass, const Vec3& centre, const Vec3& velocity = Vec3::Zero()) {
    Body body;
    body.shape = Sphere{radius};
    body.mass = mass;
    body.pose.position = centre;
    body.velocity = velocity;
    return body;
}

/// A cylinder along y.
inline Body cylinder(double radius, double height, double mass, const Vec3& centre) {
    Body body;
    body.shape = Cylinder{radius, height / 2};
    body.mass = mass;
    body.pose.position = centre;
    return body;
}

inline Body cuboid(const Vec3& size, double mass, const Vec3& centre) {
    Body body;
    body.shape = Cuboid{size / 2};
    body.mass = mass;
    body.pose.position = centre;
    return body;
}

/// The surface is { x : normal·x = offset }; `normal` is a unit vector.
inline Body wall(const Vec3& normal, double offset) {
    Body body;
    body.shape = Wall{normal, offset};
    body.fixed = true;
    return body;
}

/// A spring as long as the way between the centres at the start; noBody is the world, at its origin.
inline Spring springBetween(BodyIndex from, BodyIndex to, double stiffness, double damping = 0) {
    Spring spring;
    spring.from = from;
    spring.to = to;
    spring.stiffness = stiffness;
    spring.damping = damping;
    return spring;
}

inline Scene sceneOf(std::initializer_list<Body> bodies, const Vec3& gravity = Vec3::Zero()) {
    Scene scene;
    scene.bodies = bodies;
    scene.gravity.acceleration = gravity;
    return scene;
}

} // namespace carom::test
