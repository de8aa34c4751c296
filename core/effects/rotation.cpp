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
        decision.reason = "no body can move";
        return decision;
    }
    for (const Body& body : scene.bodies) {
        if (!canRotate(scene, body)) continue;
        const std::string name = scene.nameOf(indexOf(scene, body));
        decision.status = EffectStatus::On;
        decision.source = placeOf(scene, body.source, "angvel");
        decision.reason = body.angularVelocity != Vec3::Zero()
                              ? name + " spins from the start"
                              : name + " is not a sphere and can be hit beside its centre";
        return decision;
    }
    const MeetingPair rough = firstPairWith(scene, [](const Body& body) { return body.friction > 0; });
    if (run.method.friction && rough) {
        decision.status = EffectStatus::On;
        decision.source = placeOf(scene, rough.first->source, "friction");
        decision.reason = "friction can set " + scene.nameOf(indexOf(scene, *rough.second)) + " turning";
        return decision;
    }
    if (run.method.rollingResistance && anyCanMeet(scene)) {
        for (const Body& body : scene.bodies) {
            if (!(body.rolling > 0)) continue;
            decision.status = EffectStatus::On;
            decision.source = placeOf(scene, body.source, "rolling");
            decision.reason = "what rolls over " + scene.nameOf(indexOf(scene, body)) + " is held back";
            return decision;
        }
    }
    if (run.method.springs) {
        if (const Spring* spring = firstOffCentre(scene)) {
            decision.status = EffectStatus::On;
            decision.source = placeOf(scene, spring->source, "");
            decision.reason = "a spring between " + scene.nameOf(spring->from) + " and " +
                              scene.nameOf(spring->to) + " pulls beside a centre";
            return decision;
        }
    }
    decision.reason =
        "no body spins at the start, and impulses without friction pass through a sphere's centre";
    if (scene.bodies.size() == 1) decision.reason = "the only body does not spin and can touch nothing";
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
