// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/method_choice.h"

#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace carom {
namespace {

// Without gravity nothing is drawn back to what it has bounced off, so what cannot move may take energy. A
// pair has the smaller coefficient of its two.
std::optional<Sentence> loss(const Scene& scene) {
    if (!anyCanMeet(scene)) return std::nullopt;
    const bool falls = scene.gravity.acceleration != Vec3::Zero();
    const auto lossy = std::find_if(scene.bodies.begin(), scene.bodies.end(), [&](const Body& body) {
        return body.mobile() ? body.elastic != 1 : falls && body.elastic < 1;
    });
    if (lossy == scene.bodies.end()) return std::nullopt;
    return Sentence{"impacts on %1 lose energy", {scene.nameOf(indexOf(scene, *lossy))}};
}

std::optional<Sentence> objectionToExact(const Scene& scene, const SolverRow& method, bool simultaneous) {
    if (firstMobile(scene) == nullptr) return Sentence{"no body can move"};
    if (simultaneous) return Sentence{"impacts at one moment are to act as one"};
    if (const std::optional<SolverObjection> objection = objectionTo(method, scene)) return objection->reason;
    return loss(scene);
}

} // namespace

std::optional<SolverObjection> objectionTo(const SolverRow& method, const Scene& scene) {
    if (method.objection != nullptr)
        if (std::optional<SolverObjection> objection = method.objection(scene)) return objection;
    if (!method.isExact) return std::nullopt;
    for (const EffectRow& row : effects()) {
        if (row.exactObjection.empty()) continue;
        const EffectDecision decision = row.decide(scene, {.method = method.abilities});
        if (decision.status == EffectStatus::NotSimulatedYet)
            return SolverObjection{Sentence{row.exactObjection}, decision.source.value_or(SourceRange{})};
    }
    return std::nullopt;
}

MethodChoice chooseMethod(const Scene& scene, bool simultaneous) {
    MethodChoice choice{&generalSolver(), {}};
    for (const SolverRow& row : solvers()) {
        if (!row.isExact) continue;
        std::optional<Sentence> objection = objectionToExact(scene, row, simultaneous);
        if (!objection) return {&row, Sentence{row.choice}};
        choice.reason = *std::move(objection);
    }
    return choice;
}

} // namespace carom
