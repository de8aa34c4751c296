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
// point has its error and a time as soon as its run ends, so that a study is valid whenever it is ended; the
// time that is left is used to repeat runs until their times agree. Runs that do not fit are left out, and
// the study says so. While the reference solution is computed, the scene's own setting has a time and its
// invariants, but no error.

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
    const PresetRow* preset = nullptr; ///< of method `contacts`: gives the budget of refinement
    std::string engine{};              ///< "bullet": another engine (engines.h); empty: Carom
    bool isTuned = false;              ///< of another engine: its rules are set to Carom's as far as possible

    /// "contacts, verlet, preset default": what the settings of a family share.
    std::string family() const;
    /// The same, with the substeps.
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
    bool isDefault = false; ///< the scene's own setting
    PointStatus status = PointStatus::Waiting;
    Sentence reason{}; ///< why its status is not Measured
    ErrorNorms errors{};
    Steadiness energy{}; ///< relative to a scale that cannot vanish (run_course.h)
    /// The largest difference of the energy from that of the reference solution at the same time, relative to
    /// the same scale; empty if the reference solution has no energies.
    std::optional<double> energyOff{};
    double momentumChange = 0; ///< relative; 0 for scenes with gravity, walls or springs tied to the world
    double penetration = 0;    ///< the largest overlap, relative to half the thinnest mobile body
    double residual = 0;       ///< of the worst contact problem, how far from solved [m/s]
    double relativeResidual =
        0;                    ///< the same relative to the speed that the scale of energies gives all bodies
    double coneViolation = 0; ///< of the worst contact force, relative to its size
    std::optional<ImpactErrors> impacts{};  ///< empty where impacts cannot be recorded
    std::optional<OutcomeErrors> outcome{}; ///< errors of the final state; empty if the reference has none
    std::optional<CrowdFigures> crowd{};    ///< of a crowd, beyond the horizon
    double instructions = 0;                ///< per simulated second; 0 if they were not counted
    std::vector<double> times{};            ///< [ms] per simulated second, one for each run
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
    int iterations = 50; ///< of its contact solver in a step, if it is tuned; 0: the engine's own number
    std::int64_t frames = 0;
    double limit = 0;                             ///< [s] of wall time that it may take
    std::function<void(std::string_view)> read{}; ///< receives its output, in pieces
    std::function<bool()> goOn{};                 ///< false: end it
};

struct AccuracyPlan {
    std::vector<AccuracySetting> settings;
    double duration = 2; ///< [s] simulated; less where more does not fit into the budget
    double budget = 60;  ///< [s] of wall time for the whole study
    int runs = 9;        ///< timed runs of a setting at most; fewer if times agree
    double target = 1e-3;
    int copies = 20;                     ///< of a crowd at most; fewer if the budget is short
    const MeasureRow* measure = nullptr; ///< of the diagram; null: the first that is informative
    /// Runs a setting of another engine; returns an error message, or an empty text.
    std::function<std::string(const EngineRequest&)> runEngine{};
};

/// The measure that a study has before anything is measured.
const MeasureRow* firstMeasure();

struct AccuracyStudy {
    AccuracyPlan plan;
    RunSettings settings;                       ///< the scene's own
    std::optional<ReferenceSolution> reference; ///< without its samples
    std::vector<AccuracyPoint> points;          ///< as in the plan, the scene's own setting first
    std::vector<AccuracySetting> leftOut;       ///< settings of the plan that did not fit into the budget
    std::vector<std::string> engineNotes;       ///< how rules of other engines differ from Carom's
    double duration = 0;                        ///< [s] simulated
    double seconds = 0;                         ///< [s] of wall time spent
    const MeasureRow* measure = firstMeasure(); ///< of the diagram; never null
    bool conservative = false;                  ///< nothing in the scene dissipates energy
    bool complete = false;                      ///< false: it was cancelled; its points are valid

    /// A point's error by the study's measure; infinite if it has none.
    double errorOf(const AccuracyPoint& point) const;
    /// The smallest error by that measure that can be distinguished from zero. Points with smaller errors are
    /// shown, but these are only deviations from the finest run.
    double resolution() const;
};

/// Points of an earlier study, and how much of the scene they were simulated over [s].
struct KnownPoints {
    std::vector<AccuracyPoint> points;
    double duration = 0;
};

/// The scene's own setting.
AccuracySetting ownSettingOf(const Scene& scene);

/// The plan for a scene: every method that can treat it, with every integrator where the choice matters and
/// every preset where bodies can meet, at 1 to 64 substeps; the presets' own settings first, then coarse to
/// fine.
AccuracyPlan planFor(const Scene& scene);

/// The presets' own settings and exact methods first, then coarse to fine.
void sortForStudy(AccuracyPlan& plan);

/// Replaces the plan's substeps, and its tolerances of method `contacts`, in every family; an empty list
/// changes nothing.
void vary(AccuracyPlan& plan, const std::vector<double>& substeps, const std::vector<double>& tolerances);

struct AccuracyListener {
    std::function<bool(double seconds)> goOn; ///< the wall time spent; false ends the study
    /// Called after every run; the first one is that of the scene's own setting, which is only timed.
    std::function<void(const AccuracyStudy&)> changed{};
    StudyClock clock{};
};

/// `known` is a study of the same scene that was interrupted, or whose budget was used up: its points are not
/// measured again.
AccuracyStudy runAccuracy(const Scene& scene, const AccuracyPlan& plan, const AccuracyListener& listener,
                          const KnownPoints& known = {});

} // namespace carom
