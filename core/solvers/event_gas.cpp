// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/event_gas.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace carom {
namespace {

// A meeting of two balls that follows the last lossy one sooner than this share of the typical time is
// treated as elastic: otherwise three balls can collide infinitely often in finite time (S. Luding,
// S. McNamara, "How to handle the inelastic collapse of a dissipative hard-sphere gas with the TC model",
// Granular Matter 1, 1998). 1e-6: a ball moves a millionth of its radius between the two.
constexpr double shortest = 1e-6;

// If ten events a ball and a thousand more pass in less than this share of the typical time, the run has
// collapsed. Real gases take about 1.
constexpr double stalled = 1e-9;

/// A ball that bounces within this part of its radius of a wall is put right on it: the rest is rounding.
constexpr double touching = 1e-9;

} // namespace

Loss EventGas::advanceTo(double time) {
    const std::uint64_t window = 1000 + 10 * m_stamps.size();
    std::uint64_t windowEnd = m_counts.events() + window;
    double windowStart = -never;
    const auto before = [this](std::uint32_t i, std::uint32_t j) { return comesBefore(i, j); };
    keepDaysFitting();
    for (;;) {
        const double target = std::min(time - m_secondsPast, m_clockTurn);
        for (std::uint32_t i = m_queue.earliest(m_agendas, target, before); i != nobody;
             i = m_queue.earliest(m_agendas, target, before)) {
            const double happens = m_agendas[i].earliest();
            if (!std::isfinite(m_stamps[i].velocity.squaredNorm())) return {m_bodies[i], "velocity"};
            handle(i);
            if (m_counts.events() < windowEnd) continue;
            if (happens - windowStart < stalled * m_typicalTime) return {m_bodies[i], "time between events"};
            windowStart = happens;
            windowEnd = m_counts.events() + window;
            m_now = happens;
            keepDaysFitting();
        }
        m_now = target;
        if (target < m_clockTurn) return {};
        setClockBack();
        windowStart -= m_clockTurn;
    }
}

void EventGas::handle(std::uint32_t i) {
    Agenda& agenda = m_agendas[i];
    m_queue.remove(m_agendas, i);
    if (!agenda.meetsNext()) {
        if (agenda.other < Agenda::firstWall) return crossCell(i);
        return bounce(i, static_cast<std::uint16_t>(agenda.other - Agenda::firstWall), agenda.otherTime);
    }
    if (m_agendas[agenda.partner].changes == agenda.partnerChanges)
        return collide(i, agenda.partner, agenda.pairTime);
    ++m_counts.stale;
    planPairs(i);
    m_queue.insert(m_agendas, i);
}

void EventGas::collide(std::uint32_t i, std::uint32_t j, double time) {
    if (isCrowded(i, j, time)) return meetAtOnce(i, j, time);
    m_queue.remove(m_agendas, j);
    restamp(i, time);
    restamp(j, time);
    strike(i, j, time);
    finishStrike(i);
    finishStrike(j);
}

/// The restitution of two balls that collide at `time`; notes that they lose energy then.
double EventGas::restitutionAt(std::uint32_t i, std::uint32_t j, double time) {
    const double e =
        std::min(m_materials[m_agendas[i].material].elastic, m_materials[m_agendas[j].material].elastic);
    if (!(e < 1)) return e;
    const double since = time - std::max(m_lastLosses[i], m_lastLosses[j]);
    m_lastLosses[i] = time;
    m_lastLosses[j] = time;
    return since < shortest * m_typicalTime ? 1 : e;
}

/// One collision of two balls whose stamps are of now.
void EventGas::strike(std::uint32_t i, std::uint32_t j, double time) {
    ++m_counts.collisions;
    const Stamp &a = m_stamps[i], &b = m_stamps[j];
    const Vec3 normal = (b.position - a.position).normalized();
    const double approach = normal.dot(b.velocity - a.velocity);
    if (approach < 0) {
        const double e = restitutionAt(i, j, time);
        push(i, j, normal, -(1 + e) * approach / (inverseMassOf(i) + inverseMassOf(j)));
    }
    m_agendas[i].last = j;
    m_agendas[j].last = i;
}

