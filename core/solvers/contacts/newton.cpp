// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/newton.h"

#include "core/base/wide.h"
#include "core/solvers/contacts/work_budget.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace carom {
namespace {

/// κ at a warm start, and its range. Above 1e5 the rounding of H shows in the solution; the factor 10 is the
/// growth when the outer loop converges slowly. At twice or half the solution is the same: a smaller κ takes
/// more rounds, a larger one more steps in each.
constexpr double kappaWarm = 1e3, kappaLeast = 1e-2, kappaMost = 1e9, kappaGrowth = 10;
/// A warm start is poor if the first inner problem takes more steps than this: begin again with κ = 1. At
/// half, good guesses are given up; at twice, poor ones cost twice as many factorisations.
constexpr int fewSteps = 6;
/// Where the error no longer falls but is within this factor of the tolerance, rounding is what is left. At
/// half, problems that are as good as solved go on to the limit of steps; at twice, larger errors are left.
constexpr double stallNearby = 10;
/// The inner problem is solved to this part of the tolerance. At half, rounding hinders it earlier; at twice,
/// its error is a fifth of the tolerance, and more rounds are made.
constexpr double innerPart = 0.1;
/// Inner steps and outer rounds at most; the hardest problems met took 40 and 30. At half of the first, these
/// fail; at twice, a problem without a solution costs twice as much where its budget allows that.
constexpr int mostSteps = 60, mostRounds = 80;
/// After each inner problem that fails the later ones may take half as many steps, down to this: what
/// succeeds takes few, and failing again in the same way shows nothing new. At half, problems that would be
/// solved are given up; at twice, one without a solution costs up to twice as much.
constexpr int leastSteps = 30;
/// The inner error should fall at least to this part in a step; else the coupled step is tried, at the cost
/// of another factorisation. At half, it is tried more often in vain; at twice, slow convergence lasts
/// longer.
constexpr double slowFall = 0.3;
/// The line search is exact enough when the slope along the step has fallen to this part. Twice or half moves
/// work between the search and the number of steps.
constexpr double slopeFall = 0.1;
/// Slopes that one line search evaluates at most in each of its two loops. At half, a search that rounding
/// keeps from ending costs half as much.
constexpr int mostSlopes = 40;
/// Multipliers drift steadily if their drift changes by at most this part of it in a round. At half, more
/// rounds pass before a drift is followed; at twice, a change that bends is taken for a drift.
constexpr double steadyPart = 0.05;
/// A contact slips whose friction force is within this part of the edge of its cone. At a thousandth,
/// rounding lets it count as stuck; at a thousand times, drifts end before the edge.
constexpr double coneEdge = 1e-9;
/// Where no impulse is known, a contact counts as open that opens faster than this part of the fastest
/// closing speed. At a millionth, rounding would open contacts at rest; at a million times, some that open
/// would be taken for held ones in the first guess.
constexpr double atRest = 1e-9;

template<class Row>
BlockEdge edgeOf(const Row& row) {
    return {std::min(row.a, row.b), std::max(row.a, row.b)};
}

template<class Row>
Vec3 velocityAlong(const Row& row, const std::vector<Vec6>& step) {
    Vec3 du = Vec3::Zero();
    if (row.a != immobile) du.noalias() += row.jacobianA * step[at(row.a)];
    if (row.b != immobile) du.noalias() += row.jacobianB * step[at(row.b)];
    return du;
}

Vec2 spinAlong(const ContactRow& row, const std::vector<Vec6>& step) {
    Vec3 spin = Vec3::Zero();
    if (row.a != immobile) spin -= step[at(row.a)].tail<3>();
    if (row.b != immobile) spin += step[at(row.b)].tail<3>();
    return row.frame.bottomRows<2>() * spin;
}

/// The derivative of the projection of a two-vector on a disc of the given radius, times `rho`.
Eigen::Matrix2d discSlope(const Vec2& z, double radius, double rho) {
    if (!(radius > 0)) return Eigen::Matrix2d::Zero();
    const double size = z.norm();
    if (size <= radius) return rho * Eigen::Matrix2d::Identity();
    const Vec2 t = z / size;
    return (rho * radius / size) * (Eigen::Matrix2d::Identity() - t * t.transpose());
}

Vec6 momentumChange(const ContactBody& body, const Vec6& velocity) {
    Vec6 momentum;
    momentum.head<3>() = body.mass * velocity.head<3>();
    momentum.tail<3>().noalias() = body.inertia * velocity.tail<3>();
    return momentum;
}

} // namespace

