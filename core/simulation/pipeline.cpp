// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/pipeline.h"

#include "core/simulation/foresight.h"

#include <algorithm>

namespace carom {
namespace {

/// Warnings one effect gives at most; the last one says how many more there are.
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

} // namespace

Pipeline::Pipeline(const Scene& scene, const SimulationSettings& options)
    : m_scene(scene), m_settings(settledSettings(scene, options, m_warnings)), m_bodies(bodiesOf(scene)),
      m_initialState(initialStateOf(scene)) {
    m_bodies.boxes = m_settings.boxes;
    settleBroadphase(m_scene, options, m_bodies, m_settings, m_warnings);
    for (const EffectRow& row : carom::effects()) {
        m_effects.push_back(row.decide(m_scene, m_settings.method->abilities));
        warnOfUnmet(row, m_effects.back(), m_warnings);
    }
    for (Diagnostic& warning : foreseen(m_scene, m_settings)) m_warnings.push_back(std::move(warning));
    std::stable_sort(m_warnings.begin(), m_warnings.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return a.range.offset < b.range.offset;
    });
}

bool Pipeline::simulates(std::string_view effect) const {
    return std::any_of(m_effects.begin(), m_effects.end(), [&](const EffectDecision& decision) {
        return decision.effect == effect && decision.status == EffectStatus::On;
    });
}

Vec3 Pipeline::gravity() const { return simulates("gravity") ? m_scene.gravity.acceleration : Vec3::Zero(); }

} // namespace carom
