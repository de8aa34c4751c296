// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/events/event_gas.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace carom {
namespace {

// A collision of two balls that follows the last lossy one sooner than this share of the typical time is
// treated as elastic: otherwise three balls can collide infinitely often in finite time (S. Luding, S.
// McNamara, "How to handle the inelastic collapse of a dissipative hard-sphere gas with the TC model",
// Granular Matter 1, 1998). 1e-6: a ball moves a millionth of its radius between the two. At a thousandth,
// collapses take more events before they end; at a thousand times, dense gases lose less energy than they
// should.
constexpr double shortest = 1e-6;

// If ten events a ball and a thousand more pass in less than this share of the typical time, the run has
// collapsed. Gases take about 1, collapses reach 0 within some rounds: a thousand times more or less changes
// nothing.
constexpr double stalled = 1e-9;

/// Typical times in one call at most: radii that the fastest ball moves. Beyond, its place is rounded to
/// more than a ten-thousandth of its radius, twice as far to twice as much.
constexpr double farthest = 1e12;

// Cells that one call may take balls through: so many, and so many more for each ball and each event at which
// a velocity changes. A cell takes some 70 ns, so a frame in which nothing meets ends within half a second. A
// gas passes five cells a collision, and one ball alone may move fifty thousand kilometres a second with a
// radius of half a metre in frames of 1/60 s.
constexpr std::uint64_t mostCells = 5'000'000, cellsPerEvent = 1000;
/// What setting back the clock takes, which makes the cells anew, besides a cell for each ball. At half of it
/// a frame of one ball that is so fast takes up to twice as long before the run stops.
constexpr std::uint64_t cellsPerTurn = 100;

/// A ball that bounces within this part of its radius of a wall is put right on it: the rest is rounding,
/// which is at most a few 1e-13 of it (clockBits). At a thousandth of this some of it would be left, and add
/// up from bounce to bounce.
constexpr double touching = 1e-9;

} // namespace

Loss EventGas::advanceTo(double time, std::uint64_t mostEvents) {
    if (!m_isComputable || !(time - m_secondsPast - m_now <= farthest * m_typicalTime)) return fastest();
    const std::uint64_t window = 1000 + 10 * m_origins.size();
    std::uint64_t windowEnd = m_handled + window;
    double windowStart = -never;
    const std::uint64_t from = m_handled + m_lookedAt;
    const EventCounts atStart = m_counts;
    std::uint64_t turns = 0; // of the clock, in cells
    const auto isTooFar = [&] {
        const std::uint64_t changes =
            m_counts.collisions + m_counts.bounces - atStart.collisions - atStart.bounces;
        return m_counts.crossings - atStart.crossings + turns >
               mostCells + cellsPerEvent * (m_origins.size() + changes);
    };
    keepDaysFitting();
    for (;;) {
        const double target = std::min(time - m_secondsPast, m_clockTurn);
        const double limit = std::min(target, m_sliceEnd);
        for (std::uint32_t i = earliest(limit); i != nobody; i = earliest(limit)) {
            const double happens = m_records[i].earliest();
            if (!std::isfinite(m_origins[i].velocity.squaredNorm())) return {m_bodies[i], "velocity"};
            handle(i);
            if (m_isWedged || m_handled + m_lookedAt - from > mostEvents)
                return {m_bodies[i], "rate of events"};
            if (m_handled < windowEnd) continue;
            if (happens - windowStart < stalled * m_typicalTime) return {m_bodies[i], "rate of events"};
            if (isTooFar()) return fastest();
            windowStart = happens;
            windowEnd = m_handled + window;
            m_now = happens;
            keepDaysFitting();
        }
        m_now = limit;
        if (isTooFar()) return fastest();
        if (m_sliceEnd < target) {
            beginSlice();
            if (m_handled + m_lookedAt - from > mostEvents) return fastest();
        } else if (target < m_clockTurn) {
            return {};
        } else {
            setClockBack();
            windowStart -= m_clockTurn;
            turns += m_origins.size() + cellsPerTurn;
        }
    }
}

