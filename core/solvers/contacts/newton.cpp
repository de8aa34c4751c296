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
constexpr double kappaWarm = 1e2, kappaLeast = 1e-2, kappaMost = 1e9, kappaGrowth = 10;
/// A warm start is poor if the error of the first inner problem falls slowly after so many steps: begin again
/// with κ = 1. At half, good guesses are given up; at twice, poor ones cost twice as many factorisations.
constexpr int fewSteps = 6;
/// Where the error no longer falls but is within this factor of the tolerance, or within κ times the
/// rounding, rounding is what is left; the solution is good only in the first case. At half, problems that
/// are as good as solved go on to the limit of steps; at twice, larger errors are left.
constexpr double stallNearby = 10;
/// The inner problem is solved to this part of the tolerance. At half, rounding hinders it earlier; at twice,
/// its error is a fifth of the tolerance, and more rounds are made.
constexpr double innerPart = 0.1;
/// Steps that do not halve the least error until rounding is what is left. With one, a step that passes a
/// kink ends the iteration; with four, two more steps are made of nothing but rounding, which may lead away.
constexpr int mostStalled = 2;
/// Rounds that do not halve the least change until none is expected to. At half, bounds that contradict each
/// other are left before the drift along them has ended; at twice, problems without a solution cost twice as
/// much.
constexpr int mostVain = 20;
/// Inner steps and outer rounds at most; the hardest problems met took 40 and 30. At half of the first, these
/// fail; at twice, a problem without a solution costs twice as much where its budget allows that.
constexpr int mostSteps = 60, mostRounds = 80;
/// After each inner problem that fails the later ones may take half as many steps, down to this: what
/// succeeds takes few, and failing again in the same way shows nothing new. At half, problems that would be
/// solved are given up; at twice, one without a solution costs up to twice as much.
constexpr int leastSteps = 30;
/// The inner error should fall at least to this part in a step; else the coupled step is tried, at the cost
/// of another factorisation, and the matrix is not used again. At half, it is tried more often in vain; at
/// twice, slow convergence lasts longer.
constexpr double slowFall = 0.1;
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

void saveVelocities(const ContactProblem& problem, std::vector<Vec6>& saved) {
    saved.clear();
    for (const ContactBody& body : problem.bodies) saved.push_back(body.velocity);
}

