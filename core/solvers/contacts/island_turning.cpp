// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/wide.h"
#include "core/dynamics/contact_memory.h"
#include "core/math/rotation.h"
#include "core/solvers/contacts/contact_settings.h"
#include "core/solvers/contacts/island_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

// Contacts turn while bodies do: a disk that rolls on its rim touches elsewhere at the end of a part of the
// substep than at its start, and a block that rocks has its arm turned. Contacts as they are at the start
// make a method of order one. Here the velocities at the end obey the contacts as they are at the end, and
// the impulses that lead there act as the contacts are in the middle,
//
//     M₁ (v₁ − v̂) = J½ᵀ p        0 ≤ pₙ  ⊥  (J₁ v₁)ₙ + b ≥ 0, and Coulomb's law for p and J₁ v₁
//
//     legend   v̂    = (v₀ + T g, I₁⁻¹ L₀): velocities if nothing touched; L₀ angular momentum at the start
//              J½   Jacobian where the bodies are after half of the part, J₁ at its end
//              M₁   with the inertia I₁ as it lies in the world at the end
//
// which is the same seen backwards in time where contacts hold, as the motion itself is (rotation about the
// mean of L₀ and L₁, positions by the mean of v₀ and v₁): so the order is two, and a steady motion stays one.
// The poses follow from v₁: fixed-point rounds. To keep the problem symmetric, as the solvers want it, a
// round adds M₁⁻¹ (J½ − J₁)ᵀ p with the p of the round before to v̂. A round gains the angle turned as a
// factor; in islands of several bodies that rock on each other, often no more than a half or a tenth.
// Source: projected symmetric methods as in E. Hairer, C. Lubich, G. Wanner, "Geometric numerical
// integration", 2006, V.4 and VII.5; contacts that open and close make no difference to them.
//
// What is left of the error then points in one direction, and is extrapolated along it (D. Anderson,
// "Iterative procedures for nonlinear integral equations", 1965, with one round remembered): from a round
// that begins with x and ends with g,
//
//     f = g − x        x' = g − θ (g − g°)        θ = (f, f − f°) / (f − f°, f − f°),  ° of the round before
//
// in the scalar product of the masses, impulses with the θ of the velocities. A round that changes more than
// the one before met other contacts, and is not extrapolated. Rounds are solved for to a part of the change
// of the round before; the last one, whose change is within the tolerance, to the tolerance. Both only in
// accurate runs: at other tolerances the few rounds that there are take as much work with them as without.
//
// Islands with springs keep to the start: their own rounds (island_springs.cpp) take only springs along.

