// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/world.h"

#include "core/base/clock.h"
#include "core/dynamics/energy.h"

#include <algorithm>

namespace carom {
namespace {

// Counts add up over a frame's substeps; what the broad-phase holds is what it held last.
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

// Potential energy belongs to gravity, to springs and to corrected positions; what is then left of the change
// of the state is unexplained.
void closeLedger(const Invariants& before, double stored, FrameStatistics& frame) {
    Ledger& ledger = frame.ledger;
    const double rise = frame.potential - before.potential - stored;
    ledger[LedgerAccount::Gravity].energy += rise - ledger.lifted;
    ledger[LedgerAccount::Parting].energy += ledger.lifted;
    ledger[LedgerAccount::Spring].energy += stored;
    const LedgerEntry total = ledger.total();
    frame.unexplained.energy =
        frame.kinetic - before.kinetic + (frame.potential - before.potential) - total.energy;
    frame.unexplained.momentum = frame.momentum - before.momentum - total.momentum;
}

} // namespace

void account(const Pipeline& pipeline, const State& state, FrameStatistics& frame) {
    const Invariants invariants = invariantsOf(pipeline.bodies(), state, pipeline.gravity());
    frame.kinetic = invariants.kinetic;
    frame.potential = invariants.potential;
    frame.momentum = invariants.momentum;
    const std::vector<SpringForce>& springs = pipeline.bodies().springs;
    if (!springs.empty()) frame.potential += springEnergy(springs, state);
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
    const double stored = world.m_keepsLedger ? springEnergy(pipeline.bodies().springs, state) : 0;
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
        account(pipeline, state, frame);
        if (world.m_keepsLedger)
            closeLedger(before, springEnergy(pipeline.bodies().springs, state) - stored, frame);
    }
    frame.simulate = wholeStep.elapsed();
}

} // namespace carom
