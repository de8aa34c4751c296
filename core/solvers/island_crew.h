// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/island_motion.h"
#include "core/solvers/islands.h"
#include "core/solvers/solver.h"

#include <cstdint>
#include <span>
#include <vector>

// Moves the islands of a substep, side by side where there are several threads. Islands know nothing of each
// other: each is moved by one hand alone, and what the hands have done is collected in the order of islands.
// So the bits depend neither on the number of threads nor on who took what.

namespace carom {

class IslandCrew {
  public:
    /// Moves all islands but lone bodies that touch nothing. The contacts at the end of the substep, with
    /// their forces, become `kept`: pairs of `found`, in its order.
    void move(const SolverInput& input, const SolverSettings& settings, const Islands& islands,
              const ContactSet& found, ContactSet& kept);

    const MotionReport& report() const { return m_report; }
    /// The lone bodies that touch nothing, ascending.
    std::span<const BodyIndex> lone() const { return m_lone; }
    /// Islands that have not moved, ascending.
    std::span<const std::uint32_t> still() const { return m_still; }

  private:
    /// What one thread needs for itself.
    struct Hand {
        IslandMotion motion;
        SpringNetwork::Scratch room;
        ContactSet kept;
        std::vector<std::uint32_t> places; // by pair of kept: its index in found
    };
    /// What came of one island.
    struct Outcome {
        bool isStill = false;
        Loss loss;
        Ledger ledger;
    };
    struct Task;

    void share(const Islands& islands);
    void moveOne(const Task& task, std::uint32_t work, Hand& hand);
    void collect(const SolverInput& input, std::size_t pairs, ContactSet& kept);

    std::vector<Hand> m_hands; // by thread
    std::vector<BodyIndex> m_lone;
    std::vector<std::uint32_t> m_work;  // islands to be moved
    std::vector<std::uint32_t> m_batch; // of m_work: where each batch begins, and its end
    std::vector<Outcome> m_outcomes;    // by work
    std::vector<std::uint32_t> m_still;
    MotionReport m_report;
};

} // namespace carom