namespace carom {
namespace {

/// Rounds at most. A disk that rolls by a third of a radian needs 10 for seven digits. At half, discs that
/// roll fast keep an error; at twice, rounds that do not converge cost twice as much.
constexpr int mostTurningRounds = 30;
/// A point further from where it was than this part of the smaller body, seen from both bodies, is another.
/// At half, discs that roll fast lose their point; at twice, it may become one on the other side of the body.
constexpr double sameWithin = 0.5;
/// A point that bears a force still touches at the end: a gap that it would have there counts as a distance
/// so many times as long. Twice or half matters only where gaps are a thousandth of the distances.
constexpr double gapWeight = 1000;
/// The smallest cosine between the normals of one point, at the start and at the end: beyond 60 degrees it is
/// that of another face. At half, 76 degrees, corners of cuboids take points of two faces for one more often;
/// at twice, none could turn.
constexpr double sameFace = 0.5;
/// The change of a round over that of the one before, beyond which rounds do not converge. At half, rounds
/// end that would converge after one larger change; at twice, those that diverge go on longer.
constexpr double mostGrowth = 2;
/// A round is solved for to this part of the change of the round before. At ten times, rounds take as much
/// work in all; at a hundred times, islands of discs that rock on each other take a sixth more, because
/// errors of rounds hide the direction they have. With exact rounds they take a fifth more.
constexpr double roundPart = 1e-4;
/// What is extrapolated is at most so many times the difference of two rounds: the rounds' factor is up to
/// 0.9 then. At half, discs that rock on each other take a twelfth more work; at twice, a twelfth less, but
/// two changes that are nearly alike by chance lead further away.
constexpr double mostMixed = 10;
/// Rounds in a row whose change is not the smallest so far, until the part counts as too long: they go
/// back and forth between two sets of contacts. Without, a part of a stick that comes down flat takes all 30
/// rounds, which is half of what its frame may.
constexpr int mostStale = 4;
/// Rounds that lose a point until the part counts as too long. With one, parts are halved that the next round
/// would find a solution for; with four, such parts cost twice as much before they are halved.
constexpr int mostLosses = 2;

/// A pair that turns by less than this in a part [rad] has not rolled on too far where the end shows one
/// point less: its faces meet in other points there. From a tenth to five times, discs sink in alike, and a
/// house of cards stands; at ten times, a disc of 1:100 sinks in by a tenth more.
constexpr double hardlyTurned = 0.02;

/// A ball on a wall: neither normal nor arms ever turn.
bool neverTurns(const Bodies& bodies, const ContactPair& pair) {
    const auto is = [&]<class Kind>(std::in_place_type_t<Kind>, BodyIndex i) {
        return std::holds_alternative<Kind>(bodies.shape[i]);
    };
    constexpr std::in_place_type_t<Sphere> sphere;
    constexpr std::in_place_type_t<Wall> wall;
    return (is(sphere, pair.a) && is(wall, pair.b)) || (is(wall, pair.a) && is(sphere, pair.b));
}

} // namespace

// Whether contacts with a force turn by so much that it exceeds the tolerance.
bool IslandMotion::contactsTurn(const MotionInput& input, double duration) const {
    if (!m_springs.empty()) return false;
    const bool accurate = input.settings.tolerance < accurateTolerance;
    for (const ContactBody& body : m_problem.bodies)
        if (!body.velocity.allFinite()) return false; // the step is lost
    for (std::size_t i = 0; i < m_problem.rows.size(); ++i) {
        const ContactPair& pair = m_contacts.pairs[m_pairOf[m_rowPoint[i]]];
        if (!(m_problem.rows[i].impulse.x() > 0) || neverTurns(input.bodies, pair)) continue;
        for (const int body : {m_problem.rows[i].a, m_problem.rows[i].b}) {
            if (body == immobile) continue;
            const ContactBody& end = m_problem.bodies[at(body)];
            const double speed = std::max(fastestPart(end.velocity, end.gyration),
                                          fastestPart(m_start[at(body)].velocity, end.gyration));
            // A contact turns by duration · speed/size. Velocities turn with it, and so do impulses. These
            // matter only for a slow body under a heavy load, and are considered in accurate runs only.
            const double load = accurate ? m_problem.rows[i].impulse.norm() / end.mass : 0;
            if (duration * speed * std::max(speed, load) > m_tolerance * pair.size) return true;
        }
    }
    return false;
}

// Starts from the solution with the contacts of the start and iterates to that with those of the end.
void IslandMotion::turnContacts(const MotionInput& input, double duration) {
    const bool accurate = input.settings.tolerance < accurateTolerance;
    m_presses.assign(m_contacts.points.size(), 0);
    for (std::size_t i = 0; i < m_rowPoint.size(); ++i)
        m_presses[m_rowPoint[i]] = m_problem.rows[i].impulse.x() > 0 ? 1 : 0;
    double before = std::numeric_limits<double>::infinity(), least = before;
    int losses = 0; // rounds in which a point was not found again
    int stale = 0;  // rounds in a row that brought no smaller change
    for (int round = 0; round < mostTurningRounds; ++round) {
        if (m_unsolved || remaining(input) <= 0) {
            m_unsolved = true;
            return;
        }
        predictPoses(input, duration);
        moveRows(input);
        m_lastVelocity.resize(m_problem.bodies.size());
        for (std::size_t i = 0; i < m_lastVelocity.size(); ++i)
            m_lastVelocity[i] = m_problem.bodies[i].velocity;
        const double tolerance = m_tolerance;
        if (accurate && round > 0) m_tolerance = std::max(tolerance, roundPart * before);
        solveTurned(input);
        const double left = std::exchange(m_tolerance, tolerance); // which the next round changes, too
        const bool isExact = left == tolerance;
        double change = 0;
        for (std::size_t i = 0; i < m_lastVelocity.size(); ++i) {
            const ContactBody& body = m_problem.bodies[i];
            change = std::max(change, fastestPart(body.velocity - m_lastVelocity[i], body.gyration));
        }
        if (!isExact) change = std::max(change, left);
        const bool isLost = losesPoint(input);
        losses += isLost ? 1 : 0;
        // What a solve leaves, because bounds contradict each other, differs from round to round.
        const bool isFound = isExact && change <= std::max(m_tolerance, m_residual);
        m_turnsTooFar = isLost && (losses == mostLosses || isFound);
        stale = change < least ? 0 : stale + 1;
        least = std::min(least, change);
        m_turnsTooFar = m_turnsTooFar || (!isFound && stale == mostStale);
        if (m_turnsTooFar || isFound) return;
        if (!(change <= mostGrowth * before)) { // the rounds diverge: uses the contacts of the start
            beginPart(input, duration);
            for (std::size_t i = 0; i < m_rowPoint.size(); ++i) placeRow(m_rowPoint[i], m_problem.rows[i]);
            solve(input);
            return;
        }
        if (accurate) mixRounds(round > 0 && change < before);
        before = change;
    }
}

// Remembers the round that has ended, and goes on from where it and the one before lead if `extrapolates`.
void IslandMotion::mixRounds(bool extrapolates) {
    m_rounds.resize(m_problem.bodies.size());
    m_rowRounds.resize(m_problem.rows.size());
    double along = 0, size = 0;
    for (std::size_t i = 0; i < m_rounds.size(); ++i) {
        const ContactBody& body = m_problem.bodies[i];
        const Vec6 change = body.velocity - m_lastVelocity[i];
        if (extrapolates) {
            const Vec6 difference = change - m_rounds[i].change;
            const Vec6 momentum = momentumOf(body, difference);
            along += change.dot(momentum);
            size += difference.dot(momentum);
        }
        m_rounds[i].change = change;
    }
    const double part = size > 0 ? std::max(along / size, -mostMixed) : 0;
    const auto mix = [&](auto& now, auto& before) {
        const auto end = std::exchange(before, now);
        if (extrapolates) now -= part * (now - end);
    };
    for (std::size_t i = 0; i < m_rounds.size(); ++i) mix(m_problem.bodies[i].velocity, m_rounds[i].end);
    for (std::size_t i = 0; i < m_rowRounds.size(); ++i) {
        mix(m_problem.rows[i].impulse, m_rowRounds[i].impulse);
        mix(m_problem.rows[i].rollingImpulse, m_rowRounds[i].rolling);
    }
}

// Whether a point that bears a force is not found again at the end: the body has rolled on too far.
bool IslandMotion::losesPoint(const MotionInput& input) const {
    const auto turns = [&](BodyIndex i) {
        return localOf(i) != immobile && m_endPose[at(localOf(i))].orientation.angularDistance(
                                             input.state.pose[i].orientation) > hardlyTurned;
    };
    for (std::size_t i = 0; i < m_rowPoint.size(); ++i) {
        const std::uint32_t point = m_rowPoint[i];
        const ContactPair& pair = m_contacts.pairs[m_pairOf[point]];
        if (m_problem.rows[i].impulse.x() > 0 && !m_atEnd[point].found && !neverTurns(input.bodies, pair) &&
            (turns(pair.a) || turns(pair.b)))
            return true;
    }
    return false;
}

// Computes, from the present velocities, poses in the middle and at the end of the part, and the inertia at
// the end.
void IslandMotion::predictPoses(const MotionInput& input, double duration) {
    const std::size_t count = m_problem.bodies.size();
    m_middlePose.resize(count);
    m_endPose.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        m_middlePose[i] = middlePose(input, m_members[i], duration);
        m_endPose[i] = poseAt(input, m_members[i], duration, duration);
    }
    for (std::size_t i = 0; i < count; ++i) {
        ContactBody& body = m_problem.bodies[i];
        const Vec3 momentum = endMomentum(i);
        setInertia(input.bodies.inertia[m_members[i]], m_endPose[i].orientation, body);
        body.freeVelocity.tail<3>() = body.inverseInertia * m_start[i].angularMomentum;
        body.velocity.tail<3>() = body.inverseInertia * momentum;
    }
}

