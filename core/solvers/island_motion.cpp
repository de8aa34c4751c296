// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/island_motion.h"

#include "core/dynamics/contact_memory.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/free_rotation.h"
#include "core/math/rotation.h"
#include "core/solvers/bookings.h"
#include "core/solvers/contact_settings.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

bool areStill(const State& state, std::span<const BodyIndex> bodies) {
    return std::all_of(bodies.begin(), bodies.end(), [&](BodyIndex i) {
        return state.velocity[i] == Vec3::Zero() && state.angularVelocity[i] == Vec3::Zero();
    });
}

} // namespace

bool IslandMotion::advance(const MotionInput& input, const Island& island, const ContactSet& found) {
    load(input, island, found);
    const bool wereStill = island.links.empty() && areStill(input.state, island.bodies);
    if (!bounce(input, island) && !movePile(input, island)) move(input, island);
    return wereStill && !m_parted && areStill(input.state, island.bodies);
}

void IslandMotion::move(const MotionInput& input, const Island& island) {
    const bool accurate = input.settings.tolerance < accurateTolerance;
    const int points = static_cast<int>(m_contacts.points.size());
    const bool locates = m_isSmall || (accurate && points <= mostLocatedAccurate);
    const int most =
        (accurate ? mostEventsAccurate : mostEvents) + (m_isSmall ? mostEventsPerPoint * points : 0);
    int events = locates ? 0 : most;
    for (double left = input.substep; left > 0;) {
        const bool locating = events < most;
        m_rattles = locates && 2 * events > most;
        part(input, island);
        loadBodies(input, island);
        impacts(input, left, locating);
        double duration = left;
        smooth(input, duration, locating);
        if (locating) {
            double event = firstImpact(input, duration);
            if (event >= duration && accurate && m_isSmall) event = firstStop(input, duration);
            if (event < (1 - shortestPart) * duration) {
                duration = std::max(event, shortestPart * input.substep);
                smooth(input, duration, locating);
                ++events;
            }
        }
        if (duration == left && !isWithin(1) && isWithin(nearlyStill)) {
            m_tolerance *= finerTolerance;
            smooth(input, duration, locating);
        }
        if ((report.loss = findLoss(island))) break;
        if (input.ledger != nullptr) bookForces(input, duration);
        if (duration == left) {
            settle(input);
            countPatience();
        }
        commit(input, island, duration);
        left = duration < left ? left - duration : 0;
        if (left > 0 || accurate) recollide(input);
    }
    // No overlap is shown. Parting is linear in the displacement: what turns far overlaps a little again.
    // Deep overlaps are left to the substeps to come, or bodies would part faster than they may.
    for (int round = 0; accurate && !report.loss && round < mostPartings; ++round) {
        if (std::max(m_overlap, relativeOverlap()) > 0.5 * mostParting) break;
        part(input, island);
    }
}

void IslandMotion::load(const MotionInput& input, const Island& island, const ContactSet& found) {
    m_members = island.bodies;
    m_local.resize(input.bodies.count(), immobile);
    for (std::size_t i = 0; i < island.bodies.size(); ++i) m_local[island.bodies[i]] = static_cast<int>(i);
    m_contacts.clear();
    for (const std::uint32_t pair : island.pairs)
        m_contacts.append(found.pairs[pair], found.pointsOf(found.pairs[pair]));
    m_springs.assign(island.links.begin(), island.links.end());
    m_isSmall = m_contacts.points.size() <= std::size_t{mostLocatedPoints};
    if (m_isSmall) makeRoomToTurn();
    m_scale = input.gravity.norm() * input.substep;
    m_still = std::max(input.settings.tolerance, 1e-14) * m_scale;
    m_newtonSteps = newtonSteps(input, island);
    m_failed = m_parted = false;
    m_overlap = 0;
    for (const ContactPair& pair : m_contacts.pairs)
        for (const ContactConstraint& point : m_contacts.pointsOf(pair))
            report.maxPenetration = std::max(report.maxPenetration, -point.separation);
}