void NewtonSolver::reserve(std::size_t bodies, std::size_t rows) {
    m_rows.reserve(rows);
    m_units.length.reserve(bodies);
    m_edges.reserve(rows);
    m_first.reserve(rows);
    m_gradient.reserve(bodies);
    m_step.reserve(bodies);
    m_saved.reserve(bodies);
    m_matrix.reserve(bodies);
}

NewtonReport NewtonSolver::solve(ContactProblem& problem, double tolerance, double mostWork) {
    NewtonReport report;
    m_rowWork = work::row * static_cast<double>(problem.rows.size() + problem.springs.size()) +
                work::body * static_cast<double>(problem.bodies.size());
    report.work = m_work = m_rowWork;
    velocitiesFromImpulses(problem);
    double residual = residualOf(problem);
    report.residual = residual;
    report.solved = residual <= tolerance;
    if (report.solved || !std::isfinite(residual)) return report;

    if (!prepare(problem, mostWork)) {
        report.work = m_work;
        return report;
    }
    m_kappa = kappaWarm;
    report.factorisations += startFromNothing(problem);
    double whole = std::numeric_limits<double>::infinity();
    bool first = true;
    int most = mostSteps;
    for (int round = 0; round < mostRounds; ++round) {
        if (m_work >= mostWork) {
            takeBest(problem, report);
            report.work = m_work;
            return report;
        }
        int steps = 0;
        const double inner = std::max(innerPart * tolerance, 0.01 * residual);
        const bool minimised = minimise(problem, inner, mostWork, first ? fewSteps + 1 : most, steps);
        report.factorisations += steps;
        if (first && (!minimised || steps > fewSteps)) {
            m_kappa = 1;
            resetMultipliers(problem); // those of the warm start
            first = false;
            continue;
        }
        first = false;
        if (!minimised) { // multipliers from an unsolved inner problem would be amplified by ρ
            m_kappa = std::max(kappaLeast, m_kappa / kappaGrowth);
            most = std::max(leastSteps, most / 2);
            continue;
        }
        const double change = updateMultipliers(problem);
        if (change <= tolerance && inner <= tolerance) {
            // A small change means that l has converged; the residual of the whole problem decides.
            takeImpulses(problem);
            velocitiesFromImpulses(problem);
            report.residual = residualOf(problem);
            if (report.residual <= tolerance || report.residual >= whole) break; // the latter by rounding
            whole = report.residual;
        }
        const bool isFollowed = m_isSteady && change > tolerance && followDrift(problem);
        if (change <= tolerance) // only the inner problem is left, where rounding is least at this κ
            m_kappa = std::min(m_kappa, kappaWarm);
        else if (!isFollowed && (change > 0.1 * residual || m_kappa < kappaWarm))
            m_kappa = std::min(kappaMost, m_kappa * kappaGrowth);
        residual = change;
    }
    takeImpulses(problem);
    velocitiesFromImpulses(problem);
    report.residual = residualOf(problem);
    report.solved = report.residual <= 10 * tolerance;
    report.work = m_work;
    return report;
}

// False if one factorisation alone would be too much work.
bool NewtonSolver::prepare(const ContactProblem& problem, double mostWork) {
    m_edges.clear();
    const auto note = [&](const auto& row) {
        if (row.a != immobile && row.b != immobile) m_edges.push_back(edgeOf(row));
    };
    for (const ContactRow& row : problem.rows) note(row);
    for (const SoftRow& row : problem.springs) note(row);
    std::sort(m_edges.begin(), m_edges.end());
    m_edges.erase(std::unique(m_edges.begin(), m_edges.end()), m_edges.end());
    m_work += work::ordering * static_cast<double>(m_edges.size() + problem.bodies.size());
    const double most = std::min((mostWork - m_work) / work::block, 1e9);
    if (!(most > 0) ||
        !m_matrix.analyse(static_cast<int>(problem.bodies.size()), m_edges, static_cast<std::size_t>(most)))
        return false;

    const auto numberOf = [&](const auto& row) {
        if (row.a == immobile || row.b == immobile) return -1;
        return static_cast<int>(std::lower_bound(m_edges.begin(), m_edges.end(), edgeOf(row)) -
                                m_edges.begin());
    };
    m_rows.resize(problem.rows.size());
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
        m_rows[i].edge = numberOf(problem.rows[i]);
        m_rows[i].roll.setZero();
        m_rows[i].droll.setZero();
        m_rows[i].drift.setZero();
        m_rows[i].rollDrift.setZero();
    }
    m_springEdge.clear();
    for (const SoftRow& row : problem.springs) m_springEdge.push_back(numberOf(row));
    m_springU.resize(problem.springs.size());
    m_springDu.resize(problem.springs.size());
    m_gradient.resize(problem.bodies.size());
    m_step.resize(problem.bodies.size());
    chooseUnits(problem, m_units);
    resetMultipliers(problem);
    return true;
}

