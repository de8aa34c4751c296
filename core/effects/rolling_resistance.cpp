// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"
#include "core/scene/schema.h"

#include <algorithm>

// Rolling resistance, Coulomb's law for rolling (C. A. Coulomb, Théorie des machines simples, 1785):
//
//     |τ| ≤ b f_n      where the bodies roll  τ = −b f_n ω/|ω|      b = max(b_A, b_B)
//
//     legend   τ    moment across the normal [N m]        ω  relative angular velocity across it [rad/s]
//              f_n  normal force [N]                      b_A, b_B  `rolling` of the two bodies [m]
//
// One body with a lever arm slows all that roll over it.

namespace carom {
namespace rollingResistanceEffect {
namespace {

EffectDecision decide(const Scene& scene, const RunFacts& run) {
    EffectDecision decision{.effect = "rolling_resistance"};
    if (anyCanMeet(scene)) {
        for (const Body& body : scene.bodies)
            if (body.rolling > 0)
                decision.unmet.push_back(placeOf(scene, body.source, "rolling").value_or(SourceRange{}));
    }
    if (decision.unmet.empty()) {
        decision.reason = Sentence{"the lever arm is 0 for every pair that can meet"};
        return decision;
    }
    for (const Body& body : scene.bodies) {
        if (body.rolling <= 0) continue;
        decision.source = placeOf(scene, body.source, "rolling");
        decision.reason = Sentence{"%1 has rolling resistance", {scene.nameOf(indexOf(scene, body))}};
        if (run.method.rollingResistance) {
            decision.status = EffectStatus::On;
            decision.unmet.clear();
        } else {
            decision.status = EffectStatus::NotSimulatedYet;
            decision.reason.add(Sentence{"it rolls without it"});
        }
        break;
    }
    return decision;
}

const Body* firstResisting(const Scene& scene) {
    const auto found = std::ranges::find_if(scene.bodies, [](const Body& body) { return body.rolling > 0; });
    return found != scene.bodies.end() ? &*found : nullptr;
}

void contribute(const Scene&, Bodies& bodies) {
    addRotating(bodies, [](BodyIndex) { return true; });
}

std::optional<Cause> turns(const Scene& scene, const RunFacts& run) {
    const Body* resisting = firstResisting(scene);
    if (!run.method.rollingResistance || !anyCanMeet(scene) || resisting == nullptr) return std::nullopt;
    return Cause{Sentence{"what rolls over %1 is held back", {scene.nameOf(indexOf(scene, *resisting))}},
                 placeOf(scene, resisting->source, "rolling")};
}

std::optional<Cause> damps(const Scene& scene) {
    const Body* resisting = firstResisting(scene);
    if (resisting == nullptr) return std::nullopt;
    return Cause{Sentence{"%1 slows down what rolls on it, so bodies can come to rest",
                          {scene.nameOf(indexOf(scene, *resisting))}},
                 placeOf(scene, resisting->source, "rolling")};
}

} // namespace
} // namespace rollingResistanceEffect

EffectWords rollingResistanceWords() {
    ParameterRow rolling = {
        .name = "rolling",
        .kind = ValueKind::Number,
        .unit = "m",
        .defaultText = "0",
        .example = "0.001",
        .constraint = Constraint::NotNegative,
        .help = "Rolling resistance, a lever arm; a pair has the larger of its two.",
        .layer = Layer::Carom,
        .title = "rolling resistance",
        .typical = 0.01,
        .store = [](Declared& into,
                    const CheckedValue& value) { std::get<Body>(into).rolling = value.number; },
        .read = [](const Body& body) { return body.rolling; }};
    return {.ofBodies = {rolling}};
}

extern const EffectRow rollingResistanceRow;
constinit const EffectRow rollingResistanceRow = {
    .name = "rolling_resistance",
    .title = "Rolling resistance",
    .help = "Resists rolling by a moment of at most the lever arm times the normal force.",
    .decide = rollingResistanceEffect::decide,
    .unmetMessage = "rolling resistance is not simulated yet; bodies roll on without it",
    .exactObjection = "rolling resistance acts between events",
    .law = {&Body::rolling, &Bodies::rolling},
    .contribute = rollingResistanceEffect::contribute,
    .turns = rollingResistanceEffect::turns,
    .damps = rollingResistanceEffect::damps,
};

} // namespace carom
