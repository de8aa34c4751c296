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
//     approach     stores the closing speeds of contacts without an impulse
//     warmStart    applies the impulses of the step before
//     solve        with feedback: overlaps are corrected by velocities, open contacts may close their gap
//     x += h v     by the caller, which adds to the displacements and updates the gaps
//     relax        without feedback: removes the velocities that position correction has added
//     rebound      contacts that closed at a speed and took an impulse separate at e times that speed; for
//                  balls one impact after another (ball_rows.h)
//     limit        reduces the rebound to what the kinetic energy allows (energy_limit.h)
//
//     legend   u = vB + ωB × rB − vA − ωA × rA   velocity of B's point relative to A's
//              s = s₀ + n · (displacement of B's point less A's)         separation
//     friction (first)   pₜ ← the nearest point of the disc of radius μ pₙ to pₜ − mₜ uₜ
//     normal             pₙ ← max(0, pₙ − c mₙ (uₙ + b) − f),  uₙ after the change by friction
//              s > 0     b = s/h, c = 1, f = 0
//              s ≤ 0     b = max(e rate s, −push), c and f = d pₙ those of a damped spring of angular
//                        frequency ω = 2π hardness/h and damping ratio ζ, implicit:
//                        rate = ω/(2ζ + hω),  c = k/(1 + k),  d = 1/(1 + k),  k = hω (2ζ + hω);
//                        but f ≤ c mₙ e rate y push, and e = min(1, mₙ w/pₙ), w = 10 |g| h + push/2
//     relax    s > 0 as above, and no change if pₙ is 0: the next step treats the contact; else b = 0, c = 1,
//              f = 0
//     rebound  as relax, and b = −e times the closing speed if that was stored and pₙ > 0
//
// Limits: the residual falls slowly in tall stacks and for large ratios of masses. Bodies at rest overlap: in
// a contact that carries n times the mass of the lighter one by about 2 n g h²/(hω)², and by no more than
// y push, where the spring would give way further. So ω is as large as stacks allow. One pass removes
// only a small part of the slow modes of a stack, and feedback must add less than that part, or they grow. In
// a column of n balls a pass takes E = (π/2n)² of the error of the slowest mode, and feedback the part r = h
// rate of a gap: motion is
//     s³ + 2E s² + (2 + r) E s + r E = 0  (per step),
// which decays for E > r/4 (Routh). Of the speed of a heavy body on a light one a pass takes about the part
// E = mₙ |g| h/pₙ, so where pₙ is that large feedback is made less, by e. Bodies that stand on faces sway,
// too, and that is solved more slowly. The spectral radius of a step of n cubes on each other, four points a
// face, three rows a point, all of them sticking, computed from the step as it is above (n = 4, 6, 8; ζ =
// 10):
//
//     hardness    one pass from the top   one from the ground   two from the top     there and back
//     .18         .987   .990   .995      .999   .993   .992    .970   .972   .992   .993   .988   .991
//     .22         .993   .996   .997      1.007  1.001  .996    .972   .980   .992   1.002  .997   .994
//     .25         .998   .999   .999                            .981   .986   .993
//     .27         .998   1.000  .999      1.014  1.008  1.002   .981   .988   .993   1.010  1.005  .999
//     .54, ζ 60   .998   1.003  1.004     1.006  1.008  1.007   .996   1.001  1.002  1.004  1.008  1.007
//
// So passes go from the top to the ground, always, and opposite points of a face come one after the other.

namespace carom {

struct StepSettings {
    double duration = 0; ///< h [s]
    /// A contact with an immobile body is twice as hard as one of two mobile ones. At half, overlaps at rest
    /// are four times as deep; from .27 on, stacks sway (table above).
    double hardness = 0.25;
    /// ζ. At twice, overlaps are corrected about half as fast; at half, about twice as fast, and columns of
    /// fewer balls sway (E > r/4 above).
    double damping = 10;
    double resting = 0; ///< closing speeds up to this do not rebound [m/s]
    /// y [s]; with the default, f is that of a spring under any load.
    double yield = 1e30;
    double fall = 0; ///< |g| h [m/s]; e depends on `push` alone where it is 0
};

/// Stores the closing speeds of rows without an impulse. True if there are any.
bool recordApproach(ContactRows& rows, std::span<const SolverBody> bodies, const StepSettings& settings,
                    Workers& workers = Workers::alone());
void warmStart(const ContactRows& rows, std::span<SolverBody> bodies, Workers& workers = Workers::alone());
/// Updates the gaps by `moved`, the displacements of all bodies since the rows were made.
void updateGaps(ContactRows& rows, std::span<const Displacement> moved, Workers& workers = Workers::alone());
/// The same of single groups.
void updateGaps(ContactRows& rows, std::span<const std::uint32_t> groups,
                std::span<const Displacement> moved);
/// One pass through the groups, forwards or `back`.
void solveVelocities(ContactRows& rows, std::span<SolverBody> bodies, const StepSettings& settings, bool back,
                     Workers& workers = Workers::alone());
/// Adds what feedback may have added to the energy of bodies, pₙ |b| of every overlap, to that of the two
/// whose number is larger [J]: 0 cannot move. After the last pass with feedback.
void addCorrection(const ContactRows& rows, const StepSettings& settings, std::span<double> to);
/// Rolling resistance after a pass: torques that oppose rolling, within what the normal impulses allow.
void resistRolling(ContactRows& rows, std::span<SolverBody> bodies);
/// Returns the largest change it made, as a speed [m/s]: the residual of the worst row when it was solved.
double relaxVelocities(ContactRows& rows, std::span<SolverBody> bodies, const StepSettings& settings,
                       bool back, Workers& workers = Workers::alone());
/// The bodies that a rebound reaches, by body: 1, or 1 more than the pass in which an impact of balls changed
/// it last. 0 for immobile bodies.
struct ActiveBodies {
    std::span<std::uint8_t> bodies;
    std::uint32_t immobile = 0;
};

/// The number of rows whose closing speeds recordApproach() stored and that have taken an impulse since.
/// Their bodies become active.
int activate(const ContactRows& rows, const ActiveBodies& active);
/// Makes these rows rebound. Rows without an active body are left unchanged; those that change by more than
/// `resting` activate their bodies. The impulses of rows that separate faster than `resting` are set to 0,
/// because they are no lasting forces.
void rebound(ContactRows& rows, std::span<SolverBody> bodies, const StepSettings& settings, int passes,
             const ActiveBodies& active, Workers& workers = Workers::alone());

} // namespace carom
