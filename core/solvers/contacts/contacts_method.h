// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/contacts/contacts.h"

#include "core/base/clock.h"
#include "core/dynamics/contact_memory.h"
#include "core/shapes/manifold.h"
#include "core/solvers/coasting.h"
#include "core/solvers/contacts/balls_on_walls.h"
#include "core/solvers/contacts/base_path.h"
#include "core/solvers/contacts/calm.h"
#include "core/solvers/contacts/candidates.h"
#include "core/solvers/contacts/contact_settings.h"
#include "core/solvers/contacts/found_contacts.h"
#include "core/solvers/contacts/free_flight.h"
#include "core/solvers/contacts/impulse_reach.h"
#include "core/solvers/contacts/island_scheduler.h"
#include "core/solvers/contacts/islands.h"
#include "core/solvers/contacts/manifolds.h"
#include "core/solvers/contacts/neighbours.h"
#include "core/solvers/contacts/pair_sort.h"
#include "core/solvers/contacts/refinement.h"
#include "core/solvers/contacts/sleeping_bodies.h"
#include "core/solvers/contacts/work_budget.h"

#include <algorithm>
#include <utility>
#include <vector>

// The method `contacts`: bodies are rigid, and contacts are constraints solved for, not collisions counted.
// A substep, in order:
//
//     free flight  bodies that nothing can strike are left out (free_flight.h)
//     neighbours   the pairs that can touch within it (neighbours.h, candidates.h)
//     contacts     where they touch: carried along where they can be (manifolds.h)
//     islands      bodies that contacts or springs join; solved independently (islands.h)
//     closed form  islands of one ball and one wall (balls_on_walls.h)
//     refinement   which of the others the budget allows to be solved to the tolerance, with impacts located
//                  (refinement.h, island_motion.h)
//     base path    all others, as long as their pairs are valid: sweeps at a cost known beforehand
//                  (base_path.h); and what refinement has left of its substep where the budget ended
//     sleeping     islands at rest are left alone until something may touch them (sleeping_bodies.h)
//     the rest     bodies that touch nothing, and those on springs among them: the integrator moves them
//
// Order and determinism: pairs ascend by (smaller index, larger index) with walls among them, islands by
// their first body, contact points as the narrow phase gives them, and indices are canonical
// (local_solver.h). Nothing depends on the broad-phase chosen, nor on the order of declarations.

namespace carom {

/// Bodies that stay on the base path may move by this part of their size beyond what they need in a frame
/// before their neighbours are found anew. At half, that happens more often; at twice, they hold more pairs.
inline constexpr double lastingSkin = 0.05;

class Contacts final : public Solver {
  public:
    Contacts(const Bodies& bodies, const SolverSettings& settings)
        : m_bodies(bodies), m_settings(settings), m_neighbours(bodies), m_sleeping(bodies.count()),
          m_flight(bodies), m_candidates(bodies), m_reach(bodies.count()), m_refinement(bodies.count()),
          m_base(bodies.count(), passesOf(settings)), m_backOff(bodies.count(), 0),
          m_brief(bodies.count(), passesOf(settings)), m_calm(bodies), m_slowest(bodies.count(), 0.0) {
        for (const SpringForce& spring : bodies.springs) m_links.push_back({spring.from, spring.to});
    }

    SolverReport advance(const SolverInput& input) override;
    ContactSet contacts(const State& state) const override;
    std::unique_ptr<const SolverMemory> memory() const override;
    void recall(const SolverMemory& memory) override;

  private:
    /// What outlasts a substep besides the state.
    struct Persistent {
        ContactSet contacts; // of refined islands
        SleepingBodies sleeping;
        Manifolds manifolds; // of the base path
        BasePath base;
        std::vector<std::uint8_t> backOff;
        Refinement::Memory refinement;
        std::vector<Calm::Stay> calm;

