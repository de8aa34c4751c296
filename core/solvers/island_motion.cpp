// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/island_motion.h"

#include "core/dynamics/contact_memory.h"
#include "core/dynamics/free_rotation.h"
#include "core/math/rotation.h"
#include "core/narrowphase/narrowphase.h"
#include "core/solvers/bounce_train.h"
#include "core/solvers/contact_settings.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// Rounding of a velocity: no tolerance is smaller than this part of the speeds in play.
constexpr double speedRounding = 4e-15;

/// No part of a substep is shorter than this part of it: forces are impulses over a duration.
constexpr double shortestPart = 1e-9;

/// Forces are remembered from parts of at least this part of the substep.
constexpr double shortestMemory = 0.1;
/// Sweeps that must do where Newton's method does not get there from a warm nor from a cold start.
constexpr int rescueSweeps = 200;

double rimSpeed(const ContactBody& body) {
    return std::max(body.velocity.head<3>().norm(), body.velocity.tail<3>().norm() * body.gyration);
}

/// The first t in (0, duration] at which gap + u0 t + (u1 − u0) t²/(2 duration) vanishes; infinite if none.
double closingTime(double gap, double u0, double u1, double duration) {
    const double a = 0.5 * (u1 - u0) / duration;
    const double discriminant = u0 * u0 - 4 * a * gap;
    if (discriminant < 0) return std::numeric_limits<double>::infinity();
    const double q =
        std::sqrt(discriminant) - u0; // −2 gap/(u0 − sqrt): the root that comes first while closing
    if (q <= 0) return std::numeric_limits<double>::infinity();
    return 2 * gap / q;
}

} // namespace

void IslandMotion::advance(const MotionInput& input, const Island& island, const ContactSet& found,
                           ContactSet& kept) {
    load(input, island, found);
    if (bounce(input, island)) {
        keep(kept);
        return;
    }
    const bool accurate = input.settings.tolerance < accurateTolerance;
    const int points = static_cast<int>(m_contacts.points.size());
    const int most = (accurate ? mostEventsAccurate : mostEvents) + mostEventsPerPoint * points;
    int events = points <= mostLocatedPoints ? 0 : most;
    for (double left = input.substep; left > 0;) {
        const bool locating = events < most;
        part(input, island);
        loadBodies(input, island);
        impacts(input, left, locating);
        double duration = left;
        smooth(input, duration, locating);
        if (locating) {
            double event = firstImpact(input, island, duration);
            if (event >= duration && accurate) event = firstStop(input, duration);
            if (event < (1 - shortestPart) * duration) {
                duration = std::max(event, shortestPart * input.substep);
                smooth(input, duration, locating);
                ++events;
            }
        }
        if (duration == left) settle(input);
        commit(input, island, duration);
        left = duration < left ? left - duration : 0;
        if (left > 0) recollide(input);
    }
    keep(kept);
}

void IslandMotion::load(const MotionInput& input, const Island& island, const ContactSet& found) {
    m_local.resize(input.bodies.count(), immobile);
    for (std::size_t i = 0; i < island.bodies.size(); ++i) m_local[island.bodies[i]] = static_cast<int>(i);
    m_contacts.clear();
    for (const std::uint32_t pair : island.pairs)
        m_contacts.append(found.pairs[pair], found.pointsOf(found.pairs[pair]));
    m_springs.assign(island.links.begin(), island.links.end());
    m_scale = input.gravity.norm() * input.substep;
    m_exact = deservesNewton(input, island);
    for (const ContactPair& pair : m_contacts.pairs)
        for (const ContactConstraint& point : m_contacts.pointsOf(pair))
            report.maxPenetration = std::max(report.maxPenetration, -point.separation);
}

// Small islands, islands nearly at rest, and every island of an accurate run.
bool IslandMotion::deservesNewton(const MotionInput& input, const Island& island) const {
    const int points = static_cast<int>(m_contacts.points.size());
    if (points <= mostNewtonMoving || input.settings.tolerance < accurateTolerance) return true;
    if (points > mostNewtonResting) return false;
    double fastest = 0;
    for (const BodyIndex i : island.bodies) fastest = std::max(fastest, input.state.velocity[i].norm());
    return fastest <= nearlyResting * m_scale;
}

