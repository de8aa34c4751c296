// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/truth.h"

#include "core/base/clock.h"
#include "core/simulation/method_choice.h"
#include "core/simulation/world.h"
#include "core/study/closed_motion.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace carom {
namespace {

/// Copies start so far apart, relative to the scene's size, and count as parted beyond the second figure: an
/// early error of 1e-6 has become one of 1e-3 by then.
constexpr double copiesApart = 1e-12, copiesParted = 1e-9;
/// Errors of a closed form and of exact events: rounding of a few thousand operations.
constexpr double roundingOfTruth = 1e-13;
/// Substeps of the first converging run, how much finer than the finest setting the last one is, and what is
/// close enough to stop at.
constexpr int firstSubsteps = 8;
constexpr int finerThanFinest = 4;
constexpr double convergedEnough = 1e-13;

SimulationSettings optionsFor(const char* method, const char* integrator, double step) {
    SimulationSettings options;
    options.method = method;
    options.integrator = integrator;
    options.step = step;
    options.substeps = 1;
    options.tolerance = 1e-12;
    return options;
}

std::int64_t looksOf(const TruthRequest& request) {
    return static_cast<std::int64_t>(std::ceil(request.duration / request.settings.step * (1 - 1e-12))) *
           looksPerFrame;
}

struct Recorded {
    Trajectory trajectory;
    ImpactRecord impacts;
};

/// The states of a run at every look, `perLook` steps apart, and its impacts; nothing if told to stop, or if
/// the state is lost or `seconds` of wall time are over.
std::optional<Recorded> recordRun(const TruthRequest& request, const Scene& scene,
                                  const SimulationSettings& options, std::int64_t perLook, double seconds) {
    World world(std::make_shared<const Pipeline>(scene, options));
    const Pipeline& pipeline = world.pipeline();
    Recorded run{{request.settings.step / looksPerFrame, {world.state().pose}}, {}};
    ImpactWatch watchImpacts(pipeline.bodies(), pipeline.gravity(), request.settings.step, world.state());
    const Stopwatch watch;
    for (std::int64_t look = 0; look < looksOf(request); ++look) {
        for (std::int64_t k = 0; k < perLook; ++k) {
            world.step();
            if (!request.goOn() || watch.elapsed() > 1000 * seconds) return std::nullopt;
        }
        if (!world.health().finite) return std::nullopt;
        run.trajectory.samples.push_back(world.state().pose);
        if ((look + 1) % looksPerFrame == 0) watchImpacts.look(world.state());
    }
    if (ImpactWatch::sees(pipeline.bodies())) run.impacts = watchImpacts.record();
    return run;
}

/// How fast a nudged copy parts from the run, in the same setting.
void measureHorizon(const Trajectory& run, const Trajectory& copy, const Bodies& bodies, Truth& truth) {
    truth.horizon = static_cast<double>(run.samples.size() - 1) * run.spacing;
    double apart = copiesApart;
    for (std::size_t k = 0; k < run.common(copy); ++k) {
        ErrorMeter meter(bodies, truth.size);
        meter.add(copy.samples[k], run.samples[k]);
        apart = std::max(meter.norms().position, copiesApart);
        if (apart <= copiesParted) continue;
        truth.horizon = static_cast<double>(k > 0 ? k - 1 : 0) * run.spacing;
        truth.chaotic = true;
        break;
    }
    truth.growth = truth.horizon > 0 ? std::log(apart / copiesApart) / truth.horizon : 0;
}

Truth closedTruth(const TruthRequest& request, const ClosedMotion& motion, const Bodies& bodies) {
    Truth truth{.kind = TruthKind::ClosedForm, .description = motion.name};
    truth.trajectory.spacing = request.settings.step / looksPerFrame;
    for (std::int64_t look = 0; look <= looksOf(request); ++look)
        truth.trajectory.samples.push_back(motion.at(static_cast<double>(look) * truth.trajectory.spacing));
    truth.size = sizeOf(bodies, truth.trajectory);
    truth.error = roundingOfTruth;
    truth.horizon = static_cast<double>(looksOf(request)) * truth.trajectory.spacing;
    return truth;
}

std::optional<Truth> exactTruth(const TruthRequest& request, const Bodies& bodies) {
    SimulationSettings options = optionsFor("events", "euler", request.settings.step / looksPerFrame);
    std::optional<Recorded> run = recordRun(request, request.scene, options, 1, request.patience);
    if (!run) return std::nullopt;
    Truth truth{.kind = TruthKind::ExactEvents, .description = "exact events"};
    truth.size = sizeOf(bodies, run->trajectory);
    truth.error = roundingOfTruth;
    const std::optional<Recorded> copy =
        recordRun(request, nudged(request.scene, copiesApart * truth.size), options, 1, request.patience);
    if (!copy) return std::nullopt;
    measureHorizon(run->trajectory, copy->trajectory, bodies, truth);
    // Within the horizon rounding has grown as the distance of the copies has.
    if (truth.chaotic) truth.error = roundingOfTruth * copiesParted / copiesApart;
    truth.trajectory = std::move(run->trajectory);
    truth.impacts = std::move(run->impacts);
    if (!truth.chaotic) return truth;
    CrowdRun crowd{.scene = request.scene,
                   .frames = looksOf(request) / looksPerFrame,
                   .first = framesToForget(truth.growth, request.settings.step),
                   .step = request.settings.step,
                   .nudge = crowdNudge * truth.size,
                   .goOn = request.goOn};
    truth.crowd = exactCrowd(crowd, bodies, request.copies);
    return truth;
}

std::optional<Truth> convergedTruth(const TruthRequest& request, const Bodies& bodies, bool smooth) {
    const char* integrator = smooth ? "rk4" : "midpoint";
    const auto optionsOf = [&](int substeps) {
        return optionsFor("contacts", integrator, request.settings.step / substeps);
    };
    std::optional<Recorded> run =
        recordRun(request, request.scene, optionsOf(firstSubsteps), 1, request.patience);
    if (!run) return std::nullopt;
    Truth truth{.kind = TruthKind::ConvergedRun};
    truth.size = sizeOf(bodies, run->trajectory);
    const std::optional<Recorded> copy = recordRun(request, nudged(request.scene, copiesApart * truth.size),
                                                   optionsOf(firstSubsteps), 1, request.patience);
    if (!copy) return std::nullopt;
    measureHorizon(run->trajectory, copy->trajectory, bodies, truth);

    int substeps = firstSubsteps;
    truth.error = HUGE_VAL;
    const Stopwatch watch;
    while (substeps < std::max(finerThanFinest * request.finest, 8 * firstSubsteps)) {
        const double left = request.patience - watch.elapsed() / 1000;
        std::optional<Recorded> finer =
            recordRun(request, request.scene, optionsOf(2 * substeps), 2 * substeps / looksPerFrame, left);
        if (!request.goOn()) return std::nullopt;
        if (!finer) break;
        truth.error =
            distanceOf(run->trajectory, finer->trajectory, bodies, truth.size, truth.horizon).worst();
        run = std::move(finer);
        substeps *= 2;
        if (truth.error < convergedEnough) break;
    }
    truth.description =
        std::string("contacts, ") + integrator + ", " + std::to_string(substeps) + " substeps";
    truth.trajectory = std::move(run->trajectory);
    truth.impacts = std::move(run->impacts);
    return truth;
}

} // namespace

std::string_view nameOf(TruthKind kind) {
    switch (kind) {
    case TruthKind::ClosedForm:
        return "closed form";
    case TruthKind::ExactEvents:
        return "exact events";
    case TruthKind::ConvergedRun:
        return "converged run";
    }
    return {};
}

std::optional<Truth> findTruth(const TruthRequest& request) {
    const Pipeline pipeline(request.scene, optionsFor("contacts", "rk4", request.settings.step));
    if (const std::optional<ClosedMotion> motion = closedMotionOf(pipeline))
        return closedTruth(request, *motion, pipeline.bodies());
    const SolverRow* events = findSolver("events");
    if (!objectionTo(*events, request.scene)) {
        if (std::optional<Truth> truth = exactTruth(request, pipeline.bodies())) return truth;
        if (!request.goOn()) return std::nullopt;
    }
    const bool smooth = pipeline.simulates("spring") || pipeline.bodies().count() == 1;
    return convergedTruth(request, pipeline.bodies(), smooth);
}

} // namespace carom