Loss EventGas::fastest() const {
    std::size_t first = 0;
    const auto speed = [this](std::size_t i) { return m_origins[i].velocity.cwiseAbs().maxCoeff(); };
    for (std::size_t i = 0; i < m_origins.size(); ++i)
        if (speed(i) > speed(first)) first = i;
    return m_origins.empty() ? Loss{} : Loss{m_bodies[first], "velocity"};
}

std::uint32_t EventGas::earliest(double limit) {
    return m_queue.earliest(
        m_records, limit,
        [this](std::uint32_t i, std::uint32_t j) {
            return pairBefore(i, m_records[i].partner, j, m_records[j].partner);
        },
        [this](std::uint32_t i, bool soon) {
            if (!soon) {
                __builtin_prefetch(&m_records[i]);
                __builtin_prefetch(&m_origins[i]);
                return;
            }
            const EventRecord& record = m_records[i];
            m_cells.prefetch(record);
            if (!record.collidesNext()) return;
            __builtin_prefetch(&m_records[record.partner]);
            __builtin_prefetch(&m_origins[record.partner]);
        });
}

void EventGas::handle(std::uint32_t i) {
    EventRecord& record = m_records[i];
    ++m_handled;
    m_queue.remove(m_records, i);
    if (!record.collidesNext()) {
        if (record.other == EventRecord::crossing) return crossCell(i);
        return bounce(i, record.other, record.otherTime);
    }
    if (m_records[record.partner].changes == record.partnerChanges)
        return collide(i, record.partner, record.pairTime);
    ++m_counts.stale;
    planPairs(i);
    m_queue.insert(m_records, i);
}

void EventGas::collide(std::uint32_t i, std::uint32_t j, double time) {
    if (isInCluster(i, j, time)) return collideCluster(i, j, time);
    m_queue.remove(m_records, j);
    moveOrigin(i, time);
    moveOrigin(j, time);
    collidePair(i, j, time);
    finishCollision(i);
    finishCollision(j);
}

/// The restitution of two balls that collide at `time`; notes that they lose energy then.
double EventGas::restitutionAt(std::uint32_t i, std::uint32_t j, double time) {
    const double e = pairRestitution(m_materials[m_records[i].material].elastic,
                                     m_materials[m_records[j].material].elastic);
    if (!(e < 1)) return e;
    const double since = time - std::max(m_lastLosses[i], m_lastLosses[j]);
    m_lastLosses[i] = time;
    m_lastLosses[j] = time;
    return since < shortest * m_typicalTime ? 1 : e;
}

/// At which speed two balls that collide at `time` separate [m/s].
double EventGas::separationSpeedAt(const Touch& touch, double time) {
    const double e = restitutionAt(touch.a, touch.b, time);
    const double pull = m_allFree ? 0 : touch.normal.dot(accelerationOf(touch.b) - accelerationOf(touch.a));
    return separationSpeed(e * touch.closing, pull, e,
                           std::min(m_origins[touch.a].radius, m_origins[touch.b].radius));
}

/// One collision of two balls whose origins are of now.
void EventGas::collidePair(std::uint32_t i, std::uint32_t j, double time) {
    ++m_counts.collisions;
    const TrajectoryOrigin &a = m_origins[i], &b = m_origins[j];
    const Vec3 normal = (b.position - a.position).normalized();
    const double approach = normal.dot(b.velocity - a.velocity);
    if (comesToRestOn(i, j, -normal, -approach) || comesToRestOn(j, i, normal, -approach)) {
        // No impulse acts on either: the support of the lower ball takes it.
    } else if (approach <= 0) {
        const double separation = separationSpeedAt({i, j, -approach, normal}, time);
        push(i, j, normal, (separation - approach) / (inverseMassOf(i) + inverseMassOf(j)));
    }
    m_records[i].last = j;
    m_records[j].last = i;
}