        std::size_t bytes() const {
            return heldBytes(contacts, sleeping, manifolds, base, backOff, refinement, calm);
        }
    };
    SolverReport rest(const SolverInput& input);
    SolverReport move(const SolverInput& input);
    void findMembers(const SolverInput& input);
    void listMembers(const SolverInput& input);
    void listActive(const SolverInput& input);
    bool maySettle(BodyIndex body) const;
    void wakeMoved(const SolverInput& input);
    void joinReached(const SolverInput& input);
    void wakeChanged();
    void insert(std::span<const BodyIndex> bodies, std::vector<BodyIndex>& to);
    void wakeTouched(const SolverInput& input, std::span<const BodyIndex> members);
    void addMembers(const SolverInput& input, std::span<const BodyIndex> bodies);
    void coverMembers(const SolverInput& input);
    void findContacts(const SolverInput& input);
    bool findJoining(const SolverInput& input);
    void enterBase(const SolverInput& input);
    void passBriefly(const SolverInput& input, const Island& island);
    void enterForFrames(const SolverInput& input);
    void leaveMarked(const SolverInput& input);
    void sleepWhatRests(const SolverInput& input);
    template<class Is>
    void sleepMarked(const SolverInput& input, const Is& isCalm);
    void moveRefined(const SolverInput& input, SolverReport& report);
    void moveBalls(const SolverInput& input, SolverReport& report);
    void sleepIfCreeping(const SolverInput& input, const Island& island, bool isLast);
    void fallAsleep(std::span<const BodyIndex> bodies);
    void moveStepped(const SolverInput& input, SolverReport& report);
    void stepIsland(const SolverInput& input, const Island& island, double duration, SolverReport& report);
    void putToSleep(const SolverInput& input, const Island& island);
    SteppedInput stepped(const SolverInput& input) const {
        return {.bodies = input.bodies,
                .gravity = input.gravity,
                .state = input.state,
                .ledger = input.ledger,
                .tolerance = m_settings.tolerance * input.gravity.norm() * input.substep,
                .isFirst = input.part == 0,
                .workers = input.workers};
    }
    static int passesOf(const SolverSettings& settings) {
        return std::max(1, settings.iterations / iterationsOfOnePass);
    }
    RefinementBudget budget() const { return budgetOf(m_settings.effort, m_settings.reserve); }
    void take(const SteppedReport& stepped, SolverReport& report);
    double baseOperations() const;
    /// `time` [s] and what an impact in its last substep may add, because it can speed bodies up.
    static double reachTime(const SolverInput& input, double time) {
        return time + (Neighbours::reachFactor - 1) * input.substep;
    }
    ManifoldInput here(const SolverInput& input) const {
        return {input.bodies, input.state, input.gravity, input.substep};
    }

    const Bodies& m_bodies;
    SolverSettings m_settings;
    Neighbours m_neighbours;
    SleepingBodies m_sleeping;
    FreeFlight m_flight;
    Candidates m_candidates;
    ImpulseReach m_reach;
    Refinement m_refinement;
    BasePath m_base;                     // for many frames, while its pairs are valid
    std::vector<std::uint8_t> m_backOff; // by body of m_base: substeps until its island is tried again
    BasePath m_brief;                    // for one substep
    Calm m_calm;
    std::vector<double> m_slowest;     // by body on a spring on the base path: τ of its island [s]
    std::vector<BodyIndex> m_members;  // mobile bodies that neither sleep nor fly
    std::vector<BodyIndex> m_active;   // of these, ascending: those that have not settled
    double m_substep = 0, m_frame = 0; // when those settled that have [s]
    std::vector<BodyIndex> m_entering, m_passing, m_woken, m_met, m_changed, m_joined, m_leaving;
    std::vector<Island> m_brieflyHere; // islands of m_brief
    std::vector<SteppedMotion::Entry> m_brieflyPaired;
    std::vector<BodyPair> m_links;     // the ends of springs
    ContactSet m_contacts;             // of refined islands, from the last substep
    FoundContacts m_found;             // of the substep
    ContactSet m_kept;                 // of refined islands, at its end
    std::vector<std::uint8_t> m_joins; // by island: the block of the base path it touches, or 0
    std::vector<BodyPair> m_pairs;
    std::span<Manifolds::Entry> m_known;
    std::vector<Manifolds::Entry> m_left; // of what has left the base path
    PairSort<Manifolds::Entry> m_sort;
    std::vector<SteppedMotion::Entry> m_unused;
    Islands m_islands;
    BallsOnWalls m_balls;
    IslandScheduler m_scheduler;
    SteppedMotion m_rest; // of a substep that refinement left unfinished
    Coasting m_coasting;
    WorkCounters m_work; // of this substep
    Stopwatch m_watch;   // goes on from substep to substep: reading it costs as much as a tiny phase
};

} // namespace carom
