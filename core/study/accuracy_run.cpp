// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/accuracy_run.h"

#include "core/base/figures.h"
#include "core/simulation/world.h"
#include "core/study/run_course.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace carom {
namespace {

/// A relative change of energy, or a gain of it, beyond this counts as broken: at twice it a motion that
/// gains 2 % would be recommended; at half of it coarse settings that serve for a first look are called
/// broken.
constexpr double brokenInvariant = 0.01;
/// A timed run is repeated until it has lasted so long [ms]: clocks are read twice, which takes less than a
/// microsecond, and whatever else the machine does lasts a millisecond. At half of it times scatter more.
constexpr double leastTimed = 5;
/// Frames between two readings of the clock: as many as last so long [ms], at most. Readings then take a
/// thousandth of the time, at half twice that; cancelling is noticed after as many frames. Twice or half of
/// the number matters only for frames of less than 3 µs.
constexpr double longTogether = 0.05;
constexpr std::int64_t mostTogether = 16;

/// Between the substeps of a frame the state is that of one time for all bodies only where no contacts are
/// solved; there each substep can be run as a frame, and looked at, without changing the motion.
bool isSteppedApart(const Pipeline& pipeline) {
    return !pipeline.settings().method->iterates() || !anyCanMeet(pipeline.bodies());
}

/// Whether the run must end here, and why. Another step may take as long as the longest one so far.
bool isOver(const World& world, double limit, double elapsed, AccuracyPoint& point) {
    if (!world.health().finite) {
        point.status = PointStatus::Failed;
        point.reason = Sentence{"the state was lost after %1 s", {figure(world.state().time)}};
    } else if (elapsed + point.longestStep > limit) {
        point.status = PointStatus::TimedOut;
        point.reason = Sentence{"it took longer than the %1 s that were left for it", {figure(limit, 2)}};
    } else {
        return false;
    }
    point.times = {1000 * elapsed / world.state().time};
    return true;
}

void fillIn(const AccuracyRun& run, const RunCourse& course, const World& world, AccuracyPoint& point) {
    const ReferenceSolution& reference = *run.study.reference;
    addInvariants(course, world, point);
    if (!reference.energy.empty())
        point.energyOff = distanceOf(course.frames(), reference.energy, reference.energyScale);
    if (reference.outcome && point.status == PointStatus::Waiting)
        point.outcome =
            differenceOf(course.outcome(world), *reference.outcome, reference.size, run.study.duration);
}

} // namespace

void addInvariants(const RunCourse& course, const World& world, AccuracyPoint& point) {
    point.energy = course.energy();
    point.momentumChange = course.momentumChange(world);
    point.penetration = course.overlap();
    point.residual = course.residual();
    point.relativeResidual = course.relativeResidual();
    point.coneViolation = course.coneViolation();
}

void judge(const AccuracyStudy& study, AccuracyPoint& point) {
    point.status = PointStatus::Measured;
    const double change = study.conservative ? point.energy.worst : point.energy.gain;
    if (!(change > brokenInvariant)) return;
    point.status = PointStatus::Broken;
    const std::string percent = figure(100 * change);
    point.reason = study.conservative ? Sentence{"energy changed by %1 %", {percent}}
                                      : Sentence{"energy grew by %1 %", {percent}};
}

std::int64_t AccuracyRun::frames() const {
    return static_cast<std::int64_t>(std::ceil(study.duration / step() * (1 - 1e-12)));
}

