// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/wide.h"
#include "core/solvers/contacts/newton.h"
#include "core/solvers/contacts/wide_columns.h"
#include "core/solvers/contacts/work_budget.h"

#include <algorithm>
#include <cmath>

// A step of Newton's method: its matrix, and how far it goes.

namespace carom {
namespace {

/// The line search is exact enough when the slope along the step has fallen to this part. Twice or half moves
/// work between the search and the number of steps.
constexpr double slopeFall = 0.1;
/// Slopes that one line search evaluates at most in each of its two loops. At half, a search that rounding
/// keeps from ending costs half as much.
constexpr int mostSlopes = 40;

/// The derivative of the projection of a two-vector on a disc of the given radius, times `rho`.
CAROM_INLINE Eigen::Matrix2d discSlope(const Vec2& z, double radius, double rho) {
    if (!(radius > 0)) return Eigen::Matrix2d::Zero();
    const double size = sizeBeyond(z, radius);
    if (!(size > 0)) return rho * Eigen::Matrix2d::Identity();
    const Vec2 t = z / size;
    return (rho * radius / size) * (Eigen::Matrix2d::Identity() - t * t.transpose());
}

// Jᵀ · slope.
CAROM_INLINE WideColumns3 timesSlope(const Mat36& jacobian, const Mat3& slope) {
    const WideColumns3 rows = rowsOf(jacobian);
    const double* const columns = slope.data();
    return {times(rows, columns), times(rows, columns + 3), times(rows, columns + 6)};
}

} // namespace

// Factorises H, or if `coupled` the whole derivative of G.
bool NewtonSolver::factor(const ContactProblem& problem, bool coupled) {
    m_work += m_rowWork + work::block * static_cast<double>(m_matrix.updates() + problem.bodies.size()) *
                              (coupled ? 2 : 1);
    m_matrix.setZeroBeside(coupled);
    for (std::size_t i = 0; i < problem.bodies.size(); ++i)
        m_matrix.diagonal(static_cast<int>(i)) = massMatrix(problem.bodies[i], m_units.perMass);
    for (std::size_t i = 0; i < m_rows.size(); ++i) addContact(problem.rows[i], m_rows[i], coupled);
    for (std::size_t i = 0; i < problem.springs.size(); ++i) {
        const SoftRow& row = problem.springs[i];
        addSlope(row, m_springEdge[i], (m_units.perMass * row.rate).asDiagonal(), coupled);
    }
    return coupled ? m_matrix.factorGeneral(m_units.length) : m_matrix.factor();
}

// Adds Jᵀ · slope · J to the blocks of both bodies of a row.
template<class Row>
CAROM_INLINE void NewtonSolver::addSlope(const Row& row, int edge, const Mat3& slope, bool coupled) {
    WideColumns3 leftA, leftB;
    if (row.a != immobile) {
        leftA = timesSlope(row.jacobianA, slope);
        addProduct(leftA, row.jacobianA, m_matrix.diagonal(row.a));
    }
    if (row.b != immobile) {
        leftB = timesSlope(row.jacobianB, slope);
        addProduct(leftB, row.jacobianB, m_matrix.diagonal(row.b));
    }
    if (edge < 0) return;
    const bool isAfter = m_matrix.isAfter(row.a, row.b);
    const auto add = [&](bool fromA, Mat6& block) {
        addProduct(fromA ? leftA : leftB, fromA ? row.jacobianB : row.jacobianA, block);
    };
    add(isAfter, m_matrix.lower(at(edge)));
    if (coupled) add(!isAfter, m_matrix.upper(at(edge)));
}

// The same of what resists rolling, which only turns.
CAROM_INLINE void NewtonSolver::addRolling(const ContactRow& row, const RowState& state, double rho,
                                           bool coupled) {
    const Eigen::Matrix2d slope =
        discSlope(state.rollZ, row.rolling * state.z.x(), m_kappa * m_units.perMass * row.effectiveInertia);
    const Eigen::Matrix<double, 2, 3> across = row.frame.bottomRows<2>();
    const Mat3 turning = across.transpose() * slope * across;
    const auto rotation = [](Mat6& block) { return block.bottomRightCorner<3, 3>(); };
    if (row.a != immobile) rotation(m_matrix.diagonal(row.a)) += turning;
    if (row.b != immobile) rotation(m_matrix.diagonal(row.b)) += turning;
    if (state.edge >= 0) rotation(m_matrix.lower(at(state.edge))) -= turning;
    if (!coupled) return;
    if (state.edge >= 0) rotation(m_matrix.upper(at(state.edge))) -= turning;
    if (!(sizeBeyond(state.rollZ, row.rolling * state.z.x()) > 0)) return;
    // Resistance grows with the force along the normal.
    const Vec3 torque = across.transpose() * ((rho * row.rolling) * state.rollZ.normalized());
    if (row.a != immobile) m_matrix.diagonal(row.a).bottomRows<3>() -= torque * row.jacobianA.row(0);
    if (row.b != immobile) m_matrix.diagonal(row.b).bottomRows<3>() += torque * row.jacobianB.row(0);
    if (state.edge < 0) return;
    const bool isAfter = m_matrix.isAfter(row.a, row.b);
    Mat6& fromA = isAfter ? m_matrix.lower(at(state.edge)) : m_matrix.upper(at(state.edge));
    Mat6& fromB = isAfter ? m_matrix.upper(at(state.edge)) : m_matrix.lower(at(state.edge));
    fromA.bottomRows<3>() -= torque * row.jacobianB.row(0);
    fromB.bottomRows<3>() += torque * row.jacobianA.row(0);
}

CAROM_WIDE void NewtonSolver::addContact(const ContactRow& row, const RowState& state, bool coupled) {
    if (!(state.z.x() > 0)) return;
    const double rho = m_kappa * m_units.perMass * row.effectiveMass;
    Mat3 slope = Mat3::Zero();
    slope(0, 0) = rho;
    const Vec2 tangent = state.z.tail<2>();
    slope.bottomRightCorner<2, 2>() = discSlope(tangent, row.friction * state.z.x(), rho);
    if (coupled && sizeBeyond(tangent, row.friction * state.z.x()) > 0)
        slope.bottomLeftCorner<2, 1>() = (rho * row.friction) * tangent.normalized();
    addSlope(row, state.edge, slope, coupled);
    if (row.rolling > 0) addRolling(row, state, rho, coupled);
}

// sᵀ G(v + along s).
double NewtonSolver::slope(const ContactProblem& problem, double along, double quadratic, double linear) {
    project(problem, along);
    m_work += 0.5 * m_rowWork;
    double sum = linear + along * quadratic;
    for (const RowState& state : m_rows) {
        sum -= state.du.dot(state.p.impulse);
        sum -= state.droll.dot(state.p.rolling);
    }
    for (std::size_t i = 0; i < m_springU.size(); ++i) {
        const SoftRow& row = problem.springs[i];
        sum += m_springDu[i].dot(row.offset + row.rate.cwiseProduct(m_springU[i] + along * m_springDu[i]));
    }
    return sum;
}

// The step length at which the slope vanishes. Near the solution, differences of the objective are lost in
// rounding; the slope is not.
CAROM_WIDE double NewtonSolver::lineSearch(const ContactProblem& problem) {
    const auto step = [&](std::size_t body) -> const Vec6& { return m_step[body]; };
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
        m_rows[i].du = velocityAlong(problem.rows[i], step);
        if (problem.rows[i].rolling > 0) m_rows[i].droll = spinAlong(problem.rows[i], step);
    }
    for (std::size_t i = 0; i < m_springDu.size(); ++i)
        m_springDu[i] = velocityAlong(problem.springs[i], step);
    double quadratic = 0, linear = 0, start = 0;
    for (std::size_t i = 0; i < m_step.size(); ++i) {
        const ContactBody& body = problem.bodies[i];
        const Vec6 momentum = momentumOf(body, m_step[i]);
        quadratic += m_step[i].dot(momentum);
        linear += momentum.dot(body.velocity - body.freeVelocity);
        start += m_step[i].dot(m_gradient[i]);
    }