void NewtonSolver::resetMultipliers(const ContactProblem& problem) {
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
        m_rows[i].l = problem.rows[i].impulse;
        m_rows[i].rollL = problem.rows[i].rollingImpulse;
    }
}

// Where no impulse is known, contacts that neither close nor open are at the edge between both: Newton's
// method would let an impact reach them one after another, and each would slip until it is pressed together.
// So the first guess is what they do if none of them opens or slips; those that open already do not act.
// Returns the number of factorisations.
int NewtonSolver::startFromNothing(ContactProblem& problem) {
    const auto acts = [](const ContactRow& row) { return row.impulse != Vec3::Zero(); };
    if (std::any_of(problem.rows.begin(), problem.rows.end(), acts)) return 0;
    m_work += m_rowWork;
    evaluateRows(problem);
    double fastest = 0;
    for (const RowState& state : m_rows) fastest = std::max(fastest, -state.u.x());
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
        const ContactRow& row = problem.rows[i];
        RowState& state = m_rows[i];
        const bool holds = state.u.x() <= atRest * fastest;
        state.z = holds ? Vec3(Vec3::UnitX()) : Vec3(-Vec3::UnitX());
        state.rollZ.setZero();
        state.p = {};
        if (!holds) continue;
        state.p.impulse = -(m_kappa * row.effectiveMass) * state.u;
        if (!(row.friction > 0)) state.p.impulse.tail<2>().setZero();
        if (row.rolling > 0) state.p.rolling = -(m_kappa * row.effectiveInertia) * state.roll;
    }
    gradient(problem);
    if (!findStep(problem, false)) return 1;
    for (std::size_t i = 0; i < m_step.size(); ++i) problem.bodies[i].velocity += m_step[i];
    m_work += m_rowWork;
    evaluateRows(problem);
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
        RowState& state = m_rows[i];
        if (!(state.z.x() > 0)) continue;
        const ContactRow& row = problem.rows[i];
        const Projected guess = projectOnCone(row, -(m_kappa * row.effectiveMass) * state.u,
                                              -(m_kappa * row.effectiveInertia) * state.roll);
        state.l = guess.impulse;
        state.rollL = guess.rolling;
    }
    return 1;
}

// Solves the inner problem for the velocities. Where contacts slip, steps with H alone may converge slowly or
// not at all. Then a step with the whole derivative of G is tried, and taken if it halves the error.
bool NewtonSolver::minimise(ContactProblem& problem, double tolerance, double mostWork, int most,
                            int& steps) {
    double before = std::numeric_limits<double>::infinity();
    int stalled = 0;
    for (steps = 0; steps < most && m_work < mostWork;) {
        const double error = errorAt(problem);
        if (error <= tolerance) return true;
        if (!std::isfinite(error)) return false;
        stalled = error > 0.5 * before ? stalled + 1 : 0;
        if (stalled >= 3 && error <= stallNearby * tolerance) return true; // rounding limits the error
        if (error > slowFall * before && stepCoupled(problem, error, steps)) {
            before = error;
            continue;
        }
        before = error;
        errorAt(problem);
        if (!findStep(problem, false)) return false;
        ++steps;
        const double along = lineSearch(problem);
        if (!std::isfinite(along)) return false;
        for (std::size_t i = 0; i < m_step.size(); ++i) problem.bodies[i].velocity += along * m_step[i];
    }
    return false;
}

double NewtonSolver::errorAt(const ContactProblem& problem) {
    m_work += m_rowWork;
    evaluateRows(problem);
    project(problem, 0);
    return gradient(problem);
}

