// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/diagnostic.h"
#include "core/base/sentence.h"
#include "core/base/source.h"
#include "core/dynamics/abilities.h"
#include "core/dynamics/bodies.h"
#include "core/dynamics/ledger.h"
#include "core/dynamics/state.h"
#include "core/scene/scene.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// An effect is simulated if and only if its absence cannot be proved from the scene. Each effect is one file
// and its line in scene/effects.def. It brings its words (scene/schema.h) and gives the bodies what the
// methods of motion work with: coefficients of the contact law, springs, or a force on single bodies
// (dynamics/force_term.h). Effects that follow from others (rotation, resting, continuous collision) ask all
// rows and name none. Nothing outside an effect's file knows it by name.

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
    std::string_view methodName = {}; ///< a row's name
    Sentence methodReason = {};       ///< why `auto` chose it; empty where it was asked for
    double substep = 0;               ///< [s]
    std::string_view broadphase = {}; ///< a row's name
    Sentence broadphaseReason = {};   ///< why `auto` chose it; empty where it was asked for
};

/// Why an effect has a consequence, and the place that calls for it.
struct Cause {
    Reason reason;
    std::optional<SourceRange> source = {};
};

/// Potential energy that an effect keeps, and the account of the audit to which its changes belong.
struct StoredEnergy {
    double (*of)(const Scene& scene, const Bodies& bodies, const State& state) = nullptr; ///< [J]
    LedgerAccount account = {};
    /// It depends on the height of bodies: position corrections change it and record that themselves
    /// (Ledger::lifted), and its zero is arbitrary.
    bool ofHeight = false;
};

/// A coefficient of the contact law: each body declares one, and methods read it from the bodies where the
/// effect is on.
struct LawCoefficient {
    double Body::*declared = nullptr;
    std::vector<double> Bodies::*contributed = nullptr;
};

struct EffectRow {
    std::string_view name;  ///< "rolling_resistance"
    std::string_view title; ///< "Rolling resistance"
    std::string_view help;  ///< one sentence
    EffectDecision (*decide)(const Scene& scene, const RunFacts& run) = nullptr;
    /// What a warning says at each unmet place; empty for effects that have none.
    std::string_view unmetMessage = {};
    /// Why an exact method that does not simulate the effect cannot treat a scene that calls for it; empty
    /// where it can.
    std::string_view exactObjection = {};
    /// Without members: it contributes none.
    LawCoefficient law = {};
    /// Adds what else the effect does to the bodies of the scene, where it is on. Null: nothing.
    void (*contribute)(const Scene& scene, Bodies& bodies) = nullptr;
    /// Without a function: it stores none.
    StoredEnergy stored = {};
    /// The most energy that it can still give to the bodies from the start on [J]; nothing where that has no
    /// bound. Null: it gives none.
    std::optional<double> (*gives)(const Scene& scene) = nullptr;
    /// Why it can set a body turning that does not turn yet; nothing where it cannot. Null: it never does.
    std::optional<Cause> (*turns)(const Scene& scene, const RunFacts& run) = nullptr;
    /// Why it makes energy less, so that bodies can come to rest; nothing where it does not. Null: it never
    /// does.
    std::optional<Cause> (*damps)(const Scene& scene) = nullptr;
    /// Adds hints at words of the text by which the effect changes nothing.
    void (*hint)(const Scene& scene, std::vector<Diagnostic>& hints) = nullptr;
};

/// Every effect, in the order of the report.
std::span<const EffectRow> effects();
const EffectRow* findEffect(std::string_view name);

/// Adds to the bodies what the effect contributes: its coefficient of the contact law, and what else it does.
void contribute(const EffectRow& row, const Scene& scene, Bodies& bodies);

/// The first thing by which the scene makes energy less; nothing where no effect does.
std::optional<Cause> firstDamping(const Scene& scene);

/// A text that says something in vain a thousand times is told of it so often by one effect: the list of
/// problems stays one that can be read.
inline constexpr std::size_t mostHintsOfAKind = 50;
/// The hint at a word that has no effect.
Diagnostic noEffectHint(SourceRange range, std::string message);

} // namespace carom
