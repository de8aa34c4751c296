// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/free_rotation.h"
#include "core/narrowphase/time_of_impact.h"
#include "core/solvers/contacts/contact_settings.h"
#include "core/solvers/contacts/island_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

// When does something happen within a part of the substep that ends the smooth motion: two bodies meet, or a
// corner of bodies that touch already comes down, or a slide or a roll stops? Bodies that no contact force
// holds together may come from anywhere, turn fast or pass through thin things, so the time they meet is
// searched for along their whole paths (narrowphase/time_of_impact.h), which misses nothing. The contacts of
// bodies that are held together are followed one by one.

namespace carom {
namespace {

/// A time of impact is found to a gap of this part of contactSlop. At a thousand times, bodies would be
/// stopped at the edge of what counts as touching; at a thousandth, below the rounding of their positions.
constexpr double reached = 1e-3;
/// What has come down earlier than after this part of the time touched already, and rolled on. Where that
/// takes it deeper than this part of its size the time was too long: half of it will do, or less.
constexpr double rolledOn = 0.01, deepRoll = 1e-4;
constexpr int mostLooks = 4;
/// About how many comparisons of shapes one time of impact takes. At half or twice, the budget counts such
/// searches as half or twice as much work.
constexpr int comparisonsAnImpact = 6;
/// Newton's steps for it at most: at half, some times are less exact; at twice, searches that do not converge
/// take twice as long.
constexpr int mostSteps = 20;

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

// Time of the first impact of an open contact, or `duration` if there is none.
double IslandMotion::firstImpact(const MotionInput& input, double duration) {
    markHeld();
    m_rollsOn = false;
    double first = duration;
    for (std::uint32_t p = 0; p < m_contacts.pairs.size(); ++p) {
        const ContactPair& pair = m_contacts.pairs[p];
        if (!mayMeet(input, p, first)) continue;
        m_work += comparisonsAnImpact * collideWork(input.bodies, pair);
        if (remaining(input) <= 0) return first; // the first one found so far
        first = m_held[p] != 0 ? std::min(first, nextCorner(input, pair, first, duration))
                               : std::min(first, nextContact(input, pair, first, duration));
    }
    return first;
}

// Whether a pair comes so near within `duration` that open points may close, or that one that touches may
// roll on to where it is deep.
bool IslandMotion::mayMeet(const MotionInput& input, std::uint32_t p, double duration) const {
    const ContactPair& pair = m_contacts.pairs[p];
    double gap = m_held[p] != 0 ? deepRoll * pair.size : std::numeric_limits<double>::infinity();
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i)
        if (m_held[p] == 0 || m_waits[i] != 0) gap = std::min(gap, m_contacts.points[i].separation);
    return gap <= duration * fastestApproach(input, pair);
}

// Whether there may be impacts within the part, which the budget did not allow to locate.
bool IslandMotion::mayMissImpact(const MotionInput& input, double duration) {
    markHeld();
    for (std::uint32_t p = 0; p < m_contacts.pairs.size(); ++p)
        if (mayMeet(input, p, duration)) return true;
    return false;
}

// Whether bodies overlap at the end of the part by so much more than at its start that it would take several
// substeps to correct that: they turned too far for their contacts, of which no impact was looked for.
bool IslandMotion::sinkIn(const MotionInput& input, double duration) {
    return std::any_of(m_contacts.pairs.begin(), m_contacts.pairs.end(), [&](const ContactPair& pair) {
        if (duration * fastestApproach(input, pair) < mostCorrection * pair.size) return false;
        m_work += collideWork(input.bodies, pair);
        ++report.work.pairsCollided;
        return overlapAt(input, pair, duration, duration) > overlapOf(pair) + mostCorrection * pair.size;
    });
}

// How deep the points of a pair are [m].
double IslandMotion::overlapOf(const ContactPair& pair) const {
    double deepest = 0;
    for (const ContactConstraint& point : m_contacts.pointsOf(pair))
        deepest = std::max(deepest, -point.separation);
    return deepest;
}

// How deep the bodies are in each other at a time of a part [m]; 0 where the step is lost.
double IslandMotion::overlapAt(const MotionInput& input, const ContactPair& pair, double time,
                               double duration) const {
    const Pose a = poseAt(input, pair.a, time, duration), b = poseAt(input, pair.b, time, duration);
    Manifold manifold;
    if (!a.position.allFinite() || !b.position.allFinite() ||
        !collide({&input.bodies.shape[pair.a], &a}, {&input.bodies.shape[pair.b], &b}, 0, manifold))
        return 0;
    double deepest = 0;
    for (const ContactPoint& point : manifold) deepest = std::max(deepest, -point.separation);
    return deepest;
}

// Marks pairs that a contact force acts in, or that touch and neither close nor separate.
void IslandMotion::markHeld() {
    m_held.assign(m_contacts.pairs.size(), 0);
    m_pushed.assign(m_problem.bodies.size(), m_problem.springs.empty() ? 0 : 1);
    for (const ForcedSteps::Step& step : m_forced.steps()) m_pushed[step.owner] = 1;
    const double gentle = std::max(m_scale, 10 * m_tolerance);
    for (std::size_t i = 0; i < m_rowPoint.size(); ++i) {
        const ContactRow& row = m_problem.rows[i];
        const bool pushes = row.impulse != Vec3::Zero();
        const bool touches = row.bound == 0;
        if (pushes || (touches && std::abs(relativeVelocity(m_problem, row).x()) <= gentle))
            m_held[m_pairOf[m_rowPoint[i]]] = 1;
        if (!pushes) continue;
        if (row.a != immobile) m_pushed[at(row.a)] = 1;
        if (row.b != immobile) m_pushed[at(row.b)] = 1;
    }
}

// An upper bound of the speed at which any point of A approaches B [m/s].
double IslandMotion::fastestApproach(const MotionInput& input, const ContactPair& pair) const {
    Vec3 before = Vec3::Zero(), after = Vec3::Zero();
    double turning = 0;
    const auto add = [&](BodyIndex i, double sign) {
        const int local = localOf(i);
        if (local == immobile) return;
        const Start& start = m_start[at(local)];
        const ContactBody& end = m_problem.bodies[at(local)];
        before += sign * start.velocity.head<3>();
        after += sign * end.velocity.head<3>();
        if (std::holds_alternative<Sphere>(input.bodies.shape[i])) return;
        const double momentum = std::max(start.angularMomentum.norm(), endMomentum(at(local)).norm());
        turning += momentum / input.bodies.inertia[i].minCoeff() * input.bodies.boundingRadius[i];
    };
    add(pair.a, -1);
    add(pair.b, 1);
    return std::max(before.norm(), after.norm()) + turning;
}

// Whether bodies are deeper in each other at a time of a part than they were at its start.
bool IslandMotion::isDeep(const MotionInput& input, const ContactPair& pair, double time, double duration) {
    m_work += collideWork(input.bodies, pair);
    ++report.work.pairsCollided;
    return overlapAt(input, pair, time, duration) > overlapOf(pair) + deepRoll * pair.size;
}

// Whether any are at its end.
bool IslandMotion::anyDeep(const MotionInput& input, double duration) {
    return std::ranges::any_of(
        m_contacts.pairs, [&](const ContactPair& pair) { return isDeep(input, pair, duration, duration); });
}

// A part of `time`, at whose end they are not, or half of it so often as is looked for.
double IslandMotion::lessDeep(const MotionInput& input, const ContactPair& pair, double time,
                              double duration) {
    m_rollsOn = true;
    time *= 0.5;
    for (int look = 1; look < mostLooks && isDeep(input, pair, time, duration); ++look) time *= 0.5;
    return time;
}

bool IslandMotion::anyWaits(const ContactPair& pair) const {
    const auto first = m_waits.begin() + pair.first;
    return std::any_of(first, first + pair.count, [](std::uint8_t wait) { return wait != 0; });
}

// Whether the contact point in which the bodies of a pair are nearest now is one that waits.
bool IslandMotion::waitsAt(const MotionInput& input, const ContactPair& pair, const Pose& poseA,
                           const Pose& poseB, const Vec3& place) const {
    const Pose& anchorPose = isWall(input.bodies.shape[pair.b]) ? poseA : poseB;
    bool waits = false;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
        const double distance = (anchorPose.toWorld(m_contacts.points[i].anchor) - place).squaredNorm();
        if (!(distance < nearest)) continue;
        nearest = distance;
        waits = m_waits[i] != 0;
    }
    return waits;
}