bool measure(const AccuracyRun& run, AccuracyPoint& point) {
    const ReferenceSolution& reference = *run.study.reference;
    SimulationSettings options = point.setting.options();
    options.step = run.step();
    auto pipeline = std::make_shared<const Pipeline>(run.scene, options);
    const bool apart = isSteppedApart(*pipeline);
    const int perFrame = apart ? pipeline->settings().substeps : 1;
    if (apart) {
        options.step = run.step() / perFrame;
        options.substeps = 1;
        pipeline = std::make_shared<const Pipeline>(run.scene, options);
    }
    World world(pipeline);
    const Bodies& bodies = pipeline->bodies();
    ErrorMeter meter(bodies, reference.size);
    RunCourse course(world, reference.size);
    ImpactWatch impacts(bodies, pipeline->gravity(), run.step(), world.state());
    const double start = run.clock.wall();
    const std::int64_t steps = run.frames() * perFrame;
    double elapsed = 0; // [s] of wall time
    double spent = 0;   // [ms] behind the first frame, the first touch of everything
    for (std::int64_t step = 0;; ++step) {
        if (step > 0) course.add(world);
        if (step > 0 && step % perFrame == 0) {
            impacts.look(world.state());
            course.endFrame();
        }
        const std::int64_t parts = step * reference.looksPerFrame;
        const auto look = static_cast<std::size_t>(parts / perFrame);
        if (parts % perFrame == 0 && look < run.trajectory.samples.size())
            meter.add(world.state().pose, run.trajectory.samples[look],
                      static_cast<double>(look) * run.trajectory.spacing, reference.horizons);
        if (step == steps) break;
        const double before = run.clock.processor();
        world.step();
        if (step > 0) spent += run.clock.processor() - before;
        if (!run.goOn()) return false;
        const double now = 1e-3 * (run.clock.wall() - start);
        point.longestStep = std::max(point.longestStep, now - elapsed);
        elapsed = now;
        const bool isLast = step + 1 == steps;
        if (isOver(world, isLast ? HUGE_VAL : run.limit, elapsed, point)) break;
    }
    point.errors = meter.norms();
    if (!reference.impacts.empty()) {
        std::vector<double> ends = reference.horizons;
        for (double& end : ends) end = std::min(end, world.state().time);
        point.impacts = compareImpacts(reference.impacts, impacts.record(), ends);
    }
    fillIn(run, course, world, point);
    if (point.status != PointStatus::Waiting) return true;
    judge(run.study, point);
    if (!apart && spent >= leastTimed) point.times = {spent / (static_cast<double>(steps - 1) * run.step())};
    return true;
}

std::optional<CrowdDeviation> measureCrowd(const AccuracyRun& run, const AccuracyPoint& point, int copy) {
    const ReferenceSolution& reference = *run.study.reference;
    const CrowdRun crowd{.scene = run.scene,
                         .frames = run.frames(),
                         .first = reference.crowd->first,
                         .step = run.step(),
                         .nudge = crowdNudge * reference.size,
                         .goOn = run.goOn,
                         .fastest = reference.crowd->fastest};
    const std::optional<CrowdWatch::Sums> sums = runCopy(crowd, copy, point.setting.options());
    if (!sums) return std::nullopt;
    return deviationOf(*sums, reference.crowd->sums);
}

bool timeOnce(const AccuracyRun& run, AccuracyPoint& point) {
    SimulationSettings options = point.setting.options();
    options.step = run.step();
    World world(std::make_shared<const Pipeline>(run.scene, options));
    const std::int64_t frames = std::max<std::int64_t>(2, run.frames());
    const double begin = run.clock.wall();
    std::int64_t together = 1; // frames between two readings of the clock
    double spent = 0, simulated = 0, read = begin;
    while (spent < leastTimed) {
        world.reset();
        world.step(); // the first touch of everything
        for (std::int64_t frame = 1; frame < frames;) {
            const std::int64_t end = std::min(frames, frame + together);
            const double start = run.clock.processor();
            for (; frame < end; ++frame) {
                world.step();
                simulated += run.step();
            }
            spent += run.clock.processor() - start;
            if (!run.goOn()) return false;
            const double now = run.clock.wall();
            if (now - begin > 1000 * (run.limit - point.longestStep)) {
                if (point.times.empty()) point.times.push_back(spent / simulated);
                return true;
            }
            // Frames may become long later, when bodies meet.
            together = now - read < longTogether ? std::min(2 * together, mostTogether) : 1;
            read = now;
        }
    }
    point.times.push_back(spent / simulated);
    return true;
}

} // namespace carom
