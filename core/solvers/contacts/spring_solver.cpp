// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/spring_solver.h"

#include "core/solvers/contacts/work_budget.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

BlockEdge edgeOf(const SoftRow& row) { return std::minmax(row.a, row.b); }

bool isCoupled(const SoftRow& row) { return row.a != immobile && row.b != immobile; }

} // namespace

void SpringSolver::prepare(const ContactProblem& problem) {
    m_edges.clear();
    for (const SoftRow& row : problem.springs)
        if (isCoupled(row)) m_edges.push_back(edgeOf(row));
    std::sort(m_edges.begin(), m_edges.end());
    m_edges.erase(std::unique(m_edges.begin(), m_edges.end()), m_edges.end());
    m_matrix.analyse(static_cast<int>(problem.bodies.size()), m_edges);
    m_matrix.setZero();
    chooseUnits(problem, m_units);
    m_step.assign(problem.bodies.size(), Vec6::Zero());
}

// In a matrix that is not symmetric both halves are eliminated.
double SpringSolver::work() const {
    const double bodies = static_cast<double>(m_step.size()), edges = static_cast<double>(m_edges.size());
    return work::ordering * (edges + bodies) + work::body * bodies + work::row * edges +
           2 * work::block * (static_cast<double>(m_matrix.updates()) + bodies);
}

bool SpringSolver::step(ContactProblem& problem, std::span<const Mat3> slopes) {
    prepare(problem);
    for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
        const ContactBody& body = problem.bodies[i];
        const Mat6 mass = massMatrix(body, m_units.perMass);
        m_matrix.addToDiagonal(static_cast<int>(i), mass);
        m_step[i] = mass * (body.freeVelocity - body.velocity);
    }
    for (std::size_t i = 0; i < slopes.size(); ++i) {
        const SoftRow& row = problem.springs[i];
        const Mat3 slope = m_units.perMass * slopes[i];
        const Eigen::Matrix<double, 6, 3> leftA = row.jacobianA.transpose() * slope;
        const Eigen::Matrix<double, 6, 3> leftB = row.jacobianB.transpose() * slope;
        if (row.a != immobile) m_matrix.addToDiagonal(row.a, leftA * row.jacobianA);
        if (row.b != immobile) m_matrix.addToDiagonal(row.b, leftB * row.jacobianB);
        if (row.a != immobile)
            m_step[at(row.a)] += row.jacobianA.transpose() * (m_units.perMass * row.impulse);
        if (row.b != immobile)
            m_step[at(row.b)] += row.jacobianB.transpose() * (m_units.perMass * row.impulse);
        if (!isCoupled(row)) continue;
        const auto edge = std::lower_bound(m_edges.begin(), m_edges.end(), edgeOf(row)) - m_edges.begin();
        const Mat6 fromB = leftA * row.jacobianB, fromA = leftB * row.jacobianA;
        m_matrix.addToEdge(static_cast<std::size_t>(edge), row.a < row.b ? fromB : fromA,
                           row.a < row.b ? fromA : fromB);
    }
    if (!m_matrix.factorGeneral(m_units.length)) return false;
    m_matrix.solve(m_step);
    // Velocities change by the impulses, so that momentum is kept to rounding.
    for (std::size_t i = 0; i < slopes.size(); ++i) {
        SoftRow& row = problem.springs[i];
        Vec3 change = Vec3::Zero();
        if (row.a != immobile) change += row.jacobianA * m_step[at(row.a)];
        if (row.b != immobile) change += row.jacobianB * m_step[at(row.b)];
        row.impulse -= slopes[i] * change;
    }
    velocitiesFromImpulses(problem);
    return true;
}

} // namespace carom
