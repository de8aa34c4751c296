// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/flights.h"

#include "core/math/rotation.h"

#include <algorithm>
#include <cmath>
#include <iterator>

// The course of a frame: who takes off, what is undone and done again, who lands. Who may fly is decided in
// flight_grounds.cpp, what happens on the way in flight_impacts.cpp.

namespace carom {
namespace {

/// Balls that meet somebody in a frame, for which there is room from the start.
constexpr std::size_t fewLogs = 512;

} // namespace

Flights::Flights(const Bodies& bodies)
    : m_wallAt(bodies.count(), none), m_simple(bodies.count(), 0), m_grounded(bodies.count(), 1),
      m_support(bodies.count(), 0), m_stamps(bodies.count()), m_placeRests(bodies.count(), Vec3::Zero()),
      m_log(bodies.count(), none), m_version(bodies.count(), 0), m_courses(bodies.walls.size() + 1),
      m_platforms(bodies) {
    for (const BodyIndex i : bodies.mobileBodies)
        m_simple[i] = std::holds_alternative<Sphere>(bodies.shape[i]);
    std::vector<std::uint8_t> sprung(bodies.count(), 0);
    for (const SpringForce& spring : bodies.springs)
        for (const BodyIndex end : {spring.from, spring.to})
            if (end != noBody) sprung[end] = 1;
    for (const BodyIndex i : bodies.bounded) {
        if (sprung[i] != 0) m_simple[i] = 0;
        if (m_simple[i] == 0) m_never.push_back(i);
        if (sprung[i] == 0 && !std::holds_alternative<Sphere>(bodies.shape[i])) m_bulky.push_back(i);
    }
    for (const BodyIndex w : bodies.walls) {
        const Wall& wall = std::get<Wall>(bodies.shape[w]);
        m_wallAt[w] = static_cast<std::uint32_t>(m_walls.size());
        m_walls.push_back({w, wall.normal, wall.offset});
    }
    const std::size_t logs = std::min(bodies.mobileBodies.size(), fewLogs);
    m_logs.reserve(logs);
    m_touched.reserve(logs);
    m_saved.reserve(logs);
    m_fresh.reserve(logs);
    m_again.reserve(logs);
    m_landed.reserve(logs);
    m_groundedBodies.reserve(logs);
    m_meetings.reserve(4 * logs);
}

bool Flights::plan(const FlightInput& input) {
    if (input.now == 0)
        begin(input);
    else
        proceed(input);
    restOnWalls(input);
    findClosePairs(input);
    choosePlatforms(input);
    groundNearSeeds(input);
    foreseeAll(input);
    meetAll(input);
    groundGroups();
    return covered(input);
}

// A new frame: everybody may fly.
void Flights::begin(const FlightInput& input) {
    m_courses.front().acceleration = input.gravity;
    for (std::size_t k = 0; k < m_walls.size(); ++k) {
        const Vec3& normal = m_walls[k].normal;
        m_courses[k + 1].acceleration = input.gravity - normal.dot(input.gravity) * normal;
    }
    for (const Log& log : m_logs) m_log[log.body] = none;
    m_logs.clear();
    m_touched.clear();
    m_saved.clear();
    m_meetings.clear();
    m_again.clear();
    m_landed.clear();
    m_allFresh = true;
    m_planned = input.now;
    for (const BodyIndex i : input.bodies.mobileBodies) {
        m_grounded[i] = isSimple(input, i) ? 0 : 1;
        m_support[i] = 0;
        setStamp(input.state, i, 0, input.bodies.boundingRadius[i]);
    }
    sortPairs(input.neighbours);
}

// A later substep: the balls that were grounded may take off.
void Flights::proceed(const FlightInput& input) {
    m_again.clear();
    if (m_planned == input.now)
        undo(input);
    else
        welcome(input);
    m_planned = input.now;
    m_allFresh = false;
    for (const std::uint32_t log : m_touched) m_logs[log].saved = none;
    m_touched.clear();
    m_saved.clear();
    for (const BodyIndex ball : m_landed) m_grounded[ball] = input.resting.rests(ball) ? 1 : 0;
    m_landed.clear();
    for (const BodyIndex ball : m_fresh) freshen(input, ball);
}

// Fresh are those that were grounded, but for what was laid to rest: whoever was to meet it meets nobody.
void Flights::welcome(const FlightInput& input) {
    m_fresh.clear();
    for (const BodyIndex ball : m_landed)
        if (input.resting.rests(ball))
            ++m_version[ball];
        else
            m_fresh.push_back(ball);
}

void Flights::rouse(BodyIndex body) {
    if (m_simple[body] == 0) return;
    m_grounded[body] = 1;
    m_landed.push_back(body);
}

// Everybody is back where the substep began. Those that are not fresh are to be foreseen anew.
void Flights::undo(const FlightInput& input) {
    for (const std::uint32_t log : m_touched) {
        const BodyIndex ball = m_logs[log].body;
        const Saved& saved = m_saved[m_logs[log].saved];
        m_stamps[ball] = saved.stamp;
        m_placeRests[ball] = saved.rest;
        m_support[ball] = saved.support;
        m_logs[log] = saved.log;
        ++m_version[ball];
        if (saved.log.begin != input.now) m_again.push_back(ball);
    }
}

// A new log begins: the State of a ball that was grounded is that of this moment.
void Flights::freshen(const FlightInput& input, BodyIndex ball) {
    m_grounded[ball] = 0;
    m_support[ball] = 0;
    ++m_version[ball];
    setStamp(input.state, ball, input.now, input.bodies.boundingRadius[ball]);
    logOf(input, ball) = {.body = ball,
                          .begin = input.now,
                          .turned = input.now,
                          .spin = input.state.angularVelocity[ball],
                          .orientation = input.state.pose[ball].orientation};
    touch(input, ball);
}

// Pairs of simple balls, and of a simple ball and a wall; anew after every search.
void Flights::sortPairs(const Neighbours& neighbours) {
    if (m_searches == neighbours.searches()) return;
    m_searches = neighbours.searches();
    m_wallPairs.clear();
    m_ballPairs.clear();
    for (const BodyPair pair : neighbours.pairs()) {
        const bool wallA = isWallBody(pair.a), wallB = isWallBody(pair.b);
        if (wallA || wallB) {
            const BodyIndex ball = wallA ? pair.b : pair.a;
            if (m_simple[ball] != 0) m_wallPairs.push_back({ball, m_wallAt[wallA ? pair.a : pair.b]});
        } else if (m_simple[pair.a] != 0 && m_simple[pair.b] != 0) {
            m_ballPairs.push_back(pair);
        }
    }
}

// Those a grounded body has met, or that met one of them, are grounded with it.
void Flights::groundGroups() {
    for (const std::uint32_t log : m_touched)
        if (!flies(m_logs[log].body)) m_logs[groupOf(log)].landed = true;
    for (const std::uint32_t log : m_touched)
        if (m_logs[groupOf(log)].landed) ground(m_logs[log].body);
}

std::uint32_t Flights::groupOf(std::uint32_t log) {
    while (m_logs[log].group != log) log = m_logs[log].group = m_logs[m_logs[log].group].group;
    return log;
}

bool Flights::covered(const FlightInput& input) const {
    bool all = true;
    for (const std::uint32_t each : m_touched) {
        const Log& log = m_logs[each];
        const Stamp& stamp = m_stamps[log.body];
        const double rest = input.end + (Neighbours::reachFactor - 1) * input.substep - stamp.time;
        const double path = log.path + rest * (stamp.velocity.norm() + 0.5 * rest * input.gravity.norm());
        if (flies(log.body)) all = input.neighbours.covers(log.body, path) && all;
    }
    return all;
}

void Flights::bring(const FlightInput& input) {
    m_impacts = 0;
    for (const std::uint32_t each : m_touched) {
        Log& log = m_logs[each];
        if (flies(log.body)) {
            m_impacts += static_cast<std::size_t>(log.impacts);
            continue;
        }
        const Saved& saved = m_saved[log.saved];
        m_stamps[log.body] = saved.stamp;
        m_placeRests[log.body] = saved.rest;
        m_support[log.body] = saved.support;
        log = saved.log;
    }
    for (const BodyIndex ball : m_landed) settle(input, ball, input.now);
    std::sort(m_landed.begin(), m_landed.end());
    m_groundedBodies.clear();
    std::set_union(m_landed.begin(), m_landed.end(), m_never.begin(), m_never.end(),
                   std::back_inserter(m_groundedBodies));
    std::erase_if(m_groundedBodies, [&](BodyIndex i) { return input.bodies.mobile[i] == 0; });
}

void Flights::kickPlatforms(const FlightInput& input) const {
    m_platforms.kick(input.bodies, input.state, input.ledger,
                     [this](std::uint32_t log) { return flies(m_logs[log].body); });
}

std::span<const Course> Flights::chart(const Bodies& bodies) {
    for (Course& course : m_courses) course.bodies.clear();
    for (const BodyIndex i : bodies.mobileBodies)
        if (flies(i) && m_log[i] == none) m_courses[m_support[i]].bodies.push_back(i);
    return m_courses;
}

void Flights::land(const FlightInput& input) {
    for (std::size_t i = 0; i < m_logs.size(); ++i)
        if (flies(m_logs[i].body)) settle(input, m_logs[i].body, input.end);
}

// The State of a flying ball becomes that of `time`.
void Flights::settle(const FlightInput& input, BodyIndex ball, double time) {
    Log& log = logOf(input, ball);
    if (log.begin == time) return;
    if (input.ledger != nullptr) book(input, log, time);
    const WithRest<Vec3> place = exactSum(
        m_stamps[ball].position, wayTo(m_stamps[ball], accelerationOf(ball), time) + m_placeRests[ball]);
    input.state.pose[ball].position = place.value;
    input.state.positionRest[ball] = place.rest;
    input.state.velocity[ball] = speedAt(ball, time);
    input.state.angularVelocity[ball] = log.spin;
    if (log.spin != Vec3::Zero()) {
        log.orientation = (fromRotationVector((time - log.turned) * log.spin) * log.orientation).normalized();
    }
    input.state.pose[ball].orientation = log.orientation;
    log.begin = log.turned = time;
    log.path = log.rubbed = 0;
    log.held.setZero();
}

// Friction from its impulses; along the normal, where nothing but gravity and the impacts acts, by the
// difference.
void Flights::book(const FlightInput& input, const Log& log, double time) const {
    Ledger& ledger = *input.ledger;
    const BodyIndex i = log.body;
    const State& state = input.state;
    const Vec3 velocity = speedAt(i, time), way = placeAt(i, time) - state.pose[i].position;
    const double mass = input.bodies.mass[i];
    const double gained =
        0.5 * mass * (velocity.squaredNorm() - state.velocity[i].squaredNorm()) +
        0.5 * input.bodies.inertia[i].x() * (log.spin.squaredNorm() - state.angularVelocity[i].squaredNorm());
    const double fallen = mass * input.gravity.dot(way);
    const Vec3 weight = (mass * (time - log.begin)) * input.gravity;
    LedgerEntry& fall = ledger[LedgerAccount::Gravity];
    fall.energy += fallen;
    fall.momentum += weight;
    LedgerEntry& friction = ledger[LedgerAccount::Friction];
    friction.energy += log.rubbed;
    friction.momentum += log.held;
    LedgerEntry& impacts = ledger[LedgerAccount::Restitution];
    impacts.energy += gained - fallen - log.rubbed;
    impacts.momentum += mass * (velocity - state.velocity[i]) - weight - log.held;
}

void Flights::moveTo(const FlightInput& input, BodyIndex body, double time) {
    Log& log = touch(input, body);
    Stamp& stamp = m_stamps[body];
    const Vec3& acceleration = accelerationOf(body);
    const double passed = time - stamp.time;
    log.path += passed * (stamp.velocity.norm() + 0.5 * passed * input.gravity.norm());
    moveBy(wayTo(stamp, acceleration, time), stamp.position, m_placeRests[body]);
    stamp.velocity = velocityAt(stamp, acceleration, time);
    stamp.time = time;
    ++m_version[body];
}

void Flights::setSpin(BodyIndex body, const Vec3& spin) {
    Log& log = m_logs[m_log[body]];
    const double time = m_stamps[body].time;
    log.orientation = (fromRotationVector((time - log.turned) * log.spin) * log.orientation).normalized();
    log.turned = time;
    log.spin = spin;
}

// The first log of a ball begins with the frame.
Flights::Log& Flights::logOf(const FlightInput& input, BodyIndex body) {
    if (m_log[body] == none) {
        m_log[body] = static_cast<std::uint32_t>(m_logs.size());
        m_logs.push_back({.body = body,
                          .spin = input.state.angularVelocity[body],
                          .orientation = input.state.pose[body].orientation});
    }
    return m_logs[m_log[body]];
}

// The log, which remembers how the substep began.
Flights::Log& Flights::touch(const FlightInput& input, BodyIndex body) {
    Log& log = logOf(input, body);
    if (log.saved != none) return log;
    m_saved.push_back({log, m_stamps[body], m_placeRests[body], m_support[body]});
    log.saved = static_cast<std::uint32_t>(m_saved.size() - 1);
    log.group = m_log[body];
    log.impacts = 0;
    log.landed = false;
    m_touched.push_back(m_log[body]);
    return log;
}

} // namespace carom