// How much an exact solution is worth: any effort in an accurate run, much in a small island, some in a
// larger one unless it was in vain lately.
int IslandMotion::newtonSteps(const MotionInput& input, const Island& island) const {
    const int points = static_cast<int>(m_contacts.points.size());
    const bool springsAlone = points == 0; // sweeps know nothing of springs
    if (springsAlone || input.settings.tolerance < accurateTolerance) return mostStepsAccurate;
    if (points <= mostNewtonAlways || !island.links.empty()) return mostStepsMoving / points;
    if (points > mostNewtonResting) return 0;
    for (const ContactPair& pair : m_contacts.pairs)
        if (pair.patience > 0) return 0;
    double fastest = 0;
    for (const BodyIndex i : island.bodies) fastest = std::max(fastest, input.state.velocity[i].norm());
    if (PileMotion::treats(input.bodies, island.bodies, m_contacts))
        return fastest <= grainsResting * m_scale ? mostStepsResting : 0;
    if (points <= mostNewtonMoving) return mostStepsMoving / points;
    if (fastest <= atRest * m_scale) return mostStepsAtRest / points;
    return fastest <= nearlyResting * m_scale ? mostStepsResting : 0;
}

// After a vain attempt sweeps do for a while.
void IslandMotion::countPatience() {
    for (ContactPair& pair : m_contacts.pairs)
        pair.patience = m_failed ? patience : static_cast<std::uint16_t>(std::max(0, pair.patience - 1));
}

// A big moving pile of spheres.
bool IslandMotion::movePile(const MotionInput& input, const Island& island) {
    if (m_newtonSteps > 0 || !m_springs.empty() || input.settings.simultaneous ||
        !PileMotion::treats(input.bodies, island.bodies, m_contacts))
        return false;
    const int points = static_cast<int>(m_contacts.points.size());
    const PileInput pile{.bodies = input.bodies,
                         .gravity = input.gravity,
                         .substep = input.substep,
                         .tolerance = input.settings.tolerance * m_scale,
                         .sweeps = points <= mostNewtonMoving ? smallPileSweeps : input.settings.iterations,
                         .state = input.state};
    Invariants before;
    if (input.ledger != nullptr)
        before = invariantsOf(input.bodies, island.bodies, input.state, input.gravity);
    const double residual = m_pile.advance(pile, island.bodies, m_contacts);
    if (input.ledger != nullptr) { // a sweep's impulses are never apart: contact stands for all of them
        const Invariants after = invariantsOf(input.bodies, island.bodies, input.state, input.gravity);
        bookDifference(before, after, weightOf(input.bodies, island.bodies, input.substep * input.gravity),
                       LedgerAccount::Contact, *input.ledger);
    }
    report.residual = std::max(report.residual, residual);
    report.impacts += static_cast<int>(m_pile.impacts());
    m_parted = m_pile.parted();
    countPatience();
    return true;
}

void IslandMotion::recollide(const MotionInput& input) {
    std::swap(m_before, m_contacts);
    m_contacts.clear();
    for (const ContactPair& pair : m_before.pairs) {
        const std::size_t count = m_contacts.pairs.size();
        collideInto(input.bodies, input.state, pair, m_before.pointsOf(pair), m_contacts);
        // A pair that has no points now keeps its place: it may have some later in the substep.
        if (m_contacts.pairs.size() == count) m_contacts.append(pair, {});
    }
}

void setInertia(const Vec3& principal, const Quat& orientation, ContactBody& body) {
    const Vec3 inverse = principal.cwiseInverse();
    if (isIsotropic(principal)) {
        body.inertia = principal.asDiagonal();
        body.inverseInertia = inverse.asDiagonal();
        return;
    }
    const Mat3 turn = orientation.toRotationMatrix();
    body.inertia = turn * principal.asDiagonal() * turn.transpose();
    body.inverseInertia = turn * inverse.asDiagonal() * turn.transpose();
}

