// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/event_gas.h"

#include "core/base/assert.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <span>

namespace carom {
namespace {

// The clock is set back by one second whenever one has passed: times stay below two, so that their rounding
// (2e-16 s) does not grow with the length of the run.
constexpr double clockTurn = 1;

// A meeting of two balls that follows the last lossy one sooner than this share of the typical time is
// treated as elastic: otherwise three balls can collide infinitely often in finite time (S. Luding,
// S. McNamara, "How to handle the inelastic collapse of a dissipative hard-sphere gas with the TC model",
// Granular Matter 1, 1998). 1e-6: a ball moves a millionth of its radius between the two.
constexpr double shortest = 1e-6;

// If ten events a ball and a thousand more pass in less than this share of the typical time, the run has
// collapsed. Real gases take about 1.
constexpr double stalled = 1e-9;

/// The part of gravity left to a ball on up to three walls: the reactions are those that push and, among
/// them, balance what pushes in. Walls that would have to pull are let go.
Vec3 supportedAcceleration(const Vec3& gravity, std::span<const Vec3> normals) {
    Vec3 best = gravity;
    double strongest = -1;
    for (unsigned subset = 1; subset < (1U << normals.size()); ++subset) {
        Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> chosen(3, std::popcount(subset));
        Eigen::Index column = 0;
        for (std::size_t k = 0; k < normals.size(); ++k)
            if ((subset >> k & 1U) != 0) chosen.col(column++) = normals[k];
        const Eigen::MatrixXd gram = chosen.transpose() * chosen;
        if (std::abs(gram.determinant()) < 1e-12) continue; // parallel walls
        const Eigen::VectorXd reactions = gram.ldlt().solve(-chosen.transpose() * gravity);
        if (reactions.minCoeff() < 0) continue;
        const Vec3 left = gravity + chosen * reactions;
        bool pressesIn = false;
        for (const Vec3& normal : normals)
            pressesIn = pressesIn || normal.dot(left) < -1e-12 * gravity.norm();
        const double pushed = (left - gravity).norm();
        if (!pressesIn && pushed > strongest) {
            best = left;
            strongest = pushed;
        }
    }
    return best;
}

} // namespace

double EventGas::Agenda::earliest() const { return std::min({pairTime, wallTime, crossingTime}); }

EventGas::EventKind EventGas::Agenda::kind() const {
    const double time = earliest();
    if (crossingTime == time) return EventKind::Crossing;
    return wallTime == time ? EventKind::Wall : EventKind::Pair;
}

EventGas::EventGas(const Bodies& bodies, const State& state, const Vec3& gravity) : m_gravity(gravity) {
    takeBodies(bodies, state);
    sortByPlace();
    layCells();
    planAll(0);
}

void EventGas::takeBodies(const Bodies& bodies, const State& state) {
    for (const BodyIndex i : bodies.walls) {
        const Wall& wall = std::get<Wall>(bodies.shape[i]);
        m_walls.push_back({wall.normal, wall.offset, bodies.elastic[i]});
    }
    double radii = 0, fastest = 0;
    for (const BodyIndex i : bodies.bounded) {
        const bool mobile = bodies.mobile[i] != 0;
        const double radius = std::get<Sphere>(bodies.shape[i]).radius;
        m_stamps.push_back({state.pose[i].position, 0, state.velocity[i], radius});
        m_balls.push_back({.body = i,
                           .inverseMass = bodies.inverseMass[i],
                           .elastic = bodies.elastic[i],
                           .acceleration = mobile ? m_gravity : Vec3::Zero(),
                           .supports = {},
                           .mobile = mobile,
                           .free = mobile});
        radii += radius;
        fastest = std::max(fastest, state.velocity[i].norm());
    }
    const double radius = m_stamps.empty() ? 1 : radii / static_cast<double>(m_stamps.size());
    const double g = m_gravity.norm();
    const double speed = std::max(fastest, std::sqrt(g * radius));
    if (speed > 0) m_typicalTime = radius / speed;
}

// Balls that are near each other should be near each other in memory: order by Morton's curve.
void EventGas::sortByPlace() {
    const Aabb region = regionOfCentres();
    const double longest = std::max(region.size().maxCoeff(), 1e-300);
    const auto spread = [](std::uint64_t v) {
        std::uint64_t spaced = 0;
        for (unsigned bit = 0; bit < 20; ++bit) spaced |= (v >> bit & 1U) << (3 * bit);
        return spaced;
    };
    std::vector<std::uint64_t> code(m_stamps.size());
    for (std::size_t i = 0; i < code.size(); ++i) {
        const Vec3 unit = (m_stamps[i].position - region.lower) / longest;
        for (int axis = 0; axis < 3; ++axis)
            code[i] |= spread(static_cast<std::uint64_t>(unit[axis] * 0xfffff)) << axis;
    }
    std::vector<std::size_t> order(m_stamps.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return code[a] < code[b]; });
    std::vector<Stamp> stamps;
    std::vector<Ball> balls;
    for (const std::size_t i : order) {
        stamps.push_back(m_stamps[i]);
        balls.push_back(m_balls[i]);
    }
    m_stamps.swap(stamps);
    m_balls.swap(balls);
}