void EventGas::push(std::uint32_t i, std::uint32_t j, const Vec3& normal, double impulse) {
    Stamp &a = m_stamps[i], &b = m_stamps[j];
    a.velocity -= (impulse * inverseMassOf(i)) * normal;
    b.velocity += (impulse * inverseMassOf(j)) * normal;
    const Vec3 middle = 0.5 * (a.position + b.position);
    if (!contains(m_watched, {middle, middle})) return;
    ++m_tally.collisions;
    m_tally.virial += impulse * (b.position - a.position).norm();
}

void EventGas::finishStrike(std::uint32_t i) {
    if (!isFree(i) && isMobile(i)) settle(i, Rest(m_rests[m_agendas[i].rest]));
    plan(i);
}

void EventGas::bounce(std::uint32_t i, std::uint16_t index, double time) {
    ++m_counts.bounces;
    const BoundedWall& wall = m_walls[index];
    Stamp& stamp = m_stamps[i];
    const Material& material = m_materials[m_agendas[i].material];
    const double pull = wall.normal.dot(accelerationOf(i));
    const double landing = speedAtPlane(gapOnTheWay(i, index), wall.normal.dot(stamp.velocity), pull);
    restamp(i, time);
    const double gap = gapTo(wall, i);
    if (std::abs(gap) <= touching * stamp.radius) moveBy(-gap * wall.normal, stamp.position, m_placeRests[i]);
    const double e = std::min(material.elastic, wall.elastic);
    const double after = e * landing;
    const bool rests = restsAfter(after, pull, e, stamp.radius);
    const double change = (rests ? 0 : after) - wall.normal.dot(stamp.velocity);
    stamp.velocity += change * wall.normal;
    note(wall, stamp, change / material.inverseMass);
    if (rests)
        restOn(i, index);
    else if (!isFree(i))
        settle(i, Rest(m_rests[m_agendas[i].rest]));
    m_agendas[i].last = Agenda::wallMark | index;
    plan(i);
}

/// The gap that a flight to a wall begins with. A ball that has just bounced there touches it: 0, not what
/// rounding left.
double EventGas::gapOnTheWay(std::uint32_t i, std::uint16_t wall) const {
    return m_agendas[i].last == (Agenda::wallMark | wall) ? 0 : gapTo(m_walls[wall], i);
}

void EventGas::note(const BoundedWall& wall, const Stamp& stamp, double impulse) {
    Eigen::Index facing = 0;
    wall.normal.cwiseAbs().maxCoeff(&facing);
    Vec3 place = stamp.position;
    place[facing] = m_watched.lower[facing];
    if (contains(m_watched, {place, place}))
        m_tally.walls[static_cast<std::size_t>(&wall - m_walls.data())] += impulse;
}

void EventGas::crossCell(std::uint32_t i) {
    ++m_counts.crossings;
    const Agenda& agenda = m_agendas[i];
    const int axis = agenda.other / 2, direction = agenda.other % 2 == 1 ? 1 : -1;
    m_cells.cross(m_agendas, i, axis, direction);
    m_cells.newlyAround(m_agendas, i, axis, direction, [&](std::uint32_t j) { considerPair(i, j); });
    planOther(i, agenda.otherTime);
    m_queue.insert(m_agendas, i);
}

/// Carries the ball's stamp to `time`; whatever was found out about it before is off.
void EventGas::restamp(std::uint32_t i, double time) {
    Stamp& stamp = m_stamps[i];
    const Vec3& acceleration = accelerationOf(i);
    moveBy(wayTo(stamp, acceleration, time), stamp.position, m_placeRests[i]);
    stamp.velocity = velocityAt(stamp, acceleration, time);
    stamp.time = time;
    ++m_agendas[i].changes;
}

void EventGas::plan(std::uint32_t i) {
    if (!isMobile(i)) return;
    planPairs(i);
    planOther(i, m_stamps[i].time);
    m_queue.insert(m_agendas, i);
}

void EventGas::planPairs(std::uint32_t i) {
    m_agendas[i].pairTime = never;
    m_agendas[i].partner = nobody;
    m_agendas[i].tied = 0;
    m_cells.aroundBall(m_agendas, i, [&](std::uint32_t j) { considerPair(i, j); });
}

