// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/bodies.h"
#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"

// Orientation, angular velocity and inertia. A frictionless impulse on a sphere passes through its centre, so
// a sphere's spin never changes and never matters to anything else; it is followed only where the scene gives
// one, so that what is drawn and written is right. Everything else that can be hit can be set spinning.

namespace carom {
namespace {

/// The first spring that pulls a mobile body beside its centre, or none.
const Spring* firstOffCentre(const Scene& scene) {
    const auto turns = [&](BodyIndex body, const Vec3& at) {
        return body != noBody && scene.bodies[body].mobile() && at != Vec3::Zero();
    };
    for (const Spring& spring : scene.springs)
        if (turns(spring.from, spring.fromAt) || turns(spring.to, spring.toAt)) return &spring;
    return nullptr;
}

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
    const MeetingPair rough = firstPairWith(scene, [](const Body& body) { return body.friction > 0; });
    if (run.method.friction && rough) {
        decision.status = EffectStatus::On;
        decision.source = placeOf(scene, rough.first->source, "friction");
        decision.reason =
            Sentence{"friction can set %1 turning", {scene.nameOf(indexOf(scene, *rough.second))}};
        return decision;
    }
    if (run.method.rollingResistance && anyCanMeet(scene)) {
        for (const Body& body : scene.bodies) {
            if (!(body.rolling > 0)) continue;
            decision.status = EffectStatus::On;
            decision.source = placeOf(scene, body.source, "rolling");
            decision.reason =
                Sentence{"what rolls over %1 is held back", {scene.nameOf(indexOf(scene, body))}};
            return decision;
        }
    }
    if (run.method.springs) {
        if (const Spring* spring = firstOffCentre(scene)) {
            decision.status = EffectStatus::On;
            decision.source = placeOf(scene, spring->source, "");
            decision.reason = Sentence{"a spring between %1 and %2 pulls beside a centre",
                                       {scene.nameOf(spring->from), scene.nameOf(spring->to)}};
            return decision;
        }
    }
    decision.reason =
        Sentence{"no body spins at the start, and impulses without friction pass through a sphere's centre"};
    if (scene.bodies.size() == 1)
        decision.reason = Sentence{"the only body does not spin and can touch nothing"};
    return decision;
}

} // namespace

extern const EffectRow rotationRow;
constinit const EffectRow rotationRow = {
    .name = "rotation",
    .title = "Rotation",
    .help = "Bodies turn, and impulses beside their centres set them turning.",
    .decide = decide,
};

} // namespace carom
