// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"

// Which pairs are near enough to be compared is found out by boxes, not by comparing all: that saves time and
// changes no motion (core/broadphase).

namespace carom {
namespace broadphaseEffect {
namespace {

EffectDecision decide(const Scene& scene, const RunFacts& run) {
    EffectDecision decision{.effect = "broadphase"};
    if (scene.simulation.source && scene.find(*scene.simulation.source, "broadphase") != nullptr)
        decision.source = placeOf(scene, *scene.simulation.source, "broadphase");
    if (!anyCanMeet(scene)) {
        decision.reason = Sentence{"no two bodies can meet"};
    } else if (run.method.ownPairs) {
        decision.reason = Sentence{"the method finds by itself which bodies meet next"};
    } else if (run.broadphase.empty() || run.broadphase == "all_pairs") {
        decision.reason = run.broadphaseReason.empty() ? Sentence{"all pairs are compared, as asked for"}
                                                       : run.broadphaseReason;
    } else {
        decision.status = EffectStatus::On;
        decision.reason = run.broadphaseReason.empty()
                              ? Sentence{"%1: it is asked for", {std::string(run.broadphase)}}
                              : run.broadphaseReason;
    }
    return decision;
}

} // namespace
} // namespace broadphaseEffect

extern const EffectRow broadphaseRow;
constinit const EffectRow broadphaseRow = {
    .name = "broadphase",
    .title = "Broad-phase",
    .help = "Only pairs whose boxes overlap are compared, which saves time.",
    .decide = broadphaseEffect::decide,
};

} // namespace carom
