// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/contacts/contact_rows.h"

#include <cstdint>
#include <span>

// Projected Gauss–Seidel over groups of four contacts, as sequential impulses with warm start (E. Catto,
// "Iterative dynamics with temporal coherence", 2005), once with soft position feedback and once without
// (E. Catto, "Solver2D", 2024). A step of length h of all bodies is
//
//     v += g h
//     approach     remembers how fast contacts without an impulse close
//     warmStart    applies the impulses of the step before
//     solve        with feedback: contacts that overlap are made to part, open ones may close as far as they
//                  are
//     x += h v     by the caller, who adds to the displacements
//     relax        without feedback: what parting added to the velocities is taken out again
//     rebound      contacts that closed at a speed and took an impulse part at e times that speed
//     limit        takes back of the rebound what the kinetic energy does not allow (energy_limit.h)
//
//     legend   u = vB + ωB × rB − vA − ωA × rA   velocity of B's point relative to A's
//              s = s₀ + n · (displacement of B's point less A's)         separation
//     friction (first)   pₜ ← the nearest point of the disc of radius μ pₙ to pₜ − mₜ uₜ
//     normal             pₙ ← max(0, pₙ − c mₙ (uₙ + b) − d pₙ),  uₙ with what friction has just changed
//              s > 0     b = s/h, c = 1, d = 0
//              s ≤ 0     b = max(rate s, −push), c and d those of a damped spring of angular frequency
//                        ω = 2π hardness/h and damping ratio ζ, implicit:
//                        rate = ω/(2ζ + hω),  c = k/(1 + k),  d = 1/(1 + k),  k = hω (2ζ + hω)
//     relax    s > 0 as above, and nothing where pₙ is 0: the next step has its turn; else b = 0, c = 1, d =
//     0 rebound  as relax, and b = −e times the closing speed where that was remembered and pₙ > 0
//
// Limits: the residual falls slowly in tall stacks and for large ratios of masses. What rests overlaps: a
// contact that carries n bodies by about 2 n g h²/(hω)². So ω is large. In a stack of n bodies the slowest
// mode loses only the part E = passes (π/2n)² of its error in a step, and what feedback adds must be less:
// with the part r = h rate of a gap that is taken back in a step, motion is
//     s³ + 2E s² + (2 + r) E s + r E = 0  (per step),
// which decays for E > r/4 (Routh). So ζ is larger still.

namespace carom {

struct StepSettings {
    double duration = 0;    ///< h [s]
    double hardness = 0.54; ///< of a contact with what cannot move twice as hard
    double damping = 60;    ///< ζ
    double resting = 0;     ///< closing speeds up to this do not rebound [m/s]
};

/// Remembers closing speeds of rows without an impulse. True if there are any.
bool recordApproach(ContactRows& rows, std::span<const SolverBody> bodies, const StepSettings& settings);
void warmStart(const ContactRows& rows, std::span<SolverBody> bodies);
/// One pass through the groups, there or `back`. `moved` is empty in the first step after the rows were made.
void solveVelocities(ContactRows& rows, std::span<SolverBody> bodies, std::span<const Displacement> moved,
                     const StepSettings& settings, bool back);
/// Rolling resistance after a pass: torques that oppose rolling, within what the normal impulses allow.
void resistRolling(ContactRows& rows, std::span<SolverBody> bodies);
/// The largest change it made, as a speed [m/s]: how far the worst row was from solved when its turn came.
double relaxVelocities(ContactRows& rows, std::span<SolverBody> bodies, std::span<const Displacement> moved,
                       const StepSettings& settings, bool back);
/// The bodies that a rebound reaches, by body 1; what cannot move is none of them.
struct Stirred {
    std::span<std::uint8_t> bodies;
    std::uint32_t immobile = 0;
};

/// The number of rows that recordApproach remembered and that took an impulse since. Their bodies are
/// stirred from then on.
int stir(const ContactRows& rows, const Stirred& stirred);
/// Makes them rebound. Rows of which no body is stirred are left as they are; those that change by more than
/// what rests stir their bodies. The impulses of those that part faster than what rests are forgotten: they
/// are no forces.
void rebound(ContactRows& rows, std::span<SolverBody> bodies, std::span<const Displacement> moved,
             const StepSettings& settings, int passes, const Stirred& stirred);

} // namespace carom