// Moves the rows to the end of the part, and the directions along which their impulses act to its middle.
void IslandMotion::moveRows(const MotionInput& input) {
    m_pushes.resize(m_problem.rows.size());
    m_inMiddle.resize(m_contacts.points.size());
    m_atEnd.resize(m_contacts.points.size());
    std::size_t followed = m_contacts.pairs.size();
    for (std::size_t i = 0; i < m_problem.rows.size(); ++i) {
        const std::uint32_t point = m_rowPoint[i];
        ContactRow& row = m_problem.rows[i];
        if (m_pairOf[point] != followed) {
            followed = m_pairOf[point];
            followPair(input, m_contacts.pairs[followed], m_middlePose, m_inMiddle);
            followPair(input, m_contacts.pairs[followed], m_endPose, m_atEnd);
        }
        placeRow(point, row);
        ContactRow push = row;
        const bool turns = m_inMiddle[point].found && m_atEnd[point].found;
        if (turns) {
            placeRow(m_inMiddle[point], push);
            placeRow(m_atEnd[point], row);
        }
        m_pushes[i] = {push.jacobianA, push.jacobianB, push.frame};
    }
}

// A point of a pair, as its bodies see it at these poses. An immobile body sees the world's axes.
IslandMotion::SeenPoint IslandMotion::seenAt(const Bodies& bodies, const ContactPair& pair, const Pose& poseA,
                                             const Pose& poseB, const ContactConstraint& point) {
    const bool isMobileA = bodies.mobile[pair.a] != 0, isMobileB = bodies.mobile[pair.b] != 0;
    const Vec3 inWorld = isMobileA ? Vec3(poseA.position + point.armA) : Vec3(poseB.position + point.armB);
    return {isMobileA ? poseA.directionToBody(point.armA) : inWorld,
            isMobileB ? poseB.directionToBody(point.armB) : inWorld};
}