Aabb EventGas::regionOfCentres() const {
    if (m_stamps.empty()) return {};
    Aabb region{m_stamps[0].position, m_stamps[0].position};
    for (const Stamp& stamp : m_stamps) region = united(region, {stamp.position, stamp.position});
    return region;
}

// A ball must not reach past the neighbouring cells: the edge is at least the largest diameter. 1.1 of it at
// 5 % packing means about four crossings and twenty pairs looked at per collision; in a thin gas wider cells
// are better, half the mean spacing.
void EventGas::layCells() {
    constexpr double slack = 1.1, shareOfSpacing = 0.5;
    constexpr std::size_t cellsPerBall = 32, cellsAtLeast = 4096;
    double largest = 0;
    for (const Stamp& stamp : m_stamps) largest = std::max(largest, stamp.radius);
    const Aabb region = regionOfCentres();
    const double count = static_cast<double>(std::max<std::size_t>(1, m_stamps.size()));
    const double volume = (region.size().array() + 2 * largest).prod();
    const double side = std::max(2 * slack * largest, shareOfSpacing * std::cbrt(volume / count));
    m_cells.restart(m_stamps.size(), region, side > 0 ? side : 1,
                    cellsAtLeast + cellsPerBall * m_stamps.size());
    for (std::uint32_t i = 0; i < m_stamps.size(); ++i) m_cells.insert(i, m_stamps[i].position);
}

// Everything is looked for anew, and the queue's days are cut for the events to come: one day for two events.
// What happens does not depend on it, only how fast it is found.
void EventGas::planAll(double now) {
    m_agendas.resize(m_stamps.size());
    std::vector<double> pending;
    for (std::uint32_t i = 0; i < m_stamps.size(); ++i) {
        if (!m_balls[i].mobile) continue;
        planPairs(i);
        planWalls(i);
        planCrossing(i, now);
        if (m_agendas[i].earliest() < never) pending.push_back(m_agendas[i].earliest() - now);
    }
    double rate = 1;
    if (!pending.empty()) {
        const std::ptrdiff_t half = static_cast<std::ptrdiff_t>(pending.size() / 2);
        std::nth_element(pending.begin(), pending.begin() + half, pending.end());
        constexpr double soonest = 0.01; // of the typical time: a burst at the start is no rate
        rate = static_cast<double>(pending.size()) /
               std::max(pending[pending.size() / 2], soonest * m_typicalTime);
    }
    constexpr double mostDays = 1U << 30U;
    m_queue.restart(m_stamps.size(),
                    std::bit_ceil(static_cast<std::uint32_t>(std::clamp(rate, 1.0, mostDays))));
    for (std::uint32_t i = 0; i < m_stamps.size(); ++i)
        if (m_balls[i].mobile) schedule(i);
}

