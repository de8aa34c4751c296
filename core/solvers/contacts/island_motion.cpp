// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/island_motion.h"

#include "core/dynamics/contact_memory.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/free_rotation.h"
#include "core/math/rotation.h"
#include "core/solvers/contacts/audit.h"
#include "core/solvers/contacts/calm.h"
#include "core/solvers/contacts/contact_settings.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom {
namespace {

bool areStill(const State& state, std::span<const BodyIndex> bodies) {
    return std::all_of(bodies.begin(), bodies.end(), [&](BodyIndex i) {
        return state.velocity[i] == Vec3::Zero() && state.angularVelocity[i] == Vec3::Zero();
    });
}

/// The time of impact of a body on a spring is found again so often by the secant method, before the part is
/// halved. At half, more substeps are divided; at twice, parts too long for the spring cost twice as much.
constexpr int mostRelocations = 8;
/// And until it changes by less than this part. At a thousandth, by rounding only; at a thousand times, an
/// impact on a spring is wrong by a billionth of its time.
constexpr double relocationEnd = 1e-12;
/// A part through which contacts cannot be followed is halved so often at most. At half, discs that fall flat
/// sink in by more; at twice, a substep may take many times as many parts.
constexpr int mostHalvings = 4;
/// So is one in which contacts, or arms of springs that turn, give more than this part of the energy. At half
/// or twice, coins that spin fast sink in as deep, with 2 % more or 3 % fewer comparisons of shapes; without,
/// they gain a tenth of their energy in single frames.
constexpr double mostGained = 1e-3;
/// Where a force acts in a point that was open at the start, no more than this part: as long as a gap closes,
/// its force can only take energy. Discs that spin fast are pushed off the floor by such forces, one
/// thousandth of the energy after the other. At a tenth or three times, those of 1000 rad/s gain alike; coins
/// cost 7 % more at a tenth, and at three times thin discs still gain 1.6 %.
constexpr double mostGainedApart = 1e-4;
/// Friction and rolling resistance can only take energy, too. Where a rim rolls on by radians in a part, they
/// act along the directions that it has in the middle, against the slip at its end, and gave most of what
/// discs of 1000 rad/s gained: with two substeps a frame 2.3e-3 of their energy in a run, with four 9.9e-4.
/// With this they gain 8e-4 and 3.2e-4, at a third 8e-4 and 1.4e-4, but coins cost 11 % more; at three times
/// as much as without.
constexpr double mostByFriction = 3e-4;
/// What is left of a substep when its events are used up may give no more than this part, or it is left to
/// the base path: its contacts are not followed, and no shorter part comes behind it. From a tenth to ten
/// times, the same parts are left.
constexpr double mostGainedLast = 1e-5;

/// Turns a body by a rotation vector [rad] that no time passes for, and its angular velocity and angular
/// momentum with it: its kinetic energy and all velocities stay as they are seen from the body.
///
///     T = ½ L · I⁻¹ L      turned by θ:   dT = θ·(L × ω) with ω kept,  dT = −θ·(L × ω) with L kept
///
///     legend   ω, L  angular velocity and angular momentum, I  inertia, all in the world
///
/// (H. Goldstein, "Classical Mechanics", 1980, 5.3, with the I of the body as it lies). Both are of first
/// order in θ. For a disc whose rim touches a floor they have one sign: with ω kept one of 500 rad/s gained
/// half of its energy in two seconds, with L kept it lost as much. It costs that L turns by θ, as the body
/// does: the correction of positions keeps no total angular momentum in any case, as it moves centres of
/// mass.
///
/// Not taken: L as it is, scaled to the same T. Energies converge alike as substeps are divided, but
/// velocities of contact points change, as seen from the body.
void turnWithVelocity(const Bodies& bodies, BodyIndex body, const Vec3& rotation, State& state) {
    if (rotation == Vec3::Zero()) return;
    const Quat turn = fromRotationVector(rotation);
    const Vec3 momentum = turn * angularMomentumOf(bodies, body, state);
    state.pose[body].orientation = (turn * state.pose[body].orientation).normalized();
    state.angularVelocity[body] = turn * state.angularVelocity[body];
    keepAngularMomentum(bodies, body, momentum, state); // where moments differ, ω follows from it
}

} // namespace

