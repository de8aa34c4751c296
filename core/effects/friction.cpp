// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"
#include "core/scene/schema.h"

// Coulomb friction (C. A. Coulomb, Théorie des machines simples, 1785):
//
//     |f_t| ≤ μ f_n      where the surfaces slip  f_t = −μ f_n u/|u|      μ = √(μ_A μ_B)
//
//     legend   f_n, f_t  normal and tangential force [N]       u  slip velocity [m/s]
//              μ_A, μ_B  `friction` of the two bodies
//
// μ is 0 unless both bodies have some.

namespace carom {
namespace frictionEffect {
namespace {

bool isRough(const Body& body) { return body.friction > 0; }

EffectDecision decide(const Scene& scene, const RunFacts& run) {
    EffectDecision decision{.effect = "friction"};
    const MeetingPair pair = firstPairWith(scene, isRough);
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

void contribute(const Scene& scene, Bodies& bodies) {
    addRotating(bodies, [&scene](BodyIndex i) { return isRough(scene.bodies[i]); });
}

std::optional<Cause> turns(const Scene& scene, const RunFacts& run) {
    const MeetingPair rough = firstPairWith(scene, isRough);
    if (!run.method.friction || !rough) return std::nullopt;
    return Cause{Sentence{"friction can set %1 turning", {scene.nameOf(indexOf(scene, *rough.second))}},
                 placeOf(scene, rough.first->source, "friction")};
}

std::optional<Cause> damps(const Scene& scene) {
    const MeetingPair rough = firstPairWith(scene, isRough);
    if (!rough) return std::nullopt;
    return Cause{Sentence{"%1 slows down what it touches, so bodies can come to rest",
                          {scene.nameOf(indexOf(scene, *rough.first))}},
                 placeOf(scene, rough.first->source, "friction")};
}

void hint(const Scene& scene, std::vector<Diagnostic>& hints) {
    if (!anyCanMeet(scene) || firstPairWith(scene, isRough)) return;
    std::size_t count = 0;
    for (const Body& body : scene.bodies) {
        const ParameterSource* given = scene.find(body.source, "friction");
        if (!isRough(body) || given == nullptr || count == mostHintsOfAKind) continue;
        ++count;
        hints.push_back(noEffectHint(
            given->value, "`friction` has no effect: a pair has the geometric mean of its two, and no body "
                          "that " +
                              scene.nameOf(indexOf(scene, body)) +
                              " can meet has any; give the others friction too"));
    }
}

} // namespace
} // namespace frictionEffect

EffectWords frictionWords() {
    ParameterRow friction = {
        .name = "friction",
        .kind = ValueKind::Number,

        .defaultText = "0",
        .example = "0.3",
        .constraint = Constraint::NotNegative,
        .help = "Coulomb coefficient of friction; a pair has the geometric mean of its two.",
        .layer = Layer::Carom,
        .title = "friction",
        .typical = 1,
        .store = [](Declared& into,
                    const CheckedValue& value) { std::get<Body>(into).friction = value.number; },
        .read = [](const Body& body) { return body.friction; }};
    return {.ofBodies = {friction}};
}

extern const EffectRow frictionRow;
constinit const EffectRow frictionRow = {
    .name = "friction",
    .title = "Friction",
    .help = "Resists sliding by at most the coefficient times the normal force.",
    .decide = frictionEffect::decide,
    .unmetMessage = "friction is not simulated yet; bodies slide without it",
    .exactObjection = "friction would turn and slow the bodies it reaches",
    .law = {&Body::friction, &Bodies::friction},
    .contribute = frictionEffect::contribute,
    .turns = frictionEffect::turns,
    .damps = frictionEffect::damps,
    .hint = frictionEffect::hint,
};

} // namespace carom
