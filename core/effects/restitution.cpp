// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"
#include "core/scene/schema.h"

#include "core/base/figures.h"

#include <algorithm>

// Newton's law of restitution (I. Newton, Principia, 1687, scholium to the laws of motion):
//
//     u' = −e u      e = min(e_A, e_B)      the impact loses (1 − e²) m u²/2
//
//     legend   u, u'     separation speed along the normal before and after [m/s]
//              e_A, e_B  `elastic` of the two bodies
//              m         effective mass of the pair along the normal [kg]

namespace carom {
namespace restitutionEffect {
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
                  figure(pairRestitution(pair.first->elastic, pair.second->elastic))}};
    return decision;
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
} // namespace restitutionEffect

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
    .decide = restitutionEffect::decide,
    .law = {&Body::elastic, &Bodies::elastic},
    .gives = restitutionEffect::gives,
    .damps = restitutionEffect::damps,
};

} // namespace carom