// When two bodies that nothing holds together meet, at `first` or before; infinite if they do not.
double IslandMotion::nextContact(const MotionInput& input, const ContactPair& pair, double first,
                                 double duration) {
    constexpr double never = std::numeric_limits<double>::infinity();
    const MovingShape a = movingShape(input, pair.a, duration);
    const MovingShape b = movingShape(input, pair.b, duration);
    int comparisons = 0;
    const std::optional<Impact> impact = carom::timeOfImpact(a, b, first, &comparisons);
    m_work += std::max(0, comparisons - comparisonsAnImpact) * collideWork(input.bodies, pair);
    if (!impact) return never;
    // The ballistic path is not quite the path where a body's spin precesses.
    double t = impact->time;
    for (int step = 0; step < mostSteps; ++step) {
        const Pose poseA = poseAt(input, pair.a, t, duration), poseB = poseAt(input, pair.b, t, duration);
        const Proximity near =
            proximityOf({&input.bodies.shape[pair.a], &poseA}, {&input.bodies.shape[pair.b], &poseB});
        const Vec3 velocityA = velocityAt(pair.a, near.onA - poseA.position, t, duration);
        const Vec3 velocityB = velocityAt(pair.b, near.onB - poseB.position, t, duration);
        const double closing = near.normal.dot(velocityA - velocityB);
        // An impact at low speed between bodies whose contact could take a force has been treated by that
        // force, unless they sink in behind it: elsewhere, because they turn.
        if (closing <= gentleClosing(pair) &&
            !waitsAt(input, pair, poseA, poseB, 0.5 * (near.onA + near.onB))) {
            // Points of the pair that wait come later: they are followed one by one, as in pairs that are
            // held.
            const double corner = anyWaits(pair) ? nextCorner(input, pair, first, duration) : never;
            const double end = std::min(corner, first);
            if (!isDeep(input, pair, end, duration)) return corner;
            // Touching at the start, with nothing to stop: the contact could be followed, but without a force
            // at the end, where the rim has turned away. In less time it has one.
            if (t < rolledOn * end) return lessDeep(input, pair, end, duration);
        }
        if (!(closing > 0) || std::abs(near.distance) <= reached * touchingWithin(pair)) break;
        t = std::clamp(t + near.distance / closing, 0.0, duration);
    }
    return t;
}

