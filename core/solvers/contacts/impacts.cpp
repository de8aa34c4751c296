// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/impacts.h"

#include "core/solvers/contacts/audit.h"
#include "core/solvers/contacts/work_budget.h"
#include "core/solvers/joint_impulses.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

/// Closing speeds within this part of the largest have no order among them: far above rounding, far below any
/// difference a scene intends. At a millionth, rounding would break symmetry; at a million times, impacts
/// that differ by a thousandth would be solved at once.
constexpr double tie = 1e-9;
/// A response counts as singular below this reciprocal condition: its impulses would keep fewer than six
/// digits, and Newton's method finds them instead. Twice or half decides only about a third of a digit.
constexpr double singular = 1e-10;
/// Newton's tolerance relative to the fastest body: a slow impact of fast bodies is known as well as their
/// velocities. At five times, the energy of a cradle that is solved at once is wrong by more than a
/// trillionth; at a twentieth, it is near rounding (speedRounding), and a thousand factorisations do not find
/// one contact's impulse.
constexpr double groupTolerance = 2e-13;
/// Friction up to this coefficient changes no digit of an impact: it is below a double's rounding, and so are
/// twice and half of it.
constexpr double noFriction = 1e-17;
/// Entries of W this small relative to the others are rounding. At a thousandth, rounding would hide that two
/// bodies are spheres; at a million times, bodies that only resemble spheres would be solved for as spheres.
constexpr double responseRounding = 1e-13;
/// A gain of energy is rounding where this part less of all impulses would avoid it. At a millionth, rounding
/// reduces the impulses of elastic impacts; at a million times, an impact may gain about a thousandth.
constexpr double energyRounding = 1e-9;
/// Impacts in sequence before the rest is solved at once: enough for a light ball between two that are 10,000
/// times heavier, and for any cradle. At half, sequences that are twice as short end so; at twice, impacts
/// that do not come to an end cost twice as much.
constexpr int mostImpacts = 500, mostImpactsPerRow = 20;

Vec6 inverseMassTimes(const ContactBody& body, const Vec6& impulse) {
    Vec6 change;
    change.head<3>() = impulse.head<3>() / body.mass;
    change.tail<3>() = body.inverseInertia * impulse.tail<3>();
    return change;
}

// One entry of W: the separating speed of contact i by a unit normal impulse at contact k.
double couplingOf(const ContactProblem& problem, const ContactRow& i, const ContactRow& k) {
    double sum = 0;
    const auto add = [&](int bodyI, const Mat36& ji, int bodyK, const Mat36& jk) {
        if (bodyI == immobile || bodyI != bodyK) return;
        const Vec6 impulse = jk.row(0).transpose();
        sum += ji.row(0).dot(inverseMassTimes(problem.bodies[static_cast<std::size_t>(bodyI)], impulse));
    };
    add(i.a, i.jacobianA, k.a, k.jacobianA);
    add(i.a, i.jacobianA, k.b, k.jacobianB);
    add(i.b, i.jacobianB, k.a, k.jacobianA);
    add(i.b, i.jacobianB, k.b, k.jacobianB);
    return sum;
}

/// W of one contact with itself: its velocity under a unit impulse along each axis of its frame.
Mat3 responseOf(const ContactProblem& problem, const ContactRow& row) {
    Mat3 response = Mat3::Zero();
    const auto add = [&](int index, const Mat36& jacobian) {
        if (index == immobile) return;
        const ContactBody& body = problem.bodies[static_cast<std::size_t>(index)];
        for (Eigen::Index k = 0; k < 3; ++k)
            response.col(k) += jacobian * inverseMassTimes(body, jacobian.row(k).transpose());
    };
    add(row.a, row.jacobianA);
    add(row.b, row.jacobianB);
    return response;
}

/// Whether normal and tangential impulses do not couple, and all tangential directions are equal: spheres.
bool isIsotropic(const Mat3& response) {
    const double mixed = std::max({std::abs(response(0, 1)), std::abs(response(0, 2)),
                                   std::abs(response(1, 2)), std::abs(response(1, 1) - response(2, 2))});
    return mixed <= responseRounding * response(1, 1);
}

