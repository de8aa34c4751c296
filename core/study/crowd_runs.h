// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/crowd.h"

#include "core/scene/scene.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace carom {

/// Copies of a crowd start so far apart, relative to the scene's size; after some collisions they are as
/// different as random scenes with different seeds. At a thousandth they need half as many collisions again
/// (the distance grows exponentially); at a thousand times, bodies that touch would overlap visibly at the
/// start.
inline constexpr double crowdNudge = 1e-6;

/// A copy of the scene with each mobile body moved by `distance` [m], in a direction of its own.
Scene nudged(const Scene& scene, double distance, std::uint64_t seed = 1);

/// How copies of a scene are run.
struct CrowdRun {
    const Scene& scene;
    std::int64_t frames = 0;
    std::int64_t first = 0; ///< frame from which the copies have nothing in common
    double step = 0;        ///< a frame [s]
    double nudge = 0;       ///< [m]
    std::function<bool()> goOn{};
    double fastest = 0;                 ///< [m/s], of CrowdWatch
    std::function<bool()> hasTime = {}; ///< for another copy; null: always
};

/// The frame at which copies crowdNudge apart have diverged altogether, if they do so at `growth` [1/s].
std::int64_t framesToForget(double growth, double step);

/// Runs copy number `copy`; the scene itself is number 0. Nothing if it was stopped, or if its state was
/// lost.
std::optional<CrowdWatch::Sums> runCopy(const CrowdRun& run, int copy, SimulationSettings options);

/// The results of exact copies together.
struct ExactCrowd {
    CrowdWatch::Sums sums;
    CrowdFigures scatter{}; ///< of each copy about all others: the measure of chance
    std::int64_t first = 0;
    double fastest = 0;
};

/// Runs up to `copies` copies, as many as there is time for. Nothing with fewer than fifty balls, if the run
/// is too short, without time for two, or if it was stopped.
std::optional<ExactCrowd> exactCrowd(CrowdRun run, const Bodies& bodies, int copies);

} // namespace carom