bool IslandMotion::advance(const MotionInput& input, const Island& island, const ContactSet& found) {
    load(input, island, found);
    const bool wereStill = island.links.empty() && areStill(input.state, island.bodies);
    if (!integrateSprings(input, island)) move(input, island);
    report.work.operations += m_work;
    return wereStill && !m_isCorrected && m_left == 0 && areStill(input.state, island.bodies);
}

void IslandMotion::move(const MotionInput& input, const Island& island) {
    const bool accurate = input.settings.tolerance < accurateTolerance;
    const int points = static_cast<int>(m_contacts.points.size());
    const int usual = (accurate ? mostEventsAccurate : mostEvents) + mostEventsPerPoint * points;
    const bool isElastic = std::ranges::any_of(
        m_contacts.pairs, [&](const ContactPair& pair) { return isElasticOnSprings(pair); });
    const int most = isElastic ? mostEventsOnSprings * usual : usual;
    int events = 0;
    double dearest = 0;             // part so far [operations]
    double longest = input.substep; // part that contacts are likely to be followed through [s]
    for (double left = input.substep; left > 0;) {
        // Accurate runs use what is left of the budget for one part without located impacts: the base path
        // would leave overlaps a thousand times as deep.
        const bool isLast = accurate && remaining(input) < dearest;
        const bool findsImpacts = events < most && !isLast;
        const double workBefore = m_work;
        m_rattles = 2 * events > usual;
        m_left = left;
        // A part that is not finished is undone: bodies whose overlap is corrected here again and again, and
        // which sink in again on the base path in between, would never come to rest.
        const Ledger recorded = input.ledger != nullptr ? *input.ledger : Ledger{};
        m_uncorrected.clear();
        for (const BodyIndex i : island.bodies)
            m_uncorrected.push_back({input.state.pose[i], input.state.velocity[i],
                                     input.state.angularVelocity[i], input.state.angularMomentum[i]});
        const auto giveUp = [&] {
            for (std::size_t k = 0; k < island.bodies.size(); ++k) {
                input.state.pose[island.bodies[k]] = m_uncorrected[k].pose;
                input.state.velocity[island.bodies[k]] = m_uncorrected[k].velocity;
                input.state.angularVelocity[island.bodies[k]] = m_uncorrected[k].angularVelocity;
                input.state.angularMomentum[island.bodies[k]] = m_uncorrected[k].angularMomentum;
            }
            if (input.ledger != nullptr) *input.ledger = recorded;
        };
        correctPositions(input, island);
        loadBodies(input, island);
        impacts(input, left, findsImpacts);
        if (remaining(input) <= 0) return giveUp();
        double duration = solvePart(input, findsImpacts ? std::min(left, longest) : left, findsImpacts);
        longest = 2 * duration;
        const bool isShort = duration < left;
        if (isShort) ++events;
        if (findsImpacts && !m_unsolved && remaining(input) > 0) {
            double event = firstImpact(input, duration);
            if (event >= duration && accurate) event = firstStop(input, duration);
            if (event < (1 - shortestPart) * duration) {
                duration = std::max(event, shortestPart * input.substep);
                duration = solvePart(input, duration, findsImpacts);
                duration = lessSunkIn(input, duration);
                if (m_rollsOn) longest = 2 * duration;
                if (!isShort) ++events; // counted above
                if (!m_springs.empty()) duration = relocated(input, duration);
            }
        }
        if (duration == left) solveFiner(input, duration, findsImpacts);
        if (m_unsolved && !m_contacts.pairs.empty()) return giveUp();
        if (findsImpacts && remaining(input) <= 0 && mayMissImpact(input, duration)) return giveUp();
        if (!findsImpacts && (sinkIn(input, duration) || gainsEnergy(input, duration, mostGainedLast) ||
                              (isLast && anyDeep(input, duration))))
            return giveUp();
        if ((report.loss = findLoss(island))) break;
        if (input.ledger != nullptr) recordForces(input, duration);
        if (duration == left) settle(input, island);
        commit(input, island, duration);
        dearest = std::max(dearest, m_work - workBefore);
        left = duration < left ? left - duration : 0;
        m_left = left;
        if (left > 0 || accurate || events > 0) recollide(input);
    }
    // Accurate runs end without overlap, and so do substeps in which an impact may have turned a rim into
    // another body. Position correction is linear in the displacement, so after a large turn a small overlap
    // remains. Deep overlaps are left to later substeps, or the correction would be too fast.
    for (int round = 0; (accurate || events > 0) && !report.loss && round < mostCorrectionRounds; ++round) {
        if (std::max(m_overlap, relativeOverlap()) > 0.5 * mostCorrection) break;
        correctPositions(input, island);
    }
}

