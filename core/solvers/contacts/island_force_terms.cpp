// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/island_motion.h"

#include <algorithm>

// Force terms within an island (dynamics/forced_steps.h). Over a part of the substep they are linearised
// about a guess of the velocities. Each body then has another mass m̃ and another free velocity v̂, and the
// problem is solved for contacts and springs as usual. The first guess is the motion without contacts and
// springs.

namespace carom {
namespace {

/// The change of a velocity, relative to the fastest, below which force terms are not evaluated again. At a
/// hundredth, rounding keeps the rounds from ending; at a hundred times, two digits are lost.
constexpr double roundsEnd = 1e-14;

} // namespace

void IslandMotion::beginTerms(const MotionInput& input, double duration) {
    m_forced.clear();
    for (std::size_t i = 0; i < m_members.size(); ++i) {
        const BodyIndex body = m_members[i];
        if (!input.bodies.forces.actOn(body)) continue;
        const Start& start = m_start[i];
        m_forced.add(i, input.bodies,
                     {body, input.state.pose[body], start.velocity.head<3>(), start.velocity.tail<3>(),
                      start.angularMomentum},
                     duration);
    }
    if (m_forced.isEmpty()) return;
    m_forced.solve(input.bodies.forces, input.gravity, duration);
    applyTerms();
}

void IslandMotion::applyTerms() {
    for (const ForcedSteps::Step& step : m_forced.steps()) {
        ContactBody& body = m_problem.bodies[step.owner];
        body.mass = m_forced.massOf(step);
        body.freeVelocity.head<3>() = m_forced.freeVelocityOf(step);
    }
}

// Evaluates the terms at the velocities found. True if that changes the problem.
bool IslandMotion::followTerms(const MotionInput& input) {
    double fastest = 0;
    for (ForcedSteps::Step& step : m_forced.steps()) {
        step.after = m_problem.bodies[step.owner].velocity.head<3>();
        fastest = std::max({fastest, step.after.norm(), step.before.norm()});
    }
    if (!m_forced.follow(input.bodies.forces, std::max(roundsEnd * fastest, m_tolerance))) return false;
    applyTerms();
    return true;
}

// Gives bodies their own masses again.
void IslandMotion::endTerms(const MotionInput& input) {
    for (ForcedSteps::Step& step : m_forced.steps()) {
        ContactBody& body = m_problem.bodies[step.owner];
        body.mass = input.bodies.mass[m_members[step.owner]];
        step.after = body.velocity.head<3>();
        step.given = m_forced.impulseOf(step);
    }
}

void IslandMotion::recordTerms(const MotionInput& input) {
    m_forced.record(input.bodies.forces, *input.ledger);
}

} // namespace carom