void applyNormal(ContactProblem& problem, const ContactRow& row, double impulse) {
    const auto apply = [&](int index, const Mat36& jacobian) {
        if (index == immobile) return;
        ContactBody& body = problem.bodies[static_cast<std::size_t>(index)];
        body.velocity += inverseMassTimes(body, impulse * jacobian.row(0).transpose());
    };
    apply(row.a, row.jacobianA);
    apply(row.b, row.jacobianB);
}

// The largest part of all impulses, at most 1, at which the impact gains no kinetic energy. It is 1 except
// for a group that was not solved. Momentum is kept, because the impulses stay equal and opposite.
double lossyPart(const ContactProblem& problem) {
    double linear = 0, quadratic = 0; // energy gained = part · linear + part² · quadratic
    for (const ContactBody& body : problem.bodies) {
        const Vec6 change = body.velocity - body.freeVelocity;
        Vec6 momentum;
        momentum.head<3>() = body.mass * change.head<3>();
        momentum.tail<3>() = body.inertia * change.tail<3>();
        linear += momentum.dot(body.freeVelocity);
        quadratic += 0.5 * momentum.dot(change);
    }
    if (!(quadratic > 0)) return 1;
    const double most = std::max(0.0, -linear / quadratic);
    return most >= 1 - energyRounding ? 1 : most;
}

bool shareBody(const ContactRow& i, const ContactRow& k) {
    return (i.a != immobile && (i.a == k.a || i.a == k.b)) || (i.b != immobile && (i.b == k.a || i.b == k.b));
}

} // namespace

void ImpactSolver::reserve(std::size_t bodies, std::size_t rows) {
    m_closing.reserve(rows);
    m_group.reserve(rows);
    m_firstRow.reserve(bodies + 1);
    m_nextRow.reserve(bodies + 1);
    m_rowOf.reserve(2 * rows);
    m_local.reserve(bodies);
    m_groupProblem.bodies.reserve(bodies);
    m_groupProblem.rows.reserve(rows);
    m_newton.reserve(bodies, rows);
}

ImpactReport ImpactSolver::solve(ContactProblem& problem, std::span<const ImpactRow> rows, bool simultaneous,
                                 double mostWork) {
    m_work = 0;
    m_mostWork = mostWork;
    m_factorisations = 0;
    const int most = mostImpacts + mostImpactsPerRow * static_cast<int>(rows.size());
    linkRows(problem);
    m_closing.assign(rows.size(), 0);
    m_group.clear();
    for (std::size_t i = 0; i < rows.size(); ++i) measure(problem, rows, i);
    for (int count = 0;; ++count) {
        remeasure(problem, rows);
        std::size_t largest = rows.size();
        for (std::size_t i = 0; i < rows.size(); ++i)
            if (rows[i].touching && m_closing[i] > rows[i].threshold &&
                (largest == rows.size() || m_closing[i] > m_closing[largest]))
                largest = i;
        m_work += work::look * static_cast<double>(rows.size());
        if (largest == rows.size() || m_work >= mostWork) return {count, m_factorisations, m_work};
        const bool all = simultaneous || rows[largest].restitution == 0 || count >= most;
        if (all)
            gatherAll(rows);
        else
            gather(problem, rows, largest);
        solveGroup(problem, rows);
        if (count >= most) return {count + 1, m_factorisations, m_work};
    }
}

void ImpactSolver::measure(const ContactProblem& problem, std::span<const ImpactRow> rows, std::size_t i) {
    if (rows[i].touching) m_closing[i] = -relativeVelocity(problem, problem.rows[i]).x();
}