bool NewtonSolver::findStep(const ContactProblem& problem, bool coupled) {
    if (!factor(problem, coupled)) return false;
    for (std::size_t i = 0; i < m_step.size(); ++i) m_step[i] = -m_units.perMass * m_gradient[i];
    m_matrix.solve(m_step);
    return true;
}

bool NewtonSolver::stepCoupled(ContactProblem& problem, double error, int& steps) {
    const auto slips = [](const ContactRow& row, const RowState& state) {
        const double normal = state.z.x();
        return normal > 0 && ((row.friction > 0 && state.z.tail<2>().norm() > row.friction * normal) ||
                              (row.rolling > 0 && state.rollZ.norm() > row.rolling * normal));
    };
    bool any = false;
    for (std::size_t i = 0; i < m_rows.size(); ++i) any = any || slips(problem.rows[i], m_rows[i]);
    if (!any) return false;
    ++steps;
    if (!findStep(problem, true)) return false;
    m_saved.resize(m_step.size());
    for (std::size_t i = 0; i < m_step.size(); ++i) m_saved[i] = problem.bodies[i].velocity;
    for (std::size_t i = 0; i < m_step.size(); ++i) problem.bodies[i].velocity += m_step[i];
    if (errorAt(problem) <= 0.5 * error) return true;
    for (std::size_t i = 0; i < m_step.size(); ++i) problem.bodies[i].velocity = m_saved[i];
    return false;
}

CAROM_WIDE void NewtonSolver::evaluateRows(const ContactProblem& problem) {
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
        const ContactRow& row = problem.rows[i];
        m_rows[i].u = relativeVelocity(problem, row);
        m_rows[i].u.x() += row.bound;
        if (row.rolling > 0) m_rows[i].roll = rollingVelocity(problem, row);
    }
    for (std::size_t i = 0; i < m_springU.size(); ++i)
        m_springU[i] = relativeVelocity(problem, problem.springs[i]);
}

// Computes z and p at the velocities v + along · step.
CAROM_WIDE void NewtonSolver::project(const ContactProblem& problem, double along) {
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
        const ContactRow& row = problem.rows[i];
        RowState& state = m_rows[i];
        state.z = state.l - (m_kappa * row.effectiveMass) * (state.u + along * state.du);
        if (row.rolling > 0)
            state.rollZ = state.rollL - (m_kappa * row.effectiveInertia) * (state.roll + along * state.droll);
        state.p = projectOnCone(row, state.z, state.rollZ);
    }
}

// Computes G; returns the largest change of velocity M⁻¹ G [m/s].
CAROM_WIDE double NewtonSolver::gradient(const ContactProblem& problem) {
    for (std::size_t i = 0; i < m_gradient.size(); ++i)
        m_gradient[i] =
            momentumChange(problem.bodies[i], problem.bodies[i].velocity - problem.bodies[i].freeVelocity);
    const auto subtract = [&](const auto& row, const Vec3& impulse) {
        if (row.a != immobile) m_gradient[at(row.a)].noalias() -= row.jacobianA.transpose() * impulse;
        if (row.b != immobile) m_gradient[at(row.b)].noalias() -= row.jacobianB.transpose() * impulse;
    };
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
        const ContactRow& row = problem.rows[i];
        subtract(row, m_rows[i].p.impulse);
        if (!(row.rolling > 0)) continue;
        const Vec3 torque = row.frame.bottomRows<2>().transpose() * m_rows[i].p.rolling;
        if (row.a != immobile) m_gradient[at(row.a)].tail<3>() += torque;
        if (row.b != immobile) m_gradient[at(row.b)].tail<3>() -= torque;
    }
    for (std::size_t i = 0; i < m_springU.size(); ++i) {
        const SoftRow& row = problem.springs[i];
        subtract(row, -(row.offset + row.rate.cwiseProduct(m_springU[i])));
    }
    double largest = 0;
    for (std::size_t i = 0; i < m_gradient.size(); ++i) {
        const ContactBody& body = problem.bodies[i];
        const Vec3 spin = body.inverseInertia * m_gradient[i].tail<3>();
        largest =
            std::max({largest, m_gradient[i].head<3>().norm() / body.mass, spin.norm() * body.gyration});
    }
    return largest;
}