// Squared distances of the points of a pair at the start from those that were found at these poses [m²]: the
// smaller of those that its two bodies see. A point that slides keeps its place on one body; one that rolls
// on a wall keeps it on none.
void IslandMotion::findWays(const MotionInput& input, const ContactPair& pair, const Pose& poseA,
                            const Pose& poseB) {
    m_seenThere.clear();
    for (const ContactConstraint& point : m_followed.points)
        m_seenThere.push_back(seenAt(input.bodies, pair, poseA, poseB, point));
    m_ways.clear();
    for (const ContactConstraint& point : m_contacts.pointsOf(pair)) {
        const SeenPoint then =
            seenAt(input.bodies, pair, input.state.pose[pair.a], input.state.pose[pair.b], point);
        for (const SeenPoint& there : m_seenThere)
            m_ways.push_back(
                std::min((then.onA - there.onA).squaredNorm(), (then.onB - there.onB).squaredNorm()));
    }
}

// Finds the points of a pair again with the bodies at these poses: the nearest first, each at most once.
CAROM_WIDE void IslandMotion::followPair(const MotionInput& input, const ContactPair& pair,
                                         const std::vector<Pose>& poses, std::vector<Place>& places) {
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) places[i].found = false;
    if (neverTurns(input.bodies, pair)) return;
    const auto poseOf = [&](BodyIndex i) -> const Pose& {
        return localOf(i) == immobile ? input.state.pose[i] : poses[at(localOf(i))];
    };
    const Pose &poseA = poseOf(pair.a), &poseB = poseOf(pair.b);
    m_followed.clear();
    m_work += collideWork(input.bodies, pair);
    ++report.work.pairsCollided;
    collideAt(input.bodies, poseA, poseB, pair, {}, m_followed);
    const std::span<const ContactConstraint> points = m_contacts.pointsOf(pair);
    const std::vector<ContactConstraint>& found = m_followed.points;
    findWays(input, pair, poseA, poseB);
    m_unused.resize(found.size());
    std::iota(m_unused.begin(), m_unused.end(), 0U);
    const double within = std::pow(sameWithin * pair.size, 2);
    const bool alone = points.size() == 1 && found.size() == 1;
    for (std::size_t count = std::min(points.size(), found.size()); count > 0; --count) {
        std::size_t point = 0, best = m_unused.size();
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (places[pair.first + i].found) continue;
            const double weight = m_presses[pair.first + i] != 0 ? gapWeight : 0;
            for (std::size_t k = 0; k < m_unused.size(); ++k) {
                const double way = m_ways[i * found.size() + m_unused[k]];
                const double distance = way + std::pow(weight * found[m_unused[k]].separation, 2);
                if (!(distance < nearest) || !(alone || way <= within)) continue;
                nearest = distance;
                point = i;
                best = k;
            }
        }
        if (best == m_unused.size()) return;
        const ContactConstraint& there = found[m_unused[best]];
        const Vec3 from = points[point].frame.row(0).transpose(), to = there.frame.row(0).transpose();
        if (from.dot(to) < sameFace) return;
        // Tangents turn only as the normal does, so that tangential impulses keep their directions.
        const Mat3 turn = from == to ? Mat3(Mat3::Identity()) : shortestRotation(from, to).toRotationMatrix();
        places[pair.first + point] = {true, points[point].frame * turn.transpose(), there.armA, there.armB};
        m_unused[best] = m_unused.back();
        m_unused.pop_back();
    }
}

