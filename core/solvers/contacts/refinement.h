// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/contact_constraint.h"
#include "core/dynamics/state.h"
#include "core/solvers/contacts/islands.h"

#include <cstdint>
#include <span>
#include <vector>

// The islands that are solved to the tolerance, with their impacts located, and the work that each may take.
// All others take the base path. Only the amount of work decides (work_budget.h):
//
//     budget     a floor, so that small scenes are as exact as can be, and a part for every body and contact
//     order      islands that are expected to cost least come first, while the budget lasts
//     share      an island may take the floor in a frame, whichever substep needs it, as long as the frame
//                has taken less than mostFloors of them (of many islands each takes less), or a few times
//                what it is expected to cost; with springs forSprings times as much
//     saved      what a frame does not use is saved for later, up to a limit, beside a larger sum that a run
//                begins with: an island that is nearly at rest may use it. Its forces cost much the first
//                time and are valid for long; of what was saved later it may use no more than a few times
//                that cost. One that is too large for the budget may, too, if none of it is faster than what
//                may be put to sleep and its part pays for that first time. If more is saved than that
//                needs, as in accurate runs, any other island may use it, too, by half as much after every
//                failed attempt: a quarter of it in a frame at most. Islands share it by the squares of
//                their expected cost, because large ones need it. The base path's work is paid from the same
//                budget, so bodies that move all the time save nothing.
//     presets    differ by the sums alone: `fast` has a quarter of all of them, `accurate` twelve times the
//                floor, and saves what 200 of its frames may take. What is nearly at rest, how fast the sum
//                of the start fades, and when creeping bodies sleep (calm.h) is the same in all
//     learned    an island that moves takes more for each pair, the more pairs it has. What such islands took
//                of late says whether a share will do; where they share a frame, those for which it will not
//                are not tried
//     springs    an island in which nothing touches is left to its integrator
//     unfinished what was not solved within its share is left to the base path and tried again after 1, 3, 7,
//                ... 63 substeps: for an island that moves all the time failed attempts become rare, one that
//                has just come to rest is solved from the forces of the base path
//     last       in accurate runs the end of the budget is for one part without located impacts, through the
//                rest of the substep; it is unfinished only if bodies would sink in or gain energy by that
//
// A frame's work is at most mostShares times the floor and mostOverrun times the budget, forSprings times
// that where there are springs, what was saved, the overrun of one step of each solver, and the base path.

namespace carom {

/// In operations. At twice of floor, perItem or burst, frames may take up to twice as long; at half, islands
/// are left to the base path that are refined now. At twice of start or saved, more large islands are solved
/// exactly as they come to rest; at half, fewer. At twice of forRest, less is left for islands that move.
struct RefinementBudget {
    double floor = 1e6;    ///< in a frame: about a millisecond
    double perItem = 200;  ///< and for every body and contact
    double start = 400e6;  ///< saved when a run begins; it decreases within some frames
    double saved = 40e6;   ///< saved later at most
    double forRest = 40e6; ///< up to this it is for islands nearly at rest, beyond it for any island
    double burst = 6e6;    ///< a frame takes at most so much of it, and of what is left of the start
};
/// The same for `effort` times the work, and with `reserve` times as much saved of it.
RefinementBudget budgetOf(double effort, double reserve);

/// What decides which islands of a substep are refined.
struct RefinementInput {
    const Bodies& bodies;
    const State& state;
    const Islands& islands;
    std::span<const BodyIndex> members;    ///< bodies of the islands, ascending
    std::span<const std::uint8_t> canMeet; ///< by pair, 1: its bodies may touch within the substep
    std::span<const std::uint8_t> joins;   ///< by island, not 0: it touches bodies of the base path
    std::span<const std::uint8_t> closed;  ///< by island, 1: it has a closed form and needs nothing
    Vec3 gravity;                          ///< [m/s²]
    double substep = 0;                    ///< [s]
    int part = 0, parts = 1;               ///< of the frame
};

class Refinement {
  public:
    struct Choice {
        std::uint32_t island = 0;
        double budget = 0; ///< operations
    };
    /// An island may take so many times what it was expected to. At half, more attempts fail; at twice,
    /// frames may exceed their budget by twice as much.
    static constexpr double mostOverrun = 4;
    /// An island may take at most what a frame has left of so many floors. At half, the second of two islands
    /// may find nothing left; at twice, a frame may take two floors more.
    static constexpr double mostFloors = 2;
    /// A frame takes so many floors at most, where all its islands come in one substep. Twice or half doubles
    /// or halves the longest frame of many islands, and what each of them may take.
    static constexpr double mostShares = 4;

    explicit Refinement(std::size_t bodies)
        : m_used(bodies, 0.0), m_moving(bodies, 0.0), m_wait(bodies, 0), m_failures(bodies, 0),
          m_stepped(bodies, 0), m_solved(bodies, 0), m_isLone(bodies, 0) {}