// Solves for the velocities after `duration`, or after as much of it as contacts can be followed through,
// which is returned.
double IslandMotion::solvePart(const MotionInput& input, double duration, bool findsImpacts) {
    solveVelocities(input, duration, findsImpacts);
    const auto isTooLong = [&] {
        if (m_turnsTooFar || m_unsolved || (m_pushes.empty() && m_springs.empty())) return m_turnsTooFar;
        return gainsEnergy(input, duration, pushesApart() ? mostGainedApart : mostGained);
    };
    for (int half = 0; half < mostHalvings && remaining(input) > 0 && isTooLong(); ++half) {
        duration *= 0.5;
        solveVelocities(input, duration, findsImpacts);
    }
    return duration;
}

// Whether a force acts in a point that was open at the start of the part, and is followed through it.
bool IslandMotion::pushesApart() const {
    for (std::size_t i = 0; i < m_pushes.size(); ++i) {
        const std::uint32_t point = m_rowPoint[i];
        if (m_problem.rows[i].impulse.x() > 0 &&
            m_contacts.points[point].separation > touchingWithin(m_contacts.pairs[m_pairOf[point]]))
            return true;
    }
    return false;
}

// A part that ends at an event has other forces than the one that the event was found in: where bodies come
// to lie deep in each other by them it is halved.
double IslandMotion::lessSunkIn(const MotionInput& input, double duration) {
    for (int half = 0; half < mostHalvings && !m_unsolved && remaining(input) > 0; ++half) {
        if (!sinkIn(input, duration)) break;
        duration = solvePart(input, 0.5 * duration, true);
    }
    return duration;
}

// Whether a part gives more than `most` of the energy at its start, or friction more than it may: contacts
// turned by more than they can be followed through, or arms of springs did.
bool IslandMotion::gainsEnergy(const MotionInput& input, double duration, double most) const {
    if (!m_forced.isEmpty()) return false;
    double before = 0, gained = 0;
    for (std::size_t i = 0; i < m_start.size(); ++i) {
        const ContactBody& end = m_problem.bodies[i];
        const Vec3 v0 = m_start[i].velocity.head<3>(), v1 = end.velocity.head<3>();
        const double turning = m_start[i].velocity.tail<3>().dot(m_start[i].angularMomentum);
        const Vec3 way = 0.5 * duration * (v0 + v1), momentum = endMomentum(i);
        // Where contacts are not followed, the inertia is that of the start.
        const Quat lies = poseAt(input, m_members[i], duration, duration).orientation;
        const Vec3 own = lies.conjugate() * momentum;
        const double turningAfter = own.dot(own.cwiseQuotient(input.bodies.inertia[m_members[i]]));
        before += 0.5 * (end.mass * (v0.squaredNorm() + m_scale * m_scale) + turning);
        gained += 0.5 * (end.mass * (v1.squaredNorm() - v0.squaredNorm()) + turningAfter - turning) -
                  end.mass * input.gravity.dot(way);
    }
    for (const std::uint32_t index : m_springs) {
        const SpringForce& spring = input.bodies.springs[index];
        const SpringEnd from = springEnd(input, spring.from, spring.fromAt, duration),
                        to = springEnd(input, spring.to, spring.toAt, duration);
        const double first = springEnergy(spring, (to.before - from.before).norm());
        before += first;
        gained += springEnergy(spring, (to.after - from.after).norm()) - first;
    }
    return gained > most * before || workOfFriction() > mostByFriction * before;
}

