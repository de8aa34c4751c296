// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"

// Bodies are rigid and do not pass through each other. How they are separated is up to the method.

namespace carom {
namespace collisionEffect {
namespace {

EffectDecision decide(const Scene& scene, const RunFacts& run) {
    EffectDecision decision{.effect = "collision"};
    const Body* mobile = firstMobile(scene);
    if (mobile == nullptr) {
        decision.reason = Sentence{"no body can move"};
    } else if (scene.bodies.size() < 2) {
        decision.reason = Sentence{"there is only one body"};
    } else {
        std::size_t count = 0;
        for (const Body& body : scene.bodies) count += body.mobile() ? 1 : 0;
        decision.status = EffectStatus::On;
        decision.source = placeOf(scene, mobile->source, "");
        const std::vector<std::string> counts = {std::to_string(count), std::to_string(scene.bodies.size())};
        decision.reason = count == 1 ? Sentence{"%1 mobile body among %2 can meet the others", counts}
                                     : Sentence{"%1 mobile bodies among %2 can meet the others", counts};
    }
    if (!run.methodName.empty()) {
        decision.reason.add(Sentence{"method `%1`", {std::string(run.methodName)}});
        if (!run.methodReason.empty()) decision.reason.add(run.methodReason, ": ");
    }
    return decision;
}

} // namespace
} // namespace collisionEffect

extern const EffectRow collisionRow;
constinit const EffectRow collisionRow = {
    .name = "collision",
    .title = "Collision",
    .help = "Bodies that meet push each other apart.",
    .decide = collisionEffect::decide,
};

} // namespace carom