// Lists the rows of each body.
void ImpactSolver::linkRows(const ContactProblem& problem) {
    m_firstRow.assign(problem.bodies.size() + 1, 0);
    const auto eachEnd = [&](const auto& visit) {
        for (std::size_t i = 0; i < problem.rows.size(); ++i)
            for (const int body : {problem.rows[i].a, problem.rows[i].b})
                if (body != immobile) visit(at(body), i);
    };
    eachEnd([&](std::size_t body, std::size_t) { ++m_firstRow[body + 1]; });
    for (std::size_t body = 0; body < problem.bodies.size(); ++body) m_firstRow[body + 1] += m_firstRow[body];
    m_rowOf.resize(m_firstRow.back());
    m_nextRow.assign(m_firstRow.begin(), m_firstRow.end() - 1);
    eachEnd([&](std::size_t body, std::size_t i) { m_rowOf[m_nextRow[body]++] = i; });
}

// The last group has changed the velocities of its bodies: computes the closing speeds of their rows again.
void ImpactSolver::remeasure(const ContactProblem& problem, std::span<const ImpactRow> rows) {
    for (const std::size_t member : m_group)
        for (const int body : {problem.rows[member].a, problem.rows[member].b}) {
            if (body == immobile) continue;
            for (std::size_t k = m_firstRow[at(body)]; k < m_firstRow[at(body) + 1]; ++k)
                measure(problem, rows, m_rowOf[k]);
            m_work += work::row * static_cast<double>(m_firstRow[at(body) + 1] - m_firstRow[at(body)]);
        }
}

// Gathers the fastest closing row, rows equally fast, and the other points of the same pairs, as far as they
// share bodies.
void ImpactSolver::gather(const ContactProblem& problem, std::span<const ImpactRow> rows,
                          std::size_t largest) {
    m_group.assign(1, largest);
    const double least = (1 - tie) * m_closing[largest];
    for (std::size_t member = 0; member < m_group.size(); ++member) {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (!rows[i].touching || !(m_closing[i] > 0)) continue;
            if (std::find(m_group.begin(), m_group.end(), i) != m_group.end()) continue;
            const bool samePair = rows[i].pair == rows[m_group[member]].pair;
            const bool tied =
                m_closing[i] >= least && shareBody(problem.rows[i], problem.rows[m_group[member]]);
            if (samePair || tied) m_group.push_back(i);
        }
    }
    std::sort(m_group.begin(), m_group.end());
}

void ImpactSolver::gatherAll(std::span<const ImpactRow> rows) {
    m_group.clear();
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].touching) m_group.push_back(i);
}

void ImpactSolver::solveGroup(ContactProblem& problem, std::span<const ImpactRow> rows) {
    if (!solveDirectly(problem, rows) && !solveLone(problem, rows)) solveByNewton(problem, rows);
}

// One contact with friction: u' = (−e uₙ, 0) if the impulse for that is within the cone; else the impulse is
// on the cone's edge, against the slip. For an isotropic response the slip keeps its direction.
bool ImpactSolver::solveLone(ContactProblem& problem, std::span<const ImpactRow> rows) {
    if (m_group.size() != 1) return false;
    const std::size_t index = m_group.front();
    const ContactRow& row = problem.rows[index];
    if (row.rolling > 0 || !(m_closing[index] > 0)) return false;
    const Mat3 response = responseOf(problem, row);
    Vec3 change = -relativeVelocity(problem, row);
    change.x() = (1 + rows[index].restitution) * m_closing[index];
    Vec3 impulse;
    if (isIsotropic(response)) {
        impulse << change.x() / response(0, 0), change.tail<2>() / response(1, 1);
        impulse = projectOnCone(row, impulse, Vec2::Zero()).impulse;
    } else {
        const Eigen::LDLT<Mat3> factors(response);
        if (!(factors.rcond() > singular)) return false;
        impulse = factors.solve(change);
        if (!(impulse.tail<2>().norm() <= row.friction * impulse.x())) return false;
    }
    takeGroup(problem);
    m_groupProblem.rows.front().impulse = impulse;
    velocitiesFromImpulses(m_groupProblem);
    applyGroup(problem);
    return true;
}