void IslandMotion::loadBodies(const MotionInput& input, const Island& island) {
    m_problem.clear();
    m_start.clear();
    double fastest = 0;
    for (const BodyIndex i : island.bodies) {
        ContactBody& body = m_problem.bodies.emplace_back();
        body.velocity << input.state.velocity[i], input.state.angularVelocity[i];
        body.mass = input.bodies.mass[i];
        setInertia(input.bodies.inertia[i], input.state.pose[i].orientation, body);
        body.gyration = std::sqrt(input.bodies.inertia[i].maxCoeff() / body.mass);
        fastest = std::max(fastest, fastestPart(body));
    }
    const double scale = m_scale > 0 ? m_scale : fastest;
    m_tolerance = std::max(input.settings.tolerance * scale, speedRounding * fastest);
    m_pairOf.clear();
    for (std::uint32_t pair = 0; pair < m_contacts.pairs.size(); ++pair)
        m_pairOf.insert(m_pairOf.end(), m_contacts.pairs[pair].count, pair);
}

ContactRow IslandMotion::rowOf(const Bodies& bodies, const ContactPair& pair,
                               const ContactConstraint& point) const {
    ContactRow row;
    row.a = localOf(pair.a);
    row.b = localOf(pair.b);
    row.ballA = bodies.turnedByImpacts[pair.a] == 0;
    row.ballB = bodies.turnedByImpacts[pair.b] == 0;
    row.frame = point.frame;
    row.armA = point.armA;
    row.armB = point.armB;
    row.friction = pair.friction;
    row.rolling = pair.rolling;
    prepareRow(m_problem, row);
    return row;
}

// The deepest overlap that is to be parted, relative to the smaller body; 0 if there is none.
double IslandMotion::relativeOverlap() const {
    double deepest = 0;
    for (const ContactPair& pair : m_contacts.pairs)
        for (const ContactConstraint& point : m_contacts.pointsOf(pair))
            if (point.separation < -touchingWithin(pair))
                deepest = std::max(deepest, -point.separation / pair.size);
    return deepest;
}

// Parts bodies that overlap by the least displacement, in the sense of kinetic energy, that opens the gaps:
// the contact problem with lengths for velocities.
void IslandMotion::part(const MotionInput& input, const Island& island) {
    const double overlap = relativeOverlap();
    m_overlap = std::max(m_overlap, overlap);
    if (overlap == 0) return;
    m_parted = true;
    loadBodies(input, island);
    m_parting.clear();
    m_parting.bodies = m_problem.bodies;
    for (ContactBody& body : m_parting.bodies) body.freeVelocity.setZero();
    double narrowest = std::numeric_limits<double>::infinity(); // [m]
    for (const ContactPair& pair : m_contacts.pairs) {
        narrowest = std::min(narrowest, touchingWithin(pair));
        for (const ContactConstraint& point : m_contacts.pointsOf(pair)) {
            ContactRow row = rowOf(input.bodies, pair, point);
            row.friction = row.rolling = 0;
            row.bound = std::max(point.separation, -mostParting * pair.size);
            m_parting.rows.push_back(row);
        }
    }
    const double spinBefore =
        input.ledger != nullptr ? spinEnergy(input.bodies, island.bodies, input.state) : 0;
    const double tolerance = 1e-3 * narrowest;
    if (!m_newton.solve(m_parting, tolerance, m_newtonSteps).solved)
        m_gaussSeidel.solve(m_parting, tolerance, 2 * input.settings.iterations);
    for (std::size_t i = 0; i < island.bodies.size(); ++i) {
        Pose& pose = input.state.pose[island.bodies[i]];
        const Vec6& displacement = m_parting.bodies[i].velocity;
        pose.position += displacement.head<3>();
        if (displacement.tail<3>() != Vec3::Zero())
            pose.orientation = (fromRotationVector(displacement.tail<3>()) * pose.orientation).normalized();
    }
    if (input.ledger != nullptr) bookParting(input, island, spinBefore);
    recollide(input);
}