// What friction and rolling resistance give where contacts turn in a part, along the directions they have in
// its middle [J].
double IslandMotion::workOfFriction() const {
    double work = 0;
    for (std::size_t i = 0; i < m_pushes.size(); ++i) {
        const ContactRow& row = m_problem.rows[i];
        const Push& push = m_pushes[i];
        Vec3 slip = Vec3::Zero();
        Vec2 roll = Vec2::Zero();
        const auto add = [&](int body, const Mat36& jacobian, double sign) {
            if (body == immobile) return;
            const Vec6 mean = 0.5 * (m_start[at(body)].velocity + m_problem.bodies[at(body)].velocity);
            slip += jacobian * mean;
            roll += sign * (push.frame.bottomRows<2>() * mean.tail<3>());
        };
        add(row.a, push.a, -1);
        add(row.b, push.b, 1);
        work += row.impulse.tail<2>().dot(slip.tail<2>());
        if (row.rolling > 0) work += row.rollingImpulse.dot(roll);
    }
    return work;
}

// The path of a body on a spring depends on the duration of the part, so the time of impact is found again on
// the shorter path, until it is the end of the part: by the secant method, and by halves where the part is so
// long that this leads nowhere. A part that is a little too short ends before the impact; at the end of one
// too long bodies would overlap.
double IslandMotion::relocated(const MotionInput& input, double duration) {
    const double shortest = shortestPart * input.substep;
    double longer = 0, change = 0; // the duration before, and how much earlier its impact was [s]
    for (int round = 0; !m_unsolved && remaining(input) > 0; ++round) {
        const double event = firstImpact(input, duration);
        if (duration == shortest || !(event < (1 - relocationEnd) * duration)) break;
        const double earlier = duration - event, bend = change - earlier;
        double next = bend > 0 ? duration - earlier * (longer - duration) / bend : event;
        if (!(next > 0) || next > event) next = event;
        if (round >= mostRelocations) next = 0.5 * event;
        longer = std::exchange(duration, std::max(next, shortest));
        change = earlier;
        solveVelocities(input, duration, true);
    }
    return duration;
}

// Reserves memory, so that islands of the usual size never allocate in a step.
void IslandMotion::reserve() {
    constexpr std::size_t points = pointsRefined, bodies = points / 2;
    if (m_presses.capacity() >= points) return;
    for (ContactSet* set : {&m_contacts, &m_before}) {
        set->pairs.reserve(points);
        set->points.reserve(points);
    }
    for (ContactProblem* problem : {&m_problem, &m_correction}) {
        problem->bodies.reserve(bodies);
        problem->rows.reserve(points);
    }
    for (std::vector<Vec6>* velocities : {&m_lastVelocity, &m_free}) velocities->reserve(bodies);
    for (std::vector<Pose>* poses : {&m_middlePose, &m_endPose}) poses->reserve(bodies);
    for (std::vector<Place>* places : {&m_inMiddle, &m_atEnd}) places->reserve(points);
    for (std::vector<std::uint32_t>* indices : {&m_rowPoint, &m_pairOf}) indices->reserve(points);
    for (std::vector<std::uint8_t>* flags : {&m_presses, &m_stuck, &m_waits, &m_held, &m_pushed})
        flags->reserve(points);
    m_start.reserve(bodies);
    m_rounds.reserve(bodies);
    m_rowRounds.reserve(points);
    m_pushes.reserve(points);
    m_impactRows.reserve(points);
    m_warmRows.reserve(points);
    m_followed.pairs.reserve(1);
    m_followed.points.reserve(Manifold::capacity);
    m_seenThere.reserve(Manifold::capacity);
    m_ways.reserve(Manifold::capacity * Manifold::capacity);
    m_unused.reserve(Manifold::capacity);
    m_newton.reserve(bodies, points);
    m_impacts.reserve(bodies, points);
}

