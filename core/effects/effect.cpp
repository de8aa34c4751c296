// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"

#include "core/base/catalogue.h"

#include <algorithm>
#include <array>
#include <utility>

namespace carom {

#define CAROM_EFFECT(row, words, account) extern const EffectRow row;
#include "core/scene/effects.def"
#undef CAROM_EFFECT

std::span<const EffectRow> effects() {
    static const std::array rows = {
#define CAROM_EFFECT(row, words, account) row,
#include "core/scene/effects.def"
#undef CAROM_EFFECT
    };
    return rows;
}

const EffectRow* findEffect(std::string_view name) { return findByName(effects(), name); }

void contribute(const EffectRow& row, const Scene& scene, Bodies& bodies) {
    const LawCoefficient& law = row.law;
    if (law.contributed != nullptr)
        std::ranges::transform(scene.bodies, (bodies.*law.contributed).begin(), law.declared);
    if (row.contribute != nullptr) row.contribute(scene, bodies);
}

std::optional<Cause> firstDamping(const Scene& scene) {
    for (const EffectRow& row : effects()) {
        if (row.damps == nullptr) continue;
        if (std::optional<Cause> cause = row.damps(scene)) return cause;
    }
    return std::nullopt;
}

Diagnostic noEffectHint(SourceRange range, std::string message) {
    return {.code = DiagnosticCode::WithoutEffect,
            .range = range,
            .message = std::move(message),
            .notes = {},
            .fixIt = {}};
}

std::string_view nameOf(EffectStatus status) {
    switch (status) {
    case EffectStatus::On:
        return "on";
    case EffectStatus::Absent:
        return "absent";
    case EffectStatus::NotSimulatedYet:
        return "not simulated yet";
    }
    return "on";
}

} // namespace carom
