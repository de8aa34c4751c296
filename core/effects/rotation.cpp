// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/bodies.h"
#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"

// Orientation, angular velocity and inertia. A frictionless impulse on a sphere passes through its centre, so
// a sphere's spin never changes and never matters to anything else; it is followed only where the scene gives
// one, so that what is drawn and written is right. Everything else that can be hit can be set spinning.

namespace carom {
namespace rotationEffect {
namespace {

EffectDecision decide(const Scene& scene, const RunFacts& run) {
    EffectDecision decision{.effect = "rotation"};
    if (firstMobile(scene) == nullptr) {
        decision.reason = Sentence{"no body can move"};
        return decision;
    }
    for (const Body& body : scene.bodies) {
        if (!canRotate(scene, body)) continue;
        const std::string name = scene.nameOf(indexOf(scene, body));
        decision.status = EffectStatus::On;
        decision.source = placeOf(scene, body.source, "angvel");
        decision.reason = body.angularVelocity != Vec3::Zero()
                              ? Sentence{"%1 spins from the start", {name}}
                              : Sentence{"%1 is not a sphere and can be hit beside its centre", {name}};
        return decision;
    }
    for (const EffectRow& row : effects()) {
        const std::optional<Cause> cause = row.turns != nullptr ? row.turns(scene, run) : std::nullopt;
        if (!cause) continue;
        decision.status = EffectStatus::On;
        decision.source = cause->source;
        decision.reason = cause->reason;
        return decision;
    }
    decision.reason =
        Sentence{"no body spins at the start, and impulses without friction pass through a sphere's centre"};
    if (scene.bodies.size() == 1)
        decision.reason = Sentence{"the only body does not spin and can touch nothing"};
    return decision;
}

} // namespace
} // namespace rotationEffect

extern const EffectRow rotationRow;
constinit const EffectRow rotationRow = {
    .name = "rotation",
    .title = "Rotation",
    .help = "Bodies turn, and impulses beside their centres set them turning.",
    .decide = rotationEffect::decide,
};

} // namespace carom