    const double enough = slopeFall * std::abs(start);
    double high = 1, slopeHigh = slope(problem, high, quadratic, linear);
    if (std::abs(slopeHigh) <= enough || !(start < 0)) return 1;
    double low = 0, slopeLow = start;
    for (int i = 0; i < mostSlopes && slopeHigh < 0; ++i) { // too short: contacts left or reached their cones
        low = high;
        slopeLow = slopeHigh;
        high *= 2;
        slopeHigh = slope(problem, high, quadratic, linear);
        if (std::abs(slopeHigh) <= enough) return high;
    }
    // Regula falsi; the slope at an end that is kept twice in a row is halved, or it would be kept for ever
    // (the Illinois method, M. Dowell, P. Jarratt, "A modified regula falsi method", 1971).
    int kept = 0; // steps in a row for which low was kept; negative: high
    for (int i = 0; i < mostSlopes; ++i) {
        const double width = high - low;
        const double secant = low - slopeLow * width / (slopeHigh - slopeLow);
        const double middle = std::clamp(secant, low + 0.01 * width, high - 0.01 * width);
        const double slopeMiddle = slope(problem, middle, quadratic, linear);
        if (std::abs(slopeMiddle) <= enough) return middle;
        if (slopeMiddle < 0) {
            low = middle;
            slopeLow = slopeMiddle;
            kept = std::min(kept, 0) - 1;
            if (kept < -1) slopeHigh *= 0.5;
        } else {
            high = middle;
            slopeHigh = slopeMiddle;
            kept = std::max(kept, 0) + 1;
            if (kept > 1) slopeLow *= 0.5;
        }
    }
    return low > 0 ? low : high;
}

} // namespace carom
