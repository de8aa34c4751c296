// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/contacts/contact_problem.h"

#include <cstddef>
#include <vector>

// Projected block Gauss–Seidel on the impulses (M. Jean, J.-J. Moreau, "Unilaterality and dry friction in the
// dynamics of rigid body collections", 1992; as sequential impulses with warm start E. Catto, "Iterative
// dynamics with temporal coherence", 2005): contact after contact, each made right while the others stand.
//
//     normal     pₙ ← max(0, pₙ − mₙ (uₙ + b)),  mₙ = 1/Wₙₙ
//     tangents   pₜ ← the nearest point of the disc of radius μ pₙ to pₜ − mₜ uₜ
//
// Between sweeps all impulses go on in the directions they took before, as conjugate gradients do (M.
// Silcowitz, S. Niebe, K. Erleben, "A nonsmooth nonlinear conjugate gradient method for interactive contact
// force problems", 2010): with δ the change of a sweep,
//
//     β = |δ|²/|δ before|², in the sense of energy;  p += β d,  d ← β d + δ;  none, and d = δ, where β > 1
//
// A wall of stones gets in 20 sweeps as far as in some hundred without. Not where contacts roll with
// resistance.
//
// The yardstick for Newton's method: slow, obvious, and right where it converges.

namespace carom {

class GaussSeidelSolver {
  public:
    /// Sweeps until the largest change of a sweep, as a speed, is below `tolerance` [m/s], at most `sweeps`
    /// times. Impulses are the start on entry; velocities are those of the impulses afterwards.
    /// The last sweep's largest change [m/s].
    double solve(ContactProblem& problem, double tolerance, int sweeps);

  private:
    struct Row { // what a sweep touches of a contact, packed
        int a = immobile, b = immobile;
        Mat3 frame;
        Vec3 armA, armB;
        Vec3 coupling; // first column of W: what a normal impulse does to u
        double bound, friction, massNormal, massTangent;
        Vec3 impulse;
    };
    struct Body {
        Vec3 linear, angular;
        double inverseMass;
        Mat3 inverseInertia;
    };

    /// What a sweep changed and what it goes on along: by row impulses, by body velocities.
    struct Course {
        std::vector<Vec3> impulse, linear, angular;
        double size = 0; ///< of the last change, as an energy [J]
    };

    void load(const ContactProblem& problem);
    void beginSweep();
    void goOn(bool first);
    double relax(Row& row);
    double relaxRolling(ContactProblem& problem, std::size_t index);

    std::vector<Row> m_rows;
    std::vector<Body> m_bodies;
    Course m_before; // the sweep
    Course m_along;
};

} // namespace carom
