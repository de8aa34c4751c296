// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/sentence.h"
#include "core/simulation/pipeline.h"
#include "core/study/crowd_runs.h"
#include "core/study/error_norms.h"
#include "core/study/impacts.h"
#include "core/study/run_course.h"
#include "core/study/study_clock.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>

// The reference solution of the accuracy study: a closed form where there is one; else exact events; else
// runs of the most accurate setting with more and more substeps, whose last difference bounds the error of
// the last one.
//
// A body is followed up to its horizon, which is the earlier of two times:
//     chaos      a copy of the scene that starts a billionth of its size aside (exact events: a thousandth
//                of that) has diverged from it by a thousand times as much there; an error of 1e-6 at the
//                start has become one of 1e-3 by then
//     branching  the last two of the converging runs have diverged by `agreement` there: contacts have sent
//                the body in different directions
// What is left at the end (Outcome), and the course of the energy, are compared beyond all horizons; how far
// they differ among the runs of the reference solution is the measure of chance.
//
// Where the most accurate setting does not come to the end of the scene in its share of the time, coarser
// ones that do take its place: what is compared is then less exact, but all of the scene, and horizons are
// where runs part, not where the time ran out.

namespace carom {

enum class ReferenceKind : std::uint8_t { ClosedForm, ExactEvents, ConvergedRun, None };
std::string_view nameOf(ReferenceKind kind); ///< "closed form", "exact events", "converged run", "none"
/// Why there is none, of ReferenceKind::None; a clause.
Sentence noReferenceReason();

struct ReferenceRequest {
    const Scene& scene;
    const RunSettings& settings; ///< the scene's own
    double duration = 2;         ///< [s]
    int finest = 64;             ///< substeps of the finest setting it will be compared with
    double seconds = 20;         ///< [s] of wall time that there is for it
    double agreement = 1e-5;     ///< of runs that count as one, as ErrorNorms::worst
    int copies = 0;              ///< of a crowd, at most
    const StudyClock& clock;
    std::function<bool()> goOn = {}; ///< false: stop; asked often
};

struct ReferenceSolution {
    ReferenceKind kind = ReferenceKind::ConvergedRun;
    Reason description{};    ///< "free motion", "contacts, rk4, 256 substeps"; of exact events nothing
    int looksPerFrame = 1;   ///< frames included
    Trajectory trajectory{}; ///< every 1/looksPerFrame of a frame
    ImpactRecord impacts{};  ///< empty where they cannot be seen, or in a closed form, which has none
    std::optional<Outcome> outcome{};  ///< of a closed form nothing
    double outcomeScatter = 0;         ///< of it, among the runs that led here, as OutcomeErrors::worst
    std::vector<double> energy{};      ///< [J] at the ends of frames, the start first; of a closed form none
    double energyScale = 1;            ///< [J] what differences of it are relative to (run_course.h)
    double energyScatter = 0;          ///< the largest such difference among the runs that led here
    std::optional<ExactCrowd> crowd{}; ///< of a scene of many balls that is followed far beyond the horizon
    double size = 1;                   ///< [m], what position errors are relative to
    double duration = 0;               ///< [s] that it covers: less than asked for where that was too long
    double way = 0;                    ///< the largest of a body: relative to the size, or an angle [rad]
    double error = 0;                  ///< bound of its own error within the horizons, as ErrorNorms::worst
    Horizons horizons{};               ///< [s], by body
    double horizon = 0;                ///< [s]: half of the mobile bodies can be followed so far
    double firstHorizon = 0;           ///< [s], of the mobile body that parts first
    std::size_t followed = 0;          ///< mobile bodies that can be followed to the end
    std::size_t mobile = 0;            ///< mobile bodies
    double nudge = 0;                  ///< how far copies started apart, relative to the size
    double growth = 0;                 ///< mean rate at which the first two copies of a body part [1/s]
    bool chaotic = false;              ///< some horizon is before the end
};

/// Nothing if it was told to stop.
std::optional<ReferenceSolution> findReferenceSolution(const ReferenceRequest& request);

} // namespace carom