/// Whether ball i, which closes on j, stands still on top of it from now on. The normal points from j to i.
bool EventGas::comesToRestOn(std::uint32_t i, std::uint32_t j, const Vec3& normal, double closing) {
    if (m_weightless || !isStill(j) || !isFree(i) || closing < 0) return false;
    const double radius = std::min(m_origins[i].radius, m_origins[j].radius);
    if (!isBalanced(m_gravity, normal, m_origins[i].velocity, radius)) return false;
    const double e = pairRestitution(m_materials[m_records[i].material].elastic,
                                     m_materials[m_records[j].material].elastic);
    if (closing > leastHop(normal.dot(m_gravity), e, radius)) return false;
    m_origins[i].velocity = Vec3::Zero();
    newRest(i).ball = j;
    ++m_standing;
    return true;
}

void EventGas::push(std::uint32_t i, std::uint32_t j, const Vec3& normal, double impulse) {
    TrajectoryOrigin &a = m_origins[i], &b = m_origins[j];
    a.velocity -= (impulse * inverseMassOf(i)) * normal;
    b.velocity += (impulse * inverseMassOf(j)) * normal;
    const Vec3 middle = 0.5 * (a.position + b.position);
    if (!contains(m_watched, {middle, middle})) return;
    ++m_tally.collisions;
    m_tally.virial += impulse * (b.position - a.position).norm();
}

void EventGas::finishCollision(std::uint32_t i) {
    if (!isMobile(i)) return;
    if (!isFree(i) && !isStill(i)) {
        settle(i, Rest(m_rests[m_records[i].rest]));
        releaseWhatStandsOn(i, m_origins[i].time);
    }
    plan(i, m_origins[i].time);
    m_queue.insert(m_records, i);
}

void EventGas::bounce(std::uint32_t i, std::uint16_t index, double time) {
    ++m_counts.bounces;
    const BoundedWall& wall = m_walls[index];
    TrajectoryOrigin& origin = m_origins[i];
    const Material& material = m_materials[m_records[i].material];
    const double pull = wall.normal.dot(accelerationOf(i));
    const double impactSpeed = speedAtPlane(gapOnTheWay(i, index), wall.normal.dot(origin.velocity), pull);
    moveOrigin(i, time);
    const double gap = gapTo(wall, i);
    if (std::abs(gap) <= touching * origin.radius)
        moveBy(-gap * wall.normal, origin.position, m_placeRests[i]);
    const double e = pairRestitution(material.elastic, wall.elastic);
    const double after = e * impactSpeed;
    const bool rests = restsAfter(after, pull, e, origin.radius);
    const double change = (rests ? 0 : after) - wall.normal.dot(origin.velocity);
    origin.velocity += change * wall.normal;
    note(wall, origin, change / material.inverseMass);
    if (rests) {
        restOn(i, index);
        findWedged(i);
    } else if (!isFree(i))
        settle(i, Rest(m_rests[m_records[i].rest]));
    m_records[i].last = EventRecord::wallMark | index;
    plan(i, time);
    m_queue.insert(m_records, i);
}

/// The gap to a wall at the ball's origin. A ball that has just bounced there touches it: 0, not what
/// rounding left.
double EventGas::gapOnTheWay(std::uint32_t i, std::uint16_t wall) const {
    return m_records[i].last == (EventRecord::wallMark | wall) ? 0 : gapTo(m_walls[wall], i);
}

void EventGas::note(const BoundedWall& wall, const TrajectoryOrigin& origin, double impulse) {
    Eigen::Index facing = 0;
    wall.normal.cwiseAbs().maxCoeff(&facing);
    Vec3 place = origin.position;
    place[facing] = m_watched.lower[facing];
    if (contains(m_watched, {place, place}))
        m_tally.walls[static_cast<std::size_t>(&wall - m_walls.data())] += impulse;
}

/// Moves the ball's trajectory origin to `time`; its predictions are void.
void EventGas::moveOrigin(std::uint32_t i, double time) {
    TrajectoryOrigin& origin = m_origins[i];
    const Vec3& acceleration = accelerationOf(i);
    moveBy(wayTo(origin, acceleration, time), origin.position, m_placeRests[i]);
    origin.velocity = velocityAt(origin, acceleration, time);
    origin.time = time;
    ++m_records[i].changes;
}

/// Predicts the next events of a ball that has a new origin or was put into a cell at `now`; it is not queued
/// yet.
void EventGas::plan(std::uint32_t i, double now) {
    planCrossings(i, now);
    crossEarly(i, now);
    planPairs(i);
    planWalls(i);
    if (m_nextCrossings[i] < m_sliceEnd) queueCrossing(i);
}