    void choose(const RefinementInput& input, const RefinementBudget& budget);
    /// Records the work of an island that was refined.
    void spend(const Island& island, double operations);
    /// Pays for the work of the substep [operations].
    void pay(double refined, double base);
    std::span<const Choice> refined() const { return m_refined; }     ///< ascending
    std::span<const std::uint32_t> stepped() const { return m_base; } ///< ascending
    /// In how many substeps an island that is stepped is to be tried again.
    std::uint8_t backOffOf(std::uint32_t island) const { return m_backOff[island]; }
    /// Whether a body is left to the base path for some substeps before it is tried again.
    bool waits(BodyIndex body) const { return m_wait[body] > 0; }
    /// A body has been on the base path for a substep.
    void waited(BodyIndex body) {
        if (m_wait[body] > 0) --m_wait[body];
    }
    /// Whether an island that is stepped is to be tried again before the frame ends.
    bool isTriedSoon(std::uint32_t island) const { return m_isTriedSoon[island] != 0; }
    /// Bodies that touch nothing within the substep and that no spring holds, ascending.
    std::span<const BodyIndex> lone() const { return m_lone; }

    /// The island's refinement was not finished, or was.
    void setBack(const Island& island);
    void succeeded(const Island& island) {
        for (const BodyIndex body : island.bodies) {
            m_failures[body] = 0;
            m_solved[body] = 1;
        }
    }
    /// Whether both bodies, as far as they can move, took the base path in the substep before.
    bool isStepped(const Bodies& bodies, BodyPair pair) const {
        return (bodies.mobile[pair.a] == 0 || m_stepped[pair.a] != 0) &&
               (bodies.mobile[pair.b] == 0 || m_stepped[pair.b] != 0);
    }
    bool isStepped(BodyIndex body) const { return m_stepped[body] != 0; }
    /// These bodies are asleep, or fly, from now on.
    void forget(std::span<const BodyIndex> bodies) {
        for (const BodyIndex body : bodies) m_stepped[body] = 0;
    }

    struct Memory {
        double saved = 0, learned = 0;
        std::vector<std::uint8_t> wait, failures, stepped, solved;

        std::size_t bytes() const { return heldBytes(wait, failures, stepped, solved); }
    };
    Memory memory() const { return {m_saved, m_learned, m_wait, m_failures, m_stepped, m_solved}; }
    void recall(const Memory& memory) {
        m_saved = memory.saved;
        m_learned = memory.learned;
        m_wait = memory.wait;
        m_failures = memory.failures;
        m_stepped = memory.stepped;
        m_solved = memory.solved;
    }

  private:
    struct Expected {
        double work = 0;
        std::uint32_t island = 0;
        double open = 0; ///< openTo
    };
    double findExpected(const RefinementInput& input);
    void shareOut(const RefinementInput& input, const RefinementBudget& budget);
    bool nearlyRests(const RefinementInput& input, const Island& island) const;
    /// Whether no body is faster than what may be put to sleep.
    bool isSlow(const RefinementInput& input, const Island& island) const;
    /// What the work of an island that moves is in proportion to, 0 of others.
    double movingWork(const RefinementInput& input, const Island& island, double expected) const;
    /// What an island takes that may be too large for the budget: more where its forces are not known.
    double wholeWork(const Island& island, double expected) const;
    /// What an island may use of what is saved, if no other does.
    double openTo(const RefinementInput& input, const RefinementBudget& budget, const Island& island,
                  double expected) const;

    double m_saved = -1;                  // operations; negative: the run begins
    double m_spent = 0;                   // operations in this frame
    double m_fromStart = 0;               // of the start, when this frame began
    double m_income = 0, m_most = 0;      // of the substep; saved up to
    double m_fades = 1;                   // what a substep leaves of what is saved beyond that
    double m_learned = 0;                 // what islands that move took of late, by m_moving
    std::vector<double> m_used;           // by body: operations its island took in this frame
    std::vector<double> m_moving;         // by first body of a refined island: movingWork
    std::vector<std::uint8_t> m_wait;     // by body: substeps for which its island is not tried
    std::vector<std::uint8_t> m_failures; // by body: failed attempts in a row
    std::vector<std::uint8_t> m_stepped;  // by body, 1: on the base path
    std::vector<std::uint8_t> m_solved;   // by body, 1: its island was refined to the end the last time
    std::vector<Choice> m_refined;
    std::vector<std::uint32_t> m_base;
    std::vector<std::uint8_t> m_backOff;     // by island [substeps]
    std::vector<std::uint8_t> m_isTriedSoon; // by island
    std::vector<BodyIndex> m_lone;
    std::vector<std::uint8_t> m_isLone; // by body
    std::vector<Expected> m_expected;
};

} // namespace carom
