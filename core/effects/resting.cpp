// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"

// Bodies that have come to rest need not be simulated until something meets them. That saves time and changes
// no motion, so a scene never asks for it in words. What loses no energy never comes to rest.

namespace carom {
namespace restingEffect {
namespace {

EffectDecision decide(const Scene& scene, const RunFacts& run) {
    EffectDecision decision{.effect = "resting"};
    if (!anyCanMeet(scene)) {
        decision.reason = Sentence{"no two bodies can meet, so nothing can come to rest on anything"};
        return decision;
    }
    const std::optional<Cause> damping = firstDamping(scene);
    if (!damping) {
        decision.reason = Sentence{"every impact is elastic and nothing rubs: nothing can come to rest"};
        return decision;
    }
    decision.source = damping->source;
    decision.reason = damping->reason;
    decision.status = run.method.resting ? EffectStatus::On : EffectStatus::NotSimulatedYet;
    if (!run.method.resting) decision.reason.add(Sentence{"they are simulated at full cost"});
    return decision;
}

void contribute(const Scene&, Bodies& bodies) { bodies.canComeToRest = true; }

} // namespace
} // namespace restingEffect

extern const EffectRow restingRow;
constinit const EffectRow restingRow = {
    .name = "resting",
    .title = "Resting",
    .help = "Bodies at rest are left alone until something meets them, which saves time.",
    .decide = restingEffect::decide,
    .contribute = restingEffect::contribute,
};

} // namespace carom
