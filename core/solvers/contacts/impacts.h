// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/ledger.h"
#include "core/solvers/contacts/contact_problem.h"
#include "core/solvers/contacts/newton.h"

#include <cstdint>
#include <span>
#include <vector>

// Impacts at one instant, by Newton's law for every contact that bodies close at: u' = −e u.
//
// Sequential (the default): the contact with the largest closing speed first, until none closes any more.
// Newton's cradle is treated correctly, because its impacts do happen one after the other. Contacts that tie
// with the largest and share a body with it have no order and are solved together, as are all points of one
// pair (in sequence, the corners of a body that lands flat would set it spinning). For contacts without
// friction that is
//
//     W p = −(1+e) u,   W = J M⁻¹ Jᵀ
//
// solved in both orders of elimination and averaged, so that a mirror image gives mirrored bits. One contact
// with friction that sticks, or slips between spheres, where a normal impulse turns neither body, has a
// closed form, too. What is left, and where W is singular or a pull would result, is left to the Newton
// solver with u' + e u >= 0 for u >= 0. Perfectly plastic contacts (e = 0) are all solved together: one after
// the other would never end in a stack. Simultaneous: all contacts at once.

namespace carom {

/// What an impact needs to know of a contact besides its row.
struct ImpactRow {
    double restitution = 0;
    double threshold = 0;   ///< closing speeds up to this are no impact [m/s]
    std::uint32_t pair = 0; ///< points of one pair are solved together
    bool touching = false;  ///< only contacts that touch take part
};

struct ImpactReport {
    int impacts = 0; ///< groups of contacts that were solved
    int factorisations = 0;
    double work = 0; ///< operations (work_budget.h)
};

class ImpactSolver {
  public:
    /// So that problems of so many bodies and rows allocate nothing.
    void reserve(std::size_t bodies, std::size_t rows);
    /// Changes the bodies' velocities; rows' impulses and bounds are left as they were. Groups that have no
    /// direct solution are solved by Newton's method. Ends after `mostWork` operations, with bodies that
    /// still close.
    ImpactReport solve(ContactProblem& problem, std::span<const ImpactRow> rows, bool simultaneous,
                       double mostWork);

    Ledger* ledger = nullptr; ///< records what impacts do, where somebody keeps one

  private:
    void measure(const ContactProblem& problem, std::span<const ImpactRow> rows, std::size_t i);
    void remeasure(const ContactProblem& problem, std::span<const ImpactRow> rows);
    void linkRows(const ContactProblem& problem);
    void gather(const ContactProblem& problem, std::span<const ImpactRow> rows, std::size_t largest);
    void gatherAll(std::span<const ImpactRow> rows);
    void solveGroup(ContactProblem& problem, std::span<const ImpactRow> rows);
    bool solveDirectly(ContactProblem& problem, std::span<const ImpactRow> rows);
    bool solveLone(ContactProblem& problem, std::span<const ImpactRow> rows);
    void solveByNewton(ContactProblem& problem, std::span<const ImpactRow> rows);
    void takeGroup(const ContactProblem& problem);
    void applyGroup(ContactProblem& problem);

    std::vector<double> m_closing; // −uₙ by row [m/s]
    std::vector<std::size_t> m_group;
    std::vector<std::size_t> m_firstRow, m_nextRow, m_rowOf; // by body, into m_rowOf: its rows
    std::vector<int> m_local;                                // by body, its index in the group's problem
    ContactProblem m_groupProblem;
    double m_work = 0, m_mostWork = 0;
    int m_factorisations = 0;
    std::vector<Vec6> m_mean; // by body of m_groupProblem; for the ledger only
    NewtonSolver m_newton;
};

} // namespace carom