void takeVelocities(const std::vector<Vec6>& saved, ContactProblem& problem) {
    for (std::size_t i = 0; i < saved.size(); ++i) problem.bodies[i].velocity = saved[i];
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
    m_savedRows.reserve(rows);
    m_savedGradient.reserve(bodies);
    m_best.reserve(bodies);
    m_solved.reserve(bodies);
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
    m_solved.clear();
    m_isCoupledBetter = false;
    report.factorisations += startFromNothing(problem);
    m_factoredAt = 0; // that of the first guess is another problem's
    double whole = std::numeric_limits<double>::infinity(), least = whole;
    bool first = true;
    int most = mostSteps, vain = 0;
    double kappaLimit = kappaMost; // below a κ at which an inner problem has failed
    for (int round = 0; round < mostRounds; ++round) {
        if (m_work >= mostWork) {
            takeBest(problem, report);
            report.work = m_work;
            return report;
        }
        Steps steps{.most = most, .surely = first ? fewSteps : most};
        const double inner = std::max(innerPart * tolerance, 0.01 * residual);
        const bool minimised = minimise(problem, inner, mostWork, steps);
        report.factorisations += steps.taken;
        if (first && !minimised) {
            m_kappa = 1;
            resetMultipliers(problem); // those of the warm start
            first = false;
            continue;
        }
        first = false;
        ++vain;
        if (!minimised) { // multipliers from an unsolved inner problem would be amplified by ρ
            kappaLimit = std::max(kappaWarm, m_kappa / kappaGrowth);
            const double part = std::min(1 / kappaGrowth, steps.limit > 0 ? inner / steps.limit : 1);
            m_kappa = std::max(kappaLeast, part * m_kappa);
            if (steps.limit > 0) continue;
            if (!m_solved.empty()) takeVelocities(m_solved, problem); // those that failed may have run away
            most = std::max(leastSteps, most / 2);
            continue;
        }
        saveVelocities(problem, m_solved);
        const double change = updateMultipliers(problem);
        if (change <= 0.5 * least) {
            least = change;
            vain = 0;
        }
        if (vain >= mostVain && change <= 2 * least) break;
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
            m_kappa = std::min(kappaLimit, m_kappa * kappaGrowth);
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
    double fastest = 0;
    for (const ContactBody& body : problem.bodies)
        fastest = std::max({fastest, fastestPart(body), fastestPart(body.freeVelocity, body.gyration)});
    for (const ContactRow& row : problem.rows) fastest = std::max(fastest, std::abs(row.bound));
    m_rounding = std::numeric_limits<double>::epsilon() * fastest;
    m_solveWork = work::apply * static_cast<double>(2 * m_matrix.couplings() + problem.bodies.size());
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
// not at all. Then a step with the whole derivative of G is tried, and taken if it halves the error; where it
// did it is tried at once the next time. The matrix of the step before serves again while it still fits.
bool NewtonSolver::minimise(ContactProblem& problem, double tolerance, double mostWork, Steps& steps) {
    double before = std::numeric_limits<double>::infinity(), best = before, error = errorAt(problem);
    int stalled = 0; // steps since the least error was halved
    for (steps.taken = 0; steps.taken < steps.most && m_work < mostWork;) {
        if (error <= tolerance) return true;
        if (!std::isfinite(error)) return false;
        const bool isSlow = error > slowFall * before;
        if (steps.taken >= steps.surely && isSlow) return false;
        stalled = error > 0.5 * best ? stalled + 1 : 0;
        if (stalled == 0) {
            best = error;
            saveVelocities(problem, m_best);
        }
        if (stalled >= mostStalled && best <= std::max(stallNearby * tolerance, m_kappa * m_rounding)) {
            takeVelocities(m_best, problem);
            steps.limit = errorAt(problem);
            return steps.limit <= stallNearby * tolerance;
        }
        before = error;
        if (isFactored() && stepAgain(problem, error)) continue;
        if ((isSlow || m_isCoupledBetter) && stepCoupled(problem, error, steps.taken)) continue;
        if (!findStep(problem, false)) return false;
        ++steps.taken;
        const double along = lineSearch(problem);
        if (!std::isfinite(along)) return false;
        for (std::size_t i = 0; i < m_step.size(); ++i) problem.bodies[i].velocity += along * m_step[i];
        error = errorAt(problem);
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
    m_factoredAt = 0;
    if (!factor(problem, coupled)) return false;
    m_factoredAt = m_kappa;
    for (RowState& state : m_rows) state.factoredSide = state.side;
    solveForStep();
    return true;
}

void NewtonSolver::solveForStep() {
    for (std::size_t i = 0; i < m_step.size(); ++i) m_step[i] = -m_units.perMass * m_gradient[i];
    m_matrix.solve(m_step);
}

// Whether the factored matrix is that of a problem in which the same contacts open, stick and slip.
bool NewtonSolver::isFactored() const {
    return m_factoredAt == m_kappa && std::all_of(m_rows.begin(), m_rows.end(), [](const RowState& state) {
               return state.side == state.factoredSide;
           });
}

// Takes the whole step, if it lets the error fall to this part of it.
bool NewtonSolver::tryStep(ContactProblem& problem, double part, double& error) {
    saveVelocities(problem, m_saved);
    m_savedRows.assign(m_rows.begin(), m_rows.end());
    m_savedSpringU = m_springU;
    m_savedGradient = m_gradient;
    for (std::size_t i = 0; i < m_step.size(); ++i) problem.bodies[i].velocity += m_step[i];
    const double after = errorAt(problem);
    if (after <= part * error) {
        error = after;
        return true;
    }
    takeVelocities(m_saved, problem);
    m_work += m_rowWork; // as if all were computed again
    for (std::size_t i = 0; i < m_rows.size(); ++i) static_cast<RowValues&>(m_rows[i]) = m_savedRows[i];
    std::swap(m_springU, m_savedSpringU);
    std::swap(m_gradient, m_savedGradient);
    return false;
}

// A step with the matrix that is factored.
bool NewtonSolver::stepAgain(ContactProblem& problem, double& error) {
    m_work += m_solveWork;
    solveForStep();
    return tryStep(problem, slowFall, error);
}

bool NewtonSolver::stepCoupled(ContactProblem& problem, double& error, int& steps) {
    const bool any = std::any_of(m_rows.begin(), m_rows.end(),
                                 [](const RowState& state) { return state.side == Side::Slips; });
    if (!any) return false;
    ++steps;
    m_isCoupledBetter = findStep(problem, true) && tryStep(problem, 0.5, error);
    return m_isCoupledBetter;
}

CAROM_WIDE void NewtonSolver::evaluateRows(const ContactProblem& problem) {
    const auto velocity = [&](std::size_t body) -> const Vec6& { return problem.bodies[body].velocity; };
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
        const ContactRow& row = problem.rows[i];
        m_rows[i].u = velocityAlong(row, velocity);
        m_rows[i].u.x() += row.bound;
        if (row.rolling > 0) m_rows[i].roll = spinAlong(row, velocity);
    }
    for (std::size_t i = 0; i < m_springU.size(); ++i)
        m_springU[i] = relativeVelocity(problem, problem.springs[i]);
}

CAROM_INLINE NewtonSolver::Side NewtonSolver::sideOf(const ContactRow& row, const RowState& state) {
    const double normal = state.z.x();
    if (!(normal > 0)) return Side::Open;
    const bool slips = (row.friction > 0 && sizeBeyond(state.z.tail<2>(), row.friction * normal) > 0) ||
                       (row.rolling > 0 && sizeBeyond(state.rollZ, row.rolling * normal) > 0);
    return slips ? Side::Slips : Side::Sticks;
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
        state.side = sideOf(row, state);
    }
}

// Computes G; returns the largest change of velocity M⁻¹ G [m/s].
CAROM_WIDE double NewtonSolver::gradient(const ContactProblem& problem) {
    for (std::size_t i = 0; i < m_gradient.size(); ++i)
        m_gradient[i] =
            momentumOf(problem.bodies[i], problem.bodies[i].velocity - problem.bodies[i].freeVelocity);
    const auto subtract = [&](const auto& row, const Vec3& impulse) {
        const auto from = [&](int body, const Mat36& jacobian) {
            if (body == immobile) return;
            double* const sum = m_gradient[at(body)].data();
            storeColumn(sum, loadColumn(sum) - times(rowsOf(jacobian), impulse.data()));
        };
        from(row.a, row.jacobianA);
        from(row.b, row.jacobianB);
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
