// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/contact_settings.h"
#include "core/solvers/contacts/island_motion.h"

#include <algorithm>
#include <utility>

// The smooth part of an island's motion: velocities at the end of a part of the substep under gravity and the
// forces of the contacts that hold.

namespace carom {
namespace {

/// Forces are remembered from parts of a substep that are at least this part of it. At half, forces of
/// shorter parts, which are larger, become the first guess of later ones; at twice, guesses are older.
constexpr double shortestMemory = 0.1;
/// A residual up to so many times the tolerance is near enough to go on with: the next substep begins there.
/// At half, more islands are left to the base path; at twice, velocities may be wrong by twice as much.
constexpr double nearlySolved = 1000;
/// A friction force within this part of the edge of its cone is at the edge: the contact slides. At a
/// thousandth, what the tolerance leaves lets sliding contacts count as stuck; at a thousand times, contacts
/// that stick near the edge count as sliding.
constexpr double coneEdge = 1e-6;
/// How often force terms are evaluated at the velocities found last, at most. Each round gains about six
/// digits where a term changes a velocity by a thousandth in a part of the substep. At half, terms that
/// change it by about half may be left with an error; at twice, they cost up to twice as many solves.
constexpr int mostRounds = 8;

} // namespace

// Velocities after `duration` under gravity and the forces of contacts that touch.
void IslandMotion::solveVelocities(const MotionInput& input, double duration, bool findsImpacts) {
    m_unsolved = m_turnsTooFar = m_isColdInVain = false;
    beginPart(input, duration);
    chooseRows(input, duration, findsImpacts);
    solveForces(input, duration);
    holdRims(input, duration, findsImpacts);
    if (findsImpacts && !m_unsolved && contactsTurn(input, duration)) turnContacts(input, duration);
    if (!m_forced.isEmpty()) endTerms(input);
    report.residual = std::max(report.residual, m_unsolved ? 0 : m_residual);
    // Over a very short part impulses that stop a gentle closing look like enormous forces: no guess for
    // later.
    if (duration >= shortestMemory * input.substep) keepForces(duration);
}

// What the tolerance leaves adds up along a tower, with the square of its height where it leans. An island
// that is nearly still is solved again to a finer tolerance, and ever finer while that takes its motion away,
// if that can bring it to rest: forces of n bodies are rounded by n times as much as those of one. What is
// not solved within that is as good as it was.
void IslandMotion::solveFiner(const MotionInput& input, double duration, bool findsImpacts) {
    const std::size_t count = m_problem.bodies.size();
    const double least = leastTolerance * m_scale * static_cast<double>(count);
    const bool canRest = m_still > nearlyStillOf(count) * least;
    if (isWithin(1) || !isWithin(canRest ? nearlyStillOf(count) : nearlyStill)) return;
    const auto fastest = [&] {
        double speed = 0;
        for (const ContactBody& body : m_problem.bodies) speed = std::max(speed, fastestPart(body));
        return speed;
    };
    const double asked = m_unsolved ? 0 : m_tolerance;
    double speed = fastest();
    for (bool helps = true; helps;) {
        m_tolerance *= finerTolerance;
        solveVelocities(input, duration, findsImpacts);
        m_unsolved = m_unsolved && !(m_residual <= asked);
        if (m_unsolved || remaining(input) <= 0) return;
        const double before = std::exchange(speed, fastest());
        const bool isSame = speed == before; // it was as exact already
        helps = canRest && finerTolerance * m_tolerance > least && speed > m_still &&
                (isSame || speed <= 0.5 * before);
    }
}

void IslandMotion::keepForces(double duration) {
    for (std::size_t i = 0; i < m_rowPoint.size(); ++i) {
        ContactConstraint& point = m_contacts.points[m_rowPoint[i]];
        point.force = m_problem.rows[i].impulse / duration;
        point.rollingTorque = m_problem.rows[i].rollingImpulse / duration;
    }
}

// Stores the bodies as they are at the start of a part.
void IslandMotion::beginPart(const MotionInput& input, double duration) {
    for (std::size_t i = 0; i < m_problem.bodies.size(); ++i) {
        ContactBody& body = m_problem.bodies[i];
        const BodyIndex member = m_members[i];
        if (!m_pushes.empty())
            setInertia(input.bodies.inertia[member], input.state.pose[member].orientation, body);
        body.velocity = m_start[i].velocity;
        body.freeVelocity = m_start[i].velocity;
        body.freeVelocity.head<3>() += duration * input.gravity;
    }
    m_pushes.clear();
    if (!input.bodies.forces.empty()) beginTerms(input, duration);
}

// Velocities at the end of the part: alternately solves springs and contacts for given force terms, and
// evaluates the terms at the result.
void IslandMotion::solveForces(const MotionInput& input, double duration) {
    for (int round = 0; round < mostRounds; ++round) {
        if (m_springs.empty())
            solve(input);
        else
            solveSprings(input, duration);
        if (m_forced.isEmpty() || m_unsolved || !followTerms(input)) return;
    }
}

// Angular momentum of a body at the end of the part; without an angular impulse exactly that of the start.
Vec3 IslandMotion::endMomentum(std::size_t i) const {
    const ContactBody& body = m_problem.bodies[i];
    return m_start[i].angularMomentum + body.inertia * (body.velocity - body.freeVelocity).tail<3>();
}

// Closing speeds up to this are stopped by the contact force, not by an impact: the bound uₙ + gap/T >= 0
// stops them at the surface [m/s].
double IslandMotion::gentleClosing(const ContactPair& pair) const {
    return (pair.restitution < 1 ? 1 : restingClosing) * m_scale;
}

// Springs bring bodies together again and again, at any speed within a part however they begin. Where that
// costs no energy every gap that closes ends in an impact: a force that holds it would take that energy.
bool IslandMotion::isElasticOnSprings(const ContactPair& pair) const {
    return !m_springs.empty() && !(pair.restitution < 1);
}

// A contact that opens faster than gravity alone can reverse within a substep has no force until it closes
// again: a force during the separation would do work [m/s].
double IslandMotion::gentleOpening(const ContactPair& pair) const {
    return std::max(gentleClosing(pair), 10 * m_tolerance);
}

// Rows are made for contacts that touch, and for open ones that can close at low speed only. Those that may
// close faster are left to firstImpact(), if `findsImpacts`.
void IslandMotion::chooseRows(const MotionInput& input, double duration, bool findsImpacts) {
    m_problem.rows.clear();
    m_rowPoint.clear();
    m_stuck.clear();
    m_waits.assign(m_contacts.points.size(), 0);
    for (std::uint32_t i = 0; i < m_contacts.points.size(); ++i) {
        ContactConstraint& point = m_contacts.points[i];
        const ContactPair& pair = m_contacts.pairs[m_pairOf[i]];
        const double open = point.separation - touchingWithin(pair);
        ContactRow row = rowOf(input.bodies, pair, point);
        row.bound = std::max(0.0, open) / duration;
        if (open > 0 && findsImpacts) {
            const double closing = -relativeVelocity(m_problem, row).x();
            if (closing > gentleClosing(pair) || m_scale == 0 || isElasticOnSprings(pair)) {
                point.force.setZero();
                point.rollingTorque.setZero();
                m_waits[i] = 1;
                continue;
            }
        }
        const double opening = relativeVelocity(m_problem, row).x();
        if (open <= 0 && findsImpacts && opening > gentleOpening(pair)) {
            point.force.setZero();
            point.rollingTorque.setZero();
            m_waits[i] = 1;
            continue;
        }
        // Springs can reverse velocities within a part, and a normal force over a closing gap does work at
        // the mean of the speeds at both ends. With u₁ >= −u₀ as well it adds no energy.
        if (!m_springs.empty()) row.bound = std::max(row.bound, opening - m_tolerance);
        row.impulse = duration * point.force;
        row.rollingImpulse = duration * point.rollingTorque;
        m_problem.rows.push_back(row);
        m_rowPoint.push_back(i);
        const double most = (1 - coneEdge) * point.force.x();
        m_stuck.push_back(point.force.tail<2>().norm() < row.friction * most &&
                          (row.rolling == 0 || point.rollingTorque.norm() < row.rolling * most));
    }
}

// A second attempt without remembered impulses; its result is taken if it is better than the first.
NewtonReport IslandMotion::solveCold(const MotionInput& input, const NewtonReport& warm) {
    std::swap(m_warmRows, m_problem.rows);
    m_problem.rows = m_warmRows;
    for (ContactRow& row : m_problem.rows) {
        row.impulse.setZero();
        row.rollingImpulse.setZero();
    }
    const NewtonReport cold = m_newton.solve(m_problem, m_tolerance, remaining(input));
    report.work.factorisations += static_cast<std::uint64_t>(cold.factorisations);
    m_work += cold.work;
    if (cold.solved || cold.residual < warm.residual) return cold;
    std::swap(m_warmRows, m_problem.rows);
    velocitiesFromImpulses(m_problem);
    return warm;
}

void IslandMotion::solve(const MotionInput& input) {
    if (m_problem.rows.empty() && m_problem.springs.empty()) {
        velocitiesFromImpulses(m_problem);
        m_residual = 0;
        return;
    }
    NewtonReport solved = m_newton.solve(m_problem, m_tolerance, remaining(input));
    report.work.factorisations += static_cast<std::uint64_t>(solved.factorisations);
    m_work += solved.work;
    const auto isGood = [&] { return solved.solved || solved.residual <= nearlySolved * m_tolerance; };
    const bool accurate = input.settings.tolerance < accurateTolerance;
    const bool triesAgain = !isGood() || (accurate && !m_isColdInVain);
    if (!solved.solved && triesAgain && remaining(input) > 0) {
        solved = solveCold(input, solved);
        m_isColdInVain = !solved.solved;
    }
    m_unsolved = m_unsolved || !isGood();
    m_residual = solved.residual;
}

} // namespace carom
