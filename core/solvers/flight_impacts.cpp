// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/flights.h"

#include "core/solvers/contact_settings.h"

#include <algorithm>
#include <cmath>

// Meetings of flying spheres: when they happen and what they do. Newton's law along the normal, Coulomb's
// across it: the impulse that would stop the slip, or μ times the normal one against it. Spheres couple
// neither to the other: a normal impulse does not turn them, and a tangential one does not part them.

namespace carom {
namespace {

/// Impacts of one sphere in a substep. A ball that bounces ever lower passes this; a lone one on a wall has a
/// closed form for the whole series (bounce_train.h), and the islands will do.
constexpr int mostImpacts = 64;

} // namespace

Flights::Law Flights::lawOf(const FlightInput& input, BodyIndex a, BodyIndex b) const {
    const Bodies& bodies = input.bodies;
    const double restitution = std::min(bodies.elastic[a], bodies.elastic[b]);
    const double scale = input.gravity.norm() * input.substep;
    return {.restitution = restitution,
            .friction = pairFriction(bodies.friction[a], bodies.friction[b]),
            .leastImpact = std::max(leastImpactPart(restitution) * scale, input.restingSpeed),
            .rolls = std::max(bodies.rolling[a], bodies.rolling[b]) > 0};
}

void Flights::expect(const Meeting& meeting) {
    m_meetings.push_back(meeting);
    std::push_heap(m_meetings.begin(), m_meetings.end(), isLater);
}

void Flights::foresee(const FlightInput& input, BodyIndex a, BodyIndex b) {
    if (!flies(a) && !flies(b)) return;
    const std::uint32_t logA = m_log[a], logB = m_log[b];
    const bool justMet = logA != none && logB != none && m_logs[logA].last == b && m_logs[logB].last == a;
    double time = never;
    if (m_support[a] == m_support[b]) {
        // Fresh from their impact, under one acceleration: they part for ever, whatever rounding says.
        if (!justMet) time = pairTime(m_stamps[a], m_stamps[b], accelerationOf(a));
    } else {
        time = pairTime(m_stamps[a], accelerationOf(a), m_stamps[b], accelerationOf(b));
    }
    if (time < input.end) expect({std::max(time, input.now), a, b, versionOf(a, b)});
}

void Flights::foreseeWall(const FlightInput& input, BodyIndex ball, const BoundedWall& wall) {
    const Stamp& stamp = m_stamps[ball];
    const bool touching = m_log[ball] != none && m_logs[m_log[ball]].last == wall.body;
    const double gap = touching ? 0 : std::max(0.0, gapTo(wall, ball));
    const double time =
        stamp.time + timeToPlane(gap, wall.normal.dot(stamp.velocity), wall.normal.dot(accelerationOf(ball)));
    if (time < input.end) expect({std::max(time, input.now), ball, wall.body, versionOf(ball, wall.body)});
}

// A platform moves as foreseen to the end of the substep only.
void Flights::foreseePlatform(const FlightInput& input, BodyIndex ball, BodyIndex platform) {
    const double time =
        m_platforms.timeOf(input.bodies, ball, m_stamps[ball], accelerationOf(ball), platform, input.until);
    if (time < input.until) expect({time, ball, platform, versionOf(ball, platform)});
}

void Flights::foreseeAround(const FlightInput& input, BodyIndex body) {
    for (const BodyIndex other : input.neighbours.around(body)) {
        if (isSimple(input, other)) {
            foresee(input, std::min(body, other), std::max(body, other));
        } else if (isWallBody(other)) {
            if (m_support[body] != m_wallAt[other] + 1) foreseeWall(input, body, m_walls[m_wallAt[other]]);
        } else if (m_platforms.contains(other) && mayStrike(input, body, other)) {
            foreseePlatform(input, body, other);
        } else if (comesNear(input, body, other)) {
            ground(body);
            return;
        }
    }
}

// Whether what is left of the substep may take a ball to a body that does not fly.
bool Flights::comesNear(const FlightInput& input, BodyIndex ball, BodyIndex body) const {
    const Stamp& stamp = m_stamps[ball];
    const double left = input.until - stamp.time;
    const double path = left * (stamp.velocity.norm() + 0.5 * left * input.gravity.norm());
    const double between = (stamp.position - input.state.pose[body].position).norm();
    return between - stamp.radius - input.bodies.boundingRadius[body] <= path + reachOf(input, body);
}

void Flights::meetAll(const FlightInput& input) {
    while (!m_meetings.empty() && m_meetings.front().time < input.until) {
        std::pop_heap(m_meetings.begin(), m_meetings.end(), isLater);
        const Meeting next = m_meetings.back();
        m_meetings.pop_back();
        if (versionOf(next.a, next.b) == next.version) meet(input, next);
    }
}

void Flights::meet(const FlightInput& input, const Meeting& meeting) {
    const BodyIndex a = meeting.a, b = meeting.b;
    const bool pair = m_simple[b] != 0; // of balls; else b is a wall or a platform
    if (!flies(a) || (pair && !flies(b))) {
        ground(a);
        if (pair) ground(b);
        return;
    }
    const Law law = lawOf(input, a, b);
    const bool tooMany = impactsOf(a) >= mostImpacts || (pair && impactsOf(b) >= mostImpacts);
    const bool sticks = pair && law.restitution == 0; // plastic impacts are solved for together
    const bool crowd =
        closesOnOthers(input, a, b, meeting.time) || (pair && closesOnOthers(input, b, a, meeting.time));
    if (tooMany || sticks || law.rolls || crowd) {
        ground(a);
        if (pair) ground(b);
        return;
    }
    const std::uint32_t versionA = m_version[a];
    moveTo(input, a, meeting.time);
    if (isWallBody(b)) {
        strikeWall(input, a, m_wallAt[b]);
    } else if (!pair) {
        strikePlatform(input, a, b);
    } else {
        moveTo(input, b, meeting.time);
        strike(input, a, b);
        foreseeAround(input, b);
    }
    if (flies(a))
        foreseeAround(input, a);
    else
        m_version[a] = versionA; // it has come to rest: who would have met it does
}

// Whether a body touches and closes on a third one at the moment of an impact: then impacts have no order.
bool Flights::closesOnOthers(const FlightInput& input, BodyIndex body, BodyIndex except, double time) const {
    const Stamp& ball = m_stamps[body];
    const Vec3& acceleration = accelerationOf(body);
    const Vec3 position = positionAt(ball, acceleration, time);
    const Vec3 velocity = velocityAt(ball, acceleration, time);
    for (const BodyIndex i : input.neighbours.around(body)) {
        if (i == except) continue;
        const double touching = touchingGap * ball.radius;
        if (isWallBody(i)) {
            const BoundedWall& wall = m_walls[m_wallAt[i]];
            if (wall.normal.dot(position) - wall.offset - ball.radius <= touching &&
                -wall.normal.dot(velocity) > lawOf(input, body, i).leastImpact)
                return true;
        } else if (isSimple(input, i)) {
            const Stamp& other = m_stamps[i];
            const Vec3 between = positionAt(other, accelerationOf(i), time) - position;
            const double reach = ball.radius + other.radius + touching;
            if (between.squaredNorm() > reach * reach) continue;
            const double closing =
                -between.normalized().dot(velocityAt(other, accelerationOf(i), time) - velocity);
            if (closing > lawOf(input, body, i).leastImpact) return true;
        } else if (m_platforms.contains(i)) {
            const Platforms::Contact contact =
                m_platforms.contactAt(input.bodies, ball, acceleration, i, time);
            if (contact.gap <= touching && contact.closing > lawOf(input, body, i).leastImpact) return true;
        }
    }
    return false;
}

void Flights::strike(const FlightInput& input, BodyIndex a, BodyIndex b) {
    const Bodies& bodies = input.bodies;
    const Law law = lawOf(input, a, b);
    Stamp& ballA = m_stamps[a];
    Stamp& ballB = m_stamps[b];
    const double massA = bodies.mass[a], massB = bodies.mass[b];
    const double partA = massB / (massA + massB), partB = massA / (massA + massB);
    const Vec3 normal = (ballB.position - ballA.position).normalized();
    const Vec3 relative = ballB.velocity - ballA.velocity;
    const double closing = -normal.dot(relative);
    const std::uint32_t logA = m_log[a], logB = m_log[b];
    ++m_logs[logA].impacts;
    ++m_logs[logB].impacts;
    m_logs[logA].last = b;
    m_logs[logB].last = a;
    const std::uint32_t groupA = groupOf(logA), groupB = groupOf(logB);
    m_logs[std::max(groupA, groupB)].group = std::min(groupA, groupB);
    if (!(closing > 0)) return;
    // Written with shares of the mass: equal masses exchange their speeds to the bit.
    const double change = (1 + law.restitution) * closing;
    ballA.velocity -= (partA * change) * normal;
    ballB.velocity += (partB * change) * normal;
    if (law.friction > 0) {
        const Vec3 rims = m_logs[logA].spin * ballA.radius + m_logs[logB].spin * ballB.radius;
        Vec3 slip = relative + closing * normal - rims.cross(normal);
        const double inertiaA = bodies.inertia[a].x(), inertiaB = bodies.inertia[b].x();
        const double across = 1 / massA + 1 / massB + ballA.radius * ballA.radius / inertiaA +
                              ballB.radius * ballB.radius / inertiaB;
        const double most = law.friction * change * massA * partA, stop = slip.norm() / across;
        if (stop > 0) {
            const Vec3 impulse = -(std::min(most, stop) / (stop * across)) * slip; // on B
            m_logs[logA].rubbed += impulse.dot(slip + (0.5 * across) * impulse);
            ballA.velocity -= impulse / massA;
            ballB.velocity += impulse / massB;
            setSpin(a, m_logs[logA].spin - (ballA.radius / inertiaA) * normal.cross(impulse));
            setSpin(b, m_logs[logB].spin - (ballB.radius / inertiaB) * normal.cross(impulse));
        }
    }
    keepSupport(input, a);
    keepSupport(input, b);
}

void Flights::strikeWall(const FlightInput& input, BodyIndex ball, std::uint32_t wall) {
    const BoundedWall& plane = m_walls[wall];
    const Law law = lawOf(input, ball, plane.body);
    Stamp& stamp = m_stamps[ball];
    Log& log = m_logs[m_log[ball]];
    ++log.impacts;
    log.last = plane.body;
    const double closing = -plane.normal.dot(stamp.velocity);
    const bool pulled = plane.normal.dot(input.gravity) < 0;
    const bool comesToRest = pulled && (law.restitution == 0 || closing <= law.leastImpact);
    // A series of bounces that ends within the substep has a closed form there (bounce_train.h).
    if (comesToRest && (law.friction > 0 || law.restitution > 0 || m_support[ball] != 0)) {
        ground(ball);
        return;
    }
    if (comesToRest) {
        m_support[ball] = wall + 1;
        stamp.velocity += closing * plane.normal;
        stamp.velocity -= plane.normal.dot(stamp.velocity) * plane.normal;
        return;
    }
    const double change = (1 + law.restitution) * std::max(0.0, closing);
    stamp.velocity += change * plane.normal;
    if (law.friction > 0) {
        const double mass = input.bodies.mass[ball], inertia = input.bodies.inertia[ball].x();
        const Vec3 normal = plane.normal;
        Vec3 slip = stamp.velocity - normal.dot(stamp.velocity) * normal;
        slip -= stamp.radius * log.spin.cross(normal);
        const double across = 1 / mass + stamp.radius * stamp.radius / inertia;
        const double most = law.friction * change * mass, stop = slip.norm() / across;
        if (stop > 0) {
            const Vec3 impulse = -(std::min(most, stop) / (stop * across)) * slip;
            log.rubbed += impulse.dot(slip + (0.5 * across) * impulse);
            log.held += impulse;
            stamp.velocity += impulse / mass;
            setSpin(ball, log.spin - (stamp.radius / inertia) * normal.cross(impulse));
        }
    }
    keepSupport(input, ball);
}

void Flights::strikePlatform(const FlightInput& input, BodyIndex ball, BodyIndex platform) {
    const Law law = lawOf(input, ball, platform);
    Stamp& stamp = m_stamps[ball];
    Log& log = m_logs[m_log[ball]];
    ++log.impacts;
    log.last = platform;
    const Platforms::Contact contact =
        m_platforms.contactAt(input.bodies, stamp, accelerationOf(ball), platform, stamp.time);
    if (!(contact.closing > law.leastImpact)) {
        ground(ball);
        return;
    }
    const double mass = input.bodies.mass[ball];
    const double impulse =
        m_platforms.strike(input.bodies, mass, law.restitution, contact, platform, m_log[ball]);
    stamp.velocity += (impulse / mass) * contact.normal;
    keepSupport(input, ball);
}

// A ball that slid on a wall before an impact with something else: it goes on, lifts off, or strikes the
// wall. Struck from above it may come back upon what struck it at once.
void Flights::keepSupport(const FlightInput& input, BodyIndex ball) {
    if (m_support[ball] == 0) return;
    const BoundedWall& wall = m_walls[m_support[ball] - 1];
    Stamp& stamp = m_stamps[ball];
    const double speed = wall.normal.dot(stamp.velocity);
    const Law law = lawOf(input, ball, wall.body);
    if (speed < -input.restingSpeed) m_logs[m_log[ball]].last = wall.body;
    if (speed > input.restingSpeed || (speed < -law.leastImpact && law.restitution > 0)) {
        m_support[ball] = 0;
        if (speed < 0) stamp.velocity -= (1 + law.restitution) * speed * wall.normal;
    } else {
        stamp.velocity -= speed * wall.normal;
    }
}

} // namespace carom
