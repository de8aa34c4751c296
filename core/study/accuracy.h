// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/pipeline.h"
#include "core/study/reference_solution.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// What accuracy costs in time: every setting of a scene is a point, its error against the reference solution
// (reference_solution.h) across, its time per simulated second up; settings that differ in their substeps
// only are a family. Errors are plain, measured at every look (eight a frame) that falls on the end of a
// substep, within the chaos horizon only, and never averaged over chaotic runs. Times are processor times of
// runs without rendering, loading and the first frame, which take turns, so that a disturbance falls on all
// of them. Impacts are counted and timed (impacts.h); what many balls do beyond the horizon is compared as a
// crowd (crowd.h).

namespace carom {

/// One way to simulate a scene.
struct AccuracySetting {
    const SolverRow* method = nullptr;
    const IntegratorRow* integrator = nullptr; ///< of methods that step
    int substeps = 1;
    double tolerance = 0; ///< of method `contacts`, else 0

    /// "contacts, verlet, tolerance 1e-06": what the settings of a family share.
    std::string family() const;
    /// The same with the substeps.
    std::string name() const;
    SimulationSettings options() const;
    bool operator==(const AccuracySetting&) const = default;
};

enum class PointStatus : std::uint8_t {
    Waiting,
    Measured,
    Broken,   ///< it ran, but an invariant broke
    Failed,   ///< the state was lost
    TimedOut, ///< it took longer than the plan allows
};
std::string_view nameOf(PointStatus status); ///< "measured"

struct AccuracyPoint {
    AccuracySetting setting;
    bool isDefault = false; ///< what the scene runs with as it is
    PointStatus status = PointStatus::Waiting;
    std::string reason{}; ///< of a status beyond Measured
    ErrorNorms errors{};
    Steadiness energy{};       ///< relative to the largest kinetic energy or change of potential
    double momentumChange = 0; ///< relative, of scenes without gravity, walls and ends in the world; else 0
    double penetration = 0;    ///< the largest overlap, relative to the scene's size
    double residual = 0;       ///< of the worst contact problem, how far from solved [m/s]
    double coneViolation = 0;  ///< of the worst contact force, relative to its size
    std::optional<ImpactErrors> impacts{}; ///< where they can be seen
    std::optional<CrowdFigures> crowd{};   ///< of a crowd, beyond the horizon
    double instructions = 0;               ///< a simulated second, where somebody counted them
    std::vector<double> times{};           ///< [ms] a simulated second, a run each

    bool usable() const { return status == PointStatus::Measured; }
    double cost() const;      ///< median of the times
    double leastCost() const; ///< [ms] a simulated second
    double mostCost() const;  ///< likewise
    bool finished() const { return status == PointStatus::Measured || status == PointStatus::Broken; }
};

struct AccuracyPlan {
    std::vector<AccuracySetting> settings;
    double duration = 2;  ///< [s] simulated
    int runs = 5;         ///< timed, a setting
    double timeLimit = 5; ///< [s] of wall time a run
    double target = 1e-3;
    int copies = 20; ///< of a crowd, at most: as long as the time limit allows, a setting
};

struct AccuracyStudy {
    AccuracyPlan plan;
    RunSettings settings;                       ///< the scene's own
    std::optional<ReferenceSolution> reference; ///< without its samples
    std::vector<AccuracyPoint> points;          ///< as in the plan, the scene's own setting first
    bool conservative = false;                  ///< nothing in the scene takes energy out
    bool complete = false;                      ///< false: it was told to stop; what is there is whole

    /// The smallest error the reference solution can tell from none: a hundred times its own. Points below
    /// are shown, but they only say "deviation from the finest run".
    double resolution() const { return reference ? 100 * reference->error : 0; }
};

/// The plan for a scene: every method that can treat it, with every integrator where the choice matters, at
/// 1 to 64 substeps.
AccuracyPlan planFor(const Scene& scene);

/// Puts these substeps, and these tolerances of method `contacts`, in place of the plan's, in every family;
/// what is empty stays.
void vary(AccuracyPlan& plan, const std::vector<double>& substeps, const std::vector<double>& tolerances);

struct AccuracyListener {
    std::function<bool(double done)> goOn;               ///< the part done, 0..1; false ends the study
    std::function<void(const AccuracyStudy&)> changed{}; ///< after every run
};

/// `known` are points of an interrupted study of the same scene: what they have is not measured again.
AccuracyStudy runAccuracy(const Scene& scene, const AccuracyPlan& plan, const AccuracyListener& listener,
                          const std::vector<AccuracyPoint>& known = {});

} // namespace carom
