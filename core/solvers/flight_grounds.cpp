// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contact_settings.h"
#include "core/solvers/flights.h"

#include <cmath>

// Who may fly in a substep and who is grounded. Only those are looked at that are fresh: everybody when the
// frame begins, later those that were grounded in the substep before.

namespace carom {
namespace {

/// Overlap or gap up to which two balls touch, as |D|² − R² = (|D| − R)(|D| + R) [m²].
double touchingSquare(const Stamp& a, const Stamp& b) {
    return 2 * touchingGap * std::min(a.radius, b.radius) * (a.radius + b.radius);
}

/// Whether two balls under one acceleration may touch within h; never false if they do.
bool mayMeet(double c, double b, double u2, double h) {
    if (b >= 0) return false; // they part
    const bool closest = -b < u2 * h;
    return closest ? b * b >= u2 * c : c + h * (2 * b + u2 * h) <= 0;
}

} // namespace

template<class OnWall>
void Flights::eachFreshWall(const FlightInput& input, const OnWall& onWall) const {
    if (m_allFresh) {
        for (const WallPair pair : m_wallPairs)
            if (!input.resting.rests(pair.ball)) onWall(pair.ball, pair.wall);
        return;
    }
    for (const BodyIndex ball : m_fresh)
        for (const BodyIndex other : input.neighbours.around(ball))
            if (isWallBody(other)) onWall(ball, m_wallAt[other]);
}

template<class OnPair>
void Flights::eachFreshPair(const FlightInput& input, const OnPair& onPair) const {
    if (m_allFresh) {
        for (const BodyPair pair : m_ballPairs)
            if (!input.resting.rests(pair.a) && !input.resting.rests(pair.b)) onPair(pair.a, pair.b);
        return;
    }
    for (const BodyIndex ball : m_fresh)
        for (const BodyIndex other : input.neighbours.around(ball)) {
            if (!isSimple(input, other) || (other < ball && isFresh(input, other))) continue;
            onPair(std::min(ball, other), std::max(ball, other));
        }
}

// A ball that touches a wall, does not move across it and is pulled on it rests: without friction it slides,
// on one wall.
void Flights::restOnWalls(const FlightInput& input) {
    eachFreshWall(input, [&](BodyIndex i, std::uint32_t w) {
        const BoundedWall& wall = m_walls[w];
        const Stamp& ball = m_stamps[i];
        const double gap = gapTo(wall, i), touching = touchingGap * ball.radius;
        if (gap > touching) return;
        const double speed = wall.normal.dot(ball.velocity);
        const bool pulled = wall.normal.dot(input.gravity) < 0;
        if (gap < -touching) {
            ground(i);
        } else if (pulled) {
            const Law law = lawOf(input, i, wall.body);
            const bool slides = law.friction == 0 && !law.rolls;
            if (slides && speed == 0 && m_support[i] == 0)
                m_support[i] = w + 1;
            else if (std::abs(speed) <= law.leastImpact && (!slides || m_support[i] != 0))
                ground(i);
        }
    });
}

// Those that overlap, or press on each other, are grounded; of the others those that may meet are kept.
void Flights::findClosePairs(const FlightInput& input) {
    const double h = input.end - input.now;
    m_close.clear();
    if (m_allFresh) m_touching.clear();
    eachFreshPair(input, [&](BodyIndex i, BodyIndex k) {
        const Stamp& a = m_stamps[i];
        const Stamp& b = m_stamps[k];
        const double sum = a.radius + b.radius;
        const Vec3 between = placeAt(k, input.now) - placeAt(i, input.now);
        const Vec3 velocity = speedAt(k, input.now) - speedAt(i, input.now);
        const double c = between.squaredNorm() - sum * sum;
        const double closing = between.dot(velocity), u2 = velocity.squaredNorm();
        const bool together = m_support[i] == m_support[k];
        if (c > touchingSquare(a, b)) {
            if (!together || mayMeet(c, closing, u2, h)) m_close.push_back({i, k});
            return;
        }
        const Vec3 pull = accelerationOf(k) - accelerationOf(i);
        const bool pressed =
            !together && between.dot(pull) < 0 && std::abs(closing) <= lawOf(input, i, k).leastImpact * sum;
        if (c < -touchingSquare(a, b) || pressed) {
            ground(i);
            ground(k);
            return;
        }
        if (closing < 0 || !together) m_close.push_back({i, k});
        m_touching.push_back({i, k});
    });
}

// Bodies nearly at rest that enough light balls come near. A ball that lies on one or overlaps it is
// grounded.
void Flights::choosePlatforms(const FlightInput& input) {
    m_platforms.clear();
    m_guests.clear();
    const State& state = input.state;
    const double still = input.gravity.norm() * input.substep;
    for (const BodyIndex body : m_bulky) {
        ++m_version[body];
        if (Neighbours::surfaceSpeed(input.bodies, state, body) > still) continue;
        const std::size_t before = m_guests.size();
        m_platforms.add(state, body, input.now);
        for (const BodyIndex i : input.neighbours.around(body)) {
            if (m_simple[i] == 0 || !flies(i) || !mayStrike(input, i, body)) continue;
            const Platforms::Contact contact =
                m_platforms.contactAt(input.bodies, m_stamps[i], accelerationOf(i), body, input.now);
            if (contact.gap > reachOf(input, i) + reachOf(input, body)) continue;
            m_guests.push_back({i, body});
        }
        if (m_guests.size() - before >= Platforms::fewest) continue;
        m_guests.resize(before);
        m_platforms.removeLast();
    }
    for (const BodyPair guest : m_guests) {
        const Stamp& ball = m_stamps[guest.a];
        const Platforms::Contact contact =
            m_platforms.contactAt(input.bodies, ball, accelerationOf(guest.a), guest.b, input.now);
        const double touching = touchingGap * ball.radius;
        const bool rests = std::abs(contact.closing) <= lawOf(input, guest.a, guest.b).leastImpact;
        if (contact.gap < -touching || (contact.gap <= touching && rests)) ground(guest.a);
    }
}

// Whether the impacts of a ball with a body, if that is a platform, are of the kind that it can take.
bool Flights::mayStrike(const FlightInput& input, BodyIndex ball, BodyIndex body) const {
    if (!Platforms::isLight(input.bodies, ball, body)) return false;
    const Law law = lawOf(input, ball, body);
    return law.restitution > 0 && law.friction == 0 && !law.rolls;
}

void Flights::groundNearSeeds(const FlightInput& input) {
    const auto groundAround = [&](BodyIndex seed) {
        const Vec3 place = isSimple(input, seed) ? placeAt(seed, input.now) : input.state.pose[seed].position;
        const double radius = input.bodies.boundingRadius[seed], reach = reachOf(input, seed);
        for (const BodyIndex i : input.neighbours.around(seed)) {
            if (m_simple[i] == 0 || !flies(i)) continue;
            if (m_platforms.contains(seed) && mayStrike(input, i, seed)) continue;
            const double gap = (placeAt(i, input.now) - place).norm() - (m_stamps[i].radius + radius);
            const double least = Neighbours::leastMargin * std::min(m_stamps[i].radius, radius);
            if (gap <= std::max(reach + reachOf(input, i), least)) ground(i);
        }
    };
    const std::size_t count = m_landed.size(); // what is grounded for being near is no seed
    for (const BodyIndex seed : m_never) groundAround(seed);
    for (const BodyIndex seed : input.resting.bodies())
        if (m_simple[seed] != 0) groundAround(seed);
    for (std::size_t k = 0; k < count; ++k) groundAround(m_landed[k]);
    // But what lies on the grounded does not fly, however many lie on each other.
    for (std::size_t before = m_landed.size() + 1; before != m_landed.size();) {
        before = m_landed.size();
        for (const BodyPair pair : m_touching) {
            if (!flies(pair.a)) ground(pair.b);
            if (!flies(pair.b)) ground(pair.a);
        }
    }
}

// How far a body's surface may come in the substep [m]: as Neighbours::reach has it, for those that fly, too.
double Flights::reachOf(const FlightInput& input, BodyIndex body) const {
    const double h = input.substep, fall = 0.5 * input.gravity.norm() * h * h;
    if (isSimple(input, body)) return Neighbours::reachFactor * (speedAt(body, input.now).norm() * h + fall);
    if (input.bodies.mobile[body] == 0) return 0;
    return Neighbours::reachFactor * (Neighbours::surfaceSpeed(input.bodies, input.state, body) * h + fall);
}

void Flights::foreseeAll(const FlightInput& input) {
    eachFreshWall(input, [&](BodyIndex ball, std::uint32_t wall) {
        if (flies(ball) && m_support[ball] != wall + 1) foreseeWall(input, ball, m_walls[wall]);
    });
    for (const BodyPair pair : m_close) foresee(input, pair.a, pair.b);
    for (const BodyPair guest : m_guests)
        if (flies(guest.a)) foreseePlatform(input, guest.a, guest.b);
    for (const BodyIndex ball : m_again)
        if (flies(ball)) foreseeAround(input, ball);
}

} // namespace carom
