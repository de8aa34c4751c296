// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"

// Bodies that have come to rest need not be simulated until something meets them. That saves time and changes
// no motion, so a scene never asks for it in words. This version simulates everything all the time.

namespace carom {
namespace {

EffectDecision decide(const Scene& scene, const Abilities&) {
    EffectDecision decision{.effect = "resting"};
    if (!anyCanMeet(scene)) {
        decision.reason = "no two bodies can meet, so nothing can come to rest on anything";
        return decision;
    }
    for (const Body& body : scene.bodies) {
        if (body.elastic >= 1) continue;
        decision.status = EffectStatus::NotSimulatedYet;
        decision.source = placeOf(scene, body.source, "elastic");
        decision.reason = "impacts of " + scene.nameOf(indexOf(scene, body)) +
                          " lose energy, so bodies can come to rest; they are simulated at full cost";
        return decision;
    }
    decision.reason = "every impact is elastic: nothing loses energy, and nothing can come to rest";
    return decision;
}

} // namespace

extern const EffectRow restingRow;
constinit const EffectRow restingRow = {
    .name = "resting",
    .title = "Resting",
    .help = "Bodies at rest are left alone until something meets them, which saves time.",
    .decide = decide,
};

} // namespace carom