// Time at which the first open point of a pair that touches at another point closes.
double IslandMotion::nextCorner(const MotionInput& input, const ContactPair& pair, double first,
                                double duration) const {
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
        if (m_waits[i] == 0) continue;
        const ContactRow row = rowOf(input.bodies, pair, m_contacts.points[i]);
        const double u1 = relativeVelocity(m_problem, row).x();
        double u0 = 0;
        if (row.a != immobile) u0 += row.jacobianA.row(0).dot(m_start[at(row.a)].velocity);
        if (row.b != immobile) u0 += row.jacobianB.row(0).dot(m_start[at(row.b)].velocity);
        const double estimate = closingTime(m_contacts.points[i].separation, u0, u1, duration);
        if (!(estimate < 1.01 * first)) continue;
        first = std::min(
            first, cornerTime(input, pair, m_contacts.points[i], std::min(estimate, duration), duration));
    }
    for (int look = 0; look < mostLooks; ++look) {
        const double impact = impactTime(input, pair, first, duration);
        if (!(impact < first)) break;
        first = impact;
    }
    return first;
}

// Time of an impact of a pair, which touches elsewhere, at a place that was no contact point at the start. It
// is needed for a disc that falls flat, whose rim meets the floor at any of its places. Infinite if there is
// none by `time`; a part of `time` if a contact has rolled too far.
double IslandMotion::impactTime(const MotionInput& input, const ContactPair& pair, double time,
                                double duration) const {
    const Pose poseA = poseAt(input, pair.a, time, duration), poseB = poseAt(input, pair.b, time, duration);
    double first = std::numeric_limits<double>::infinity();
    if (!poseA.position.allFinite() || !poseB.position.allFinite()) return first; // the step is lost
    Manifold manifold;
    if (!collide({&input.bodies.shape[pair.a], &poseA}, {&input.bodies.shape[pair.b], &poseB}, 0, manifold))
        return first;
    const BodyIndex anchorBody = isWall(input.bodies.shape[pair.b]) ? pair.a : pair.b;
    const Pose& anchorPose = anchorBody == pair.a ? poseA : poseB;
    const bool overlapped = overlapOf(pair) > 0.5 * deepRoll * pair.size;
    for (const ContactPoint& deep : manifold) {
        if (!(deep.separation < -touchingWithin(pair))) continue;
        const Vec3 velocityA = velocityAt(pair.a, deep.onA - poseA.position, time, duration);
        const Vec3 velocityB = velocityAt(pair.b, deep.onB - poseB.position, time, duration);
        const double closing = manifold.normal.dot(velocityA - velocityB);
        double corner = 0;
        if (closing > gentleClosing(pair)) {
            ContactConstraint point;
            point.anchor = anchorPose.toBody(0.5 * (deep.onA + deep.onB));
            corner = cornerTime(input, pair, point, time, duration);
        }
        if (corner >= rolledOn * time)
            first = std::min(first, corner);
        else if (!overlapped && deep.separation < -deepRoll * pair.size)
            first = std::min(first, 0.5 * time);
    }
    return first;
}

