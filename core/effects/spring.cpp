// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"

// Springs with dampers: a force k (length − rest) + c · rate along the line between two points of bodies.

namespace carom {
namespace {

bool movable(const Scene& scene, BodyIndex body) { return body != noBody && scene.bodies[body].mobile(); }

EffectDecision decide(const Scene& scene, const RunFacts& run) {
    EffectDecision decision{.effect = "spring"};
    for (const Spring& spring : scene.springs) {
        if (!movable(scene, spring.from) && !movable(scene, spring.to)) continue;
        if (!run.method.springs)
            decision.unmet.push_back(placeOf(scene, spring.source, "").value_or(SourceRange{}));
        if (decision.status != EffectStatus::Absent) continue;
        decision.status = run.method.springs ? EffectStatus::On : EffectStatus::NotSimulatedYet;
        decision.source = placeOf(scene, spring.source, "");
        decision.reason =
            Sentence{"a spring joins %1 and %2", {scene.nameOf(spring.from), scene.nameOf(spring.to)}};
        if (!run.method.springs) decision.reason.add(Sentence{"it exerts no force"});
    }
    if (decision.status == EffectStatus::Absent)
        decision.reason = scene.springs.empty() ? Sentence{"none is declared"}
                                                : Sentence{"no spring has an end that can move"};
    return decision;
}

void contribute(const Scene& scene, Bodies& bodies) { bodies.springs = springsOf(scene); }

} // namespace

extern const EffectRow springRow;
constinit const EffectRow springRow = {
    .name = "spring",
    .title = "Springs",
    .help = "Pull and damp along the line between two points of bodies.",
    .decide = decide,
    .unmetMessage = "springs are not simulated yet; this one exerts no force",
    .contribute = contribute,
    .exactObjection = "springs bend the path of a body between events",
};

} // namespace carom
