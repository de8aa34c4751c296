// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/pipeline.h"
#include "core/study/crowd_runs.h"
#include "core/study/error_norms.h"
#include "core/study/impacts.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>

// What a scene really does: the yardstick of the accuracy study. The best that can be had is taken: a closed
// form; else exact events; else runs of the most accurate setting with more and more substeps, whose last
// difference bounds the error of the last one.

namespace carom {

enum class ReferenceKind : std::uint8_t { ClosedForm, ExactEvents, ConvergedRun };
std::string_view nameOf(ReferenceKind kind); ///< "closed form", "exact events", "converged run"

/// Looks between two frames, besides the frame itself: errors are measured there too.
inline constexpr int looksPerFrame = 8;

struct ReferenceRequest {
    const Scene& scene;
    const RunSettings& settings;     ///< the scene's own
    double duration = 2;             ///< [s]
    int finest = 64;                 ///< substeps of the finest setting it will be compared with
    double timeLimit = 20;           ///< [s] of wall time for converging runs
    int copies = 0;                  ///< of a crowd
    std::function<bool()> goOn = {}; ///< false: stop; asked often
};

struct ReferenceSolution {
    ReferenceKind kind = ReferenceKind::ConvergedRun;
    std::string description{}; ///< "exact events", "contacts, rk4, 256 substeps"
    Trajectory trajectory{};   ///< every 1/looksPerFrame of a frame
    ImpactRecord impacts{};    ///< empty where they cannot be seen, or in a closed form, which has none
    std::optional<ExactCrowd> crowd{}; ///< of a scene of many balls that is followed far beyond the horizon
    double size = 1;                   ///< [m], what position errors are relative to
    double error = 0;                  ///< bound of its own error, as ErrorNorms::worst
    double horizon = 0;                ///< [s], to which two copies 1e-12 apart stay within 1e-9 of the size
    double growth = 0;                 ///< mean rate at which they part until then [1/s]
    bool chaotic = false;              ///< the horizon is before the end
};

/// Nothing if it was told to stop.
std::optional<ReferenceSolution> findReferenceSolution(const ReferenceRequest& request);

} // namespace carom
