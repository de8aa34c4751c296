// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"

// Coulomb friction: a tangential impulse of at most μ times the normal one, against the slip. μ of a pair is
// the geometric mean of its two, so it is 0 unless both have some.

namespace carom {
namespace {

EffectDecision decide(const Scene& scene, const RunFacts& run) {
    EffectDecision decision{.effect = "friction"};
    const MeetingPair pair = firstPairWith(scene, [](const Body& body) { return body.friction > 0; });
    if (!pair) {
        decision.reason =
            Sentence{"the geometric mean of the coefficients is 0 for every pair that can meet"};
        return decision;
    }
    decision.source = placeOf(scene, pair.first->source, "friction");
    decision.reason =
        Sentence{"%1 and %2 have friction",
                 {scene.nameOf(indexOf(scene, *pair.first)), scene.nameOf(indexOf(scene, *pair.second))}};
    if (run.method.friction) {
        decision.status = EffectStatus::On;
        return decision;
    }
    decision.status = EffectStatus::NotSimulatedYet;
    decision.reason.add(Sentence{"they slide without it"});
    for (const Body& body : scene.bodies)
        if (body.friction > 0)
            decision.unmet.push_back(placeOf(scene, body.source, "friction").value_or(SourceRange{}));
    return decision;
}

} // namespace

extern const EffectRow frictionRow;
constinit const EffectRow frictionRow = {
    .name = "friction",
    .title = "Friction",
    .help = "Resists sliding by at most the coefficient times the normal force.",
    .decide = decide,
    .unmetMessage = "friction is not simulated yet; bodies slide without it",
    .exactObjection = "friction would turn and slow the bodies it reaches",
};

} // namespace carom