// Newton's iteration for the time at which one point closes, found again by its place on the body.
double IslandMotion::cornerTime(const MotionInput& input, const ContactPair& pair,
                                const ContactConstraint& point, double t, double duration) const {
    const BodyIndex anchorBody = isWall(input.bodies.shape[pair.b]) ? pair.a : pair.b;
    for (int step = 0; step < mostSteps; ++step) {
        const Pose poseA = poseAt(input, pair.a, t, duration), poseB = poseAt(input, pair.b, t, duration);
        Manifold manifold;
        if (!collide({&input.bodies.shape[pair.a], &poseA}, {&input.bodies.shape[pair.b], &poseB},
                     pair.margin, manifold))
            return t;
        const Vec3 place = (anchorBody == pair.a ? poseA : poseB).toWorld(point.anchor);
        const ContactPoint* nearest = std::min_element(
            manifold.begin(), manifold.end(), [&](const ContactPoint& one, const ContactPoint& other) {
                return (one.onA + one.onB - 2 * place).squaredNorm() <
                       (other.onA + other.onB - 2 * place).squaredNorm();
            });
        if (std::abs(nearest->separation) <= reached * touchingWithin(pair)) return t;
        const Vec3 velocityA = velocityAt(pair.a, nearest->onA - poseA.position, t, duration);
        const Vec3 velocityB = velocityAt(pair.b, nearest->onB - poseB.position, t, duration);
        const double closing = manifold.normal.dot(velocityA - velocityB);
        if (!(closing > 0)) return t;
        const double next = std::clamp(t + nearest->separation / closing, 0.0, duration);
        if (next == t) return t;
        t = next;
    }
    return t;
}

// A body's path: a parabola, and the free rotation about the mean of the angular momenta at both ends.
MovingShape IslandMotion::movingShape(const MotionInput& input, BodyIndex i, double duration) const {
    MovingShape moving{.start = {&input.bodies.shape[i], &input.state.pose[i]}};
    const int local = localOf(i);
    if (local == immobile) return moving;
    const Start& start = m_start[at(local)];
    const ContactBody& end = m_problem.bodies[at(local)];
    moving.velocity = start.velocity.head<3>();
    // Without rounding if only gravity acts: two balls in the same field have a closed form.
    moving.acceleration =
        m_pushed[at(local)] == 0 ? input.gravity : Vec3((end.velocity - start.velocity).head<3>() / duration);
    if (hasEqualMoments(input.bodies.inertia[i])) {
        moving.angularVelocity = 0.5 * (start.velocity + end.velocity).tail<3>();
        return moving;
    }
    const Vec3 momentum = 0.5 * (start.angularMomentum + endMomentum(at(local)));
    const TwoRotations turning =
        rotationsOf(input.bodies.inertia[i], momentum, duration, input.state.pose[i].orientation);
    moving.angularVelocity = turning.world;
    moving.ownSpin = turning.body;
    return moving;
}

Pose IslandMotion::poseAt(const MotionInput& input, BodyIndex i, double t, double duration) const {
    const int local = localOf(i);
    Pose pose = input.state.pose[i];
    if (local == immobile) return pose;
    const Start& start = m_start[at(local)];
    const Vec3 v0 = start.velocity.head<3>(), v1 = m_problem.bodies[at(local)].velocity.head<3>();
    pose.position += t * (v0 + (0.5 * t / duration) * (v1 - v0));
    const Vec3 momentum =
        start.angularMomentum + (0.5 * t / duration) * (endMomentum(at(local)) - start.angularMomentum);
    rotateFreely(input.bodies.inertia[i], momentum, t, pose.orientation);
    return pose;
}

// Velocity at time t of the point of the body that is at `arm` from its centre.
Vec3 IslandMotion::velocityAt(BodyIndex i, const Vec3& arm, double t, double duration) const {
    const int local = localOf(i);
    if (local == immobile) return Vec3::Zero();
    const Vec6 v0 = m_start[at(local)].velocity, v1 = m_problem.bodies[at(local)].velocity;
    const Vec6 v = v0 + (t / duration) * (v1 - v0);
    return v.head<3>() + v.tail<3>().cross(arm);
}

// A sliding or rolling contact that friction slows down, as seen in a row of the problem.
struct IslandMotion::Braked {
    std::uint32_t point = 0; // of m_contacts
    bool rolling = false;
    double before = 0;             // its speed at the start of the part [m/s] or [rad/s]
    Vec2 direction = Vec2::Zero(); // of that speed
    double part = 0;               // share of the largest possible friction that stopped it
};

