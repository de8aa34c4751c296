// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/scratch.h"
#include "core/dynamics/forced_steps.h"
#include "core/solvers/contacts/ball_rows.h"
#include "core/solvers/contacts/pair_ends.h"
#include "core/solvers/contacts/solver_body.h"
#include "core/solvers/contacts/stepped_input.h"
#include "core/solvers/contacts/stepped_islands.h"
#include "core/solvers/contacts/turning_bodies.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// The bodies of a block of the base path as the solve has them, by number (stepped_islands.h), and how they
// move in a step:
//
//     beginStep   gravity and force terms change the velocities: those are `free`
//     ...         impulses change them
//     move        a body without any impulse moves by the mean of the velocities at both ends of the step,
//     the
//                 others by the velocity at its end
//     turnBalls   when the look ends: contacts of balls need no orientation
//     store       velocities
//
// How far a body has come is counted from the last look on, and from where its contacts were found, which may
// have been at one before.

namespace carom {

/// How far a body has moved since its contacts were found.
struct MovedSince {
    Vec3 shift = Vec3::Zero();    ///< of its centre [m]
    double moved = 0, turned = 0; ///< the size of that [m], and the angle [rad]
};

/// What moves: known until bodies or pairs come or go, or other bodies stand still. As long as it is known,
/// what is kept by number of the others is 0.
struct MovingBodies {
    std::vector<std::uint32_t> awake;  ///< numbers of those that do not stand still
    std::vector<BodyIndex> bodies;     ///< these
    std::vector<std::uint32_t> pairs;  ///< that are not of balls, of which one moves
    std::vector<std::uint32_t> paired; ///< numbers of those awake in such pairs
    bool isKnown = false;

    void clear() {
        for (std::vector<std::uint32_t>* list : {&awake, &paired}) list->clear();
        bodies.clear();
    }
    /// Those after these, but for the pairs.
    void append(const MovingBodies& later) {
        awake.insert(awake.end(), later.awake.begin(), later.awake.end());
        bodies.insert(bodies.end(), later.bodies.begin(), later.bodies.end());
        paired.insert(paired.end(), later.paired.begin(), later.paired.end());
    }
};

class SteppedBodies {
  public:
    static constexpr std::size_t fewAwake = Workers::enoughOf(10); ///< that one thread moves at least

    /// Number 0 only.
    void begin();
    /// The next number. It has no mass yet.
    void add(const SteppedInput& input, BodyIndex body);
    /// A body that stands still has no inverse mass.
    void setMass(const SteppedInput& input, BodyIndex body, std::uint32_t number, bool isStill);
    void stop(std::uint32_t number) { m_solved[number].velocity = m_solved[number].spin = {}; }
    /// Those with a new number keep all but how far they have moved.
    void leave(std::span<const std::uint32_t> newNumbers, std::size_t kept);
    /// Whether the bodies are where, and as fast as, the last step left them.
    bool isUnchanged(const State& state, const SteppedIslands& islands, Workers& workers) const;

    std::span<SolverBody> solved() { return m_solved; }
    std::span<const SolverBody> solved() const { return m_solved; }
    std::span<const BodyPlace> places() const { return m_places; }
    /// Velocities before the impulses of the step.
    std::span<const BodyVelocity> free() const { return m_free; }
    std::span<Turnable> turnable() { return m_turnable; }
    /// Since the last look.
    std::span<Displacement> moved() { return m_moved; }
    std::span<const Displacement> moved() const { return m_moved; }
    /// Since contacts were found; of its turning, less what `moved` has.
    std::span<const MovedSince> since() const { return m_since; }
    std::span<SeenTurn> seenTurn() { return m_seenTurn; }
    /// Its contacts must be found anew at the next look.
    void noteFar(std::uint32_t number) {
        m_isFar.resize(m_solved.size(), 0);
        m_isFar[number] = 1;
    }
    /// The same of all that move of which is(number) holds.
    template<class Is>
    void noteFarWhere(const Is& is, Workers& workers) {
        forEachOf(m_moving.awake, workers, [&](std::uint32_t i) {
            if (is(i)) m_isFar[i] = 1;
        });
    }
    bool isFar(std::uint32_t number) const { return m_isFar[number] != 0; }
    /// An impulse has acted on it since the last look, this step included.
    bool isStruck(std::uint32_t number) const {
        return m_struck[number] != 0 || m_solved[number].velocity != m_free[number].velocity;
    }

    /// Bodies or pairs come or go, get other numbers, or begin or cease to stand still.
    void forgetMoving() { m_moving.isKnown = false; }
    bool isMovingKnown() const { return m_moving.isKnown; }
    const MovingBodies& moving() const { return m_moving; }
    /// Lists what moves. False if it was known.
    bool findMoving(std::span<const std::uint8_t> isStill, const PairEnds& ends,
                    const SteppedIslands& islands, Workers& workers);
    /// Calls work(number) for all bodies of a list.
    template<class Work>
    static void forEachOf(std::span<const std::uint32_t> list, Workers& workers, const Work& work) {
        workers.forRanges(list.size(), fewAwake, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) work(list[i]);
        });
    }

    /// A look: notes how far bodies have come, and which have come further than these parts of their size and
    /// angle [rad].
    void noteMoved(const SteppedInput& input, const SteppedIslands& islands, double part, double angle);
    /// They have not moved since this look.
    void forgetMoved(Workers& workers);

    void beginStep(const SteppedInput& input, const SteppedIslands& islands, double duration);
    /// True if the effective masses of rows with a body that `hasTurned` must be computed anew.
    bool move(const SteppedInput& input, const SteppedIslands& islands, double duration, bool turnsBalls);
    std::span<const std::uint8_t> hasTurned() const { return m_hasTurned; }
    void turnBalls(const SteppedInput& input, const SteppedIslands& islands);
    void store(const SteppedInput& input, const SteppedIslands& islands);
    std::size_t bytes() const {
        return heldBytes(m_solved, m_places, m_turnable, m_turning, m_moved, m_free, m_struck);
    }

  private:
    void applyTerms(const SteppedInput& input, const SteppedIslands& islands, double duration);
    void recordTerms(const SteppedInput& input);
    void shift(const SteppedInput& input, const SteppedIslands& islands, double duration,
               std::span<const std::uint32_t> list);
    bool renewMasses(Workers& workers);

    std::vector<SolverBody> m_solved;
    std::vector<BodyPlace> m_places;
    std::vector<Turnable> m_turnable;
    TurningBodies m_turning;
    std::vector<Displacement> m_moved;
    std::vector<BodyVelocity> m_free;
    std::vector<std::uint8_t> m_struck; // in a step since the last look
    Scratch<std::vector<MovedSince>> m_since;
    Scratch<std::vector<SeenTurn>> m_seenTurn;
    Scratch<std::vector<std::uint8_t>> m_isFar;
    Derived<MovingBodies> m_moving;
    Scratch<std::vector<std::uint8_t>> m_isPaired;  // in a pair of which one moves
    Scratch<std::vector<std::uint32_t>> m_turns;    // numbers of those that turn in the step
    Scratch<std::vector<std::uint8_t>> m_hasTurned; // since the rows had their effective masses
    Scratch<ForcedSteps> m_forced;         // of the bodies that force terms act on; owners are their numbers
    Scratch<std::vector<Vec3>> m_halfWays; // what its last velocity adds too much, with terms
};

} // namespace carom
