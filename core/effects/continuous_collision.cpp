// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"

#include "core/base/figures.h"
#include "core/dynamics/spring_force.h"
#include "core/dynamics/state.h"

#include <algorithm>
#include <cmath>
#include <optional>

// A body that moves further than its half-extent (half its thickness) in a substep can be in front of a thin
// body at the beginning and behind it at the end, unless the time of impact is located in between. How fast a
// body can become follows from the energy that there is: all of it may end up in one body,
//
//     v + ω r ≤ √(2 E (1/m + r²/I))      E = kinetic energy + Σ m |g| (height above the floor) + springs
//
// where r counts for bodies that are no spheres. Without a level floor bodies fall ever faster, and where an
// impact gives energy, or wind does, there is no bound either.

namespace carom {
namespace {

/// How high the highest level floor is, against gravity [m]; nothing if there is none.
std::optional<double> floorOf(const Scene& scene, const Vec3& up) {
    std::optional<double> highest;
    for (const Body& body : scene.bodies)
        if (const Wall* wall = std::get_if<Wall>(&body.shape); wall != nullptr && wall->normal == up)
            highest = std::max(highest.value_or(wall->offset), wall->offset);
    return highest;
}

double kineticEnergyOf(const Body& body) {
    const Vec3 spin = body.pose.directionToBody(body.angularVelocity);
    return 0.5 * (body.mass * body.velocity.squaredNorm() +
                  spin.dot(inertiaOf(body.shape, body.mass).cwiseProduct(spin)));
}

/// What there is to spend [J]; nothing where that has no bound.
std::optional<double> energyOf(const Scene& scene) {
    const bool gains = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                   [](const Body& body) { return body.elastic > 1; });
    const bool windy = scene.air.density > 0 && scene.air.wind != Vec3::Zero();
    if (gains || windy) return std::nullopt;

    const Vec3& gravity = scene.gravity.acceleration;
    const bool falls = gravity != Vec3::Zero();
    const Vec3 up = falls ? Vec3(-gravity.normalized()) : Vec3::Zero();
    const std::optional<double> floor = falls ? floorOf(scene, up) : 0;
    if (!floor) return std::nullopt;
    double energy = scene.springs.empty() ? 0 : springEnergy(springsOf(scene), initialStateOf(scene));
    for (const Body& body : scene.bodies) {
        if (!body.mobile()) continue;
        const double height = up.dot(body.pose.position) - *floor;
        if (falls && height < 0) return std::nullopt; // behind the floor, it falls for ever
        energy += kineticEnergyOf(body) + body.mass * gravity.norm() * height;
    }
    return energy;
}

/// The furthest that a point of the body comes in a substep with that energy [m].
double furthest(const Body& body, double energy, double substep) {
    double perMass = 1 / body.mass;
    if (!hasCentralNormals(body.shape)) {
        const double radius = boundingRadiusOf(body.shape);
        perMass += radius * radius / inertiaOf(body.shape, body.mass).minCoeff();
    }
    return std::sqrt(2 * energy * perMass) * substep;
}

EffectDecision decide(const Scene& scene, const RunFacts& run) {
    EffectDecision decision{.effect = "continuous_collision"};
    if (!anyCanMeet(scene)) {
        decision.reason = Sentence{"no two bodies can meet"};
        return decision;
    }
    const std::optional<double> energy = energyOf(scene);
    const Body* fast = nullptr; // the first that may pass its half-extent
    double way = 0;
    for (const Body& body : scene.bodies) {
        if (!body.mobile()) continue;
        if (energy) way = furthest(body, *energy, run.substep);
        if (energy && way <= halfThicknessOf(body.shape)) continue;
        fast = &body;
        break;
    }
    if (fast == nullptr) {
        decision.reason = Sentence{"no body can pass its half-extent in a substep by the energy there is"};
    } else {
        decision.source = placeOf(scene, fast->source, "vel");
        const std::string name = scene.nameOf(indexOf(scene, *fast));
        decision.reason =
            energy ? Sentence{"%1 may move %2 m in a substep by the energy there is, more than its "
                              "half-extent of %3 m",
                              {name, figure(way), figure(halfThicknessOf(fast->shape))}}
                   : Sentence{"nothing bounds the speed of %1", {name}};
    }
    if (run.method.locatesImpacts) {
        decision.status = EffectStatus::On;
        decision.reason.add(fast != nullptr
                                ? Sentence{"impacts are located within the step"}
                                : Sentence{"impacts are located within the step for the accuracy alone"});
        if (!decision.source) decision.source = placeOf(scene, firstMobile(scene)->source, "");
    } else if (fast != nullptr) {
        decision.status = EffectStatus::NotSimulatedYet;
        decision.reason.add(Sentence{"the method looks at the ends of substeps only"});
    }
    return decision;
}

} // namespace

extern const EffectRow continuousCollisionRow;
constinit const EffectRow continuousCollisionRow = {
    .name = "continuous_collision",
    .title = "Continuous collision",
    .help = "Impacts are found between the ends of a step, so that nothing passes through anything.",
    .decide = decide,
};

} // namespace carom
