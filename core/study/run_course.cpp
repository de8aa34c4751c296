// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/run_course.h"

#include "core/simulation/world.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

/// ε: the part of weight times size below which an exchange of energy counts as none. At a tenth of it the
/// residual motion of scenes at rest counts as an error; at ten times as much small motions in large scenes
/// have no error of energy.
constexpr double noExchange = 1e-3;
/// Kinetic energy below which bodies are at rest, relative to E: a thousandth of the speed that E gives. At a
/// hundred times bodies that still settle count as at rest; at a hundredth, residual motion does not.
constexpr double restingPart = 1e-6;
/// Momentum below this part of what E gives all bodies is none to compare with: rounding of some thousand
/// steps. At a thousandth of it bodies that have come to rest are said to have changed their momentum.
constexpr double noMomentum = 1e-12;

bool isClosed(const Pipeline& pipeline) {
    const Bodies& bodies = pipeline.bodies();
    if (bodies.gravity != Vec3::Zero() || !bodies.forces.empty()) return false;
    if (bodies.mobileBodies.size() < bodies.count()) return false;
    return std::all_of(bodies.springs.begin(), bodies.springs.end(),
                       [](const SpringForce& s) { return s.from != noBody && s.to != noBody; });
}

} // namespace

double OutcomeErrors::worst() const { return std::max({height, centre, restTime, work}); }

OutcomeErrors differenceOf(const Outcome& run, const Outcome& reference, double size, double duration) {
    return {.height = std::abs(run.height - reference.height) / size,
            .centre = (run.centre - reference.centre).norm() / size,
            .restTime = std::abs(run.restTime - reference.restTime) / duration,
            .work = std::abs(run.work - reference.work) / reference.energyScale};
}

double distanceOf(const std::vector<double>& run, const std::vector<double>& reference, double scale) {
    double largest = 0;
    for (std::size_t k = 0; k < std::min(run.size(), reference.size()); ++k)
        largest = std::max(largest, std::abs(run[k] - reference[k]));
    return largest / scale;
}

RunCourse::RunCourse(const Pipeline& pipeline, double size) {
    const Bodies& bodies = pipeline.bodies();
    double thinnest = HUGE_VAL;
    for (const BodyIndex i : bodies.mobileBodies) {
        m_mass += bodies.mass[i];
        thinnest = std::min(thinnest, halfThicknessOf(bodies.shape[i]));
    }
    if (std::isfinite(thinnest)) m_thickness = thinnest;
    m_weightTimesSize = noExchange * m_mass * pipeline.gravity().norm() * size;
}

RunCourse::RunCourse(const World& world, double size) : RunCourse(world.pipeline(), size) {
    m_momentum = world.statistics().momentum;
    add(world);
    endFrame();
}

void RunCourse::add(double time, double kinetic, double potential) {
    m_time.push_back(time);
    m_energy.push_back(kinetic + potential);
    m_kinetic.push_back(kinetic);
    m_fastest = std::max(m_fastest, kinetic);
    m_highest = std::max(m_highest, potential);
    m_lowest = std::min(m_lowest, potential);
}

void RunCourse::add(const World& world) {
    const FrameStatistics& frame = world.statistics();
    add(world.state().time, frame.kinetic, frame.potential);
    m_overlap = std::max(m_overlap, frame.maxPenetration / m_thickness);
    m_residual = std::max(m_residual, frame.residual);
    m_coneViolation = std::max(m_coneViolation, frame.coneViolation);
}

double RunCourse::energyScale() const {
    const double scale = std::max({m_fastest, m_highest - m_lowest, m_weightTimesSize});
    return scale > 0 ? scale : 1; // no energy at any time: zero of whatever
}

Steadiness RunCourse::energy() const { return steadinessOf(m_time, m_energy, energyScale()); }

double RunCourse::relativeResidual() const {
    return m_mass > 0 ? m_residual / std::sqrt(2 * energyScale() / m_mass) : 0;
}

double RunCourse::momentumChange(const World& world) const {
    if (!isClosed(world.pipeline())) return 0;
    double most = 0;
    for (const BodyIndex i : world.pipeline().bodies().mobileBodies)
        most += world.pipeline().bodies().mass[i] * world.state().velocity[i].norm();
    const double scale = std::sqrt(2 * m_mass * energyScale());
    return most > noMomentum * scale ? (world.statistics().momentum - m_momentum).norm() / most : 0;
}

Outcome RunCourse::outcome(const World& world) const { return outcome(world.pipeline(), world.state()); }

Outcome RunCourse::outcome(const Pipeline& pipeline, const State& state) const {
    const Bodies& bodies = pipeline.bodies();
    const Vec3 gravity = pipeline.gravity();
    const Vec3 up = gravity.norm() > 0 ? Vec3(-gravity.normalized()) : Vec3(Vec3::UnitY());
    Outcome outcome{.height = -HUGE_VAL, .energyScale = energyScale()};
    for (const BodyIndex i : bodies.mobileBodies) {
        outcome.height = std::max(outcome.height, state.pose[i].position.dot(up));
        outcome.centre += bodies.mass[i] / m_mass * state.pose[i].position;
    }
    std::size_t still = m_kinetic.size();
    while (still > 0 && m_kinetic[still - 1] <= restingPart * outcome.energyScale) --still;
    outcome.restTime = m_time[std::min(still, m_time.size() - 1)];
    outcome.work = m_energy.front() - m_energy.back();
    return outcome;
}

} // namespace carom