void EventGas::planPairs(std::uint32_t i) {
    m_records[i].pairTime = never;
    m_records[i].partner = nobody;
    m_records[i].tied = 0;
    m_cells.aroundBall(m_records, i, [&](std::uint32_t j) { considerPair(i, j); });
}

/// A predicted collision.
void EventGas::noteCollision(std::uint32_t i, std::uint32_t j, double time) {
    EventRecord& record = m_records[i];
    record.tied = record.pairTime - time <= m_tie ? 1 : 0;
    if (!(time <= record.pairTime)) return;
    if (time == record.pairTime && !pairBefore(i, j, i, record.partner)) return;
    record.pairTime = time;
    record.partner = j;
    record.partnerChanges = m_records[j].changes;
}

void EventGas::planWalls(std::uint32_t i) {
    m_records[i].otherTime = never;
    m_records[i].other = EventRecord::crossing;
    considerWalls(i, m_cells.wallsNear(m_records[i]));
}

void EventGas::considerWalls(std::uint32_t i, unsigned near) {
    for (; near != 0; near &= near - 1) {
        const unsigned k = static_cast<unsigned>(std::countr_zero(near));
        if (k + 1 < EventCells::wallBits) {
            if (k < m_walls.size()) considerWall(i, k);
            continue;
        }
        for (std::size_t rest = k; rest < m_walls.size(); ++rest) considerWall(i, rest);
    }
}

void EventGas::considerWall(std::uint32_t i, std::size_t k) {
    EventRecord& record = m_records[i];
    const TrajectoryOrigin& origin = m_origins[i];
    const BoundedWall& wall = m_walls[k];
    const std::uint16_t number = static_cast<std::uint16_t>(k);
    if (!isFree(i))
        for (const std::uint16_t support : m_rests[record.rest].on())
            if (support == number) return;
    const double time = origin.time + timeToPlane(gapOnTheWay(i, number), wall.normal.dot(origin.velocity),
                                                  wall.normal.dot(accelerationOf(i)));
    if (time < record.otherTime) {
        record.otherTime = time;
        record.other = number;
    }
}

// Of pairs at equal times that do not touch each other, by the places of their origins (those that do:
// event_clusters.cpp). Numbers and cells do not count, so neither the order of the text nor the size of the
// cells changes the motion.
bool EventGas::pairBefore(std::uint32_t i, std::uint32_t a, std::uint32_t j, std::uint32_t b) const {
    using Places = std::array<std::array<double, 3>, 2>;
    const auto placesOf = [this](std::uint32_t p, std::uint32_t q) {
        const Vec3& x = m_origins[p].position;
        const Vec3& y = m_origins[q].position;
        Places places{{{x.x(), x.y(), x.z()}, {y.x(), y.y(), y.z()}}};
        std::sort(places.begin(), places.end());
        return places;
    };
    return placesOf(i, a) < placesOf(j, b);
}

/// After an impact on a ball at rest: which of its walls does it still rest on, which does it leave?
void EventGas::settle(std::uint32_t i, const Rest& before) {
    TrajectoryOrigin& origin = m_origins[i];
    const Material& material = m_materials[m_records[i].material];
    release(i);
    for (const std::uint16_t index : before.on()) {
        const BoundedWall& wall = m_walls[index];
        const double speed = wall.normal.dot(origin.velocity);
        const double e = pairRestitution(material.elastic, wall.elastic);
        const double after = speed < 0 ? -e * speed : speed;
        const double pull = wall.normal.dot(m_gravity);
        const bool rests = restsAfter(after, pull, e, origin.radius) ||
                           (pull < 0 && after <= leastHop(pull, e, origin.radius));
        const double change = (rests ? 0 : after) - speed;
        origin.velocity += change * wall.normal;
        note(wall, origin, change / material.inverseMass);
        if (change != 0)
            m_records[i].last = EventRecord::wallMark | index; // and it may collide again with what hit it
        if (rests) restOn(i, index);
    }
    findWedged(i);
}

