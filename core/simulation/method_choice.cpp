// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/method_choice.h"

#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"

#include <optional>
#include <utility>

namespace carom {
namespace {

std::optional<Sentence> objectionToExact(const Scene& scene, const SolverRow& method, bool simultaneous) {
    if (firstMobile(scene) == nullptr) return Sentence{"no body can move"};
    if (simultaneous) return Sentence{"impacts at one moment are to act as one"};
    if (const std::optional<SolverObjection> objection = objectionTo(method, scene)) return objection->reason;
    return std::nullopt;
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
