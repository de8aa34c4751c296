// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"

// Bodies that have come to rest need not be simulated until something meets them. That saves time and changes
// no motion, so a scene never asks for it in words. What loses no energy never comes to rest.

namespace carom {
namespace {

/// What makes energy less: the first that the scene declares, and in what words.
struct Loser {
    const DeclarationSource* source = nullptr;
    std::string_view parameter;
    Sentence reason;
};

Loser firstLoser(const Scene& scene) {
    for (const Body& body : scene.bodies)
        if (body.elastic < 1)
            return {&body.source, "elastic",
                    Sentence{"impacts of %1 lose energy, so bodies can come to rest",
                             {scene.nameOf(indexOf(scene, body))}}};
    const auto byPair = [&](bool (*has)(const Body&), std::string_view parameter) -> Loser {
        const MeetingPair pair = firstPairWith(scene, has);
        if (!pair) return {};
        return {&pair.first->source, parameter,
                Sentence{"%1 slows down what it touches, so bodies can come to rest",
                         {scene.nameOf(indexOf(scene, *pair.first))}}};
    };
    const Loser rubs = byPair([](const Body& body) { return body.friction > 0; }, "friction");
    if (rubs.source != nullptr) return rubs;
    for (const Body& body : scene.bodies)
        if (body.rolling > 0)
            return {&body.source, "rolling",
                    Sentence{"%1 slows down what rolls on it, so bodies can come to rest",
                             {scene.nameOf(indexOf(scene, body))}}};
    for (const Spring& spring : scene.springs)
        if (spring.damping > 0)
            return {&spring.source, "damping", Sentence{"a spring is damped, so bodies can come to rest"}};
    return {};
}

EffectDecision decide(const Scene& scene, const RunFacts& run) {
    EffectDecision decision{.effect = "resting"};
    if (!anyCanMeet(scene)) {
        decision.reason = Sentence{"no two bodies can meet, so nothing can come to rest on anything"};
        return decision;
    }
    const Loser loser = firstLoser(scene);
    if (loser.source == nullptr) {
        decision.reason = Sentence{"every impact is elastic and nothing rubs: nothing can come to rest"};
        return decision;
    }
    decision.source = placeOf(scene, *loser.source, loser.parameter);
    decision.reason = loser.reason;
    decision.status = run.method.resting ? EffectStatus::On : EffectStatus::NotSimulatedYet;
    if (!run.method.resting) decision.reason.add(Sentence{"they are simulated at full cost"});
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
