// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/contacts/block_matrix.h"
#include "core/solvers/contacts/contact_problem.h"

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

// A proximal Newton method for the contact problem: an augmented Lagrangian outside (M. Hestenes, 1969;
// R. T. Rockafellar, "Augmented Lagrangians and applications of the proximal point algorithm in convex
// programming", 1976; for friction P. Alart, A. Curnier, "A mixed formulation for frictional contact problems
// prone to Newton like solution methods", 1991), Newton's method with an exact line search inside.
//
//     outer    ρ = κ m,  m the contact's effective mass           (per contact: mass ratios cost nothing)
//              p(v) = proj(l − ρ (u(v) + b n))                     l the multipliers so far
//              l ← p(v) once v is solved for
//     inner    G(v) = M (v − v̂) − Jᵀ p(v) = 0
//              H    = M + Σ ρ Jᵀ D J
//              Dₙₙ  = 1 if zₙ > 0;  Dₜₜ = 1 sticking, (r/|zₜ|)(1 − t tᵀ) slipping, r = μ pₙ, t = zₜ/|zₜ|
//     step     H s = −G;  v ← v + α s with sᵀG(v + α s) = 0, which needs only u and du of each contact
//
// H omits the dependence of the slip radius r on pₙ, which keeps it symmetric positive definite and the step
// a descent direction; G includes it, so the solution is exact. Where that converges slowly the whole
// derivative of G is factored instead (not symmetric, Alart and Curnier's) and its step is taken if it helps.
// The outer loop hardly changes H: while the same contacts open, stick and slip, a step with the matrix that
// is factored already is tried first (the chord method), which takes no factorisation.
//
// Rounding leaves an error of about κ ε |v| in G. Where that is more than the tolerance, further steps are
// made of nothing but rounding: the iteration ends at the best velocities, and goes on with a κ at which
// there is less of it. The outer loop ends where the multipliers no longer come nearer.
//
// H contains M: redundant contacts (four corners of a cube) need no special treatment. A larger κ makes the
// outer loop converge faster and conditions H worse.
//
// Masses enter H in a unit of the problem and pivots are chosen with lengths in a unit of each body, powers
// of two both: the same problem in other units gives the same bits. (Roots of masses would differ for every
// other power of two, and kg against kg m² would decide on pivots.)
//
// Bounds may contradict each other by a little, as those of four corners do whose gaps are rounded. Then l
// drifts by ρ times the contradiction a round, along impulses that cancel, until a contact opens or slips: a
// drift that is steady is followed to there at once.
//
// The problem's impulses are the start. If they already solve it to the tolerance nothing is computed: that
// is what makes rest exactly still and cheap. If there are none, all contacts are first taken to stick that
// do not open: an impact on a tower reaches its foot in one step, not in one for each cube.

namespace carom {

struct NewtonReport {
    bool solved = false;
    int factorisations = 0;
    double work = 0;     ///< operations (work_budget.h)
    double residual = 0; ///< residualOf the result [m/s]
};

class NewtonSolver {
  public:
    /// So that problems of so many bodies and rows allocate nothing.
    void reserve(std::size_t bodies, std::size_t rows);
    /// Changes impulses and velocities of the problem. `tolerance` [m/s] > 0 bounds residualOf. If it is not
    /// reached within `mostWork` operations (work_budget.h; exceeded by one factorisation at most) the
    /// impulses are the best that were found, those of the start if none were better.
    NewtonReport solve(ContactProblem& problem, double tolerance,
                       double mostWork = std::numeric_limits<double>::infinity());

  private:
    /// What a contact does where its multipliers are projected.
    enum class Side : std::uint8_t { Open, Sticks, Slips };
    /// What a row is at the velocities that it was looked at last.
    struct RowValues {
        Vec3 u = Vec3::Zero(); // with the bound
        Vec2 roll = Vec2::Zero();
        Vec3 z = Vec3::Zero();
        Vec2 rollZ = Vec2::Zero();
        Projected p;
        Side side = Side::Open; // at z
    };
    struct RowState : RowValues {
        Vec3 du = Vec3::Zero(); // along the step
        Vec2 droll = Vec2::Zero();
        Vec3 l = Vec3::Zero();
        Vec2 rollL = Vec2::Zero();
        Vec3 drift = Vec3::Zero(); // of l in the last round, as a speed
        Vec2 rollDrift = Vec2::Zero();
        int edge = -1;
        Side factoredSide = Side::Open; // when the matrix was factored
    };
    /// Factorisations of an inner problem: so many at most; beyond `surely` while the error falls fast.
    struct Steps {
        int most = 0, surely = 0, taken = 0;
        double limit = 0; ///< the error that rounding leaves, where that ended it [m/s]
    };

    bool prepare(const ContactProblem& problem, double mostWork);
    void resetMultipliers(const ContactProblem& problem);
    int startFromNothing(ContactProblem& problem);
    bool minimise(ContactProblem& problem, double tolerance, double mostWork, Steps& steps);
    void evaluateRows(const ContactProblem& problem);
    void project(const ContactProblem& problem, double along);
    double gradient(const ContactProblem& problem);
    double errorAt(const ContactProblem& problem);
    bool findStep(const ContactProblem& problem, bool coupled);
    void solveForStep();
    bool isFactored() const;
    bool tryStep(ContactProblem& problem, double part, double& error);
    bool stepAgain(ContactProblem& problem, double& error);
    bool stepCoupled(ContactProblem& problem, double& error, int& steps);
    static Side sideOf(const ContactRow& row, const RowState& state);
    bool factor(const ContactProblem& problem, bool coupled);
    void addContact(const ContactRow& row, const RowState& state, bool coupled);
    void addRolling(const ContactRow& row, const RowState& state, double rho, bool coupled);
    template<class Row>
    void addSlope(const Row& row, int edge, const Mat3& slope, bool coupled);
    double slope(const ContactProblem& problem, double along, double quadratic, double linear);
    double lineSearch(const ContactProblem& problem);
    double updateMultipliers(const ContactProblem& problem);
    static double roomOf(const ContactRow& row, const Vec3& l, const Vec3& change);
    bool followDrift(const ContactProblem& problem);
    void takeImpulses(ContactProblem& problem);
    void takeBest(ContactProblem& problem, NewtonReport& report);

    double m_kappa = 1;
    double m_rounding = 0;          // of the velocities [m/s]
    double m_factoredAt = 0;        // κ of the factored matrix; 0: there is none
    bool m_isCoupledBetter = false; // the last step with the whole derivative was taken
    bool m_isSteady = false;        // multipliers drift as in the round before
    double m_work = 0;              // of this solve, operations
    double m_rowWork = 0;           // of looking at all rows and bodies once
    double m_solveWork = 0;         // of a step with a matrix that is factored
    std::vector<RowState> m_rows;
    std::vector<int> m_springEdge;
    std::vector<Vec3> m_springU, m_springDu;
    ProblemUnits m_units; // that H is written in, and its pivots are chosen in
    std::vector<BlockEdge> m_edges;
    std::vector<std::pair<Vec3, Vec2>> m_first; // by row: the impulses of the start
    std::vector<Vec6> m_gradient, m_step;
    std::vector<Vec6> m_saved, m_savedGradient; // before a step that is tried
    std::vector<RowValues> m_savedRows;
    std::vector<Vec3> m_savedSpringU;
    std::vector<Vec6> m_best;   // velocities of the least error of an inner problem
    std::vector<Vec6> m_solved; // and those of the inner problem that was solved last
    BlockMatrix m_matrix;
};

} // namespace carom
