// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/events/event_gas.h"

#include "core/math/morton.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

// How a gas is set up, and set up anew whenever its clock is set back. Nothing of this changes what happens,
// to the bit: times are functions of the origins alone, and they depend neither on the order of the balls in
// memory nor on the cells nor on the days of the queue.

namespace carom {
namespace {

/// The clock is set back whenever 2^clockBits typical times have passed, rounded down to a power of two:
/// times stay below two of these turns, so that their rounding does not grow with the length of the run (a
/// radius is crossed to 1e-13 of it at worst), and is the same in every unit of time. A turn plans every ball
/// anew, which costs about an event a ball; it goes through some ten times as many in between.
constexpr int clockBits = 8;
/// Times are rounded to this part of a turn, a few times over: collisions that are no further apart have no
/// order. At half of it rounding decides which of two simultaneous ones comes first.
constexpr double tieRounding = 4e-15;
/// Of the typical time; later slices are fitted to what happens, so twice or half of it costs time in the
/// first ones.
constexpr double firstSlice = 0.4;

} // namespace

EventGas::EventGas(const Bodies& bodies, const State& state, const Vec3& gravity)
    : m_gravity(gravity), m_weightless(gravity.isZero(0)) {
    loadBodies(bodies, state);
    m_isComputable = areSquaresFinite();
    if (!m_isComputable) return; // crossings would all be at time 0, without end
    sortByPlace();
    makeCells();
    planAll();
    fillQueue(pendingRate(0));
}

// Times are roots of equations with squares of velocities and of gravity in them.
bool EventGas::areSquaresFinite() const {
    return std::isfinite(m_gravity.squaredNorm()) &&
           std::all_of(m_origins.begin(), m_origins.end(), [](const TrajectoryOrigin& origin) {
               return std::isfinite(origin.velocity.squaredNorm());
           });
}

void EventGas::loadBodies(const Bodies& bodies, const State& state) {
    for (const BodyIndex i : bodies.walls) {
        const Wall& wall = std::get<Wall>(bodies.shape[i]);
        m_walls.push_back({wall.normal, wall.offset, bodies.elastic[i]});
    }
    m_tally.walls.assign(m_walls.size(), 0);
    const std::size_t count = bodies.bounded.size();
    m_origins.reserve(count);
    m_placeRests.reserve(count);
    m_bodies.reserve(count);
    m_records.resize(count);
    m_order.resize(count);
    m_crossings.assign(count, {never, never, never});
    m_nextCrossings.assign(count, never);
    m_crossing.reserve(count);
    std::map<std::pair<double, double>, std::uint32_t> materials;
    double radii = 0, fastest = 0;
    bool dissipates = false;
    for (const BodyIndex i : bodies.bounded) {
        const bool mobile = bodies.mobile[i] != 0;
        const double radius = std::get<Sphere>(bodies.shape[i]).radius;
        EventRecord& record = m_records[m_origins.size()];
        m_origins.push_back({state.pose[i].position, 0, state.velocity[i], radius});
        m_placeRests.push_back(state.positionRest[i]);
        m_bodies.push_back(i);
        const Material material{bodies.inverseMass[i], bodies.elastic[i]};
        const auto [entry, isNew] = materials.try_emplace({material.inverseMass, material.elastic},
                                                          static_cast<std::uint32_t>(m_materials.size()));
        if (isNew) m_materials.push_back(material);
        record.material = entry->second;
        if (!mobile) {
            record.rest = static_cast<std::uint32_t>(m_rests.size());
            m_rests.emplace_back();
            m_allFree = false;
        }
        dissipates = dissipates || material.elastic < 1;
        radii += radius;
        fastest = std::max(fastest, state.velocity[i].norm());
    }
    if (dissipates) m_lastLosses.assign(count, -never);
    const double radius = count == 0 ? 1 : radii / static_cast<double>(count);
    const double speed = std::max(fastest, std::sqrt(m_gravity.norm() * radius));
    // [s], so that rates are finite; no call is as short (advanceTo). Twice or half changes nothing.
    constexpr double shortest = 1e-290;
    if (speed > 0) m_typicalTime = std::max(radius / speed, shortest);
    m_clockTurn = std::ldexp(1.0, std::ilogb(m_typicalTime) + clockBits);
    m_tie = tieRounding * m_clockTurn;
    m_slice = firstSlice * m_typicalTime;
}

// Balls that are near each other should be near each other in memory: order by Morton's curve. The upper half
// of a word of m_order is the place on the curve, the lower half the ball's former row.
void EventGas::sortByPlace() {
    // Of an axis: a thousand steps along the longest side. With one less, eight times as many balls share a
    // place; with 11, three of them would not fit into 32 bits.
    constexpr unsigned bits = 10;
    const Aabb region = regionOfCentres();
    const double scale = ((1U << bits) - 1) / std::max(region.size().maxCoeff(), 1e-300);
    for (std::uint32_t i = 0; i < m_origins.size(); ++i) {
        const Vec3 position = positionAt(m_origins[i], accelerationOf(i), m_now);
        m_order[i] = mortonCode((position - region.lower) * scale, bits) << 32U | i;
    }
    std::sort(m_order.begin(), m_order.end());

    // Row k comes from row m_order[k]: the cycles of this permutation, one after the other.
    constexpr std::uint64_t rowMask = 0xffffffffU;
    for (std::uint64_t& entry : m_order) entry &= rowMask;
    for (EventRecord& record : m_records)
        record.queuePrevious = nobody; // free to remember the new row of each former one
    for (std::uint32_t k = 0; k < m_order.size(); ++k)
        m_records[static_cast<std::size_t>(m_order[k])].queueNext = k;
    for (EventRecord& record : m_records)
        if (record.last != nobody && (record.last & EventRecord::wallMark) == 0)
            record.last = m_records[record.last].queueNext;
    for (const EventRecord& record : m_records)
        if (record.rest != nobody && m_rests[record.rest].ball != nobody)
            m_rests[record.rest].ball = m_records[m_rests[record.rest].ball].queueNext;
    for (std::uint32_t begin = 0; begin < m_order.size(); ++begin) {
        for (std::uint32_t to = begin;;) {
            const std::uint32_t from = static_cast<std::uint32_t>(m_order[to]);
            m_order[to] = to;
            if (from == begin) break;
            std::swap(m_origins[to], m_origins[from]);
            std::swap(m_placeRests[to], m_placeRests[from]);
            std::swap(m_records[to], m_records[from]);
            std::swap(m_bodies[to], m_bodies[from]);
            if (!m_lastLosses.empty()) std::swap(m_lastLosses[to], m_lastLosses[from]);
            to = from;
        }
    }
}

Aabb EventGas::regionOfCentres() const {
    if (m_origins.empty()) return {};
    Aabb region{m_origins[0].position, m_origins[0].position};
    for (std::uint32_t i = 0; i < m_origins.size(); ++i) {
        const Vec3 position = positionAt(m_origins[i], accelerationOf(i), m_now);
        region = united(region, {position, position});
    }
    return region;
}

void EventGas::makeCells() {
    m_cells.restart(m_records, m_origins, regionOfCentres());
    for (const BoundedWall& wall : m_walls) m_cells.addWall(wall.normal, wall.offset);
    fillCells();
}

void EventGas::fillCells() {
    m_cells.clear();
    for (std::uint32_t i = 0; i < m_origins.size(); ++i)
        m_cells.insert(m_records, i, positionAt(m_origins[i], accelerationOf(i), m_now));
}

void EventGas::planAll() {
    m_sliceEnd = m_now + m_slice;
    m_queuedCrossings = 0;
    for (std::uint32_t i = 0; i < m_origins.size(); ++i)
        if (isMobile(i)) plan(i, m_now);
}

/// How many events a second to expect: the median of the waiting times, which a burst does not disturb.
double EventGas::pendingRate(double now) const {
    std::vector<double> pending;
    for (const EventRecord& record : m_records)
        if (record.earliest() < never) pending.push_back(record.earliest() - now);
    if (pending.empty()) return 1 / m_clockTurn;
    const std::ptrdiff_t half = static_cast<std::ptrdiff_t>(pending.size() / 2);
    std::nth_element(pending.begin(), pending.begin() + half, pending.end());
    // Of the typical time: a burst at the start is no rate. At twice or half the length of a day may be off
    // by as much until it is chosen again (keepDaysFitting).
    constexpr double soonest = 0.01;
    return static_cast<double>(pending.size()) /
           std::max(pending[pending.size() / 2], soonest * m_typicalTime);
}

void EventGas::fillQueue(double eventsPerSecond) {
    // Days a turn of the clock: more would cost more to pass than their events. Twice or half changes the
    // time of runs with more events a turn only.
    constexpr double most = 1e9;
    m_daysPerSecond = std::clamp(eventsPerSecond, 1 / m_clockTurn, most / m_clockTurn);
    m_queue.restart(m_records, m_daysPerSecond, m_now);
    m_handledAtFilling = m_handled;
    m_timeOfFilling = m_now;
    for (std::uint32_t i = 0; i < m_origins.size(); ++i)
        if (isMobile(i)) m_queue.insert(m_records, i);
}

// The queue is quick while a day holds about one event. When the rate of events has changed much, the length
// of a day is chosen again: a break is over after some milliseconds, and empty days cost time, too.
void EventGas::keepDaysFitting() {
    // A day is then off by four, or sixteen, from one event. At half of these the queue is filled anew more
    // often, at twice as much its lists, or its walks over empty days, are twice as long.
    constexpr double mostEventsADay = 4, mostDaysAnEvent = 16;
    const double passed = m_now - m_timeOfFilling, days = m_daysPerSecond * passed;
    const double events = static_cast<double>(m_handled - m_handledAtFilling);
    const double balls = static_cast<double>(m_origins.size()); // filling passes over all of them
    if (events > mostEventsADay * (days + 1) || days > mostDaysAnEvent * (events + balls))
        fillQueue(events / std::max(passed, 1e-300));
}

void EventGas::setClockBack() {
    const double events = static_cast<double>(m_handled - m_handledAtTurn);
    m_handledAtTurn = m_handled;
    m_secondsPast += m_clockTurn;
    m_now -= m_clockTurn;
    for (TrajectoryOrigin& origin : m_origins) origin.time -= m_clockTurn;
    for (double& time : m_lastLosses) time -= m_clockTurn;
    sortByPlace();
    if (m_cells.areOutgrown(m_records))
        makeCells();
    else
        fillCells();
    planAll();
    fillQueue(events / m_clockTurn);
}

} // namespace carom
