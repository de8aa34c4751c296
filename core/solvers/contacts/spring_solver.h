// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/contacts/block_matrix.h"
#include "core/solvers/contacts/contact_problem.h"

#include <span>
#include <vector>

// Springs that nothing touches: one step of Newton's method for the velocities v they lead to,
//
//     M (v − v̂) = Jᵀ p(J v)        (M + Jᵀ A J) Δ = M (v̂ − v) + Jᵀ p      A = −∂p/∂u
//
// with the whole derivative A of every spring. It is not symmetric, and of a spring that is pushed together
// not positive: there is nothing to minimise, as with contacts (newton.h).

namespace carom {

class SpringSolver {
  public:
    /// On entry the springs' impulses are those at the bodies' velocities, `slopes` their A [N s per m/s] by
    /// spring; on return both are those of the step's end. False, and nothing is changed, where the step does
    /// not exist.
    bool step(ContactProblem& problem, std::span<const Mat3> slopes);
    /// What the last one took [operations].
    double work() const;

  private:
    void prepare(const ContactProblem& problem);

    BlockMatrix m_matrix;
    std::vector<BlockEdge> m_edges;
    ProblemUnits m_units;
    std::vector<Vec6> m_step;
};

} // namespace carom
