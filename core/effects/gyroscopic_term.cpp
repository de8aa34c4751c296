// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/bodies.h"
#include "core/dynamics/free_rotation.h"
#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"

// Euler's equation for a free body, I ω' = −ω × I ω (L. Euler, 1758): where the three moments differ, a
// constant angular momentum means a changing angular velocity. The reference kept ω constant between
// collisions, and so does the method `microcollisions`.

namespace carom {
namespace gyroscopicTermEffect {
namespace {

/// A torque of less, relative to the largest there could be, is rounding: ten times that of the products
/// below.
constexpr double noTorque = 1e-14;

// Spin about a principal axis stays there: ω × I ω = 0.
bool spinsAboutPrincipalAxis(const Body& body) {
    const Vec3 spin = body.pose.directionToBody(body.angularVelocity);
    const Vec3 torque = spin.cross(inertiaOf(body.shape, 1).cwiseProduct(spin));
    return torque.norm() <= noTorque * inertiaOf(body.shape, 1).maxCoeff() * spin.squaredNorm();
}

EffectDecision decide(const Scene& scene, const RunFacts& run) {
    EffectDecision decision{.effect = "gyroscopic_term"};
    const Body* possible = nullptr; // could come to spin askew
    for (const Body& body : scene.bodies) {
        if (!canRotate(scene, body) || hasEqualMoments(inertiaOf(body.shape, body.mass))) continue;
        if (possible == nullptr) possible = &body;
        if (spinsAboutPrincipalAxis(body)) continue;
        decision.unmet.push_back(placeOf(scene, body.source, "angvel").value_or(SourceRange{}));
        if (decision.unmet.size() == 1) possible = &body;
    }
    if (possible == nullptr) {
        decision.reason = Sentence{"no body that can turn has moments of inertia that differ"};
        return decision;
    }
    decision.source = placeOf(scene, possible->source, "angvel");
    const std::string name = scene.nameOf(indexOf(scene, *possible));
    decision.reason = decision.unmet.empty() ? Sentence{"%1 may come to spin askew to its axes", {name}}
                                             : Sentence{"%1 spins askew to its axes", {name}};
    if (run.method.gyroscopicTerm) {
        decision.status = EffectStatus::On;
        decision.unmet.clear();
        decision.reason.add(Sentence{"its angular velocity precesses between impacts"});
    } else {
        decision.status = EffectStatus::NotSimulatedYet;
        decision.reason.add(
            Sentence{"its angular velocity is kept constant between collisions, as in the reference"});
    }
    return decision;
}

} // namespace
} // namespace gyroscopicTermEffect

extern const EffectRow gyroscopicTermRow;
constinit const EffectRow gyroscopicTermRow = {
    .name = "gyroscopic_term",
    .title = "Gyroscopic term",
    .help = "The angular velocity of a free body precesses where its moments of inertia differ.",
    .decide = gyroscopicTermEffect::decide,
    .unmetMessage =
        "the gyroscopic term is not simulated yet; the angular velocity stays constant between collisions",
};

} // namespace carom
