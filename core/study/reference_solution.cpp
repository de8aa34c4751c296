// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/reference_solution.h"

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
constexpr double roundingOfReference = 1e-13;
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

std::int64_t looksOf(const ReferenceRequest& request) {
    return static_cast<std::int64_t>(std::ceil(request.duration / request.settings.step * (1 - 1e-12))) *
           looksPerFrame;
}

struct Recorded {
    Trajectory trajectory;
    ImpactRecord impacts;
};

/// The states of a run at every look, `perLook` steps apart, and its impacts; nothing if told to stop, or if
/// the state is lost or `seconds` of wall time are over.
std::optional<Recorded> recordRun(const ReferenceRequest& request, const Scene& scene,
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
void measureHorizon(const Trajectory& run, const Trajectory& copy, const Bodies& bodies,
                    ReferenceSolution& reference) {
    reference.horizon = static_cast<double>(run.samples.size() - 1) * run.spacing;
    double apart = copiesApart;
    for (std::size_t k = 0; k < run.common(copy); ++k) {
        ErrorMeter meter(bodies, reference.size);
        meter.add(copy.samples[k], run.samples[k]);
        apart = std::max(meter.norms().position, copiesApart);
        if (apart <= copiesParted) continue;
        reference.horizon = static_cast<double>(k > 0 ? k - 1 : 0) * run.spacing;
        reference.chaotic = true;
        break;
    }
    reference.growth = reference.horizon > 0 ? std::log(apart / copiesApart) / reference.horizon : 0;
}

ReferenceSolution closedReference(const ReferenceRequest& request, const ClosedMotion& motion,
                                  const Bodies& bodies) {
    ReferenceSolution reference{.kind = ReferenceKind::ClosedForm, .description = motion.name};
    reference.trajectory.spacing = request.settings.step / looksPerFrame;
    for (std::int64_t look = 0; look <= looksOf(request); ++look)
        reference.trajectory.samples.push_back(
            motion.at(static_cast<double>(look) * reference.trajectory.spacing));
    reference.size = sizeOf(bodies, reference.trajectory);
    reference.error = roundingOfReference;
    reference.horizon = static_cast<double>(looksOf(request)) * reference.trajectory.spacing;
    return reference;
}

std::optional<ReferenceSolution> exactReference(const ReferenceRequest& request, const Bodies& bodies) {
    SimulationSettings options = optionsFor("events", "euler", request.settings.step / looksPerFrame);
    std::optional<Recorded> run = recordRun(request, request.scene, options, 1, request.timeLimit);
    if (!run) return std::nullopt;
    ReferenceSolution reference{.kind = ReferenceKind::ExactEvents, .description = "exact events"};
    reference.size = sizeOf(bodies, run->trajectory);
    reference.error = roundingOfReference;
    const std::optional<Recorded> copy = recordRun(
        request, nudged(request.scene, copiesApart * reference.size), options, 1, request.timeLimit);
    if (!copy) return std::nullopt;
    measureHorizon(run->trajectory, copy->trajectory, bodies, reference);
    // Within the horizon rounding has grown as the distance of the copies has.
    if (reference.chaotic) reference.error = roundingOfReference * copiesParted / copiesApart;
    reference.trajectory = std::move(run->trajectory);
    reference.impacts = std::move(run->impacts);
    if (!reference.chaotic) return reference;
    CrowdRun crowd{.scene = request.scene,
                   .frames = looksOf(request) / looksPerFrame,
                   .first = framesToForget(reference.growth, request.settings.step),
                   .step = request.settings.step,
                   .nudge = crowdNudge * reference.size,
                   .goOn = request.goOn};
    reference.crowd = exactCrowd(crowd, bodies, request.copies);
    return reference;
}

std::optional<ReferenceSolution> convergedReference(const ReferenceRequest& request, const Bodies& bodies,
                                                    bool smooth) {
    const char* integrator = smooth ? "rk4" : "midpoint";
    const auto optionsOf = [&](int substeps) {
        return optionsFor("contacts", integrator, request.settings.step / substeps);
    };
    std::optional<Recorded> run =
        recordRun(request, request.scene, optionsOf(firstSubsteps), 1, request.timeLimit);
    if (!run) return std::nullopt;
    ReferenceSolution reference{.kind = ReferenceKind::ConvergedRun};
    reference.size = sizeOf(bodies, run->trajectory);
    const std::optional<Recorded> copy =
        recordRun(request, nudged(request.scene, copiesApart * reference.size), optionsOf(firstSubsteps), 1,
                  request.timeLimit);
    if (!copy) return std::nullopt;
    measureHorizon(run->trajectory, copy->trajectory, bodies, reference);

    int substeps = firstSubsteps;
    reference.error = HUGE_VAL;
    const Stopwatch watch;
    while (substeps < std::max(finerThanFinest * request.finest, 8 * firstSubsteps)) {
        const double left = request.timeLimit - watch.elapsed() / 1000;
        std::optional<Recorded> finer =
            recordRun(request, request.scene, optionsOf(2 * substeps), 2 * substeps / looksPerFrame, left);
        if (!request.goOn()) return std::nullopt;
        if (!finer) break;
        reference.error =
            distanceOf(run->trajectory, finer->trajectory, bodies, reference.size, reference.horizon).worst();
        run = std::move(finer);
        substeps *= 2;
        if (reference.error < convergedEnough) break;
    }
    reference.description =
        std::string("contacts, ") + integrator + ", " + std::to_string(substeps) + " substeps";
    reference.trajectory = std::move(run->trajectory);
    reference.impacts = std::move(run->impacts);
    return reference;
}

} // namespace

std::string_view nameOf(ReferenceKind kind) {
    switch (kind) {
    case ReferenceKind::ClosedForm:
        return "closed form";
    case ReferenceKind::ExactEvents:
        return "exact events";
    case ReferenceKind::ConvergedRun:
        return "converged run";
    }
    return {};
}

std::optional<ReferenceSolution> findReferenceSolution(const ReferenceRequest& request) {
    const Pipeline pipeline(request.scene, optionsFor("contacts", "rk4", request.settings.step));
    if (const std::optional<ClosedMotion> motion = closedMotionOf(pipeline))
        return closedReference(request, *motion, pipeline.bodies());
    const SolverRow* events = findSolver("events");
    if (!objectionTo(*events, request.scene)) {
        if (std::optional<ReferenceSolution> reference = exactReference(request, pipeline.bodies()))
            return reference;
        if (!request.goOn()) return std::nullopt;
    }
    const bool smooth = pipeline.simulates("spring") || pipeline.bodies().count() == 1;
    return convergedReference(request, pipeline.bodies(), smooth);
}

} // namespace carom