Loss EventGas::advanceTo(double time) {
    const std::uint64_t window = 1000 + 10 * m_stamps.size();
    std::uint64_t windowEnd = m_counts.events() + window;
    double windowStart = -never;
    const auto before = [this](std::uint32_t i, std::uint32_t j) { return comesBefore(i, j); };
    for (;;) {
        const double target = std::min(time - m_secondsPast, clockTurn);
        for (std::uint32_t i = m_queue.earliest(target, before); i != nobody;
             i = m_queue.earliest(target, before)) {
            const double happens = m_queue.timeOf(i);
            if (!std::isfinite(m_stamps[i].velocity.squaredNorm())) return {m_balls[i].body, "velocity"};
            handle(i);
            if (m_counts.events() < windowEnd) continue;
            if (happens - windowStart < stalled * m_typicalTime)
                return {m_balls[i].body, "time between events"};
            windowStart = happens;
            windowEnd = m_counts.events() + window;
        }
        m_now = target;
        if (target < clockTurn) return {};
        setClockBack();
        windowStart -= clockTurn;
    }
}

void EventGas::setClockBack() {
    m_secondsPast += clockTurn;
    m_now -= clockTurn;
    for (Stamp& stamp : m_stamps) stamp.time -= clockTurn;
    for (Ball& ball : m_balls) ball.lastDissipation -= clockTurn;
    planAll(m_now);
}

void EventGas::write(State& state) const {
    for (std::size_t i = 0; i < m_stamps.size(); ++i) {
        const Ball& ball = m_balls[i];
        if (!ball.mobile) continue;
        state.pose[ball.body].position = positionAt(m_stamps[i], ball.acceleration, m_now);
        state.velocity[ball.body] = velocityAt(m_stamps[i], ball.acceleration, m_now);
    }
}

void EventGas::handle(std::uint32_t i) {
    const Agenda& agenda = m_agendas[i];
    switch (agenda.kind()) {
    case EventKind::Crossing:
        return crossCell(i);
    case EventKind::Wall:
        return bounce(i, agenda.wallTime);
    case EventKind::Pair:
        break;
    }
    if (m_agendas[agenda.partner].changes == agenda.partnerChanges)
        return collide(i, agenda.partner, agenda.pairTime);
    ++m_counts.stale;
    planPairs(i);
    schedule(i);
}

void EventGas::collide(std::uint32_t i, std::uint32_t j, double time) {
    ++m_counts.collisions;
    Stamp& a = m_stamps[i];
    Stamp& b = m_stamps[j];
    Ball& ballA = m_balls[i];
    Ball& ballB = m_balls[j];
    restamp(i, time);
    restamp(j, time);
    const Vec3 D = b.position - a.position;
    const Vec3 normal = D / D.norm();
    const double approach = normal.dot(b.velocity - a.velocity);
    if (approach < 0) {
        double e = std::min(ballA.elastic, ballB.elastic);
        if (e < 1) {
            const double since = time - std::max(ballA.lastDissipation, ballB.lastDissipation);
            if (since < shortest * m_typicalTime) e = 1;
            ballA.lastDissipation = time;
            ballB.lastDissipation = time;
        }
        const double impulse = -(1 + e) * approach / (ballA.inverseMass + ballB.inverseMass);
        a.velocity -= (impulse * ballA.inverseMass) * normal;
        b.velocity += (impulse * ballB.inverseMass) * normal;
    }
    for (const std::uint32_t k : {i, j}) {
        const Supports before = m_balls[k].supports;
        if (before.count > 0) settle(k, before);
    }
    m_agendas[i].last = j;
    m_agendas[j].last = i;
    plan(i);
    plan(j);
}

void EventGas::bounce(std::uint32_t i, double time) {
    ++m_counts.bounces;
    const std::uint16_t index = m_agendas[i].wall;
    const BoundedWall& wall = m_walls[index];
    restamp(i, time);
    Stamp& stamp = m_stamps[i];
    Ball& ball = m_balls[i];
    const double approach = wall.normal.dot(stamp.velocity);
    const double e = std::min(ball.elastic, wall.elastic);
    const double after = -e * std::min(approach, 0.0);
    const Supports before = ball.supports;
    const bool rests = restsAfter(after, wall.normal.dot(ball.acceleration), e, stamp.radius);
    stamp.velocity += ((rests ? 0 : after) - approach) * wall.normal;
    if (rests)
        support(i, index);
    else if (before.count > 0)
        settle(i, before);
    m_agendas[i].last = nobody;
    m_agendas[i].touching = index;
    plan(i);
}

