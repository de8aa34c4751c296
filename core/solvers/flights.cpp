// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/flights.h"

#include "core/math/rotation.h"
#include "core/solvers/contact_settings.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

double radiusSum(const Stamp& a, const Stamp& b) { return a.radius + b.radius; }

/// Overlap or gap up to which two balls touch, as |D|² − R² = (|D| − R)(|D| + R) [m²].
double touchingSquare(const Stamp& a, const Stamp& b) {
    return 2 * touchingGap * std::min(a.radius, b.radius) * radiusSum(a, b);
}

/// Whether two balls under one acceleration may touch within h; never false if they do.
bool mayMeet(double c, double b, double u2, double h) {
    if (b >= 0) return false; // they part
    const bool closest = -b < u2 * h;
    return closest ? b * b >= u2 * c : c + h * (2 * b + u2 * h) <= 0;
}

} // namespace

Flights::Flights(const Bodies& bodies)
    : m_wallAt(bodies.count(), noWall), m_simple(bodies.count(), 0), m_grounded(bodies.count(), 1),
      m_support(bodies.count(), 0), m_stamps(bodies.count()), m_log(bodies.count(), noLog),
      m_courses(bodies.walls.size() + 1) {
    for (const BodyIndex i : bodies.mobileBodies)
        m_simple[i] = std::holds_alternative<Sphere>(bodies.shape[i]);
    for (const SpringForce& spring : bodies.springs)
        for (const BodyIndex end : {spring.from, spring.to})
            if (end != noBody) m_simple[end] = 0;
    for (const BodyIndex w : bodies.walls) {
        const Wall& wall = std::get<Wall>(bodies.shape[w]);
        m_wallAt[w] = static_cast<std::uint32_t>(m_walls.size());
        m_walls.push_back({w, wall.normal, wall.offset});
    }
}

