// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"
#include "core/scene/schema.h"

#include "core/dynamics/spring_force.h"
#include "core/dynamics/state.h"

#include <cstdint>
#include <utility>
#include <vector>

// Springs with dampers between two points of bodies (dynamics/spring_force.h):
//
//     f = −(k (l − l₀) + c l') d  on `to`, −f on `from`      energy  k (l − l₀)²/2
//
//     legend   d  unit vector from the first point to the second      k  `stiffness` [N/m]
//              l  their distance [m], l' its rate [m/s]               c  `damping` [N s/m]
//              l₀ `length` at rest [m]

namespace carom {
namespace springEffect {
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

Spring& spring(Declared& declared) { return std::get<Spring>(declared); }

/// Whether the spring pulls a body beside its centre at that end.
bool pullsAside(const Scene& scene, BodyIndex body, const Vec3& at) {
    return movable(scene, body) && at != Vec3::Zero();
}

void contribute(const Scene& scene, Bodies& bodies) {
    bodies.springs = springsOf(scene);
    std::vector<std::uint8_t> aside(bodies.count(), 0);
    for (const Spring& spring : scene.springs) {
        if (pullsAside(scene, spring.from, spring.fromAt)) aside[spring.from] = 1;
        if (pullsAside(scene, spring.to, spring.toAt)) aside[spring.to] = 1;
    }
    addRotating(bodies, [&aside](BodyIndex i) { return aside[i] != 0; });
}

double stored(const Scene&, const Bodies& bodies, const State& state) {
    return springEnergy(bodies.springs, state);
}

std::optional<double> gives(const Scene& scene) {
    return scene.springs.empty() ? 0 : springEnergy(springsOf(scene), initialStateOf(scene));
}

std::optional<Cause> turns(const Scene& scene, const RunFacts& run) {
    if (!run.method.springs) return std::nullopt;
    for (const Spring& spring : scene.springs)
        if (pullsAside(scene, spring.from, spring.fromAt) || pullsAside(scene, spring.to, spring.toAt))
            return Cause{Sentence{"a spring between %1 and %2 pulls beside a centre",
                                  {scene.nameOf(spring.from), scene.nameOf(spring.to)}},
                         placeOf(scene, spring.source, "")};
    return std::nullopt;
}

std::optional<Cause> damps(const Scene& scene) {
    for (const Spring& spring : scene.springs)
        if (spring.damping > 0)
            return Cause{Sentence{"a spring is damped, so bodies can come to rest"},
                         placeOf(scene, spring.source, "damping")};
    return std::nullopt;
}

void hint(const Scene& scene, std::vector<Diagnostic>& hints) {
    std::size_t count = 0;
    for (const Spring& spring : scene.springs) {
        if (movable(scene, spring.from) || movable(scene, spring.to) || count == mostHintsOfAKind) continue;
        ++count;
        hints.push_back(noEffectHint(spring.source.type,
                                     "this spring has no effect: neither of its ends can move; tie it to a "
                                     "body that is not fixed"));
    }
}

} // namespace
} // namespace springEffect

EffectWords springWords() {
    using namespace springEffect;
    std::vector<ParameterRow> rows = {
        {.name = "from",
         .kind = ValueKind::Label,
         .required = true,
         .example = "world",
         .help = "Label of the body at its first end, or `world`.",
         .store = [](Declared& into, const CheckedValue& value) { spring(into).from = value.body; }},
        {.name = "to",
         .kind = ValueKind::Label,
         .required = true,
         .example = "world",
         .help = "Label of the body at its second end, or `world`.",
         .store = [](Declared& into, const CheckedValue& value) { spring(into).to = value.body; }},
        {.name = "stiffness",
         .kind = ValueKind::Number,
         .unit = "N/m",
         .required = true,
         .example = "100",
         .constraint = Constraint::Positive,
         .help = "Force per length of stretch.",
         .store = [](Declared& into, const CheckedValue& value) { spring(into).stiffness = value.number; }},
        {.name = "damping",
         .kind = ValueKind::Number,
         .unit = "N·s/m",
         .defaultText = "0",
         .example = "1",
         .constraint = Constraint::NotNegative,
         .help = "Force per speed of stretching.",
         .store = [](Declared& into, const CheckedValue& value) { spring(into).damping = value.number; }},
        {.name = "length",
         .kind = ValueKind::Number,
         .unit = "m",
         .defaultText = "the distance between its ends at the start",
         .example = "1",
         .constraint = Constraint::NotNegative,
         .help = "Length at which it neither pulls nor pushes.",
         .store = [](Declared& into, const CheckedValue& value) { spring(into).length = value.number; }},
        {.name = "fromAt",
         .kind = ValueKind::Vector,
         .unit = "m",
         .defaultText = "0, 0, 0",
         .example = "0, 0, 0",
         .help = "Where the first end is attached, in the body's own frame, or in the world's for `world`.",
         .store = [](Declared& into, const CheckedValue& value) { spring(into).fromAt = value.vector; }},
        {.name = "toAt",
         .kind = ValueKind::Vector,
         .unit = "m",
         .defaultText = "0, 0, 0",
         .example = "0, 0, 0",
         .help = "Where the second end is attached, in the body's own frame, or in the world's for `world`.",
         .store = [](Declared& into, const CheckedValue& value) { spring(into).toAt = value.vector; }}};
    for (ParameterRow& row : rows) row.layer = Layer::Carom;
    DeclarationRow declared = {
        .name = "spring",
        .help = "A straight spring with a damper between two bodies, or a body and the world.",
        .layer = Layer::Carom,
        .parameters = std::move(rows),
        .begin = []() -> Declared { return Spring{}; },
        .example = "sphere bob { radius 0.1  mass 1  centre 0, 1, 0 }\n"
                   "spring { from world  to bob  fromAt 0, 2, 0  stiffness 100 }"};
    return {.declarations = {std::move(declared)}};
}

extern const EffectRow springRow;
constinit const EffectRow springRow = {
    .name = "spring",
    .title = "Springs",
    .help = "Pull and damp along the line between two points of bodies.",
    .decide = springEffect::decide,
    .unmetMessage = "springs are not simulated yet; this one exerts no force",
    .exactObjection = "springs bend the path of a body between events",
    .contribute = springEffect::contribute,
    .stored = {springEffect::stored, LedgerAccount::Spring},
    .gives = springEffect::gives,
    .turns = springEffect::turns,
    .damps = springEffect::damps,
    .hint = springEffect::hint,
};

} // namespace carom