void IslandMotion::impacts(const MotionInput& input, double duration, bool locating) {
    m_problem.rows.clear();
    m_impactRows.clear();
    double fastest = 0;
    for (const ContactBody& body : m_problem.bodies) fastest = std::max(fastest, fastestPart(body));
    const double rounding = std::max(speedRounding * fastest, 10 * input.settings.tolerance * m_scale);
    bool any = false;
    for (std::uint32_t p = 0; p < m_contacts.pairs.size(); ++p) {
        const ContactPair& pair = m_contacts.pairs[p];
        const double e = pair.restitution;
        const double rattle = m_rattles && e > 0 && e < 1 ? rattling * fastest : 0;
        const double threshold = std::max({leastImpactPart(e) * m_scale, rounding, rattle});
        for (const ContactConstraint& point : m_contacts.pointsOf(pair)) {
            ContactRow row = rowOf(input.bodies, pair, point);
            const double closing = -relativeVelocity(m_problem, row).x();
            const bool touching = point.separation <= touchingWithin(pair) ||
                                  (!locating && closing * duration > point.separation);
            m_problem.rows.push_back(row);
            m_impactRows.push_back({e, threshold, p, touching});
            any = any || (touching && closing > threshold);
        }
    }
    m_impacts.ledger = input.ledger;
    if (any)
        report.impacts +=
            m_impacts.solve(m_problem, m_impactRows, input.settings.simultaneous || !locating, m_newtonSteps);
    for (std::size_t i = 0; i < m_problem.bodies.size(); ++i) {
        if (i >= m_start.size()) m_start.emplace_back();
        const ContactBody& body = m_problem.bodies[i];
        const bool hit = body.velocity.tail<3>() != input.state.angularVelocity[m_members[i]];
        m_start[i] = {body.velocity, hit ? Vec3(body.inertia * body.velocity.tail<3>())
                                         : angularMomentumOf(input.bodies, m_members[i], input.state)};
    }
}

// Whether no body was or is faster than so many times the tolerance.
bool IslandMotion::isWithin(double factor) const {
    if (m_problem.rows.empty() || !m_problem.springs.empty() || m_scale == 0) return false;
    for (std::size_t i = 0; i < m_problem.bodies.size(); ++i) {
        const ContactBody& body = m_problem.bodies[i];
        if (fastestPart(body) > factor * m_still) return false;
        if (fastestPart(m_start[i].velocity, body.gyration) > factor * m_still) return false;
    }
    return true;
}

// A body within the tolerance of rest is at rest: the forces balance as well as they are known.
void IslandMotion::settle(const MotionInput& input) {
    if (!isWithin(1)) return;
    if (input.ledger != nullptr) bookMotion(m_problem, -1, LedgerAccount::Rest, *input.ledger);
    for (std::size_t i = 0; i < m_problem.bodies.size(); ++i) {
        m_problem.bodies[i].velocity.setZero();
        m_problem.bodies[i].freeVelocity.setZero();
        m_start[i].angularMomentum.setZero();
    }
}

// Velocities that are no numbers are found before they make places that are none.
Loss IslandMotion::findLoss(const Island& island) const {
    for (std::size_t i = 0; i < m_problem.bodies.size(); ++i) {
        const Vec6& velocity = m_problem.bodies[i].velocity;
        if (velocity.allFinite()) continue;
        return {island.bodies[i], velocity.head<3>().allFinite() ? "angular velocity" : "velocity"};
    }
    return {};
}

void IslandMotion::commit(const MotionInput& input, const Island& island, double duration) {
    for (std::size_t i = 0; i < island.bodies.size(); ++i) {
        const BodyIndex body = island.bodies[i];
        const Vec6& before = m_start[i].velocity;
        const Vec6& after = m_problem.bodies[i].velocity;
        input.state.pose[body].position += (0.5 * duration) * (before.head<3>() + after.head<3>());
        input.state.velocity[body] = after.head<3>();
        input.state.angularVelocity[body] = after.tail<3>();
        rotateBetween(input.bodies, body, m_start[i].angularMomentum, endMomentum(i), duration, input.state);
    }
    if (input.ledger != nullptr) bookTurning(input, island);
}

} // namespace carom