bool Flights::plan(const FlightInput& input) {
    const Bodies& bodies = input.bodies;
    m_courses.front().acceleration = input.gravity;
    for (std::size_t k = 0; k < m_walls.size(); ++k) {
        const Vec3& normal = m_walls[k].normal;
        m_courses[k + 1].acceleration = input.gravity - normal.dot(input.gravity) * normal;
    }
    for (const Log& log : m_logs) m_log[log.body] = noLog;
    m_logs.clear();
    m_meetings.clear();
    m_impacts = 0;
    for (const BodyIndex i : bodies.mobileBodies) {
        m_grounded[i] = m_simple[i] == 0;
        m_support[i] = 0;
        m_stamps[i] = {input.state.pose[i].position, 0, input.state.velocity[i], bodies.boundingRadius[i]};
    }
    sortPairs(input.neighbours);
    restOnWalls(input);
    findClosePairs(input);
    groundNearSeeds(input);

    for (const WallPair pair : m_wallPairs)
        if (flies(pair.ball) && m_support[pair.ball] != pair.wall + 1)
            foreseeWall(input, pair.ball, m_walls[pair.wall]);
    for (const BodyPair pair : m_close) foresee(input, pair.a, pair.b);
    const auto later = [](const Meeting& x, const Meeting& y) { return x.time > y.time; };
    while (!m_meetings.empty()) {
        std::pop_heap(m_meetings.begin(), m_meetings.end(), later);
        const Meeting next = m_meetings.back();
        m_meetings.pop_back();
        meet(input, next);
    }
    groundGroups();
    chart(input);
    return covered(input);
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

// A ball that touches a wall, does not move across it and is pulled on it rests: without friction it slides,
// on one wall.
void Flights::restOnWalls(const FlightInput& input) {
    for (const WallPair pair : m_wallPairs) {
        const BoundedWall& wall = m_walls[pair.wall];
        const Stamp& ball = m_stamps[pair.ball];
        const double gap = gapTo(wall, ball.position, ball.radius), touching = touchingGap * ball.radius;
        if (gap > touching) continue;
        const double speed = wall.normal.dot(ball.velocity);
        const bool pulled = wall.normal.dot(input.gravity) < 0;
        if (gap < -touching) {
            m_grounded[pair.ball] = 1;
        } else if (pulled) {
            const Law law = lawOf(input, pair.ball, wall.body);
            const bool slides = law.friction == 0 && !law.rolls;
            if (slides && speed == 0 && m_support[pair.ball] == 0)
                m_support[pair.ball] = pair.wall + 1;
            else if (std::abs(speed) <= law.leastImpact && (!slides || m_support[pair.ball] != 0))
                m_grounded[pair.ball] = 1;
        }
    }
}

// Those that overlap, or press on each other, are grounded; of the others those that may meet are kept.
void Flights::findClosePairs(const FlightInput& input) {
    const double h = input.substep;
    m_close.clear();
    for (const BodyPair pair : m_ballPairs) {
        const Stamp& a = m_stamps[pair.a];
        const Stamp& b = m_stamps[pair.b];
        const double sum = radiusSum(a, b);
        const Vec3 between = b.position - a.position, velocity = b.velocity - a.velocity;
        const double c = between.squaredNorm() - sum * sum;
        const double closing = between.dot(velocity), u2 = velocity.squaredNorm();
        const bool together = m_support[pair.a] == m_support[pair.b];
        if (c > touchingSquare(a, b)) {
            if (!together || mayMeet(c, closing, u2, h)) m_close.push_back(pair);
            continue;
        }
        const Vec3 pull = accelerationOf(pair.b) - accelerationOf(pair.a);
        const bool pressed = !together && between.dot(pull) < 0 &&
                             std::abs(closing) <= lawOf(input, pair.a, pair.b).leastImpact * sum;
        if (c < -touchingSquare(a, b) || pressed)
            m_grounded[pair.a] = m_grounded[pair.b] = 1;
        else if (closing < 0 || !together)
            m_close.push_back(pair);
    }
}

void Flights::groundNearSeeds(const FlightInput& input) {
    m_seeds.clear();
    for (const BodyIndex i : input.bodies.bounded)
        if (m_grounded[i] != 0) m_seeds.push_back(i);
    const Neighbours& neighbours = input.neighbours;
    for (const BodyIndex seed : m_seeds)
        for (const BodyIndex i : neighbours.around(seed)) {
            if (isWallBody(i) || !flies(i)) continue;
            const double reach = neighbours.reach(seed) + neighbours.reach(i);
            const double size = std::min(input.bodies.boundingRadius[seed], input.bodies.boundingRadius[i]);
            const double gap = boundingGap(input.bodies, input.state, {seed, i});
            if (gap <= std::max(reach, Neighbours::leastMargin * size)) m_grounded[i] = 1;
        }
}

// Those a grounded body has met, or that met one of them, are grounded with it.
void Flights::groundGroups() {
    for (std::uint32_t i = 0; i < m_logs.size(); ++i)
        if (m_grounded[m_logs[i].body] != 0) m_grounded[m_logs[groupOf(i)].body] = 1;
    for (std::uint32_t i = 0; i < m_logs.size(); ++i)
        if (m_grounded[m_logs[groupOf(i)].body] != 0) m_grounded[m_logs[i].body] = 1;
}

std::uint32_t Flights::groupOf(std::uint32_t log) {
    while (m_logs[log].group != log) log = m_logs[log].group = m_logs[m_logs[log].group].group;
    return log;
}

void Flights::chart(const FlightInput& input) {
    for (Course& course : m_courses) course.bodies.clear();
    for (const BodyIndex i : input.bodies.mobileBodies)
        if (flies(i) && m_log[i] == noLog) m_courses[m_support[i]].bodies.push_back(i);
    for (const Log& log : m_logs)
        if (flies(log.body)) m_impacts += static_cast<std::size_t>(log.impacts);
}

bool Flights::covered(const FlightInput& input) const {
    bool all = true;
    for (const Log& log : m_logs) {
        const Stamp& stamp = m_stamps[log.body];
        const double rest = input.substep - stamp.time;
        const double path = log.path + rest * (stamp.velocity.norm() + 0.5 * rest * input.gravity.norm());
        if (flies(log.body)) all = input.neighbours.covers(log.body, path) && all;
    }
    return all;
}

void Flights::book(const Bodies& bodies, const Vec3& gravity, double substep, const State& state,
                   Ledger& ledger) const {
    LedgerEntry& fall = ledger[LedgerAccount::Gravity];
    LedgerEntry& impacts = ledger[LedgerAccount::Restitution];
    LedgerEntry& friction = ledger[LedgerAccount::Friction];
    for (const Log& log : m_logs) {
        if (!flies(log.body)) continue;
        const BodyIndex i = log.body;
        const Stamp& stamp = m_stamps[i];
        const Vec3 velocity = velocityAt(stamp, accelerationOf(i), substep);
        const Vec3 way = positionAt(stamp, accelerationOf(i), substep) - state.pose[i].position;
        const double mass = bodies.mass[i];
        const double gained =
            0.5 * mass * (velocity.squaredNorm() - state.velocity[i].squaredNorm()) +
            0.5 * bodies.inertia[i].x() * (log.spin.squaredNorm() - state.angularVelocity[i].squaredNorm());
        const double fallen = mass * gravity.dot(way);
        const Vec3 weight = (mass * substep) * gravity;
        fall.energy += fallen;
        fall.momentum += weight;
        friction.energy += log.rubbed;
        friction.momentum += log.held;
        impacts.energy += gained - fallen - log.rubbed;
        impacts.momentum += mass * (velocity - state.velocity[i]) - weight - log.held;
    }
}

void Flights::land(double substep, State& state) const {
    for (const Log& log : m_logs) {
        if (!flies(log.body)) continue;
        const Stamp& stamp = m_stamps[log.body];
        const Vec3& acceleration = accelerationOf(log.body);
        state.pose[log.body].position = positionAt(stamp, acceleration, substep);
        state.velocity[log.body] = velocityAt(stamp, acceleration, substep);
        state.angularVelocity[log.body] = log.spin;
        if (log.spin == Vec3::Zero() && log.turned == 0) continue;
        const Vec3 turn = (substep - log.turned) * log.spin;
        state.pose[log.body].orientation = (fromRotationVector(turn) * log.orientation).normalized();
    }
}

} // namespace carom