// A lone ball that bounces on a lone wall has a closed form, however many bounces a substep holds.
bool IslandMotion::bounce(const MotionInput& input, const Island& island) {
    if (island.bodies.size() != 1 || !island.links.empty() || m_contacts.points.size() != 1) return false;
    const ContactPair& pair = m_contacts.pairs.front();
    const BodyIndex ball = island.bodies.front();
    const BodyIndex other = pair.a == ball ? pair.b : pair.a;
    const Wall* wall = std::get_if<Wall>(&input.bodies.shape[other]);
    if (wall == nullptr || !std::holds_alternative<Sphere>(input.bodies.shape[ball])) return false;

    ContactConstraint& point = m_contacts.points.front();
    Vec3& velocity = input.state.velocity[ball];
    const Vec3& normal = wall->normal;
    const double speed = normal.dot(velocity), pull = -normal.dot(input.gravity);
    const double noise = std::max(elasticClosing, 10 * input.settings.tolerance) * m_scale;
    const bool touching = std::abs(point.separation) <= touchingGap * pair.size;
    if (touching && std::abs(speed) <= std::max(noise, speedRounding * velocity.norm())) return false;
    if (point.separation < -touchingGap * pair.size) return false; // to be parted first

    loadBodies(input, island);
    const double h = input.substep;
    const Bounce after = bounceTrain(std::max(0.0, point.separation), speed, pull, pair.restitution, h);
    const double impulse = input.bodies.mass[ball] * (after.speed - speed + pull * h);
    ContactBody& body = m_problem.bodies.front();
    const Vec6 before = body.velocity;
    body.velocity.head<3>() += h * input.gravity;
    body.freeVelocity = body.velocity;
    if (impulse > 0 && (pair.friction > 0 || pair.rolling > 0)) {
        // Momentum gives the whole normal impulse of the bounces; friction has μ times that to stop the slip.
        ContactRow row = rowOf(pair, point);
        const double arm = input.bodies.boundingRadius[ball];
        const double mass = 1 / (1 / body.mass + arm * arm * body.inverseInertia(0, 0));
        row.impulse << impulse, -mass * relativeVelocity(m_problem, row).tail<2>();
        row.rollingImpulse = -row.effectiveInertia * rollingVelocity(m_problem, row);
        const Projected across = projectOnCone(row, row.impulse, row.rollingImpulse);
        row.impulse << 0, across.impulse.tail<2>(); // the normal part is in `after`
        row.rollingImpulse = across.rolling;
        m_problem.rows.assign(1, row);
        velocitiesFromImpulses(m_problem);
    }
    // Along the normal the closed form; across it the mean of both ends.
    Vec3 end = body.velocity.head<3>();
    end += (after.speed - normal.dot(end)) * normal;
    Vec3 across = 0.5 * h * (before.head<3>() + end);
    across -= normal.dot(across) * normal;
    input.state.pose[ball].position += across + (after.gap - point.separation) * normal;
    velocity = end;
    rotateBetween(input.bodies, ball, before.tail<3>(), body.velocity.tail<3>(), h, input.state);
    point.force.setZero();
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

void IslandMotion::loadBodies(const MotionInput& input, const Island& island) {
    m_problem.clear();
    m_start.clear();
    double fastest = 0;
    for (const BodyIndex i : island.bodies) {
        ContactBody& body = m_problem.bodies.emplace_back();
        const Mat3 turn = input.state.pose[i].orientation.toRotationMatrix();
        const Vec3& inertia = input.bodies.inertia[i];
        body.velocity << input.state.velocity[i], input.state.angularVelocity[i];
        body.mass = input.bodies.mass[i];
        const bool isotropic = inertia.x() == inertia.y() && inertia.y() == inertia.z();
        body.inertia =
            isotropic ? Mat3(inertia.asDiagonal()) : Mat3(turn * inertia.asDiagonal() * turn.transpose());
        const Vec3 inverse = inertia.cwiseInverse();
        body.inverseInertia =
            isotropic ? Mat3(inverse.asDiagonal()) : Mat3(turn * inverse.asDiagonal() * turn.transpose());
        body.gyration = std::sqrt(inertia.maxCoeff() / body.mass);
        fastest = std::max(fastest, rimSpeed(body));
    }
    const double scale = m_scale > 0 ? m_scale : fastest;
    m_tolerance = std::max(input.settings.tolerance * scale, speedRounding * fastest);
    m_pairOf.clear();
    for (std::uint32_t pair = 0; pair < m_contacts.pairs.size(); ++pair)
        m_pairOf.insert(m_pairOf.end(), m_contacts.pairs[pair].count, pair);
}

ContactRow IslandMotion::rowOf(const ContactPair& pair, const ContactConstraint& point) const {
    ContactRow row;
    row.a = localOf(pair.a);
    row.b = localOf(pair.b);
    row.frame = point.frame;
    row.armA = point.armA;
    row.armB = point.armB;
    row.friction = pair.friction;
    row.rolling = pair.rolling;
    prepareRow(m_problem, row);
    return row;
}

// Parts bodies that overlap by the least displacement, in the sense of kinetic energy, that opens the gaps:
// the contact problem with lengths for velocities.
void IslandMotion::part(const MotionInput& input, const Island& island) {
    bool overlapping = false;
    for (const ContactPair& pair : m_contacts.pairs)
        for (const ContactConstraint& point : m_contacts.pointsOf(pair))
            overlapping = overlapping || point.separation < -touchingGap * pair.size;
    if (!overlapping) return;
    loadBodies(input, island);
    m_parting.clear();
    m_parting.bodies = m_problem.bodies;
    for (ContactBody& body : m_parting.bodies) body.freeVelocity.setZero();
    double size = std::numeric_limits<double>::infinity();
    for (const ContactPair& pair : m_contacts.pairs) {
        size = std::min(size, pair.size);
        for (const ContactConstraint& point : m_contacts.pointsOf(pair)) {
            ContactRow row = rowOf(pair, point);
            row.friction = row.rolling = 0;
            row.bound = std::max(point.separation, -mostParting * pair.size);
            m_parting.rows.push_back(row);
        }
    }
    const double tolerance = 1e-3 * touchingGap * size;
    if (m_exact)
        m_newton.solve(m_parting, tolerance);
    else
        m_gaussSeidel.solve(m_parting, tolerance, 2 * input.settings.iterations);
    for (std::size_t i = 0; i < island.bodies.size(); ++i) {
        Pose& pose = input.state.pose[island.bodies[i]];
        const Vec6& displacement = m_parting.bodies[i].velocity;
        pose.position += displacement.head<3>();
        if (displacement.tail<3>() != Vec3::Zero())
            pose.orientation = (fromRotationVector(displacement.tail<3>()) * pose.orientation).normalized();
    }
    recollide(input);
}

void IslandMotion::impacts(const MotionInput& input, double duration, bool locating) {
    m_problem.rows.clear();
    m_impactRows.clear();
    double fastest = 0;
    for (const ContactBody& body : m_problem.bodies) fastest = std::max(fastest, rimSpeed(body));
    const double rounding = std::max(speedRounding * fastest, 10 * input.settings.tolerance * m_scale);
    bool any = false;
    for (std::uint32_t p = 0; p < m_contacts.pairs.size(); ++p) {
        const ContactPair& pair = m_contacts.pairs[p];
        // A series of bounces that would end within the substep is rest: T/(1 − e) with T = 2 e u/g.
        const double e = pair.restitution;
        const double series = e < 1 && e > 0 ? std::min(1.0, (1 - e) / (2 * e)) : 1;
        const double threshold =
            std::max((e < 1 ? std::max(restingClosing, 0.5 * series) : elasticClosing) * m_scale, rounding);
        for (const ContactConstraint& point : m_contacts.pointsOf(pair)) {
            ContactRow row = rowOf(pair, point);
            const double closing = -relativeVelocity(m_problem, row).x();
            const bool touching = point.separation <= touchingGap * pair.size ||
                                  (!locating && closing * duration > point.separation);
            m_problem.rows.push_back(row);
            m_impactRows.push_back({e, threshold, p, touching});
            any = any || (touching && closing > threshold);
        }
    }
    if (any)
        report.impacts +=
            m_impacts.solve(m_problem, m_impactRows, input.settings.simultaneous || !locating, m_exact);
    for (std::size_t i = 0; i < m_problem.bodies.size(); ++i) {
        if (i >= m_start.size()) m_start.emplace_back();
        const ContactBody& body = m_problem.bodies[i];
        m_start[i] = {body.velocity, body.inertia * body.velocity.tail<3>()};
    }
}

// Velocities after `duration` under gravity and the forces of contacts that touch.
void IslandMotion::smooth(const MotionInput& input, double duration, bool locating) {
    for (std::size_t i = 0; i < m_problem.bodies.size(); ++i) {
        ContactBody& body = m_problem.bodies[i];
        body.velocity = m_start[i].velocity;
        body.freeVelocity = m_start[i].velocity;
        body.freeVelocity.head<3>() += duration * input.gravity;
    }
    chooseRows(input, duration, locating);
    if (m_springs.empty())
        solve(input);
    else
        solveSprings(input, duration);
    // Over a very short part impulses that stop a gentle closing look like enormous forces: no guess for
    // later.
    if (duration < shortestMemory * input.substep) return;
    for (std::size_t i = 0; i < m_rowPoint.size(); ++i) {
        ContactConstraint& point = m_contacts.points[m_rowPoint[i]];
        point.force = m_problem.rows[i].impulse / duration;
        point.rollingTorque = m_problem.rows[i].rollingImpulse / duration;
    }
}

// Contacts that touch take part; so do open ones that could only close gently, which the bound
// uₙ + gap/T >= 0 stops at the surface. Those that may close hard are left to firstImpact while locating.
void IslandMotion::chooseRows(const MotionInput& input, double duration, bool locating) {
    m_problem.rows.clear();
    m_rowPoint.clear();
    m_waiting.clear();
    for (std::uint32_t i = 0; i < m_contacts.points.size(); ++i) {
        ContactConstraint& point = m_contacts.points[i];
        const ContactPair& pair = m_contacts.pairs[m_pairOf[i]];
        const double open = point.separation - touchingGap * pair.size;
        ContactRow row = rowOf(pair, point);
        if (open > 0 && locating) {
            const double gentle = (pair.restitution < 1 ? 1 : restingClosing) * m_scale;
            const double closing = -relativeVelocity(m_problem, row).x();
            if (closing > gentle || m_scale == 0) {
                point.force.setZero();
                point.rollingTorque.setZero();
                m_waiting.push_back(i);
                continue;
            }
        }
        row.bound = std::max(0.0, open) / duration;
        row.impulse = duration * point.force;
        row.rollingImpulse = duration * point.rollingTorque;
        m_problem.rows.push_back(row);
        m_rowPoint.push_back(i);
    }
    (void)input;
}

void IslandMotion::solve(const MotionInput& input) {
    if (m_problem.rows.empty() && m_problem.springs.empty()) {
        velocitiesFromImpulses(m_problem);
        return;
    }
    double residual = 0;
    if (m_exact) {
        NewtonReport solved = m_newton.solve(m_problem, m_tolerance);
        report.factorisations += solved.factorisations;
        if (!solved.solved) {
            for (ContactRow& row : m_problem.rows) {
                row.impulse.setZero();
                row.rollingImpulse.setZero();
            }
            solved = m_newton.solve(m_problem, m_tolerance);
            report.factorisations += solved.factorisations;
            if (!solved.solved && m_problem.springs.empty())
                m_gaussSeidel.solve(m_problem, m_tolerance, rescueSweeps);
        }
        residual = solved.residual;
    } else {
        residual = m_gaussSeidel.solve(m_problem, m_tolerance, input.settings.iterations);
    }
    if (m_scale > 0) report.residual = std::max(report.residual, residual / m_scale);
}

// When the first of the waiting contacts closes, or `duration` if none does.
double IslandMotion::firstImpact(const MotionInput& input, const Island&, double duration) {
    double first = duration;
    std::uint32_t donePair = std::numeric_limits<std::uint32_t>::max();
    for (const std::uint32_t i : m_waiting) {
        const std::uint32_t p = m_pairOf[i];
        if (p == donePair) continue;
        const ContactPair& pair = m_contacts.pairs[p];
        const ContactConstraint& point = m_contacts.points[i];
        const ContactRow row = rowOf(pair, point);
        const double u1 = relativeVelocity(m_problem, row).x();
        double u0 = 0;
        if (row.a != immobile) u0 += row.jacobianA.row(0).dot(m_start[at(row.a)].velocity);
        if (row.b != immobile) u0 += row.jacobianB.row(0).dot(m_start[at(row.b)].velocity);
        const double estimate = closingTime(point.separation, u0, u1, duration);
        if (!(estimate < 1.01 * first)) continue;
        donePair = p;
        first = std::min(first, timeOfImpact(input, pair, std::min(estimate, first), duration));
    }
    return first;
}

Pose IslandMotion::poseAt(const MotionInput& input, BodyIndex i, double t, double duration) const {
    const int local = localOf(i);
    Pose pose = input.state.pose[i];
    if (local == immobile) return pose;
    const Start& start = m_start[at(local)];
    const ContactBody& end = m_problem.bodies[at(local)];
    const Vec3 v0 = start.velocity.head<3>(), v1 = end.velocity.head<3>();
    pose.position += t * (v0 + (0.5 * t / duration) * (v1 - v0));
    const Vec3 momentum =
        start.angularMomentum +
        (0.5 * t / duration) * (end.inertia * end.velocity.tail<3>() - start.angularMomentum);
    rotateFreely(input.bodies.inertia[i], momentum, t, pose.orientation);
    return pose;
}

// Conservative advancement (B. Mirtich, 1996) along the paths: from a time at which the two are apart on by
// their distance over the speed at which the nearest points close. It never passes the first contact of
// convex bodies in translation, and turns into Newton's iteration near it.
double IslandMotion::timeOfImpact(const MotionInput& input, const ContactPair& pair, double from,
                                  double duration) const {
    constexpr int mostSteps = 30;
    constexpr double reached = 1e-3; // of touchingGap
    double t = from;
    for (int step = 0; step < mostSteps; ++step) {
        const Pose a = poseAt(input, pair.a, t, duration), b = poseAt(input, pair.b, t, duration);
        const Proximity near =
            proximityOf({&input.bodies.shape[pair.a], &a}, {&input.bodies.shape[pair.b], &b});
        if (near.distance <= reached * touchingGap * pair.size && step > 0) return t;
        const auto velocityOf = [&](BodyIndex i, const Pose& pose, const Vec3& point) -> Vec3 {
            const int local = localOf(i);
            if (local == immobile) return Vec3::Zero();
            const Vec6 v0 = m_start[at(local)].velocity, v1 = m_problem.bodies[at(local)].velocity;
            const Vec6 v = v0 + (t / duration) * (v1 - v0);
            return v.head<3>() + v.tail<3>().cross(point - pose.position);
        };
        const double closing =
            near.normal.dot(velocityOf(pair.a, a, near.onA) - velocityOf(pair.b, b, near.onB));
        if (!(closing > 0)) return near.distance <= touchingGap * pair.size ? t : duration;
        t = std::max(0.0, t + near.distance / closing);
        if (t >= duration) return duration;
    }
    return t;
}

// When the first sliding contact comes to stick, or `duration`. Slip falls linearly under constant forces:
// the force that stopped it, as a part of what the cone allows, tells about when; a solve shortly before
// gives the slope.
double IslandMotion::firstStop(const MotionInput& input, double duration) {
    constexpr double stuck = 1e-9; // of the slip before
    double earliest = 1;
    std::uint32_t stopping = 0;
    Vec2 direction = Vec2::Zero();
    double before = 0;
    for (std::size_t i = 0; i < m_rowPoint.size(); ++i) {
        const ContactRow& row = m_problem.rows[i];
        if (!(row.friction > 0) || !(row.impulse.x() > 0)) continue;
        Vec3 u0 = Vec3::Zero();
        if (row.a != immobile) u0 += row.jacobianA * m_start[at(row.a)].velocity;
        if (row.b != immobile) u0 += row.jacobianB * m_start[at(row.b)].velocity;
        const double slip = u0.tail<2>().norm();
        if (slip <= 1e3 * m_tolerance) continue;
        if (relativeVelocity(m_problem, row).tail<2>().norm() > 10 * m_tolerance) continue;
        const double part = row.impulse.tail<2>().norm() / (row.friction * row.impulse.x());
        if (part >= earliest) continue;
        earliest = part;
        stopping = m_rowPoint[i];
        before = slip;
        direction = u0.tail<2>() / slip;
    }
    if (earliest >= 1) return duration;
    const auto slipAfter = [&](double t) {
        smooth(input, t, true);
        for (std::size_t i = 0; i < m_rowPoint.size(); ++i)
            if (m_rowPoint[i] == stopping)
                return direction.dot(relativeVelocity(m_problem, m_problem.rows[i]).tail<2>());
        return 0.0;
    };
    double low = 0, slipLow = before, high = duration, guess = 0.9 * earliest * duration;
    for (int i = 0; i < 8; ++i) {
        const double slip = slipAfter(guess);
        if (slip > stuck * before) {
            const double slope = (slip - slipLow) / (guess - low);
            low = guess;
            slipLow = slip;
            guess = slope < 0 ? std::min(high, low - slipLow / slope) : high;
            if (guess >= high) return high;
        } else if (low > 0) {
            return guess; // on the line through two sliding states: the stop itself
        } else {
            high = guess;
            guess *= 0.5;
        }
    }
    return high;
}

// A body within the tolerance of rest is at rest: the forces balance as well as they are known.
void IslandMotion::settle(const MotionInput& input) {
    if (m_problem.rows.empty() || !m_problem.springs.empty() || m_scale == 0) return;
    const double still = std::max(input.settings.tolerance * m_scale, 1e-14 * m_scale);
    for (std::size_t i = 0; i < m_problem.bodies.size(); ++i) {
        const ContactBody& body = m_problem.bodies[i];
        const Vec6& before = m_start[i].velocity;
        const double was = std::max(before.head<3>().norm(), before.tail<3>().norm() * body.gyration);
        if (rimSpeed(body) > still || was > still) return;
    }
    for (ContactBody& body : m_problem.bodies) body.velocity.setZero();
}

void IslandMotion::commit(const MotionInput& input, const Island& island, double duration) {
    for (std::size_t i = 0; i < island.bodies.size(); ++i) {
        const BodyIndex body = island.bodies[i];
        const Vec6& before = m_start[i].velocity;
        const Vec6& after = m_problem.bodies[i].velocity;
        input.state.pose[body].position += (0.5 * duration) * (before.head<3>() + after.head<3>());
        input.state.velocity[body] = after.head<3>();
        rotateBetween(input.bodies, body, before.tail<3>(), after.tail<3>(), duration, input.state);
    }
}

void IslandMotion::keep(ContactSet& kept) const {
    for (const ContactPair& pair : m_contacts.pairs)
        if (pair.count > 0) kept.append(pair, m_contacts.pointsOf(pair));
}

} // namespace carom
