// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/accuracy_run.h"

#include "core/base/clock.h"
#include "core/base/figures.h"
#include "core/simulation/world.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace carom {
namespace {

/// A relative change of energy, or a gain of it, beyond this counts as broken.
constexpr double brokenInvariant = 0.01;
/// A timed run is repeated until it has lasted so long [ms]: clocks are read twice.
constexpr double leastTimed = 5;
/// Momentum below this [kg m/s] is none to compare with.
constexpr double noMomentum = 1e-12;

bool isClosed(const Pipeline& pipeline) {
    if (pipeline.simulates("gravity") || !pipeline.bodies().forces.empty()) return false;
    if (pipeline.bodies().mobileBodies.size() < pipeline.bodies().count()) return false;
    return std::all_of(pipeline.bodies().springs.begin(), pipeline.bodies().springs.end(),
                       [](const SpringForce& s) { return s.from != noBody && s.to != noBody; });
}

/// What is looked at in every substep of a run.
class Course {
  public:
    Course(const World& world, double size) : m_size(size), m_momentum(world.statistics().momentum) {}

    void add(const World& world, AccuracyPoint& point) {
        const FrameStatistics& frame = world.statistics();
        m_time.push_back(world.state().time);
        m_energy.push_back(frame.kinetic + frame.potential);
        m_kinetic = std::max(m_kinetic, frame.kinetic);
        m_highest = std::max(m_highest, frame.potential);
        m_lowest = std::min(m_lowest, frame.potential);
        point.penetration = std::max(point.penetration, frame.maxPenetration / m_size);
        point.residual = std::max(point.residual, frame.residual);
        point.coneViolation = std::max(point.coneViolation, frame.coneViolation);
    }

    void finish(const World& world, AccuracyPoint& point) const {
        point.energy = steadinessOf(m_time, m_energy, std::max(m_kinetic, m_highest - m_lowest));
        if (!isClosed(world.pipeline())) return;
        double most = 0;
        for (const BodyIndex i : world.pipeline().bodies().mobileBodies)
            most += world.pipeline().bodies().mass[i] * world.state().velocity[i].norm();
        if (most > noMomentum)
            point.momentumChange = (world.statistics().momentum - m_momentum).norm() / most;
    }

  private:
    double m_size; ///< [m]
    Vec3 m_momentum;
    std::vector<double> m_time, m_energy;
    double m_kinetic = 0, m_highest = -HUGE_VAL, m_lowest = HUGE_VAL; ///< [J]
};

void judge(const AccuracyStudy& study, AccuracyPoint& point) {
    point.status = PointStatus::Measured;
    const double change = study.conservative ? point.energy.worst : point.energy.gain;
    if (!(change > brokenInvariant)) return;
    point.status = PointStatus::Broken;
    point.reason = "energy " + std::string(study.conservative ? "changed" : "grew") + " by " +
                   figure(100 * change) + " %";
}

/// Whether the run must end here, and why.
bool isOver(const World& world, const AccuracyPlan& plan, double elapsed, AccuracyPoint& point) {
    if (!world.health().finite) {
        point.status = PointStatus::Failed;
        point.reason = "the state was lost after " + figure(world.state().time) + " s";
    } else if (elapsed > 1000 * plan.timeLimit) {
        point.status = PointStatus::TimedOut;
        point.reason = "it took longer than " + figure(plan.timeLimit) + " s";
    } else {
        return false;
    }
    point.times = {elapsed / world.state().time};
    return true;
}

} // namespace

std::int64_t AccuracyRun::frames() const {
    return static_cast<std::int64_t>(std::ceil(study.plan.duration / step() * (1 - 1e-12)));
}

bool measure(const AccuracyRun& run, AccuracyPoint& point) {
    const ReferenceSolution& reference = *run.study.reference;
    const int substeps = point.setting.substeps;
    SimulationSettings options = point.setting.options();
    options.step = run.step() / substeps;
    options.substeps = 1;
    World world(std::make_shared<const Pipeline>(run.scene, options));
    const Bodies& bodies = world.pipeline().bodies();
    ErrorMeter meter(bodies, reference.size);
    Course course(world, reference.size);
    ImpactWatch impacts(bodies, world.pipeline().gravity(), run.step(), world.state());
    const Stopwatch watch;
    const std::int64_t steps = run.frames() * substeps;
    for (std::int64_t step = 0;; ++step) {
        course.add(world, point);
        if (step > 0 && step % substeps == 0) impacts.look(world.state());
        const std::int64_t eighths = step * looksPerFrame;
        const auto look = static_cast<std::size_t>(eighths / substeps);
        if (eighths % substeps == 0 && look < run.trajectory.samples.size() &&
            static_cast<double>(look) * run.trajectory.spacing <= reference.horizon)
            meter.add(world.state().pose, run.trajectory.samples[look]);
        if (step == steps) break;
        world.step();
        if (!run.goOn()) return false;
        if (isOver(world, run.study.plan, watch.elapsed(), point)) break;
    }
    point.errors = meter.norms();
    if (!reference.impacts.empty()) {
        const double end = std::min(reference.horizon, world.state().time);
        point.impacts = compareImpacts(reference.impacts, impacts.record(), end);
    }
    course.finish(world, point);
    if (point.status == PointStatus::Waiting) judge(run.study, point);
    return true;
}

bool measureCrowd(const AccuracyRun& run, AccuracyPoint& point) {
    const ReferenceSolution& reference = *run.study.reference;
    if (!reference.crowd) return true;
    const CrowdRun crowd{.scene = run.scene,
                         .frames = run.frames(),
                         .first = reference.crowd->first,
                         .step = run.step(),
                         .nudge = crowdNudge * reference.size,
                         .goOn = run.goOn,
                         .fastest = reference.crowd->fastest};
    std::vector<CrowdDeviation> deviations;
    const Stopwatch watch;
    for (int copy = 0; copy < run.study.plan.copies; ++copy) {
        if (copy > 0 && watch.elapsed() > 1000 * run.study.plan.timeLimit) break;
        const std::optional<CrowdWatch::Sums> sums = runCopy(crowd, copy, point.setting.options());
        if (!sums) return run.goOn(); // a copy that is lost says nothing
        deviations.push_back(deviationOf(*sums, reference.crowd->sums));
    }
    point.crowd = figuresOf(deviations);
    return true;
}

bool timeOnce(const AccuracyRun& run, AccuracyPoint& point) {
    constexpr std::int64_t together = 16; // frames between two readings of the clock
    SimulationSettings options = point.setting.options();
    options.step = run.step();
    World world(std::make_shared<const Pipeline>(run.scene, options));
    const std::int64_t frames = std::max<std::int64_t>(2, run.frames());
    double spent = 0, simulated = 0;
    while (spent < leastTimed) {
        world.reset();
        world.step(); // the first touch of everything
        for (std::int64_t frame = 1; frame < frames;) {
            const std::int64_t end = std::min(frames, frame + together);
            const double start = processorTimeOfThread();
            for (; frame < end; ++frame) {
                world.step();
                simulated += run.step();
            }
            spent += processorTimeOfThread() - start;
            if (!run.goOn()) return false;
        }
    }
    point.times.push_back(spent / simulated);
    return true;
}

} // namespace carom
