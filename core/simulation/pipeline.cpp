// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/pipeline.h"

#include "core/simulation/pre_run_checks.h"
#include "core/simulation/without_effect.h"

#include "core/integrators/integrator.h"

#include <algorithm>

namespace carom {
namespace {

/// Warnings one effect gives at most; the last one says how many more there are. At half, places of others
/// remain unnamed; at twice, the list of problems is twice as long.
constexpr std::size_t mostWarnings = 50;

void warnOfUnmet(const EffectRow& row, const EffectDecision& decision, std::vector<Diagnostic>& warnings) {
    const std::size_t count = std::min(decision.unmet.size(), mostWarnings);
    for (std::size_t k = 0; k < count; ++k) {
        std::string message(row.unmetMessage);
        if (k + 1 == count && decision.unmet.size() > count)
            message += " (and so in " + std::to_string(decision.unmet.size() - count) + " more places)";
        warnings.push_back({.code = DiagnosticCode::NotSimulatedYet,
                            .range = decision.unmet[k],
                            .message = std::move(message),
                            .notes = {},
                            .fixIt = {}});
    }
}

// Warnings and declarations both ascend, so one pass over the bodies finds all.
std::vector<BodyIndex> bodiesIn(const Scene& scene, const std::vector<Diagnostic>& warnings) {
    std::vector<BodyIndex> found;
    std::size_t next = 0;
    for (BodyIndex i = 0; i < scene.bodies.size(); ++i) {
        const SourceRange declaration = scene.bodies[i].source.declaration;
        while (next < warnings.size() && warnings[next].range.offset < declaration.offset) ++next;
        for (std::size_t k = next; k < warnings.size() && declaration.contains(warnings[k].range.offset);
             ++k) {
            if (warnings[k].severity() == Severity::Hint || warnings[k].range.length == 0) continue;
            found.push_back(i);
            break;
        }
    }
    return found;
}

void turnNone(std::span<const BodyIndex>, double, State&) {}
void rotateNone(const Bodies&, std::span<const BodyIndex>, double, State&) {}

SmoothMotion motionFor(const Bodies& bodies, SmoothMotion motion) {
    if (!bodies.rotating.empty()) return motion;
    motion.turn = turnNone;
    motion.rotateFreely = rotateNone;
    motion.isExactInFreeRotation = true;
    return motion;
}

} // namespace

Pipeline::Pipeline(const Scene& scene, const SimulationSettings& options, const WorkStage& stage)
    : m_scene(scene), m_settings(settledSettings(scene, options, m_warnings)) {
    // Part of the work that is done after each stage, as it is for 200,000 spheres in a gas. Other values
    // change only how evenly the progress that is shown runs.
    constexpr double copied = 0.1, numbered = 0.35, started = 0.4, settled = 0.55, decided = 0.6;
    stage.reach(copied);
    m_bodies = bareBodiesOf(scene);
    m_bodies.boxes = m_settings.boxes;
    stage.reach(numbered);
    m_initialState = initialStateOf(scene);
    stage.reach(started);
    settleBroadphase(m_scene, options, m_bodies, m_settings, m_warnings);
    stage.reach(settled);
    const RunFacts run{.method = m_settings.method->abilities,
                       .methodName = m_settings.method->name,
                       .methodReason = m_settings.methodReason,
                       .substep = m_settings.substep(),
                       .broadphase = m_settings.broadphase->name,
                       .broadphaseReason = m_settings.broadphaseReason};
    for (const EffectRow& row : carom::effects()) {
        m_effects.push_back(row.decide(m_scene, run));
        warnOfUnmet(row, m_effects.back(), m_warnings);
        if (m_effects.back().status != EffectStatus::On) continue;
        contribute(row, m_scene, m_bodies);
        if (row.stored.of != nullptr) m_stored.push_back(row.stored);
    }
    m_motion = motionFor(m_bodies, m_settings.integrator->motion);
    for (Diagnostic& warning : preRunWarnings(m_scene, m_settings, m_bodies, stage.part(decided, 1)))
        m_warnings.push_back(std::move(warning));
    for (Diagnostic& hint : withoutEffect(m_scene)) m_warnings.push_back(std::move(hint));
    std::stable_sort(m_warnings.begin(), m_warnings.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return a.range.offset < b.range.offset;
    });
    m_warnedBodies = bodiesIn(m_scene, m_warnings);
}

bool Pipeline::simulates(std::string_view effect) const {
    return std::any_of(m_effects.begin(), m_effects.end(), [&](const EffectDecision& decision) {
        return decision.effect == effect && decision.status == EffectStatus::On;
    });
}

} // namespace carom
