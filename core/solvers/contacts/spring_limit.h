// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"
#include "core/solvers/contacts/solver_body.h"

#include <cstdint>
#include <span>
#include <vector>

// A few passes do not solve for springs that share bodies, and where these are stiff, the remaining error
// moves the bodies to where the springs store many times the energy that there was. After some passes more,
// an island with springs moves in a step only as far as its energy allows:
//
//     x + h (v̄ + s (v − v̄))   the largest s ≤ 1 with  T(s) + V(s) <= T₀ + V₀ + W
//
//     legend   v, T, V  velocities, kinetic energy, energy of the springs; T₀ with what gravity has added
//              v̄  the motion of the island as a whole, 0 if anything fixed holds it;  h  the step [s]
//              W  what position correction may add: Σ pₙ |b| of overlaps (velocity_solve.h)
//
// There is such an s, since V(0) = V₀. Contacts that are open at v stay so: at s = 0 nothing closes. At the
// end of the step the same is done with the velocities alone, to which V has been added as it then is.

namespace carom {

struct SpringIslands {
    const Bodies& bodies;
    const State& state;
    std::span<const std::uint32_t> springs;  ///< of the scene
    std::span<const std::uint32_t> local;    ///< by body of the scene: its number below, 0 if it cannot move
    std::span<const std::uint32_t> islandOf; ///< by number
    std::size_t islands = 0;
};

class SpringLimit {
  public:
    /// The energy that islands have now is their limit.
    void remember(const SpringIslands& input, std::span<const SolverBody> bodies);
    /// Raises the limit of the island of each body by what position correction may add there [J], by number.
    void allow(const SpringIslands& input, std::span<const double> added);
    /// Something fixed touches a body of the island.
    void hold(std::uint32_t island) { m_sums[island].isHeld = true; }
    /// Whether an island would exceed its limit when it has moved for `duration` [s].
    bool isExceeded(const SpringIslands& input, double duration, std::span<const SolverBody> bodies);
    /// Slows bodies down until no island exceeds its limit when it has moved for `duration` [s].
    void keep(const SpringIslands& input, double duration, std::span<SolverBody> bodies);

  private:
    struct Sums {
        bool hasSprings = false, isHeld = false, exceeds = false;
        double limit = 0, energy = 0;         // [J]
        double mass = 0;                      // [kg]
        Vec3 drift = Vec3::Zero();            // v̄ [m/s]
        double part = 1, least = 0, most = 1; // s, and where it is
    };
    void findEnergies(const SpringIslands& input, double duration, std::span<const SolverBody> bodies);
    SolverBody slowed(const SpringIslands& input, std::span<const SolverBody> bodies, std::size_t body) const;

    std::vector<Sums> m_sums; // by island
};

} // namespace carom
