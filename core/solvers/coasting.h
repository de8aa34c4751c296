// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/solver.h"

#include <span>
#include <vector>

// The motion of bodies without contacts, by the integrator alone.

namespace carom {

/// Moves the bodies of a network, which springs couple or force terms act on, and records what acted in the
/// audit.
void moveNetwork(const SolverInput& input, SpringNetwork& network, Ledger* ledger);

/// Moves bodies that touch nothing and that no spring holds, and records what acted in the audit.
class Coasting {
  public:
    void move(const SolverInput& input, std::span<const BodyIndex> bodies);

  private:
    std::vector<BodyIndex> m_ballistic, m_driven;
    SpringNetwork::Scratch m_room;
};

} // namespace carom
