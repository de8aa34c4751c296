// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"

#include "core/dynamics/spring_force.h"
#include "core/dynamics/state.h"

#include <cstdint>
#include <vector>

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

extern const EffectRow springRow;
constinit const EffectRow springRow = {
    .name = "spring",
    .title = "Springs",
    .help = "Pull and damp along the line between two points of bodies.",
    .decide = decide,
    .unmetMessage = "springs are not simulated yet; this one exerts no force",
    .exactObjection = "springs bend the path of a body between events",
    .contribute = contribute,
    .stored = {stored, LedgerAccount::Spring},
    .gives = gives,
    .turns = turns,
    .damps = damps,
    .hint = hint,
};

} // namespace carom
