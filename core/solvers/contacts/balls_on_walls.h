// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/contact_constraint.h"
#include "core/dynamics/ledger.h"
#include "core/solvers/contacts/islands.h"
#include "core/solvers/solver.h"

#include <cstdint>
#include <span>
#include <vector>

// Islands of one ball that meets one wall have a closed form. It costs less than a step of the base path, so
// they take it however many there are, and need no budget.
//
//     normal      any number of bounces, until they have ended (bounce_train.h); what lies on the wall stays
//     tangential  the impulse that would stop the slip of the surface, as far as friction goes,
//
//                     |P| ≤ μ N,   N = m (u₁ − u₀ + a h)     u along the normal, a of gravity, to the wall
//
//                 which is exact for a slip along a line: N does not depend on P. Rolling resistance takes
//                 what it can of the spin that an impact leaves.
//
// Left to others are balls that overlap the wall, which are to be moved out of it; those that force terms act
// on; and of those that lie on it the ones with rolling resistance, which changes what friction must do, and
// all in accurate runs, which locate when slip ends.

namespace carom {

class BallsOnWalls {
  public:
    struct Ball {
        std::uint32_t island = 0, pair = 0; ///< of the substep, into its islands and its pairs
        BodyIndex body = 0, wall = 0;
        double gap = 0;            ///< when the substep begins [m]
        double speed = 0;          ///< then, away from the wall [m/s]
        double pull = 0;           ///< of gravity, towards it [m/s²]
        bool lies = false;         ///< it does not part from the wall
        bool isStill = false;      ///< it had no velocity in the substep
        Vec3 force = Vec3::Zero(); ///< of the wall on one that lies, world [N]
    };

    /// Finds these islands among those of a substep. By pair, `canMeet`, 1: the two may touch within it.
    void find(const SolverInput& input, const SolverSettings& settings, const Islands& islands,
              std::span<const ContactPair> pairs, std::span<const std::uint8_t> canMeet);
    std::span<const std::uint8_t> isOne() const { return m_isOne; } ///< by island
    std::span<const Ball> balls() const { return m_balls; }         ///< ascending by island
    /// Moves them through the substep.
    void move(const SolverInput& input, const SolverSettings& settings, std::span<const ContactPair> pairs);

  private:
    std::vector<std::uint8_t> m_isOne;
    std::vector<Ball> m_balls;
    std::vector<Ledger> m_ledgers; // of some balls each
};

} // namespace carom