// Two balls that have just collided and that nothing has happened to since fly apart for ever, as long as
// gravity bends both paths alike; rounding must not make them collide again.
inline void EventGas::considerPair(std::uint32_t i, std::uint32_t j) {
    ++m_counts.tested;
    Agenda& agenda = m_agendas[i];
    const bool free = m_unusedRests.size() == m_rests.size() || (isFree(i) && isFree(j));
    const Vec3& acceleration = free ? m_gravity : accelerationOf(i);
    const bool alike = free || acceleration == accelerationOf(j);
    const double time = alike ? pairTime(m_stamps[i], m_stamps[j], acceleration)
                              : pairTime(m_stamps[i], acceleration, m_stamps[j], accelerationOf(j));
    if (!(time <= agenda.pairTime + m_tie) || time == never) return;
    if (alike && agenda.last == j && m_agendas[j].last == i) return;
    agenda.tied = agenda.pairTime - time <= m_tie ? 1 : 0;
    if (!(time <= agenda.pairTime)) return;
    if (time == agenda.pairTime && !pairBefore(i, j, i, agenda.partner)) return;
    agenda.pairTime = time;
    agenda.partner = j;
    agenda.partnerChanges = m_agendas[j].changes;
}

// Borders are seen from `now`, not from the stamp: the stamp may lie cells away, on the other side of one.
// Crossings need not be the same to the bit, because no motion depends on them. Walls are.
void EventGas::planOther(std::uint32_t i, double now) {
    Agenda& agenda = m_agendas[i];
    const Vec3& acceleration = accelerationOf(i);
    const EventCells::Surroundings cell = m_cells.surroundingsOf(agenda);
    const Vec3 above = positionAt(m_stamps[i], acceleration, now) - cell.lower;
    const Vec3 velocity = velocityAt(m_stamps[i], acceleration, now);
    // Without an acceleration along an axis the ball leaves by the border its velocity points to. No branch
    // depends on the velocity: that would be a coin's toss to the processor.
    std::array<double, 3> times;
    std::array<unsigned, 3> upwards;
    for (int axis = 0; axis < 3; ++axis) {
        constexpr double least = 1e-300; // of a gap [m], so that no speed at all means never
        const std::size_t k = static_cast<std::size_t>(axis);
        const double v = velocity[axis], half = 0.5 * cell.side;
        times[k] = std::max(half + std::copysign(1.0, v) * (half - above[axis]), least) / std::abs(v);
        upwards[k] = v > 0 ? 1 : 0;
    }
    if (!m_weightless || !isFree(i))
        for (int axis = 0; axis < 3; ++axis) {
            const double v = velocity[axis], a = acceleration[axis];
            if (a == 0) continue;
            const std::size_t k = static_cast<std::size_t>(axis);
            const double down = timeToPlane(above[axis], v, a);
            const double up = timeToPlane(cell.side - above[axis], -v, -a);
            upwards[k] = up < down ? 1 : 0;
            times[k] = std::min(up, down);
        }
    if (cell.isRepeated)
        for (int axis = 0; axis < 3; ++axis)
            if (EventCells::isOutermost(agenda, axis)) times[static_cast<std::size_t>(axis)] = never;
    const std::size_t first = times[1] < times[0] ? 1 : 0;
    const std::size_t axis = times[2] < times[first] ? 2 : first;
    agenda.otherTime = now + times[axis];
    agenda.other = static_cast<std::uint16_t>(2 * axis + upwards[axis]);
    for (unsigned near = cell.wallsNear; near != 0; near &= near - 1) {
        const unsigned k = static_cast<unsigned>(std::countr_zero(near));
        if (k + 1 < EventCells::wallBits) {
            if (k < m_walls.size()) considerWall(i, k);
            continue;
        }
        for (std::size_t rest = k; rest < m_walls.size(); ++rest) considerWall(i, rest);
    }
}

void EventGas::considerWall(std::uint32_t i, std::size_t k) {
    Agenda& agenda = m_agendas[i];
    const Stamp& stamp = m_stamps[i];
    const BoundedWall& wall = m_walls[k];
    const std::uint16_t number = static_cast<std::uint16_t>(k);
    if (!isFree(i))
        for (const std::uint16_t support : m_rests[agenda.rest].on())
            if (support == number) return;
    const double time = stamp.time + timeToPlane(gapOnTheWay(i, number), wall.normal.dot(stamp.velocity),
                                                 wall.normal.dot(accelerationOf(i)));
    if (time < agenda.otherTime) {
        agenda.otherTime = time;
        agenda.other = static_cast<std::uint16_t>(Agenda::firstWall + k);
    }
}