void IslandMotion::load(const MotionInput& input, const Island& island, const ContactSet& found) {
    m_members = island.bodies;
    m_local.resize(input.bodies.count(), immobile);
    for (std::size_t i = 0; i < island.bodies.size(); ++i) m_local[island.bodies[i]] = static_cast<int>(i);
    m_contacts.clear();
    for (const std::uint32_t pair : island.pairs)
        m_contacts.append(found.pairs[pair], found.pointsOf(found.pairs[pair]));
    m_springs.assign(island.links.begin(), island.links.end());
    reserve();
    m_scale = input.gravity.norm() * input.substep;
    m_still = std::max(input.settings.tolerance, leastTolerance) * m_scale;
    m_work = m_left = 0;
    m_unsolved = m_isCorrected = false;
    m_overlap = 0;
    for (const ContactPair& pair : m_contacts.pairs)
        report.maxPenetration = std::max(report.maxPenetration, overlapOf(pair));
}

double IslandMotion::collideWork(const Bodies& bodies, const ContactPair& pair) const {
    const auto simple = [&](BodyIndex i) {
        return std::holds_alternative<Sphere>(bodies.shape[i]) || isWall(bodies.shape[i]);
    };
    return simple(pair.a) || simple(pair.b) ? work::collideRound : work::collide;
}