/// Walls on which a ball rests are not looked at any more. What one of them does to it may push it into
/// another: that has no end where they face each other.
void EventGas::findWedged(std::uint32_t i) {
    if (isFree(i)) return;
    constexpr double rounding = 1e-9; // of its speed: a thousandth of a radius after a million radii
    const Vec3& velocity = m_origins[i].velocity;
    for (const std::uint16_t index : m_rests[m_records[i].rest].on())
        m_isWedged = m_isWedged || m_walls[index].normal.dot(velocity) < -rounding * velocity.norm();
}

/// Of a ball that moved freely.
Rest& EventGas::newRest(std::uint32_t i) {
    if (m_unusedRests.empty()) {
        m_unusedRests.push_back(static_cast<std::uint32_t>(m_rests.size()));
        m_rests.emplace_back();
    }
    m_records[i].rest = m_unusedRests.back();
    m_unusedRests.pop_back();
    m_allFree = false;
    return m_rests[m_records[i].rest] = {};
}

void EventGas::restOn(std::uint32_t i, std::uint16_t wall) {
    Rest& rest = isFree(i) ? newRest(i) : m_rests[m_records[i].rest];
    if (rest.count < Rest::mostWalls) rest.walls[rest.count++] = wall;
    std::array<Vec3, Rest::mostWalls> normals;
    for (std::uint8_t k = 0; k < rest.count; ++k) normals[k] = m_walls[rest.walls[k]].normal;
    rest.acceleration = supportedAcceleration(m_gravity, {normals.data(), rest.count});
}

/// Balls that stand on one that is no longer at rest, and on those, fall freely from now on; if one touches a
/// ball that comes back, that is its next event.
void EventGas::releaseWhatStandsOn(std::uint32_t support, double time) {
    if (m_standing == 0) return;
    m_released.assign(1, support);
    for (std::size_t below = 0; below < m_released.size(); ++below)
        m_cells.aroundBall(m_records, m_released[below], [&](std::uint32_t i) {
            if (!isFree(i) && m_rests[m_records[i].rest].ball == m_released[below]) m_released.push_back(i);
        });
    for (std::size_t k = 1; k < m_released.size(); ++k) {
        const std::uint32_t i = m_released[k];
        moveOrigin(i, time);
        release(i);
    }
    for (std::size_t k = 1; k < m_released.size(); ++k) {
        m_queue.remove(m_records, m_released[k]);
        plan(m_released[k], time);
        m_queue.insert(m_records, m_released[k]);
    }
}

void EventGas::release(std::uint32_t i) {
    if (m_rests[m_records[i].rest].ball != nobody) --m_standing;
    m_unusedRests.push_back(m_records[i].rest);
    m_records[i].rest = nobody;
    m_allFree = m_unusedRests.size() == m_rests.size();
}

void EventGas::write(State& state) const {
    for (std::uint32_t i = 0; i < m_origins.size(); ++i) {
        if (!isMobile(i)) continue;
        const TrajectoryOrigin& origin = m_origins[i];
        const Vec3& acceleration = accelerationOf(i);
        const double passed = m_now - origin.time;
        const BodyIndex body = m_bodies[i];
        Vec3 &place = state.pose[body].position, &rest = state.positionRest[body];
        Vec3& velocity = state.velocity[body];
        for (int axis = 0; axis < 3; ++axis) {
            const double way = passed * (origin.velocity[axis] + (0.5 * passed) * acceleration[axis]) +
                               m_placeRests[i][axis];
            const WithRest<double> sum = exactSum(origin.position[axis], way);
            place[axis] = sum.value;
            rest[axis] = sum.rest;
            velocity[axis] = origin.velocity[axis] + passed * acceleration[axis];
        }
    }
}

std::size_t EventGas::bytes() const {
    return heldBytes(m_origins, m_placeRests, m_records, m_bodies, m_materials, m_rests, m_unusedRests,
                     m_released, m_lastLosses, m_walls, m_cluster, m_touches, m_group, m_order, m_crossings,
                     m_nextCrossings, m_crossing, m_cells, m_queue);
}

} // namespace carom
