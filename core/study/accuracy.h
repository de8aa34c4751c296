// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/pipeline.h"
#include "core/study/reference_solution.h"
#include "core/study/study_clock.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// The work-precision study: every setting of a scene is a point, with its error against the reference
// solution (reference_solution.h) and its time per simulated second; settings that differ in their substeps
// only are a family. The error is one of several measures (measures.h): where trajectories are chaotic, a
// quantity that is well defined is compared instead. Errors are never averaged over chaotic runs. Times are
// processor times of runs without rendering, loading and the first frame.
//
// A study lasts as long as its budget at most. It goes from coarse to fine: the scene's own setting, those of
// the presets, then every family with 1, 2, 4, ... substeps, as long as the next run is known to fit. Every
// point has its error and a time as soon as it is there, so that a study is valid whenever it ends; what time
// is left repeats runs until their times agree. Runs that do not fit are left out, and said to be. While the
// reference solution is computed the scene's own setting has a time and its invariants, but no error.

namespace carom {

struct MeasureRow;

/// Times that differ by at most this part of the shorter one count as equal. At half, runs are repeated more
/// often until their times agree; at twice, differences of a tenth are not seen.
inline constexpr double agreeingTimes = 0.05;

/// One way to simulate a scene.
struct AccuracySetting {
    const SolverRow* method = nullptr;
    const IntegratorRow* integrator = nullptr; ///< of methods that step
    int substeps = 1;
    double tolerance = 0;              ///< of method `contacts`, else 0
    const PresetRow* preset = nullptr; ///< of method `contacts`: whose budget of refinement it has
    std::string engine{};              ///< "bullet": another one (engines.h); empty: this one
    bool isTuned = false;              ///< of another engine: set to our rules as far as it can be

    /// "contacts, verlet, preset default": what the settings of a family share.
    std::string family() const;
    /// The same with the substeps.
    std::string name() const;
    SimulationSettings options() const;
    bool operator==(const AccuracySetting&) const = default;
};

enum class PointStatus : std::uint8_t {
    Waiting,
    Timed, ///< it ran, but there is no reference solution yet: it has a time, and no errors
    Measured,
    Broken,   ///< it ran, but an invariant broke
    Failed,   ///< the state was lost
    TimedOut, ///< it took longer than what was left of the budget
};
std::string_view nameOf(PointStatus status); ///< "measured"

struct AccuracyPoint {
    AccuracySetting setting;
    bool isDefault = false; ///< what the scene runs with as it is
    PointStatus status = PointStatus::Waiting;
    Sentence reason{}; ///< of a status beyond Measured
    ErrorNorms errors{};
    Steadiness energy{}; ///< relative to a scale that cannot vanish (run_course.h)
    /// How far the energy was from its course in the reference solution, relative to the same scale; where
    /// the reference solution has one.
    std::optional<double> energyOff{};
    double momentumChange = 0; ///< relative, of scenes without gravity, walls and ends in the world; else 0
    double penetration = 0;    ///< the largest overlap, relative to half the thinnest mobile body
    double residual = 0;       ///< of the worst contact problem, how far from solved [m/s]
    double relativeResidual =
        0;                    ///< the same relative to the speed that the scale of energies gives all bodies
    double coneViolation = 0; ///< of the worst contact force, relative to its size
    std::optional<ImpactErrors> impacts{};  ///< where they can be seen
    std::optional<OutcomeErrors> outcome{}; ///< what is left at the end, where the reference knows it
    std::optional<CrowdFigures> crowd{};    ///< of a crowd, beyond the horizon
    double instructions = 0;                ///< a simulated second, where they were counted
    std::vector<double> times{};            ///< [ms] a simulated second, a run each
    double longestStep = 0;                 ///< [s] of wall time, of the run that gave the errors

    bool usable() const { return status == PointStatus::Measured; }
    double cost() const;      ///< median of the times
    double leastCost() const; ///< [ms] a simulated second
    double mostCost() const;  ///< likewise
    bool finished() const { return status == PointStatus::Measured || status == PointStatus::Broken; }
};

/// A run of the scene in another engine, by a program that the front end starts.
struct EngineRequest {
    std::string engine{};
    bool isTuned = false;
    int substeps = 1;    ///< steps a frame
    int iterations = 50; ///< of its contact solver a step, where it is tuned; 0: its own number
    std::int64_t frames = 0;
    double limit = 0;                             ///< [s] of wall time that it may take
    std::function<void(std::string_view)> read{}; ///< what it prints, in pieces
    std::function<bool()> goOn{};                 ///< false: end it
};

struct AccuracyPlan {
    std::vector<AccuracySetting> settings;
    double duration = 2; ///< [s] simulated; less where more does not fit into the budget
    double budget = 60;  ///< [s] of wall time for the whole study
    int runs = 9;        ///< timed, a setting, at most: until they agree
    double target = 1e-3;
    int copies = 20;                     ///< of a crowd, at most: as many as fit into the budget
    const MeasureRow* measure = nullptr; ///< of the diagram; null: the first that says something
    /// Runs a setting of another engine; what went wrong, or nothing.
    std::function<std::string(const EngineRequest&)> runEngine{};
};

/// The one that a study has before it has measured anything.
const MeasureRow* firstMeasure();

struct AccuracyStudy {
    AccuracyPlan plan;
    RunSettings settings;                       ///< the scene's own
    std::optional<ReferenceSolution> reference; ///< without its samples
    std::vector<AccuracyPoint> points;          ///< as in the plan, the scene's own setting first
    std::vector<AccuracySetting> leftOut;       ///< of the plan: what did not fit into the budget
    std::vector<std::string> engineNotes;       ///< where rules of other engines are not ours
    double duration = 0;                        ///< [s] that were simulated
    double seconds = 0;                         ///< [s] of wall time that it took
    const MeasureRow* measure = firstMeasure(); ///< of the diagram; never null
    bool conservative = false;                  ///< nothing in the scene takes energy out
    bool complete = false;                      ///< false: it was cancelled; the points it has are valid

    /// By the study's measure; infinite where the point has none.
    double errorOf(const AccuracyPoint& point) const;
    /// The smallest error by that measure that can be told from none. Points below are shown, but they only
    /// say "deviation from the finest run".
    double resolution() const;
};

/// Points of an earlier study, and how much of the scene they were simulated over [s].
struct KnownPoints {
    std::vector<AccuracyPoint> points;
    double duration = 0;
};

/// What the scene runs with as it is.
AccuracySetting ownSettingOf(const Scene& scene);

/// The plan for a scene: every method that can treat it, with every integrator where the choice matters and
/// every preset where bodies can meet, at 1 to 64 substeps; the presets' own settings first, then coarse to
/// fine.
AccuracyPlan planFor(const Scene& scene);

/// The presets' own settings and exact methods first, then coarse to fine.
void sortForStudy(AccuracyPlan& plan);

/// Puts these substeps, and these tolerances of method `contacts`, in place of the plan's, in every family;
/// what is empty stays.
void vary(AccuracyPlan& plan, const std::vector<double>& substeps, const std::vector<double>& tolerances);

struct AccuracyListener {
    std::function<bool(double seconds)> goOn; ///< the wall time spent; false ends the study
    /// After every run, the first one of the scene's own setting, which is only timed.
    std::function<void(const AccuracyStudy&)> changed{};
    StudyClock clock{};
};

/// `known` is a study of the same scene that was interrupted, or ran out of its budget: what it has is not
/// measured again.
AccuracyStudy runAccuracy(const Scene& scene, const AccuracyPlan& plan, const AccuracyListener& listener,
                          const KnownPoints& known = {});

} // namespace carom