void IslandMotion::placeRow(const Place& place, ContactRow& row) const {
    row.frame = place.frame;
    row.armA = place.armA;
    row.armB = place.armB;
    prepareRow(m_problem, row);
}

// Sets the row as the point was found at the start.
void IslandMotion::placeRow(std::uint32_t point, ContactRow& row) const {
    const ContactConstraint& start = m_contacts.points[point];
    placeRow({true, start.frame, start.armA, start.armB}, row);
}

// Solves for the contacts at the end, with the impulses as they act in the middle.
void IslandMotion::solveTurned(const MotionInput& input) {
    m_free.clear();
    for (const ContactBody& body : m_problem.bodies) m_free.push_back(body.freeVelocity);
    const auto addPushes = [&](double minus) { // impulses along J½; with `minus`, less those along J₁
        const auto add = [&](int index, const Vec6& impulse) {
            if (index == immobile) return;
            ContactBody& body = m_problem.bodies[at(index)];
            body.freeVelocity.head<3>() += impulse.head<3>() / body.mass;
            body.freeVelocity.tail<3>() += body.inverseInertia * impulse.tail<3>();
        };
        for (std::size_t i = 0; i < m_pushes.size(); ++i) {
            const ContactRow& row = m_problem.rows[i];
            Vec6 onA = (m_pushes[i].a - minus * row.jacobianA).transpose() * row.impulse;
            Vec6 onB = (m_pushes[i].b - minus * row.jacobianB).transpose() * row.impulse;
            if (row.rolling > 0) {
                const Vec3 torque =
                    (m_pushes[i].frame - minus * row.frame).bottomRows<2>().transpose() * row.rollingImpulse;
                onA.tail<3>() -= torque;
                onB.tail<3>() += torque;
            }
            add(row.a, onA);
            add(row.b, onB);
        }
    };
    addPushes(1);
    solve(input);
    // Velocities follow from the impulses found: so momentum is exact even if the rounds have not converged.
    for (std::size_t i = 0; i < m_free.size(); ++i) m_problem.bodies[i].freeVelocity = m_free[i];
    addPushes(0);
    for (std::size_t i = 0; i < m_free.size(); ++i) {
        m_problem.bodies[i].velocity = m_problem.bodies[i].freeVelocity;
        m_problem.bodies[i].freeVelocity = m_free[i];
    }
}

} // namespace carom