// Factorises H, or if `coupled` the whole derivative of G.
bool NewtonSolver::factor(const ContactProblem& problem, bool coupled) {
    m_work += m_rowWork + work::block * static_cast<double>(m_matrix.updates() + problem.bodies.size()) *
                              (coupled ? 2 : 1);
    m_matrix.setZero();
    for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
        m_matrix.addToDiagonal(static_cast<int>(i), massMatrix(problem.bodies[i], m_units.perMass));
    }
    for (std::size_t i = 0; i < m_rows.size(); ++i) addContact(problem.rows[i], m_rows[i], coupled);
    for (std::size_t i = 0; i < problem.springs.size(); ++i) {
        const SoftRow& row = problem.springs[i];
        const Mat3 slope = (m_units.perMass * row.rate).asDiagonal();
        addBlocks<3>({row.a, row.b, m_springEdge[i]}, row.jacobianA.transpose() * slope,
                     row.jacobianB.transpose() * slope, row.jacobianA, row.jacobianB);
    }
    return coupled ? m_matrix.factorGeneral(m_units.length) : m_matrix.factor();
}

// Adds the products left · right of both bodies of a row to their blocks.
template<int rows>
CAROM_INLINE void NewtonSolver::addBlocks(const Place& place, const Eigen::Matrix<double, 6, rows>& leftA,
                                          const Eigen::Matrix<double, 6, rows>& leftB,
                                          const Eigen::Matrix<double, rows, 6>& rightA,
                                          const Eigen::Matrix<double, rows, 6>& rightB) {
    if (place.a != immobile) m_matrix.addToDiagonal(place.a, leftA * rightA);
    if (place.b != immobile) m_matrix.addToDiagonal(place.b, leftB * rightB);
    if (place.edge < 0) return;
    if (place.a < place.b)
        m_matrix.addToEdge(at(place.edge), leftA * rightB, leftB * rightA);
    else
        m_matrix.addToEdge(at(place.edge), leftB * rightA, leftA * rightB);
}

CAROM_WIDE void NewtonSolver::addContact(const ContactRow& row, const RowState& state, bool coupled) {
    if (!(state.z.x() > 0)) return;
    const double rho = m_kappa * m_units.perMass * row.effectiveMass;
    Mat3 slope = Mat3::Zero();
    slope(0, 0) = rho;
    const Vec2 tangent = state.z.tail<2>();
    slope.bottomRightCorner<2, 2>() = discSlope(tangent, row.friction * state.z.x(), rho);
    if (coupled && tangent.norm() > row.friction * state.z.x())
        slope.bottomLeftCorner<2, 1>() = (rho * row.friction) * tangent.normalized();
    const Place place{row.a, row.b, state.edge};
    addBlocks<3>(place, row.jacobianA.transpose() * slope, row.jacobianB.transpose() * slope, row.jacobianA,
                 row.jacobianB);
    if (!(row.rolling > 0)) return;

    const Eigen::Matrix2d rollSlope =
        discSlope(state.rollZ, row.rolling * state.z.x(), m_kappa * m_units.perMass * row.effectiveInertia);
    Eigen::Matrix<double, 2, 6> across = Eigen::Matrix<double, 2, 6>::Zero();
    across.rightCols<3>() = row.frame.bottomRows<2>();
    const Eigen::Matrix<double, 6, 2> left = across.transpose() * rollSlope;
    addBlocks<2>(place, -left, left, -across, across);
    if (!coupled || !(state.rollZ.norm() > row.rolling * state.z.x())) return;
    const Vec6 torque = across.transpose() * ((rho * row.rolling) * state.rollZ.normalized());
    addBlocks<1>(place, -torque, torque, row.jacobianA.row(0), row.jacobianB.row(0));
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
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
        m_rows[i].du = velocityAlong(problem.rows[i], m_step);
        if (problem.rows[i].rolling > 0) m_rows[i].droll = spinAlong(problem.rows[i], m_step);
    }
    for (std::size_t i = 0; i < m_springDu.size(); ++i)
        m_springDu[i] = velocityAlong(problem.springs[i], m_step);
    double quadratic = 0, linear = 0;
    for (std::size_t i = 0; i < m_step.size(); ++i) {
        const ContactBody& body = problem.bodies[i];
        const Vec6 momentum = momentumChange(body, m_step[i]);
        quadratic += m_step[i].dot(momentum);
        linear += momentum.dot(body.velocity - body.freeVelocity);
    }

    const double start = slope(problem, 0, quadratic, linear);
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