// At equal times: crossings, then walls, then pairs, and pairs that do not touch each other by the places of
// their stamps (those that do: event_moments.cpp). Numbers and cells have no say, so neither the order of the
// text nor the size of the cells changes what happens.
bool EventGas::comesBefore(std::uint32_t i, std::uint32_t j) const {
    const Agenda& a = m_agendas[i];
    const Agenda& b = m_agendas[j];
    if (a.meetsNext() != b.meetsNext()) return b.meetsNext();
    if (a.meetsNext()) return pairBefore(i, a.partner, j, b.partner);
    const bool crosses = a.other < Agenda::firstWall;
    if (crosses != (b.other < Agenda::firstWall)) return crosses;
    return i < j;
}

bool EventGas::pairBefore(std::uint32_t i, std::uint32_t a, std::uint32_t j, std::uint32_t b) const {
    using Places = std::array<std::array<double, 3>, 2>;
    const auto placesOf = [this](std::uint32_t p, std::uint32_t q) {
        const Vec3& x = m_stamps[p].position;
        const Vec3& y = m_stamps[q].position;
        Places places{{{x.x(), x.y(), x.z()}, {y.x(), y.y(), y.z()}}};
        std::sort(places.begin(), places.end());
        return places;
    };
    return placesOf(i, a) < placesOf(j, b);
}

/// After a blow to a ball that rested: which of its walls does it still rest on, which does it leave?
void EventGas::settle(std::uint32_t i, const Rest& before) {
    Stamp& stamp = m_stamps[i];
    const Material& material = m_materials[m_agendas[i].material];
    release(i);
    for (const std::uint16_t index : before.on()) {
        const BoundedWall& wall = m_walls[index];
        const double speed = wall.normal.dot(stamp.velocity);
        const double e = std::min(material.elastic, wall.elastic);
        const double after = speed < 0 ? -e * speed : speed;
        const bool rests = restsAfter(after, wall.normal.dot(m_gravity), e, stamp.radius);
        const double change = (rests ? 0 : after) - speed;
        stamp.velocity += change * wall.normal;
        note(wall, stamp, change / material.inverseMass);
        if (rests) restOn(i, index);
    }
}

void EventGas::restOn(std::uint32_t i, std::uint16_t wall) {
    std::uint32_t& index = m_agendas[i].rest;
    if (index == nobody) {
        if (m_unusedRests.empty()) {
            m_unusedRests.push_back(static_cast<std::uint32_t>(m_rests.size()));
            m_rests.emplace_back();
        }
        index = m_unusedRests.back();
        m_unusedRests.pop_back();
        m_rests[index] = {};
    }
    Rest& rest = m_rests[index];
    if (rest.count < Rest::mostWalls) rest.walls[rest.count++] = wall;
    std::array<Vec3, Rest::mostWalls> normals;
    for (std::uint8_t k = 0; k < rest.count; ++k) normals[k] = m_walls[rest.walls[k]].normal;
    rest.acceleration = supportedAcceleration(m_gravity, {normals.data(), rest.count});
}

void EventGas::release(std::uint32_t i) {
    m_unusedRests.push_back(m_agendas[i].rest);
    m_agendas[i].rest = nobody;
}

void EventGas::write(State& state) const {
    for (std::uint32_t i = 0; i < m_stamps.size(); ++i) {
        if (!isMobile(i)) continue;
        const Vec3& acceleration = accelerationOf(i);
        const WithRest<Vec3> place =
            exactSum(m_stamps[i].position, wayTo(m_stamps[i], acceleration, m_now) + m_placeRests[i]);
        state.pose[m_bodies[i]].position = place.value;
        state.positionRest[m_bodies[i]] = place.rest;
        state.velocity[m_bodies[i]] = velocityAt(m_stamps[i], acceleration, m_now);
    }
}

std::size_t EventGas::memoryBytes() const {
    return m_stamps.capacity() * sizeof(Stamp) + m_placeRests.capacity() * sizeof(Vec3) +
           m_agendas.capacity() * sizeof(Agenda) + m_bodies.capacity() * sizeof(BodyIndex) +
           m_materials.capacity() * sizeof(Material) + m_rests.capacity() * sizeof(Rest) +
           (m_lastLosses.capacity() + m_order.capacity()) * sizeof(double) + m_cells.memoryBytes() +
           m_queue.memoryBytes();
}

} // namespace carom