// Time at which the first sliding contact sticks, or a rolling one stops; `duration` if none does. Under
// constant forces the speed falls linearly: the force that stopped it, as a part of what the law allows, is
// the first guess of the time; a solve shortly before that gives the slope.
double IslandMotion::firstStop(const MotionInput& input, double duration) {
    Braked braked;
    if (!findStop(braked)) return duration;
    const double stop = findStopTime(input, braked, duration);
    if (stop < (1 - shortestPart) * duration) return stop;
    solveVelocities(input, duration, true); // undoes the trials
    return duration;
}

double IslandMotion::findStopTime(const MotionInput& input, const Braked& braked, double duration) {
    // Part of the speed before at which it has stopped. At a thousandth, it is near rounding; at a million
    // times, contacts stick while they still slide.
    constexpr double stopped = 1e-9;
    // Each trial is a solve. At half, the time of a stop is less exact where the speed does not fall
    // linearly; at twice, a stop that is not found costs twice as much.
    constexpr int mostTrials = 10;
    double low = 0, speedLow = braked.before, high = duration;
    double guess = 0.9 * std::min(1.0, braked.part) * duration;
    for (int trial = 0; trial < mostTrials && !m_unsolved; ++trial) {
        solveVelocities(input, guess, true);
        const double speed = speedOf(braked);
        if (speed > stopped * braked.before) {
            const double slope = (speed - speedLow) / (guess - low);
            low = guess;
            speedLow = speed;
            guess = slope < 0 ? std::min(high, low - speedLow / slope) : high;
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

// Finds the contact that took the smallest part of the friction that its law allows.
bool IslandMotion::findStop(Braked& first) const {
    bool found = false;
    const auto look = [&](const Braked& braked, double after, double fastest) {
        if (braked.before <= 1e3 * fastest || after > 10 * fastest) return;
        if (found && braked.part >= first.part) return;
        first = braked;
        found = true;
    };
    for (std::size_t i = 0; i < m_rowPoint.size(); ++i) {
        const ContactRow& row = m_problem.rows[i];
        const double normal = row.impulse.x();
        // Where a body turns about a corner that sticks, the corner's speed over a part is that of turning.
        if (!(normal > 0) || m_stuck[i] != 0) continue;
        // Where a gap closes within the part, its force is the larger, the shorter the part: there is no time
        // at which the speed vanishes under a constant force.
        const std::uint32_t point = m_rowPoint[i];
        if (m_contacts.points[point].separation > touchingWithin(m_contacts.pairs[m_pairOf[point]])) continue;
        // The speed before is that of the contact as it was then.
        ContactRow start = row;
        if (!m_pushes.empty()) placeRow(m_rowPoint[i], start);
        Vec3 slip = Vec3::Zero();
        Vec2 roll = Vec2::Zero();
        const auto add = [&](int body, const Mat36& jacobian, double sign) {
            if (body == immobile) return;
            slip += jacobian * m_start[at(body)].velocity;
            roll += sign * (start.frame.bottomRows<2>() * m_start[at(body)].velocity.tail<3>());
        };
        add(row.a, start.jacobianA, -1);
        add(row.b, start.jacobianB, 1);
        if (row.friction > 0) {
            const double speed = slip.tail<2>().norm();
            look({.point = m_rowPoint[i],
                  .before = speed,
                  .direction = slip.tail<2>() / (speed > 0 ? speed : 1),
                  .part = row.impulse.tail<2>().norm() / (row.friction * normal)},
                 relativeVelocity(m_problem, row).tail<2>().norm(), m_tolerance);
        }
        if (row.rolling > 0) {
            const double speed = roll.norm();
            look({.point = m_rowPoint[i],
                  .rolling = true,
                  .before = speed,
                  .direction = roll / (speed > 0 ? speed : 1),
                  .part = row.rollingImpulse.norm() / (row.rolling * normal)},
                 rollingVelocity(m_problem, row).norm(),
                 m_tolerance / std::max(row.armA.norm(), row.armB.norm()));
        }
    }
    return found;
}

double IslandMotion::speedOf(const Braked& braked) const {
    for (std::size_t i = 0; i < m_rowPoint.size(); ++i) {
        if (m_rowPoint[i] != braked.point) continue;
        const ContactRow& row = m_problem.rows[i];
        return braked.rolling ? braked.direction.dot(rollingVelocity(m_problem, row))
                              : braked.direction.dot(relativeVelocity(m_problem, row).tail<2>());
    }
    return 0;
}

} // namespace carom
