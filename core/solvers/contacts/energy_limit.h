// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/workers.h"
#include "core/solvers/contacts/solver_body.h"

#include <cstdint>
#include <span>
#include <vector>

// Newton's law of impact for several contacts at once may gain energy, all the more as few passes do not
// solve it. So the change of velocities by restitution, from v to v + Δv, is scaled so that the kinetic
// energy T of the island does not increase:
//
//     v + s Δv,   the largest s ≤ 1 with  T(v + s Δv) ≤ limit
//
// No contact closes by that: all separate at s = 0 and at s = 1.

namespace carom {

/// Of a body that can move [J].
double kineticEnergyOf(const SolverBody& body);

/// The velocities of bodies of a list, by number.
void copyVelocities(std::span<const SolverBody> bodies, std::span<const std::uint32_t> list,
                    std::vector<BodyVelocity>& to, Workers& workers = Workers::alone());
/// About twice the energy that each body of a list has gained since it had the velocities `before`, less that
/// of the speed whose square is `resting` [J]: as if it were a ball.
void findGains(std::span<const SolverBody> bodies, std::span<const BodyVelocity> before,
               std::span<const std::uint32_t> list, double resting, std::vector<double>& to,
               Workers& workers = Workers::alone());

class EnergyLimit {
  public:
    /// Those that can move, and the island of every body.
    struct Members {
        std::span<const std::uint32_t> list, islandOf;
    };
    /// The limit of an island is the kinetic energy its bodies have now.
    void remember(std::span<const SolverBody> bodies, const Members& of, std::size_t islands,
                  Workers& workers = Workers::alone());
    /// The same with the velocities they had `before`.
    void remember(std::span<const SolverBody> bodies, std::span<const BodyVelocity> before, const Members& of,
                  std::size_t islands, Workers& workers = Workers::alone());
    /// Raises the limit of an island by what springs do to it [J].
    void allow(std::uint32_t island, double work) { m_sums[island].limit += work; }
    /// Takes bodies back towards `before`, by as little as keeps every island within its limit. True if any
    /// had to go back.
    bool keep(std::span<const BodyVelocity> before, const Members& of, std::span<SolverBody> bodies,
              Workers& workers = Workers::alone());
    /// How much of its change of velocity the last call left an island: s.
    double partOf(std::uint32_t island) const { return m_sums[island].part; }

  private:
    struct Sums {
        double limit = 0, before = 0, between = 0, after = 0; // [J]; between: ½ Σ v · M (v + Δv)
        double part = 1;                                      // s
    };
    /// The velocities of a product: now in both places, before in both, or one in each.
    enum class Times { Now, Before, Between };
    /// Adds ½ v · M v' of every member to its island's sum.
    void addUp(Times times, std::span<const SolverBody> bodies, std::span<const BodyVelocity> before,
               const Members& of, Workers& workers, double Sums::*to);

    std::vector<Sums> m_sums;       // by island
    std::vector<double> m_products; // by place in the list
};

} // namespace carom
