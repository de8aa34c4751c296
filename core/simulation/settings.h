// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/diagnostic.h"
#include "core/base/sentence.h"
#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"
#include "core/scene/scene.h"
#include "core/solvers/solver.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

struct BroadphaseRow;
struct IntegratorRow;

struct PresetRow;

/// Every setting of a run, with nothing left open.
struct RunSettings {
    double step = 1.0 / 60; ///< one frame [s]
    int substeps = 1;
    const SolverRow* method = nullptr;
    Sentence methodReason; ///< why `auto` chose it; empty where it was asked for
    const IntegratorRow* integrator = nullptr;
    const BroadphaseRow* broadphase = nullptr;
    Sentence broadphaseReason; ///< why `auto` chose it; empty where it was asked for
    BoxKind boxes = BoxKind::Tight;
    int iterations = 0;      ///< 0: the method does not iterate
    double tolerance = 0;    ///< 0: the method does not iterate
    double effort = 1;       ///< times the work that the method may spend on refinement
    double reserve = 1;      ///< times what it may save of that for frames that need more
    int crowdedSubsteps = 1; ///< of a frame that an exact method leaves to the general one
    bool simultaneousImpacts = false;
    int threads = 1;
    std::optional<double> duration; ///< [s]
    const PresetRow* preset = nullptr;

    double substep() const { return step / substeps; } ///< [s]
    /// `resting`: whether anything in the scene can come to rest.
    SolverSettings solver(bool resting) const {
        return {.tolerance = tolerance,
                .iterations = iterations,
                .simultaneous = simultaneousImpacts,
                .resting = resting,
                .effort = effort,
                .reserve = reserve,
                .substeps = crowdedSubsteps,
                .bounded = !methodReason.empty()};
    }
};

/// Frames of `step` [s] that end at a time or behind it. A time written as so many frames gains none by
/// rounding.
std::int64_t framesUntil(double time, double step);
/// Frames of a run where nothing else says: of the duration, else ten seconds at the default step, 600.
std::int64_t framesOf(const RunSettings& settings);

/// A word of `preset`; what it sets is said by the method (SolverRow::presets).
struct PresetRow {
    std::string_view name;
    std::string_view help;
};
std::span<const PresetRow> presets();

/// Settles what the scene and the options (which win) say, then the preset. What this version does not have
/// is replaced by what it has, with a warning at the value that asks for it.
RunSettings settledSettings(const Scene& scene, const SimulationSettings& options,
                            std::vector<Diagnostic>& warnings);

/// Fills in the broad-phase: the one asked for, or the best for the bodies as they start.
void settleBroadphase(const Scene& scene, const SimulationSettings& options, const Bodies& bodies,
                      RunSettings& settings, std::vector<Diagnostic>& warnings);

} // namespace carom
