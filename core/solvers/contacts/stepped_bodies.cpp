// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/stepped_bodies.h"

#include "core/base/shared_loops.h"
#include "core/dynamics/contact_memory.h"
#include "core/dynamics/free_rotation.h"
#include "core/math/rotation.h"
#include "core/solvers/contacts/manifolds.h"
#include "core/solvers/contacts/wide_bodies.h"

#include <algorithm>
#include <utility>

namespace carom {
namespace {

/// Effective masses are computed anew where turning may have changed a body's response to an impulse by this
/// part. A pass diverges where they are too large by 2 (it is then a relaxation by more than 2); at half,
/// they are computed anew twice as often.
constexpr double mostChange = 0.25;
/// Bodies that one thread lists at least.
constexpr std::size_t fewSpinning = Workers::enoughOf(3);

} // namespace

void SteppedBodies::begin() {
    m_solved.assign(1, {});
    m_places.assign(1, {});
    m_turnable.assign(1, {});
    m_turning.begin();
    m_moved.assign(1, {});
    m_free.assign(1, {});
    m_struck.assign(1, 0);
    m_forced.clear();
    forgetMoving();
}

void SteppedBodies::add(const SteppedInput& input, BodyIndex body) {
    SolverBody& to = m_solved.emplace_back();
    to.velocity = arrayOf(input.state.velocity[body]);
    to.spin = arrayOf(input.state.angularVelocity[body]);
    m_places.push_back({arrayOf(input.state.pose[body].position)});
    m_turnable.push_back(turnableOf(input.bodies.shape[body], input.bodies.boundingRadius[body]));
    m_turning.add(input.bodies, body, input.state);
    m_moved.emplace_back();
    m_free.emplace_back();
    m_struck.push_back(0);
}

void SteppedBodies::setMass(const SteppedInput& input, BodyIndex body, std::uint32_t number, bool isStill) {
    SolverBody& to = m_solved[number];
    to.inverseMass = isStill ? 0 : input.bodies.inverseMass[body];
    to.roundInverse = isStill || !isSphere(input.bodies, body) ? 0 : input.bodies.inverseInertia[body].x();
    const Vec3 principal = isStill ? Vec3(Vec3::Zero()) : input.bodies.inverseInertia[body];
    const Mat3 turn = isIsotropic(principal) ? Mat3(Mat3::Identity())
                                             : input.state.pose[body].orientation.toRotationMatrix();
    setInverseInertia(turn * principal.asDiagonal() * turn.transpose(), to);
}

void SteppedBodies::leave(std::span<const std::uint32_t> newNumbers, std::size_t kept) {
    for (std::uint32_t i = 1; i < m_solved.size(); ++i) {
        const std::uint32_t number = newNumbers[i];
        if (number == SteppedIslands::gone) continue;
        m_solved[number] = m_solved[i];
        m_places[number] = m_places[i];
        m_turnable[number] = m_turnable[i];
        m_turning.renumber(i, number);
    }
    m_solved.resize(kept);
    m_places.resize(kept);
    m_turnable.resize(kept);
    m_turning.resize(kept);
    m_moved.resize(kept);
    m_free.resize(kept);
    m_struck.resize(kept);
    forgetMoving();
}

bool SteppedBodies::isUnchanged(const State& state, const SteppedIslands& islands, Workers& workers) const {
    return !holdsForAny(m_solved.size() - 1, fewAwake, workers, [&](std::size_t k) {
        const std::size_t i = k + 1;
        const BodyIndex body = islands.bodyOf(i);
        return vectorOf(m_solved[i].velocity) != state.velocity[body] ||
               vectorOf(m_solved[i].spin) != state.angularVelocity[body] ||
               vectorOf(m_places[i].position) != state.pose[body].position ||
               m_turning.orientationOf(i).coeffs() != state.pose[body].orientation.coeffs();
    });
}

bool SteppedBodies::findMoving(std::span<const std::uint8_t> isStill, const PairEnds& ends,
                               const SteppedIslands& islands, Workers& workers) {
    if (std::exchange(m_moving.isKnown, true)) return false;
    m_isPaired.assign(m_solved.size(), 0);
    m_moving.pairs.resize(ends.all().size());
    std::uint8_t* const isPaired = m_isPaired.data();
    std::uint32_t* const list = m_moving.pairs.data();
    std::size_t pairs = 0;
    for (std::uint32_t number = 0; const auto& [a, b] : ends.all()) {
        const bool moves = (isStill[a] & isStill[b]) == 0;
        list[pairs] = number++;
        pairs += moves ? 1 : 0;
        if (moves) isPaired[a] = isPaired[b] = 1;
    }
    m_moving.pairs.resize(pairs);
    m_moving.clear();
    m_since.resize(m_solved.size());
    m_seenTurn.resize(m_solved.size());
    m_isFar.resize(m_solved.size(), 0);
    workers.forLists(
        m_solved.size() - 1, fewAwake, static_cast<MovingBodies&>(m_moving),
        [&](std::size_t begin, std::size_t end, MovingBodies& moving) {
            for (auto i = static_cast<std::uint32_t>(begin + 1); i <= end; ++i) {
                if (isStill[i] != 0) {
                    m_moved[i] = {};
                    m_since[i] = {};
                    continue;
                }
                moving.awake.push_back(i);
                moving.bodies.push_back(islands.bodyOf(i));
                if (m_isPaired[i] != 0) moving.paired.push_back(i);
            }
        },
        [this](const MovingBodies& part) { m_moving.append(part); });
    return true;
}

void SteppedBodies::noteMoved(const SteppedInput& input, const SteppedIslands& islands, double part,
                              double angle) {
    forEachOf(m_moving.paired, input.workers, [&](std::uint32_t i) {
        MovedSince& since = m_since[i];
        since.shift += vectorOf(m_moved[i].shift);
        since.turned = (vectorOf(m_moved[i].turn) - vectorOf(m_seenTurn[i].turn)).norm();
        since.moved = since.shift.norm();
        if (since.moved > part * input.bodies.boundingRadius[islands.bodyOf(i)] || since.turned > angle)
            m_isFar[i] = 1;
    });
}

void SteppedBodies::forgetMoved(Workers& workers) {
    forEachOf(m_moving.awake, workers, [&](std::uint32_t i) {
        const bool isFar = m_isFar[i] != 0;
        if (isFar)
            m_seenTurn[i] = {};
        else
            carom::add(m_seenTurn[i].turn, -vectorOf(m_moved[i].turn));
        if (isFar) m_since[i] = {};
        m_moved[i] = {};
        m_struck[i] = 0;
    });
    std::fill(m_isFar.begin(), m_isFar.end(), std::uint8_t{0});
}

void SteppedBodies::beginStep(const SteppedInput& input, const SteppedIslands& islands, double duration) {
    const Vec3 fall = duration * input.gravity;
    forEachOf(m_moving.awake, input.workers, [&](std::uint32_t i) {
        carom::add(m_solved[i].velocity, fall);
        m_free[i] = {.velocity = m_solved[i].velocity, .spin = m_solved[i].spin};
    });
    if (!input.bodies.forces.empty()) applyTerms(input, islands, duration);
}

// Applies force terms as if only they and gravity acted: as an impulse before those of the contacts.
void SteppedBodies::applyTerms(const SteppedInput& input, const SteppedIslands& islands, double duration) {
    m_forced.clear();
    for (const std::uint32_t i : m_moving.awake)
        if (const BodyIndex body = islands.bodyOf(i); input.bodies.forces.actOn(body))
            m_forced.add(i, input.bodies, input.state, body, duration);
    m_forced.solve(input.bodies.forces, input.gravity, duration);
    m_halfWays.assign(m_solved.size(), 0.5 * duration * duration * input.gravity);
    for (const ForcedSteps::Step& step : m_forced.steps()) {
        m_solved[step.owner].velocity = m_free[step.owner].velocity = arrayOf(step.after);
        m_halfWays[step.owner] = 0.5 * duration * (step.after - step.before);
    }
}

// Records the work of force terms, and takes it from the contacts' account, which holds the whole change.
void SteppedBodies::recordTerms(const SteppedInput& input) {
    for (ForcedSteps::Step& step : m_forced.steps()) {
        step.given = m_forced.impulseOf(step);
        step.after = vectorOf(m_solved[step.owner].velocity);
    }
    const LedgerEntry given = m_forced.record(input.bodies.forces, *input.ledger);
    LedgerEntry& contact = (*input.ledger)[LedgerAccount::Contact];
    contact.energy -= given.energy;
    contact.momentum -= given.momentum;
}

CAROM_WIDE void SteppedBodies::shift(const SteppedInput& input, const SteppedIslands& islands,
                                     double duration, std::span<const std::uint32_t> list) {
    const Vec3 half = 0.5 * duration * duration * input.gravity;
    for (const std::uint32_t i : list) {
        const SolverBody& from = m_solved[i];
        Displacement& moved = m_moved[i];
        Vec3 shift = duration * vectorOf(from.velocity);
        if (from.velocity == m_free[i].velocity)
            shift -= m_forced.isEmpty() ? half : m_halfWays[i];
        else
            m_struck[i] = 1;
        Vec3& position = input.state.pose[islands.bodyOf(i)].position;
        position += shift;
        m_places[i].position = arrayOf(position);
        carom::add(moved.shift, shift);
        const Vec3 spin = vectorOf(from.spin);
        carom::add(moved.turn, duration * spin);
        moved.angle += duration * spin.norm();
    }
}

bool SteppedBodies::move(const SteppedInput& input, const SteppedIslands& islands, double duration,
                         bool turnsBalls) {
    const std::span<const std::uint32_t> awake = m_moving.awake;
    input.workers.forRanges(awake.size(), fewAwake, [&](std::size_t begin, std::size_t end) {
        shift(input, islands, duration, awake.subspan(begin, end - begin));
    });
    m_turns.clear();
    const auto turns = [&](std::uint32_t i) {
        return vectorOf(m_solved[i].spin) != Vec3::Zero() && (turnsBalls || !(m_solved[i].roundInverse > 0));
    };
    input.workers.forLists(awake.size(), fewSpinning, static_cast<std::vector<std::uint32_t>&>(m_turns),
                           [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& list) {
                               for (const std::uint32_t i : awake.subspan(begin, end - begin))
                                   if (turns(i)) list.push_back(i);
                           });
    m_turning.turn(m_turns, duration, m_solved, input.workers);
    forEachOf(m_turns, input.workers, [&](std::uint32_t i) {
        input.state.pose[islands.bodyOf(i)].orientation = m_turning.orientationOf(i);
        input.state.angularMomentum[islands.bodyOf(i)] = m_turning.momentumOf(i);
    });
    return renewMasses(input.workers);
}

// A body that turns by φ changes its response to an impulse, along any direction, by at most φ (I₁/I₃ − 1) of
// it, with I₁ and I₃ its largest and least moment of inertia.
bool SteppedBodies::renewMasses(Workers& workers) {
    const auto hasTurned = [&](std::uint32_t i) {
        const Displacement& moved = m_moved[i];
        return (moved.angle - moved.renewed) * m_turning.unevennessOf(i) > mostChange;
    };
    if (!holdsForAny(m_turns.size(), fewSpinning, workers,
                     [&](std::size_t k) { return hasTurned(m_turns[k]); }))
        return false;
    m_hasTurned.assign(m_solved.size(), 0);
    forEachOf(m_turns, workers, [&](std::uint32_t i) {
        if (!hasTurned(i)) return;
        m_hasTurned[i] = 1;
        m_moved[i].renewed = m_moved[i].angle;
    });
    return true;
}

void SteppedBodies::turnBalls(const SteppedInput& input, const SteppedIslands& islands) {
    forEachOf(m_moving.awake, input.workers, [&](std::uint32_t i) {
        const Vec3 turn = vectorOf(m_moved[i].turn);
        if (!(m_solved[i].roundInverse > 0) || turn == Vec3::Zero()) return;
        Quat& orientation = input.state.pose[islands.bodyOf(i)].orientation;
        orientation = (fromRotationVector(turn) * orientation).normalized();
        m_turning.setOrientation(i, orientation);
    });
}

void SteppedBodies::store(const SteppedInput& input, const SteppedIslands& islands) {
    forEachOf(m_moving.awake, input.workers, [&](std::uint32_t i) {
        input.state.velocity[islands.bodyOf(i)] = vectorOf(m_solved[i].velocity);
        input.state.angularVelocity[islands.bodyOf(i)] = vectorOf(m_solved[i].spin);
    });
    if (input.ledger != nullptr && !m_forced.isEmpty()) recordTerms(input);
}

} // namespace carom
