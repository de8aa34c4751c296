// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/contacts/island_motion.h"
#include "core/solvers/contacts/islands.h"
#include "core/solvers/contacts/refinement.h"
#include "core/solvers/solver.h"

#include <cstdint>
#include <span>
#include <vector>

// Moves the islands of a substep, side by side where there are several threads. Islands are independent: each
// is moved by one worker, and results are collected in the order of islands. So the bits depend neither on
// the number of threads nor on which worker moved which island.

namespace carom {

class IslandScheduler {
  public:
    /// An island whose budget has ended, or whose forces were not found.
    struct Unfinished {
        std::uint32_t island = 0;
        double left = 0; ///< of the substep [s]
    };

    /// Moves the chosen islands, each within its budget. The contacts at the end of the substep, with
    /// their forces, become `kept`: pairs of `found`, in its order.
    void move(const SolverInput& input, const SolverSettings& settings, const Islands& islands,
              std::span<const Refinement::Choice> chosen, const ContactSet& found, ContactSet& kept);

    const MotionReport& report() const { return m_report; }
    std::span<const Unfinished> unfinished() const { return m_unfinished; } ///< ascending
    std::span<const std::uint32_t> finished() const { return m_finished; }  ///< ascending
    /// What each of the chosen took, as its budget was given; ascending.
    std::span<const Refinement::Choice> spent() const { return m_spent; }
    /// Islands that have not moved, ascending.
    std::span<const std::uint32_t> still() const { return m_still; }

  private:
    /// What one thread needs for itself.
    struct Worker {
        IslandMotion motion;
        SpringNetwork::Scratch room;
        ContactSet kept;
        std::vector<std::uint32_t> places; // by pair of kept: its index in found
    };
    /// What came of one island.
    struct Outcome {
        bool isStill = false;
        double left = 0;  // [s]
        double spent = 0; // operations
        Loss loss;
        Ledger ledger;
    };
    struct Task;

    void share(const Islands& islands, std::span<const Refinement::Choice> chosen);
    void moveOne(const Task& task, std::uint32_t work, Worker& worker);
    void collect(const SolverInput& input, std::size_t pairs, ContactSet& kept);

    std::vector<Worker> m_workers;          // by thread
    std::vector<Refinement::Choice> m_work; // islands to be moved
    std::vector<Unfinished> m_unfinished;
    std::vector<std::uint32_t> m_finished;
    std::vector<Refinement::Choice> m_spent;
    std::vector<std::uint32_t> m_batch; // of m_work: where each batch begins, and its end
    std::vector<Outcome> m_outcomes;    // by work
    std::vector<std::uint32_t> m_still;
    MotionReport m_report;
};

} // namespace carom