void EventGas::crossCell(std::uint32_t i) {
    ++m_counts.crossings;
    const Agenda& agenda = m_agendas[i];
    const int axis = agenda.axis, direction = agenda.direction;
    m_cells.cross(i, axis, direction);
    m_cells.newlyAround(i, axis, direction, [&](std::uint32_t j) { considerPair(i, j); });
    planCrossing(i, agenda.crossingTime);
    schedule(i);
}

/// Carries the ball's stamp to `time`; whatever was found out about it before is off.
void EventGas::restamp(std::uint32_t i, double time) {
    Stamp& stamp = m_stamps[i];
    const Vec3& acceleration = m_balls[i].acceleration;
    stamp.position = positionAt(stamp, acceleration, time);
    stamp.velocity = velocityAt(stamp, acceleration, time);
    stamp.time = time;
    ++m_agendas[i].changes;
    m_agendas[i].touching = noWall;
}

void EventGas::plan(std::uint32_t i) {
    if (!m_balls[i].mobile) return;
    planPairs(i);
    planWalls(i);
    planCrossing(i, m_stamps[i].time);
    schedule(i);
}

void EventGas::planPairs(std::uint32_t i) {
    m_agendas[i].pairTime = never;
    m_agendas[i].partner = nobody;
    m_cells.aroundBody(i, [&](std::uint32_t j) { considerPair(i, j); });
}

void EventGas::considerPair(std::uint32_t i, std::uint32_t j) {
    ++m_counts.tested;
    Agenda& agenda = m_agendas[i];
    const double time = meeting(i, j);
    const bool wins = time < agenda.pairTime ||
                      (time == agenda.pairTime && time < never && pairBefore(i, j, i, agenda.partner));
    if (!wins) return;
    agenda.pairTime = time;
    agenda.partner = j;
    agenda.partnerChanges = m_agendas[j].changes;
}

// Two balls that have just collided and that nothing has happened to since fly apart for ever, as long as
// gravity bends both paths alike; rounding must not make them collide again.
double EventGas::meeting(std::uint32_t i, std::uint32_t j) const {
    const Ball& a = m_balls[i];
    const Ball& b = m_balls[j];
    if (a.free && b.free) {
        if (m_agendas[i].last == j && m_agendas[j].last == i) return never;
        return pairTime(m_stamps[i], m_stamps[j], m_gravity);
    }
    return pairTime(m_stamps[i], a.acceleration, m_stamps[j], b.acceleration);
}

void EventGas::planWalls(std::uint32_t i) {
    Agenda& agenda = m_agendas[i];
    const Stamp& stamp = m_stamps[i];
    const Ball& ball = m_balls[i];
    agenda.wallTime = never;
    for (std::uint16_t k = 0; k < m_walls.size(); ++k) {
        bool supports = false;
        for (std::uint8_t s = 0; s < ball.supports.count; ++s)
            supports = supports || ball.supports.wall[s] == k;
        if (supports) continue;
        const BoundedWall& wall = m_walls[k];
        const double gap =
            k == agenda.touching ? 0 : wall.normal.dot(stamp.position) - wall.offset - stamp.radius;
        const double time = stamp.time + timeToPlane(gap, wall.normal.dot(stamp.velocity),
                                                     wall.normal.dot(ball.acceleration));
        if (time < agenda.wallTime) {
            agenda.wallTime = time;
            agenda.wall = k;
        }
    }
}

