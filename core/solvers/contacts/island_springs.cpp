// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/energy.h"
#include "core/dynamics/free_rotation.h"
#include "core/math/rotation.h"
#include "core/solvers/contacts/contact_settings.h"
#include "core/solvers/contacts/island_motion.h"

#include <algorithm>
#include <limits>
#include <variant>

// Springs within an island. Over a part T of the substep their ends go from x₀ to x₁ (of one relative to the
// other), and the spring pulls along the middle of the way, by what its mean length and the change of its
// length say,
//
//     p = −T (k (l̄ − L) + c (l₁ − l₀)/T) x̄/l̄      x̄ = (x₀ + x₁)/2,  l̄ = (l₀ + l₁)/2,  l = |x|
//
// (R. LaBudde, D. Greenspan, "Energy and momentum conserving methods of arbitrary order for the numerical
// integration of equations of motion", Numerische Mathematik 25, 1975). Since x̄·(x₁ − x₀) = l̄ (l₁ − l₀), its
// work is exactly what it had stored less what its damper took: the energy of an undamped spring between
// centres is kept to rounding at any step, so that no spring ever gets longer than its energy allows. Where
// nothing meets, five such parts make a substep, to order four (dynamics/spring_steps.h). The
// implicit midpoint rule, with |x̄| for l̄, is the same along a line but has no such bound: where ω T is some
// hundred it finds a length of 3 L, 5 L, ... whose middle is on the other side. Both are symmetric, of order
// two, and exact for constant forces, and the phase of a linear oscillation is late by (ωT)²/12 of it.
//
// x₁ follows from the velocities sought, x₁ = x₀ + T (u₀ + u₁)/2 for the centres, so the rule is an equation
// for them, solved by Newton's method with
//
//     A = −∂p/∂u₁ = T/l̄ (T/4 f 1 + (T/4 (k − f/l̄) + c/2) x̄ eᵀ)      f = −|p|/T the tension, e = x₁/l₁
//
// Among contacts springs are rows of the contact problem that give way (contact_problem.h), which knows
// nothing of parts of A that are not symmetric or push: there the rounds converge more slowly, and for
// springs far too stiff for the step not at all. Between points off the centres the arms are means of both
// ends, too, and the energy is kept to order two. An island with springs moves so if the integrator is
// `midpoint` or anything touches.