bool ImpactSolver::solveDirectly(ContactProblem& problem, std::span<const ImpactRow> rows) {
    const std::size_t count = m_group.size();
    if (count > std::size_t{mostJointContacts}) return false;
    for (const std::size_t i : m_group)
        if (problem.rows[i].friction > noFriction || !(m_closing[i] > 0)) return false;
    const Eigen::Index size = static_cast<Eigen::Index>(count);
    JointResponse w(size, size);
    JointValues right(size), impulse;
    for (Eigen::Index i = 0; i < size; ++i) {
        const std::size_t rowI = m_group[static_cast<std::size_t>(i)];
        right[i] = (1 + rows[rowI].restitution) * m_closing[rowI];
        for (Eigen::Index k = 0; k < size; ++k)
            w(i, k) =
                couplingOf(problem, problem.rows[rowI], problem.rows[m_group[static_cast<std::size_t>(k)]]);
    }
    if (!jointImpulses(w, right, impulse)) return false;
    for (Eigen::Index i = 0; i < size; ++i)
        applyNormal(problem, problem.rows[m_group[static_cast<std::size_t>(i)]], impulse[i]);
    if (ledger == nullptr) return true;
    for (std::size_t i = 0; i < count; ++i) {
        const ContactRow& row = problem.rows[m_group[i]];
        const double mean = 0.5 * (relativeVelocity(problem, row).x() - m_closing[m_group[i]]);
        recordNormal(row, impulse[static_cast<Eigen::Index>(i)], mean, LedgerAccount::Restitution, *ledger);
    }
    return true;
}

void ImpactSolver::solveByNewton(ContactProblem& problem, std::span<const ImpactRow> rows) {
    takeGroup(problem);
    double fastest = 0;
    for (const ContactBody& body : m_groupProblem.bodies) fastest = std::max(fastest, fastestPart(body));
    for (std::size_t k = 0; k < m_group.size(); ++k) {
        const std::size_t i = m_group[k];
        m_groupProblem.rows[k].bound = -rows[i].restitution * std::max(0.0, m_closing[i]);
    }
    const NewtonReport report =
        m_newton.solve(m_groupProblem, groupTolerance * fastest, std::max(0.0, m_mostWork - m_work));
    m_work += report.work;
    m_factorisations += report.factorisations;
    applyGroup(problem);
}

// Copies the group into a problem of its own, without impulses.
void ImpactSolver::takeGroup(const ContactProblem& problem) {
    m_groupProblem.clear();
    m_local.assign(problem.bodies.size(), immobile);
    const auto localOf = [&](int body) {
        if (body == immobile) return immobile;
        int& local = m_local[static_cast<std::size_t>(body)];
        if (local == immobile) {
            local = static_cast<int>(m_groupProblem.bodies.size());
            m_groupProblem.bodies.push_back(problem.bodies[static_cast<std::size_t>(body)]);
            m_groupProblem.bodies.back().freeVelocity = m_groupProblem.bodies.back().velocity;
        }
        return local;
    };
    for (const std::size_t i : m_group) {
        ContactRow row = problem.rows[i];
        row.a = localOf(row.a);
        row.b = localOf(row.b);
        row.impulse.setZero();
        row.rollingImpulse.setZero();
        m_groupProblem.rows.push_back(row);
    }
}

// Applies the velocities of the solved group.
void ImpactSolver::applyGroup(ContactProblem& problem) {
    const double part = lossyPart(m_groupProblem);
    for (std::size_t body = 0; body < m_local.size(); ++body) {
        if (m_local[body] == immobile) continue;
        const ContactBody& solved = m_groupProblem.bodies[static_cast<std::size_t>(m_local[body])];
        problem.bodies[body].velocity += part * (solved.velocity - solved.freeVelocity);
    }
    if (ledger == nullptr) return;
    m_mean.clear();
    for (const ContactBody& body : m_groupProblem.bodies)
        m_mean.push_back(body.freeVelocity + (0.5 * part) * (body.velocity - body.freeVelocity));
    recordRows(m_groupProblem, m_mean, part, LedgerAccount::Restitution, *ledger);
}

} // namespace carom
