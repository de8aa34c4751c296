// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"
#include "core/scene/schema.h"

#include "core/base/figures.h"

#include <algorithm>

// Newton's law of restitution: bodies part with e times the speed they met at, along the normal (I. Newton,
// Principia, 1687, scholium to the laws of motion). e of a pair is the smaller `elastic` of the two. An
// impact of masses mA and mB loses (1 − e²) of the energy of the relative motion along the normal.

namespace carom {
namespace {

EffectDecision decide(const Scene& scene, const RunFacts&) {
    EffectDecision decision{.effect = "restitution"};
    if (!anyCanMeet(scene)) {
        decision.reason = Sentence{"no two bodies can meet"};
        return decision;
    }
    const MeetingPair pair = firstPairWith(scene, [](const Body& body) { return body.elastic > 0; });
    if (!pair) {
        decision.reason = Sentence{"in every pair that can meet, one body has `elastic 0`"};
        return decision;
    }
    decision.status = EffectStatus::On;
    decision.source = placeOf(scene, pair.second->source, "elastic");
    decision.reason =
        Sentence{"%1 and %2 part with %3 times the speed they meet at",
                 {scene.nameOf(indexOf(scene, *pair.first)), scene.nameOf(indexOf(scene, *pair.second)),
                  figure(std::min(pair.first->elastic, pair.second->elastic))}};
    return decision;
}

void contribute(const Scene& scene, Bodies& bodies) {
    std::ranges::transform(scene.bodies, bodies.elastic.begin(), &Body::elastic);
}

std::optional<double> gives(const Scene& scene) {
    const bool gains = std::ranges::any_of(scene.bodies, [](const Body& body) { return body.elastic > 1; });
    return gains ? std::nullopt : std::optional<double>(0);
}

std::optional<Cause> damps(const Scene& scene) {
    for (const Body& body : scene.bodies)
        if (body.elastic < 1)
            return Cause{Sentence{"impacts of %1 lose energy, so bodies can come to rest",
                                  {scene.nameOf(indexOf(scene, body))}},
                         placeOf(scene, body.source, "elastic")};
    return std::nullopt;
}

} // namespace

EffectWords restitutionWords() {
    ParameterRow elastic = {
        .name = "elastic",
        .kind = ValueKind::Number,

        .defaultText = "1",
        .example = "1",
        .constraint = Constraint::NotNegative,
        .help = "Coefficient of restitution; a pair has the smaller of its two.",

        .title = "elasticity",
        .typical = 1,
        .store = [](Declared& into,
                    const CheckedValue& value) { std::get<Body>(into).elastic = value.number; },
        .read = [](const Body& body) { return body.elastic; }};
    return {.ofBodies = {elastic}};
}

extern const EffectRow restitutionRow;
constinit const EffectRow restitutionRow = {
    .name = "restitution",
    .title = "Restitution",
    .help = "Bodies part with a share of the speed they met at.",
    .decide = decide,
    .contribute = contribute,
    .gives = gives,
    .damps = damps,
};

} // namespace carom
