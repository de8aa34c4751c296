// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/sentence.h"
#include "core/base/source.h"
#include "core/dynamics/abilities.h"
#include "core/dynamics/bodies.h"
#include "core/scene/scene.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// An effect is simulated if and only if its absence cannot be proved from the scene. Each effect is one file
// and its line in effects.def. A force on single bodies is a term (dynamics/force_term.h) that its effect
// contributes, and every method of motion takes it into account.

namespace carom {

enum class EffectStatus : std::uint8_t {
    On,              ///< simulated
    Absent,          ///< proved absent: it costs nothing
    NotSimulatedYet, ///< the scene calls for it, this version does not have it
};

/// "on", "absent", "not simulated yet".
std::string_view nameOf(EffectStatus status);

/// The compiler's decision on one effect.
struct EffectDecision {
    std::string_view effect; ///< a row's name
    EffectStatus status = EffectStatus::Absent;
    Reason reason = {};                     ///< why it is simulated, or why it cannot matter
    std::optional<SourceRange> source = {}; ///< what in the text calls for it, or rules it out
    /// Places that ask in so many words for what is not simulated yet (`friction 0.3`), source among them:
    /// each deserves a warning. Empty where the scene only implies it.
    std::vector<SourceRange> unmet = {};
};

/// What a decision goes by besides the scene: how the scene is run.
struct RunFacts {
    Abilities method = {};            ///< what the method of motion simulates
    double substep = 0;               ///< [s]
    std::string_view broadphase = {}; ///< a row's name
    Sentence broadphaseReason = {};   ///< why `auto` chose it; empty where it was asked for
};

struct EffectRow {
    std::string_view name;  ///< "rolling_resistance"
    std::string_view title; ///< "Rolling resistance"
    std::string_view help;  ///< one sentence
    EffectDecision (*decide)(const Scene& scene, const RunFacts& run) = nullptr;
    /// What a warning says at each unmet place; empty for effects that have none.
    std::string_view unmetMessage = {};
    /// Adds what the effect does to the bodies of the scene, where it is on. Null: methods of motion read it
    /// from the bodies' own constants.
    void (*contribute)(const Scene& scene, Bodies& bodies) = nullptr;
    /// Why an exact method that does not simulate the effect cannot treat a scene that calls for it; empty
    /// where it can.
    std::string_view exactObjection = {};
};

/// Every effect, in the order of the report.
std::span<const EffectRow> effects();
const EffectRow* findEffect(std::string_view name);

} // namespace carom