namespace carom {
namespace {

/// Rounds at most among contacts, and the change of velocities, relative to the fastest, at which they end.
/// The third round is good to 1e-10 at any step that resolves the oscillation. At half as many, stiffer
/// springs end with an error; at twice, they cost twice as many solves. At a hundredth of the change,
/// rounding keeps the rounds from ending; at a hundred times, two digits are lost.
constexpr int mostSpringRounds = 8;
constexpr double roundsEnd = 1e-14;
/// Rounds of Newton's method at most; and the change, relative to the fastest velocity, below which one that
/// does not halve is rounding. At half as many, more steps are found to have no solution; at a thousandth of
/// the change, rounding of stiff springs is taken for that; at a thousand times, slow convergence for a
/// solution.
constexpr int mostNewtonRounds = 40;
constexpr double maybeRounding = 1e-6;
/// Tolerance of the solve relative to the speeds in play: springs lose nothing, so nothing may be lost here.
/// At a hundredth, it is below rounding; at a hundred times, the energy of undamped springs drifts by the
/// errors.
constexpr double springTolerance = 1e-14;
/// With contacts in play, which lose energy, this part of the tolerance of contacts is enough. At ten times,
/// errors of the springs come within a hundredth of the tolerance; at a tenth, more rounds are made.
constexpr double contactPart = 1e-3;
/// Between the parts of a step two bodies move relative to each other at most this many times as fast as at
/// the ends of parts. At twice, bodies on springs are left to the integrator less often where others are
/// near; near 1, a pair might meet between two parts unseen.
constexpr double fasterBetween = 1.5;

/// How far two bodies are apart at least, one of them at the places given [m].
double leastGap(const Bodies& bodies, BodyIndex a, const Vec3& placeA, BodyIndex b, const Vec3& placeB) {
    const auto fromWall = [&](BodyIndex wall, BodyIndex other, const Vec3& place) {
        return distanceTo(std::get<Wall>(bodies.shape[wall]), place) - bodies.boundingRadius[other];
    };
    if (isWall(bodies.shape[a])) return fromWall(a, b, placeB);
    if (isWall(bodies.shape[b])) return fromWall(b, a, placeA);
    return (placeB - placeA).norm() - bodies.boundingRadius[a] - bodies.boundingRadius[b];
}

} // namespace

// Moves an island on springs through a substep in which no two bodies meet. False if two may meet; then
// nothing has moved.
bool IslandMotion::integrateSprings(const MotionInput& input, const Island& island) {
    if (m_springs.empty()) return false;
    const Forces& forces = input.bodies.forces;
    if (!forces.empty() && std::ranges::any_of(island.bodies, [&](BodyIndex i) { return forces.actOn(i); }))
        return false;
    const auto isApart = [&](const ContactPair& pair) {
        return leastGap(input.bodies, pair.a, input.state.pose[pair.a].position, pair.b,
                        input.state.pose[pair.b].position) > 0;
    };
    if (!std::ranges::all_of(m_contacts.pairs, isApart)) return false;
    const SpringNetwork network{input.bodies, island.bodies, m_springs, input.gravity, m_springScratch};
    const int order = input.settings.tolerance < accurateTolerance ? 6 : 4;
    const bool isFound = m_springSteps.find(network, input.substep, order, input.state);
    m_work += work::pull * static_cast<double>(m_springSteps.looks());
    if (!isFound || !staysApart(input)) return false;
    for (ContactConstraint& point : m_contacts.points) {
        point.force.setZero();
        point.rollingTorque.setZero();
    }
    Invariants before;
    if (input.ledger != nullptr)
        before = invariantsOf(input.bodies, island.bodies, input.state, input.gravity);
    m_springSteps.apply(network, input.substep, input.state);
    if (input.ledger != nullptr)
        recordDifference(before, invariantsOf(input.bodies, island.bodies, input.state, input.gravity),
                         weightOf(input.bodies, island.bodies, input.substep * input.gravity),
                         LedgerAccount::Spring, *input.ledger);
    return true;
}

// Whether all gaps stay open: a gap shrinks no faster than the bodies move, so it suffices that it cannot
// close from its values at both ends.
bool IslandMotion::staysApart(const MotionInput& input) const {
    const auto placeAfter = [&](BodyIndex i) {
        return localOf(i) == immobile ? input.state.pose[i].position
                                      : m_springSteps.placeAfter(at(localOf(i)));
    };
    const auto velocity = [&](BodyIndex i, std::size_t time) {
        return localOf(i) == immobile ? Vec3(Vec3::Zero()) : m_springSteps.velocity(at(localOf(i)), time);
    };
    return std::ranges::all_of(m_contacts.pairs, [&](const ContactPair& pair) {
        const double first = leastGap(input.bodies, pair.a, input.state.pose[pair.a].position, pair.b,
                                      input.state.pose[pair.b].position);
        const double last = leastGap(input.bodies, pair.a, placeAfter(pair.a), pair.b, placeAfter(pair.b));
        double fastest = 0;
        for (std::size_t time = 0; time < m_springSteps.times(); ++time)
            fastest = std::max(fastest, (velocity(pair.a, time) - velocity(pair.b, time)).norm());
        return std::min({first, last, first + last - fasterBetween * input.substep * fastest}) > 0;
    });
}

void IslandMotion::solveSprings(const MotionInput& input, double duration) {
    // A spring too stiff for the step ends the part about where it began: that guess is near the solution,
    // while one with unchanged velocities may be metres off.
    linkSprings(input, duration);
    bool stiff = false;
    for (const SoftRow& row : m_problem.springs) stiff = stiff || row.rate.maxCoeff() > row.effectiveMass;
    const auto guess = [&](double sign) {
        for (std::size_t i = 0; i < m_problem.bodies.size(); ++i)
            m_problem.bodies[i].velocity = sign * m_start[i].velocity;
    };
    if (stiff) guess(-1);
    if (!m_problem.rows.empty()) {
        for (int round = 0; round < mostSpringRounds && !m_unsolved; ++round) {
            rememberVelocities();
            linkSprings(input, duration);
            solve(input);
            if (changeOfVelocities() <= std::max(roundsEnd * m_fastest, m_tolerance)) return;
        }
        return;
    }
    if (solveSpringsAlone(input, duration)) return;
    guess(stiff ? 1 : -1);
    solveSpringsAlone(input, duration);
}

// True if the rounds have converged.
bool IslandMotion::solveSpringsAlone(const MotionInput& input, double duration) {
    double before = std::numeric_limits<double>::infinity();
    for (int round = 0; round < mostNewtonRounds; ++round) {
        rememberVelocities();
        linkSprings(input, duration);
        const bool isStep = m_springSolver.step(m_problem, m_springSlopes);
        ++report.work.factorisations;
        m_work += m_springSolver.work();
        if (!isStep) return false;
        const double change = changeOfVelocities();
        if (change <= std::max(roundsEnd * m_fastest, m_tolerance)) return true;
        if (change <= maybeRounding * m_fastest && change > 0.5 * before) return true;
        before = change;
    }
    return false;
}

void IslandMotion::rememberVelocities() {
    m_lastVelocity.resize(m_problem.bodies.size());
    for (std::size_t i = 0; i < m_lastVelocity.size(); ++i) m_lastVelocity[i] = m_problem.bodies[i].velocity;
}

// Change of velocities since they were stored [m/s]; stores the largest speed of that time, and of the start
// of the part, in m_fastest.
double IslandMotion::changeOfVelocities() {
    double change = 0;
    m_fastest = 0;
    for (std::size_t i = 0; i < m_lastVelocity.size(); ++i) {
        const ContactBody& body = m_problem.bodies[i];
        change = std::max(change, fastestPart(body.velocity - m_lastVelocity[i], body.gyration));
        m_fastest = std::max({m_fastest, fastestPart(m_lastVelocity[i], body.gyration),
                              fastestPart(m_start[i].velocity, body.gyration)});
    }
    return change;
}

// The mean of the poses at both ends. An accelerated body is not there at half time.
Pose IslandMotion::middlePose(const MotionInput& input, BodyIndex i, double duration) const {
    const std::size_t local = at(localOf(i));
    const Start& start = m_start[local];
    const ContactBody& end = m_problem.bodies[local];
    Pose pose = input.state.pose[i];
    pose.position += (0.25 * duration) * (start.velocity + end.velocity).head<3>();
    const Vec3 momentum = 0.5 * (start.angularMomentum + endMomentum(local));
    rotateFreely(input.bodies.inertia[i], momentum, 0.5 * duration, pose.orientation);
    return pose;
}

// Places of one end of a spring at the start and the end of the part, by the present velocities.
IslandMotion::SpringEnd IslandMotion::springEnd(const MotionInput& input, BodyIndex i, const Vec3& point,
                                                double duration) const {
    SpringEnd end;
    if (i == noBody) {
        end.before = end.after = point;
        return end;
    }
    const Pose& pose = input.state.pose[i];
    end.before = end.after = pose.toWorld(point);
    if (localOf(i) == immobile || input.bodies.mobile[i] == 0) return end;
    const Pose last = poseAt(input, i, duration, duration);
    end.body = localOf(i);
    end.after = last.toWorld(point);
    end.arm = 0.5 * ((end.before - pose.position) + (end.after - last.position));
    return end;
}

// Makes the rows of the island's springs, linearised about the path that the present velocities give.
void IslandMotion::linkSprings(const MotionInput& input, double duration) {
    m_problem.springs.clear();
    m_springSlopes.clear();
    const bool alone = m_problem.rows.empty();
    double fastest = 0, pulled = 0;
    for (const ContactBody& body : m_problem.bodies)
        fastest = std::max(fastest, fastestPart(body.velocity, body.gyration));
    for (const std::uint32_t index : m_springs) {
        const SpringForce& spring = input.bodies.springs[index];
        const SpringEnd from = springEnd(input, spring.from, spring.fromAt, duration);
        const SpringEnd to = springEnd(input, spring.to, spring.toAt, duration);
        const Vec3 first = to.before - from.before, last = to.after - from.after;
        const Vec3 middle = 0.5 * (first + last);
        const double firstLength = first.norm(), lastLength = last.norm();
        const double length = 0.5 * (firstLength + lastLength);
        const Vec3 along = length > 0 ? Vec3(middle / length) : Vec3(Vec3::UnitY());
        const Vec3 grows = lastLength > 0 ? Vec3(last / lastLength) : along;
        const double tension = spring.stiffness * (length - spring.length) +
                               spring.damping * (lastLength - firstLength) / duration;
        const double turning = length > 0 ? 0.25 * duration * duration * tension / length : 0;
        const double stretching =
            0.25 * duration * duration * spring.stiffness + 0.5 * duration * spring.damping - turning;

        SoftRow row;
        row.a = from.body;
        row.b = to.body;
        if (alone) {
            prepareRow(m_problem, Mat3::Identity(), from.arm, to.arm, row);
            row.impulse = (-duration * tension) * along;
            row.rate = Vec3::Constant(stretching + turning); // how stiff it is, for the guess
            // The rounding of lengths becomes an error of forces.
            pulled = std::max(pulled, std::abs(duration) * spring.stiffness * length / row.effectiveMass);
            m_springSlopes.push_back(turning * Mat3::Identity() + stretching * along * grows.transpose());
        } else {
            const double part = along.norm();
            const Vec3 direction = part > 0 ? Vec3(along / part) : Vec3(Vec3::UnitY());
            const Tangents tangents = tangentsOf(direction);
            Mat3 frame;
            frame << direction.transpose(), tangents.first.transpose(), tangents.second.transpose();
            prepareRow(m_problem, frame, from.arm, to.arm, row);
            const Vec3 after = relativeVelocity(m_problem, row);
            const double across = std::max(0.0, turning);
            row.rate =
                Vec3(std::max(0.0, turning + stretching * part * grows.dot(direction)), across, across);
            row.offset = -row.rate.cwiseProduct(after);
            row.offset.x() += duration * tension * part;
            const Vec3 yielded = row.rate.cwiseProduct(after);
            row.impulse = -(row.offset + yielded);
            // For a stiff spring both terms are large and cancel: their difference has the rounding error of
            // the terms.
            pulled = std::max(pulled, (row.offset.norm() + yielded.norm()) / row.effectiveMass);
        }
        m_problem.springs.push_back(row);
    }
    m_tolerance = springTolerance * std::max({m_scale, fastest, pulled});
    if (!alone) m_tolerance = std::max(m_tolerance, contactPart * input.settings.tolerance * m_scale);
}

} // namespace carom