// Sets l := p(v); returns the largest change, as a speed [m/s].
double NewtonSolver::updateMultipliers(const ContactProblem& problem) {
    double largest = 0, bend = 0;
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
        const ContactRow& row = problem.rows[i];
        RowState& state = m_rows[i];
        const Vec3 drift = (state.p.impulse - state.l) / (m_kappa * row.effectiveMass);
        largest = std::max(largest, drift.norm());
        bend = std::max(bend, (drift - state.drift).norm());
        state.drift = drift;
        state.l = state.p.impulse;
        if (!(row.rolling > 0)) continue;
        const Vec2 turning =
            (state.p.rolling - state.rollL) * (row.rolling / (m_kappa * row.effectiveInertia));
        largest = std::max(largest, turning.norm());
        bend = std::max(bend, (turning - state.rollDrift).norm());
        state.rollDrift = turning;
        state.rollL = state.p.rolling;
    }
    m_isSteady = bend <= steadyPart * largest;
    return largest;
}

// How many times `change` can be added to l until the contact opens, or slips if it does not yet.
double NewtonSolver::roomOf(const ContactRow& row, const Vec3& l, const Vec3& change) {
    constexpr double unbounded = std::numeric_limits<double>::infinity();
    if (!(l.x() > 0)) return unbounded;
    const double opens = change.x() < 0 ? l.x() / -change.x() : unbounded;
    const Vec2 t = l.tail<2>(), dt = change.tail<2>();
    const double radius = row.friction * l.x(), growth = row.friction * change.x();
    const double inside = radius * radius - t.squaredNorm();
    if (!(inside > coneEdge * radius * radius)) return opens;
    // |t + s dt| = radius + s growth:  a s² + 2 b s = inside
    const double a = dt.squaredNorm() - growth * growth, b = t.dot(dt) - radius * growth;
    const double root = std::sqrt(std::max(0.0, b * b + a * inside));
    return b + root > 0 ? std::min(opens, inside / (b + root)) : opens;
}

// If bounds contradict each other slightly (at the four corners of a face, three of which determine its
// motion), multipliers drift along impulses that cancel, by the same amount in each round, until a contact
// opens or slips. This moves them there at once. False if none would, or if it would happen in the next
// round.
bool NewtonSolver::followDrift(const ContactProblem& problem) {
    double room = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < m_rows.size(); ++i)
        room = std::min(
            room, roomOf(problem.rows[i], m_rows[i].l, problem.rows[i].effectiveMass * m_rows[i].drift));
    if (!std::isfinite(room) || room <= m_kappa) return false;
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
        const ContactRow& row = problem.rows[i];
        RowState& state = m_rows[i];
        state.l += (room * row.effectiveMass) * state.drift;
        if (row.rolling > 0) state.rollL += (room * row.effectiveInertia / row.rolling) * state.rollDrift;
        state.drift.setZero();
        state.rollDrift.setZero();
    }
    return true;
}

// The multipliers come from inner problems that were solved, so they are usable even if the outer loop has
// not converged.
void NewtonSolver::takeBest(ContactProblem& problem, NewtonReport& report) {
    m_first.clear();
    for (const ContactRow& row : problem.rows) m_first.emplace_back(row.impulse, row.rollingImpulse);
    takeImpulses(problem);
    velocitiesFromImpulses(problem);
    const double residual = residualOf(problem);
    if (residual < report.residual) {
        report.residual = residual;
        return;
    }
    for (std::size_t i = 0; i < m_first.size(); ++i)
        std::tie(problem.rows[i].impulse, problem.rows[i].rollingImpulse) = m_first[i];
    velocitiesFromImpulses(problem);
}

void NewtonSolver::takeImpulses(ContactProblem& problem) {
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
        problem.rows[i].impulse = m_rows[i].l;
        problem.rows[i].rollingImpulse = m_rows[i].rollL;
    }
    for (std::size_t i = 0; i < problem.springs.size(); ++i) {
        SoftRow& row = problem.springs[i];
        row.impulse = -(row.offset + row.rate.cwiseProduct(relativeVelocity(problem, row)));
    }
}

} // namespace carom