void IslandMotion::recollide(const MotionInput& input) {
    std::swap(m_before, m_contacts);
    m_contacts.clear();
    for (const ContactPair& pair : m_before.pairs) {
        const std::size_t count = m_contacts.pairs.size();
        m_work += collideWork(input.bodies, pair);
        ++report.work.pairsCollided;
        collideInto(input.bodies, input.state, pair, m_before.pointsOf(pair), m_contacts);
        // A pair without contact points stays in the list: it may have some later in the substep.
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
    double narrowest = std::numeric_limits<double>::infinity(); // [m]
    for (const ContactPair& pair : m_contacts.pairs) narrowest = std::min(narrowest, touchingWithin(pair));
    // Contacts drift by what the tolerance leaves. Where that is more in a substep than the slop, each
    // substep would correct positions, which costs more than solving once to what the slop hides. Where
    // speeds overflow there is nothing to solve for: the loss is found at once.
    const double asked = input.settings.tolerance * scale;
    m_tolerance = std::max(std::isfinite(asked) ? std::min(asked, narrowest / input.substep) : asked,
                           speedRounding * fastest);
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

// The deepest overlap to be corrected, relative to the smaller body; 0 if there is none.
double IslandMotion::relativeOverlap() const {
    double deepest = 0;
    for (const ContactPair& pair : m_contacts.pairs)
        if (const double overlap = overlapOf(pair); overlap > touchingWithin(pair))
            deepest = std::max(deepest, overlap / pair.size);
    return deepest;
}

// Separates bodies that overlap by the smallest displacement, in the norm of the kinetic energy, that closes
// the overlaps: the contact problem with lengths in place of velocities. Kinetic energies stay as they are.
void IslandMotion::correctPositions(const MotionInput& input, const Island& island) {
    const double overlap = relativeOverlap();
    m_overlap = std::max(m_overlap, overlap);
    if (overlap == 0) return;
    m_isCorrected = true;
    loadBodies(input, island);
    m_correction.clear();
    m_correction.bodies = m_problem.bodies;
    for (ContactBody& body : m_correction.bodies) body.freeVelocity.setZero();
    double narrowest = std::numeric_limits<double>::infinity(); // [m]
    for (const ContactPair& pair : m_contacts.pairs) {
        narrowest = std::min(narrowest, touchingWithin(pair));
        for (const ContactConstraint& point : m_contacts.pointsOf(pair)) {
            ContactRow row = rowOf(input.bodies, pair, point);
            row.friction = row.rolling = 0;
            row.bound = std::max(point.separation, -mostCorrection * pair.size);
            m_correction.rows.push_back(row);
        }
    }
    const double tolerance = 1e-3 * narrowest;
    const double stored = storedInSprings(input);
    const NewtonReport correction = m_newton.solve(m_correction, tolerance, std::max(0.0, remaining(input)));
    m_work += correction.work;
    report.work.factorisations += static_cast<std::uint64_t>(correction.factorisations);
    for (std::size_t i = 0; i < island.bodies.size(); ++i) {
        const Vec6& displacement = m_correction.bodies[i].velocity;
        input.state.pose[island.bodies[i]].position += displacement.head<3>();
        turnWithVelocity(input.bodies, island.bodies[i], displacement.tail<3>(), input.state);
    }
    if (input.ledger != nullptr) recordPositionCorrection(input, island);
    takeEnergy(input, island, storedInSprings(input) - stored);
    recollide(input);
}

// [J]
double IslandMotion::storedInSprings(const MotionInput& input) const {
    double energy = 0;
    for (const std::uint32_t spring : m_springs)
        energy += springEnergy(input.bodies.springs[spring], input.state);
    return energy;
}

// The energy that position correction has added to springs is taken from the kinetic energy, as far as there
// is any: from all of it if the bodies touch or are tied to something immobile, else from that relative to
// their centre of mass.
void IslandMotion::takeEnergy(const MotionInput& input, const Island& island, double energy) {
    if (!(energy > 0)) return;
    const auto isFixed = [&](BodyIndex i) { return i == noBody || input.bodies.mobile[i] == 0; };
    bool held = std::any_of(m_contacts.pairs.begin(), m_contacts.pairs.end(), [&](const ContactPair& pair) {
        return pair.count > 0 && (isFixed(pair.a) || isFixed(pair.b));
    });
    for (const std::uint32_t index : m_springs) {
        const SpringForce& spring = input.bodies.springs[index];
        held = held || isFixed(spring.from) || isFixed(spring.to);
    }
    Vec3 momentum = Vec3::Zero();
    double mass = 0, kinetic = 0;
    for (const BodyIndex i : island.bodies) {
        momentum += input.bodies.mass[i] * input.state.velocity[i];
        mass += input.bodies.mass[i];
    }
    const Vec3 drift = held ? Vec3(Vec3::Zero()) : Vec3(momentum / mass);
    for (const BodyIndex i : island.bodies)
        kinetic += 0.5 * input.bodies.mass[i] * (input.state.velocity[i] - drift).squaredNorm();
    const double part = kinetic > energy ? std::sqrt(1 - energy / kinetic) : 0;
    for (const BodyIndex i : island.bodies)
        input.state.velocity[i] = drift + part * (input.state.velocity[i] - drift);
    if (input.ledger == nullptr) return;
    LedgerEntry& correction = (*input.ledger)[LedgerAccount::PositionCorrection];
    correction.energy -= (1 - part * part) * kinetic;
    correction.momentum -= (1 - part) * (momentum - mass * drift);
}

void IslandMotion::impacts(const MotionInput& input, double duration, bool findsImpacts) {
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
                                  (!findsImpacts && closing * duration > point.separation);
            m_problem.rows.push_back(row);
            m_impactRows.push_back({e, threshold, p, touching});
            any = any || (touching && closing > threshold);
        }
    }
    m_impacts.ledger = input.ledger;
    if (any) {
        const ImpactReport impacts = m_impacts.solve(
            m_problem, m_impactRows, input.settings.simultaneous || !findsImpacts, remaining(input));
        report.work.impacts += static_cast<std::uint64_t>(impacts.impacts);
        report.work.factorisations += static_cast<std::uint64_t>(impacts.factorisations);
        m_work += impacts.work;
    }
    for (std::size_t i = 0; i < m_problem.bodies.size(); ++i) {
        if (i >= m_start.size()) m_start.emplace_back();
        const ContactBody& body = m_problem.bodies[i];
        const bool hit = body.velocity.tail<3>() != input.state.angularVelocity[m_members[i]];
        m_start[i] = {body.velocity, hit ? Vec3(body.inertia * body.velocity.tail<3>())
                                         : angularMomentumOf(input.bodies, m_members[i], input.state)};
    }
}