// Seen from `now`, not from the stamp: the stamp may lie cells away, on the other side of a border. Crossings
// need not be the same to the bit, because no motion depends on them.
void EventGas::planCrossing(std::uint32_t i, double now) {
    Agenda& agenda = m_agendas[i];
    const Vec3& acceleration = m_balls[i].acceleration;
    const Vec3 position = positionAt(m_stamps[i], acceleration, now);
    const Vec3 velocity = velocityAt(m_stamps[i], acceleration, now);
    agenda.crossingTime = never;
    for (int axis = 0; axis < 3; ++axis) {
        const double p = position[axis], v = velocity[axis], a = acceleration[axis];
        const double down = now + timeToPlane(p - m_cells.lowerBorder(i, axis), v, a);
        const double up = now + timeToPlane(m_cells.upperBorder(i, axis) - p, -v, -a);
        const bool goesUp = up < down;
        const double time = goesUp ? up : down;
        if (time < agenda.crossingTime) {
            agenda.crossingTime = time;
            agenda.axis = static_cast<std::int8_t>(axis);
            agenda.direction = goesUp ? 1 : -1;
        }
    }
}

void EventGas::schedule(std::uint32_t i) { m_queue.set(i, m_agendas[i].earliest()); }

// At equal times: crossings, then walls, then pairs, and pairs by the places of their stamps. Numbers and
// cells have no say, so neither the order of the text nor the size of the cells changes what happens.
bool EventGas::comesBefore(std::uint32_t i, std::uint32_t j) const {
    const EventKind kindOfI = m_agendas[i].kind(), kindOfJ = m_agendas[j].kind();
    if (kindOfI != kindOfJ) return kindOfI < kindOfJ;
    if (kindOfI != EventKind::Pair) return i < j;
    return pairBefore(i, m_agendas[i].partner, j, m_agendas[j].partner);
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

// A ball that leaves a wall at `speed` and is pulled back bounces for 2 speed / (|a| (1 − e)) more seconds in
// all, the sum of the geometric series, and is at rest then. Where that is shorter than anything one could
// see, a billionth of the time a fall through its radius takes, it is at rest now; likewise where a single
// bounce is a tenth of that, which ends the bounces that rounding alone keeps up.
bool EventGas::restsAfter(double speed, double acceleration, double restitution, double radius) const {
    if (!(acceleration < 0)) return false;
    constexpr double unseen = 1e-9, roundings = 1e-10;
    const double bounceTime = 2 * speed / -acceleration;
    const double fall = std::sqrt(2 * radius / -acceleration);
    return bounceTime <= std::max(unseen * (1 - restitution), roundings) * fall;
}

/// After a blow to a ball that rested: which of its walls does it still rest on, which does it leave?
void EventGas::settle(std::uint32_t i, const Supports& before) {
    Ball& ball = m_balls[i];
    Stamp& stamp = m_stamps[i];
    ball.supports.count = 0;
    refreshAcceleration(i);
    for (std::uint8_t k = 0; k < before.count; ++k) {
        const BoundedWall& wall = m_walls[before.wall[k]];
        const double speed = wall.normal.dot(stamp.velocity);
        const double e = std::min(ball.elastic, wall.elastic);
        const double after = speed < 0 ? -e * speed : speed;
        const bool rests = restsAfter(after, wall.normal.dot(m_gravity), e, stamp.radius);
        stamp.velocity += ((rests ? 0 : after) - speed) * wall.normal;
        if (rests) support(i, before.wall[k]);
    }
}

void EventGas::support(std::uint32_t i, std::uint16_t wall) {
    Supports& supports = m_balls[i].supports;
    if (supports.count < mostSupports) supports.wall[supports.count++] = wall;
    refreshAcceleration(i);
}

void EventGas::refreshAcceleration(std::uint32_t i) {
    Ball& ball = m_balls[i];
    std::array<Vec3, mostSupports> normals;
    for (std::uint8_t k = 0; k < ball.supports.count; ++k) normals[k] = m_walls[ball.supports.wall[k]].normal;
    ball.free = ball.mobile && ball.supports.count == 0;
    ball.acceleration = !ball.mobile ? Vec3::Zero()
                        : ball.free  ? m_gravity
                                    : supportedAcceleration(m_gravity, {normals.data(), ball.supports.count});
}

std::size_t EventGas::memoryBytes() const {
    return m_stamps.capacity() * sizeof(Stamp) + m_agendas.capacity() * sizeof(Agenda) +
           m_balls.capacity() * sizeof(Ball) + m_cells.memoryBytes() + m_queue.memoryBytes();
}

} // namespace carom
