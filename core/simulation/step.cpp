// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/world.h"

#include "core/base/clock.h"
#include "core/dynamics/energy.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace carom {
namespace {

/// Bodies of which one thread adds up the energies.
constexpr std::size_t fewSummed = Workers::enoughOf(5);

// Counts are summed over a frame's substeps; the memory of the broad-phase is that of the last one.
void add(FrameStatistics& frame, const SolverReport& report, const BroadphaseCounters& broad) {
    frame.integrate += report.integrate;
    frame.broadphase += report.broadphase;
    frame.narrowphase += report.narrowphase;
    frame.respond += report.respond;
    frame.contacts += report.contacts;
    frame.events += report.events;
    frame.axesTried += report.axesTried;
    frame.axesSpared += report.axesSpared;
    frame.resting = report.resting;
    frame.work.add(report.work);
    frame.maxPenetration = std::max(frame.maxPenetration, report.maxPenetration);
    frame.residual = std::max(frame.residual, report.residual);
    frame.coneViolation = std::max(frame.coneViolation, report.coneViolation);

    frame.broad.pairs = broad.pairs;
    frame.broad.memoryBytes = broad.memoryBytes;
    if (!report.searched) return;
    frame.broad.boxes += broad.boxes;
    frame.broad.tested += broad.tested;
    frame.broad.swaps += broad.swaps;
    frame.broad.added += broad.added;
    frame.broad.removed += broad.removed;
    frame.broad.cells += broad.cells;
}

void measureStored(const Pipeline& pipeline, const State& state, std::vector<double>& into) {
    for (const StoredEnergy& stored : pipeline.stored())
        into.push_back(stored.of(pipeline.scene(), pipeline.bodies(), state));
}

// Potential energy belongs to the effects that store it, and height also to corrected positions; what is then
// left of the change of the state is unexplained.
void closeLedger(const Pipeline& pipeline, const Invariants& before, std::span<const double> storedBefore,
                 std::span<const double> storedAfter, FrameStatistics& frame) {
    Ledger& ledger = frame.ledger;
    for (std::size_t k = 0; k < storedBefore.size(); ++k) {
        const StoredEnergy& stored = pipeline.stored()[k];
        double rise = storedAfter[k] - storedBefore[k];
        if (stored.ofHeight) rise -= ledger.lifted;
        ledger[stored.account].energy += rise;
    }
    ledger[LedgerAccount::PositionCorrection].energy += ledger.lifted;
    const LedgerEntry total = ledger.total();
    frame.unexplained.energy =
        frame.kinetic - before.kinetic + (frame.potential - before.potential) - total.energy;
    frame.unexplained.momentum = frame.momentum - before.momentum - total.momentum;
}

// Appends the stored energies. Each sum is in the order of the bodies, so threads share the sums, not the
// bodies.
void account(const Pipeline& pipeline, const State& state, Workers& workers, std::vector<double>& stored,
             FrameStatistics& frame) {
    const std::size_t first = stored.size();
    MotionTotals motion;
    Workers& several = state.pose.size() < fewSummed ? Workers::alone() : workers;
    several.forEach(2, [&](std::size_t, std::size_t which) {
        if (which == 0)
            motion = motionTotalsOf(pipeline.bodies(), state);
        else
            measureStored(pipeline, state, stored);
    });
    frame.kinetic = motion.kinetic;
    frame.momentum = motion.momentum;
    frame.potential = 0;
    for (const double energy : std::span(stored).subspan(first)) frame.potential += energy;
}

} // namespace

void account(const Pipeline& pipeline, const State& state, FrameStatistics& frame) {
    std::vector<double> stored;
    account(pipeline, state, Workers::alone(), stored, frame);
}

// One frame: `substeps` times the method's smooth motion, pairs, contacts and responses; then the accounts.
void stepWorld(World& world) {
    if (!world.m_health.finite) return;
    const Stopwatch wholeStep;
    const Pipeline& pipeline = *world.m_pipeline;
    const RunSettings& settings = pipeline.settings();
    State& state = world.m_state;
    FrameStatistics& frame = world.m_statistics;

    const Invariants before{frame.kinetic, frame.potential, frame.momentum};
    frame = {};
    ++state.frame;
    state.time = static_cast<double>(state.frame) * settings.step;
    frame.frame = state.frame;
    frame.time = state.time;

    SolverInput input{.bodies = pipeline.bodies(),
                      .motion = pipeline.motion(),
                      .gravity = pipeline.gravity(),
                      .substep = settings.substep(),
                      .broadphase = *world.m_broadphase,
                      .workers = world.m_workers,
                      .state = state,
                      .ledger = world.m_keepsLedger ? &frame.ledger : nullptr,
                      .parts = settings.substeps};
    world.m_stored.clear();
    if (world.m_keepsLedger) measureStored(pipeline, state, world.m_stored);
    const std::size_t storedBefore = world.m_stored.size();
    Loss loss;
    for (input.part = 0; input.part < input.parts && !loss; ++input.part) {
        const SolverReport report = world.m_solver->advance(input);
        add(frame, report, world.m_broadphase->counters());
        loss = report.loss;
    }

    if (loss) { // energy and momentum of a lost state are no numbers: those of the last frame stand
        world.m_health = {false, loss.body, state.frame, loss.quantity};
        frame.kinetic = before.kinetic;
        frame.potential = before.potential;
        frame.momentum = before.momentum;
        frame.ledger = {};
    } else {
        account(pipeline, state, world.m_workers, world.m_stored, frame);
        const std::span<const double> stored = world.m_stored;
        if (world.m_keepsLedger)
            closeLedger(pipeline, before, stored.first(storedBefore), stored.subspan(storedBefore), frame);
    }
    frame.simulate = wholeStep.elapsed();
}

} // namespace carom