// Whether no body was or is faster than `factor` times the tolerance.
bool IslandMotion::isWithin(double factor) const {
    if (m_problem.rows.empty() || !m_problem.springs.empty() || m_scale == 0) return false;
    for (std::size_t i = 0; i < m_problem.bodies.size(); ++i) {
        const ContactBody& body = m_problem.bodies[i];
        if (fastestPart(body) > factor * m_still) return false;
        if (fastestPart(m_start[i].velocity, body.gyration) > factor * m_still) return false;
    }
    return true;
}

// No force slows a ball that rests on one point and spins about its normal, because only a real contact has
// an area. Its spin is stopped once its surface is as slow as a calm body of the base path.
void IslandMotion::stopPivoting(const MotionInput& input, const Island& island) {
    const double gravity = input.gravity.norm();
    for (std::size_t i = 0; i < island.bodies.size(); ++i) {
        Vec6& velocity = m_problem.bodies[i].velocity;
        const Vec3 spin = velocity.tail<3>();
        const double radius = input.bodies.boundingRadius[island.bodies[i]];
        if (spin == Vec3::Zero() || !(velocity.head<3>().norm() <= m_still) ||
            spin.squaredNorm() * radius > calmSpeed * calmSpeed * gravity)
            continue;
        const int index = static_cast<int>(i);
        const ContactRow* only = nullptr;
        int touching = 0;
        for (const ContactRow& row : m_problem.rows) {
            if (row.a != index && row.b != index) continue;
            ++touching;
            const bool isBall = row.a == index ? row.ballA : row.ballB;
            only = isBall && row.impulse.x() > 0 ? &row : nullptr;
        }
        if (touching != 1 || only == nullptr) continue;
        const Vec3 normal = only->frame.row(0).transpose();
        if ((spin - normal.dot(spin) * normal).norm() * radius > m_still) continue;
        if (input.ledger != nullptr) recordMotion(m_problem, -1, LedgerAccount::Rest, *input.ledger);
        velocity.tail<3>().setZero();
        if (input.ledger != nullptr) recordMotion(m_problem, 1, LedgerAccount::Rest, *input.ledger);
    }
}

// A body whose speed is within the tolerance is set to rest: its forces balance as well as they are known.
void IslandMotion::settle(const MotionInput& input, const Island& island) {
    stopPivoting(input, island);
    if (!isWithin(1)) return;
    if (input.ledger != nullptr) recordMotion(m_problem, -1, LedgerAccount::Rest, *input.ledger);
    for (std::size_t i = 0; i < m_problem.bodies.size(); ++i) {
        m_problem.bodies[i].velocity.setZero();
        m_problem.bodies[i].freeVelocity.setZero();
        m_start[i].angularMomentum.setZero();
    }
}

// Finds velocities that are not finite before they are used to move bodies.
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
    if (input.ledger != nullptr) recordTurning(input, island);
}

} // namespace carom
