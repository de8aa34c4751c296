// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"

#include "core/base/figures.h"

#include <algorithm>
#include <cmath>
#include <optional>

// A body that moves further than its half-extent (half its thickness) in a substep can be in front of a thin
// body at the beginning and behind it at the end, unless the time of impact is located in between. How fast a
// body can become follows from the energy that there is: all of it may end up in one body,
//
//     v + ω r ≤ √(2 E (1/m + r²/I))      E = kinetic energy + what each effect can give (EffectRow::gives)
//
// where r counts for bodies that are no spheres. Without a level floor bodies fall ever faster, and where an
// impact gives energy, or wind does, there is no bound either.

namespace carom {
namespace continuousCollisionEffect {
namespace {

double kineticEnergyOf(const Body& body) {
    const Vec3 spin = body.pose.directionToBody(body.angularVelocity);
    return 0.5 * (body.mass * body.velocity.squaredNorm() +
                  spin.dot(inertiaOf(body.shape, body.mass).cwiseProduct(spin)));
}

/// The energy available [J]; nothing where that has no bound.
std::optional<double> energyOf(const Scene& scene) {
    double energy = 0;
    for (const EffectRow& row : effects()) {
        if (row.gives == nullptr) continue;
        const std::optional<double> given = row.gives(scene);
        if (!given) return std::nullopt;
        energy += *given;
    }
    for (const Body& body : scene.bodies)
        if (body.mobile()) energy += kineticEnergyOf(body);
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
} // namespace continuousCollisionEffect

extern const EffectRow continuousCollisionRow;
constinit const EffectRow continuousCollisionRow = {
    .name = "continuous_collision",
    .title = "Continuous collision",
    .help = "Impacts are found between the ends of a step, so that nothing passes through anything.",
    .decide = continuousCollisionEffect::decide,
};

} // namespace carom
