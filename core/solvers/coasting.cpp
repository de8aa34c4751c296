// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/coasting.h"

#include "core/dynamics/energy.h"
#include "core/dynamics/free_rotation.h"

namespace carom {
namespace {

/// Bodies that one thread moves, at least.
constexpr std::size_t fewMoved = Workers::enoughOf(50);

/// Of bodies whose energy of rotation a free rotation may change by rounding [J]: not of balls.
double unevenSpinEnergy(const SolverInput& input, std::span<const BodyIndex> bodies) {
    double sum = 0;
    for (const BodyIndex i : bodies)
        if (!isIsotropic(input.bodies.inertia[i])) sum += spinEnergy(input.bodies, i, input.state);
    return sum;
}

void moveBallistic(const SolverInput& input, std::span<const BodyIndex> bodies) {
    double spinBefore = 0;
    Workers& several = bodies.size() < 2 * fewMoved ? Workers::alone() : input.workers;
    if (input.ledger != nullptr)
        several.forEach(2, [&](std::size_t, std::size_t which) { // sums in the order of the bodies
            if (which == 0)
                spinBefore = unevenSpinEnergy(input, bodies);
            else
                recordBallisticAdvance(input.bodies, bodies, {input.gravity, input.gravity, input.substep},
                                       input.state, *input.ledger);
        });
    input.workers.forRanges(bodies.size(), fewMoved, [&](std::size_t begin, std::size_t end) {
        const std::span<const BodyIndex> part = bodies.subspan(begin, end - begin);
        input.motion.move(part, input.gravity, input.substep, input.state);
        input.motion.rotateFreely(input.bodies, part, input.substep, input.state);
    });
    // Bodies with unequal moments keep their energy as well as the integrator can.
    if (input.ledger != nullptr)
        (*input.ledger)[LedgerAccount::Rotation].energy += unevenSpinEnergy(input, bodies) - spinBefore;
}

/// Power [W] and force [N] of one term on the bodies of a network.
LedgerEntry rateOf(const ForceTerm& term, SpringNetwork& network, const State& state) {
    SpringNetwork::Scratch& scratch = network.scratch;
    scratch.samples.clear();
    for (const BodyIndex i : network.moving)
        if (network.bodies.forces.actOn(i)) // where another term acts this one gives 0
            scratch.samples.push_back({i, state.pose[i], state.velocity[i], state.angularVelocity[i]});
    scratch.values.assign(scratch.samples.size(), ForceValue{});
    term.add(scratch.samples, scratch.values);
    LedgerEntry rate;
    for (std::size_t k = 0; k < scratch.samples.size(); ++k) {
        rate.energy += scratch.values[k].force.dot(scratch.samples[k].velocity);
        rate.momentum += scratch.values[k].force;
    }
    return rate;
}

void pass(double part, const LedgerEntry& amount, LedgerEntry& from, LedgerEntry& to) {
    from.energy -= part * amount.energy;
    from.momentum -= part * amount.momentum;
    to.energy += part * amount.energy;
    to.momentum += part * amount.momentum;
}

/// The account for what no other account of a network explains: the springs, else the last term.
LedgerAccount remainderOf(const SpringNetwork& network) {
    const bool isDriven = network.springs.empty() && !network.bodies.forces.empty();
    return isDriven ? network.bodies.forces.terms.back()->account() : LedgerAccount::Spring;
}

// Half of what each term gives in a step as it pushes now: the trapezoidal rule, called at both ends.
void recordTerms(const SolverInput& input, SpringNetwork& network, Ledger& ledger) {
    LedgerEntry& remainder = ledger[remainderOf(network)];
    for (const auto& term : network.bodies.forces.terms) {
        LedgerEntry& entry = ledger[term->account()];
        if (&entry != &remainder)
            pass(0.5 * input.substep, rateOf(*term, network, input.state), remainder, entry);
    }
}

} // namespace

void moveNetwork(const SolverInput& input, SpringNetwork& network, Ledger* ledger) {
    const auto move = network.springs.empty() ? input.motion.moveUnderForces : input.motion.moveOnSprings;
    if (ledger == nullptr) {
        move(network, input.substep, input.state);
        return;
    }
    const auto invariants = [&] {
        return invariantsOf(input.bodies, network.moving, input.state, input.gravity);
    };
    const Invariants before = invariants();
    const double spinBefore = spinEnergy(input.bodies, network.moving, input.state);
    recordTerms(input, network, *ledger);
    move(network, input.substep, input.state);
    recordTerms(input, network, *ledger);
    const LedgerAccount remainder = remainderOf(network);
    recordDifference(before, invariants(),
                     weightOf(input.bodies, network.moving, input.substep * input.gravity), remainder,
                     *ledger);
    if (!network.springs.empty()) return;
    // As in ballistic motion: forces at the centre turn nothing.
    const LedgerEntry turning{spinEnergy(input.bodies, network.moving, input.state) - spinBefore,
                              Vec3::Zero()};
    pass(1, turning, (*ledger)[remainder], (*ledger)[LedgerAccount::Rotation]);
}

void Coasting::move(const SolverInput& input, std::span<const BodyIndex> bodies) {
    if (input.bodies.forces.empty()) {
        moveBallistic(input, bodies);
        return;
    }
    m_ballistic.clear();
    m_driven.clear();
    for (const BodyIndex i : bodies) (input.bodies.forces.actOn(i) ? m_driven : m_ballistic).push_back(i);
    moveBallistic(input, m_ballistic);
    if (m_driven.empty()) return;
    SpringNetwork network{input.bodies, m_driven, {}, input.gravity, m_room};
    moveNetwork(input, network, input.ledger);
}

} // namespace carom
