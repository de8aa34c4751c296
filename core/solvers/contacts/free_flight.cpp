// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/free_flight.h"

#include "core/base/shared_extremes.h"
#include "core/solvers/contacts/manifolds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
namespace {

constexpr double noMeeting = std::numeric_limits<double>::infinity();

/// Bodies that one thread moves at least, of which it finds what they meet, and, where they were struck, what
/// they hit.
constexpr std::size_t fewMoved = Workers::enoughOf(5), fewStarts = Workers::enoughOf(500),
                      fewStrikes = Workers::enoughOf(500);

/// The distance of two centres within which their bodies may touch however slow they are [m].
double touching(const Bodies& bodies, BodyIndex a, BodyIndex b) {
    return (1 + Neighbours::leastMargin) * (bodies.boundingRadius[a] + bodies.boundingRadius[b]);
}

/// What a body may be off its course and still touch what it meets on it [m].
double leastRoom(const Bodies& bodies, BodyIndex body) {
    return Neighbours::leastMargin * bodies.boundingRadius[body];
}

/// Takes `some`, at least one, from a list that has all of them; both ascend.
void remove(std::span<const BodyIndex> some, std::vector<BodyIndex>& from) {
    auto to = std::lower_bound(from.begin(), from.end(), some.front()), next = to;
    for (const BodyIndex body : some) {
        const auto at = std::lower_bound(next, from.end(), body);
        to = std::copy(next, at, to);
        next = at + 1;
    }
    from.erase(std::copy(next, from.end(), to), from.end());
}

/// How far what flies comes by gravity in this time [m].
double fallIn(const SolverInput& input, double time) { return 0.5 * input.gravity.norm() * time * time; }

} // namespace

FreeFlight::FreeFlight(const Bodies& bodies)
    : m_kind(bodies.count(), Kind::Left), m_flight(bodies.count()), m_landing(bodies.count()) {}

void FreeFlight::clear() {
    for (const BodyIndex i : m_bodies) m_kind[i] = Kind::Left;
    m_bodies.clear();
    m_meeting.clear();
}

// How far the surface of what does not look the same from all sides may turn in the frame and after a strike
// at its end [m]. It may spin faster about another axis.
double FreeFlight::turnInFrame(const SolverInput& input, BodyIndex body) const {
    const Vec3& inverse = input.bodies.inverseInertia[body];
    const double time = (input.parts + Neighbours::reachFactor) * input.substep;
    const double spin = inverse.maxCoeff() / inverse.minCoeff() * input.state.angularVelocity[body].norm();
    return std::min(2.0, time * spin) * input.bodies.boundingRadius[body];
}

// What the boxes of one that flies must hold besides its way through a substep, seen as straight [m].
double FreeFlight::roomOf(const SolverInput& input, BodyIndex body) const {
    return m_flight[body].turn + leastRoom(input.bodies, body) + m_fall;
}

// Where a body that flies is when a substep begins.
Vec3 FreeFlight::placeIn(const SolverInput& input, BodyIndex body, int part) const {
    const double time = part * input.substep;
    const Flight& flight = m_flight[body];
    return flight.position + time * (flight.velocity + 0.5 * time * input.gravity);
}

// Whether the boxes of two meet in this part of the frame.
bool FreeFlight::doBoxesMeet(const SolverInput& input, BodyIndex body, BodyIndex other, int part) const {
    if (isSphere(input.bodies, body) && isSphere(input.bodies, other)) return true;
    const auto boxIn = [&](BodyIndex i) {
        Pose pose = input.state.pose[i];
        if (has(i)) pose.position = placeIn(input, i, part);
        return grown(input.bodies.boxAt(i, pose), has(i) ? roomOf(input, i) : leastRoom(input.bodies, i));
    };
    const auto shiftOf = [&](BodyIndex i) -> Vec3 {
        if (!has(i)) return Vec3::Zero();
        return placeIn(input, i, part + 1) - placeIn(input, i, part);
    };
    return meetOnTheWay(boxIn(body), boxIn(other), shiftOf(body) - shiftOf(other));
}

// When two may touch in the frame, if nothing strikes them [s]; infinite if they do not. The other flies too,
// sleeps, or cannot move.
double FreeFlight::timeOfMeeting(const SolverInput& input, BodyIndex body, BodyIndex other) const {
    if (!has(other)) return timeOfMeetingUnmoved(input, body, other);
    const double h = input.substep;
    const Flight &from = m_flight[body], &to = m_flight[other];
    const double meeting = firstWithin(to.position - from.position, to.velocity - from.velocity,
                                       input.parts * h, touching(input.bodies, body, other));
    if (!(meeting < noMeeting)) return noMeeting;
    for (int part = static_cast<int>(meeting / h); part < input.parts; ++part)
        if (doBoxesMeet(input, body, other, part)) return std::max(meeting, part * h);
    return noMeeting;
}

double FreeFlight::timeOfMeetingUnmoved(const SolverInput& input, BodyIndex body, BodyIndex other) const {
    const double h = input.substep, time = input.parts * h;
    if (const Wall* wall = std::get_if<Wall>(&input.bodies.shape[other])) {
        const double within = input.bodies.boundingRadius[body] + leastRoom(input.bodies, body) + m_fall;
        bool isWithin = distanceTo(*wall, placeIn(input, body, 0)) <= within;
        for (int part = 0; part < input.parts; ++part) {
            const bool isThen = distanceTo(*wall, placeIn(input, body, part + 1)) <= within;
            if (isWithin || isThen) return part * h;
            isWithin = isThen;
        }
        return noMeeting;
    }
    const auto meetingOf = [&](const Vec3& place, const Vec3& velocity, double duration) {
        return firstWithin(place - input.state.pose[other].position, velocity, duration,
                           touching(input.bodies, body, other) + fallIn(input, duration));
    };
    const Flight& flight = m_flight[body];
    if (!(meetingOf(flight.position, flight.velocity, time) < noMeeting)) return noMeeting;
    for (int part = 0; part < input.parts; ++part) {
        const Vec3 place = placeIn(input, body, part), next = placeIn(input, body, part + 1);
        const double meeting = meetingOf(place, (next - place) / h, h);
        if (meeting < noMeeting && doBoxesMeet(input, body, other, part)) return part * h + meeting;
    }
    return noMeeting;
}

void FreeFlight::choose(const SolverInput& input, std::span<const std::uint8_t> isOnSpring,
                        std::span<const std::uint8_t> isPlaced, std::vector<BodyIndex>& members) {
    m_bodies.clear();
    m_meeting.clear();
    m_struck.clear();
    std::fill(m_kind.begin(), m_kind.end(), Kind::Left);
    const bool mayFly = input.motion.isExactInFreeFall && input.motion.isExactInFreeRotation;
    std::erase_if(members, [&](BodyIndex i) {
        if (!mayFly || isOnSpring[i] != 0 || isPlaced[i] != 0 || input.bodies.forces.actOn(i)) {
            join(i);
            return false;
        }
        m_kind[i] = Kind::Flying;
        m_bodies.push_back(i);
        return true;
    });
}

void FreeFlight::start(const SolverInput& input, Neighbours& neighbours, std::vector<BodyIndex>& landed) {
    landed.clear();
    const double time = input.parts * input.substep, fall = fallIn(input, time);
    m_fall = fallIn(input, input.substep);
    const bool covered =
        neighbours.coversFlights(input.bodies, input.state, m_bodies, [&](BodyIndex i) -> Neighbours::Flight {
            m_flight[i] = {input.state.pose[i].position, input.state.velocity[i], noMeeting,
                           isSphere(input.bodies, i) ? 0 : turnInFrame(input, i)};
            return {roomOf(input, i), time, fall};
        });
    if (!covered) neighbours.search(input.bodies, input.state, input.broadphase);
    input.workers.forRanges(m_bodies.size(), fewStarts, [&](std::size_t begin, std::size_t end) {
        for (const BodyIndex i : std::span(m_bodies).subspan(begin, end - begin))
            for (const BodyIndex k : neighbours.around(i, time)) {
                const bool fly = has(k);
                if (m_kind[k] == Kind::Member || (fly && k < i)) continue;
                if (sharedValue(m_flight[i].due) == 0 && (!fly || sharedValue(m_flight[k].due) == 0))
                    continue;
                const double meeting = timeOfMeeting(input, i, k);
                lowerTo(m_flight[i].due, meeting);
                if (fly) lowerTo(m_flight[k].due, meeting);
            }
    });
    m_meeting.clear();
    std::erase_if(m_bodies, [&](BodyIndex i) {
        const double due = m_flight[i].due;
        if (due == noMeeting) return false;
        if (due != 0) {
            m_meeting.push_back(i);
            return false;
        }
        m_kind[i] = Kind::Member;
        m_landing[i] = {};
        landed.push_back(i);
        return true;
    });
}

void FreeFlight::advance(const SolverInput& input) {
    input.workers.forRanges(m_bodies.size(), fewMoved, [&](std::size_t begin, std::size_t end) {
        const double time = input.part * input.substep;
        const Vec3 gained = time * input.gravity, gainedInMean = 0.5 * time * input.gravity;
        const Flight* const flights = m_flight.data();
        Pose* const poses = input.state.pose.data();
        Vec3* const velocities = input.state.velocity.data();
        for (const BodyIndex i : std::span(m_bodies).subspan(begin, end - begin)) {
            const Flight& flight = flights[i]; // placeIn(), where the time is the same for all
            poses[i].position = flight.position + time * (flight.velocity + gainedInMean);
            velocities[i] = flight.velocity + gained;
        }
    });
}

void FreeFlight::findDue(const SolverInput& input, std::vector<BodyIndex>& due) {
    due.clear();
    for (const BodyIndex i : m_struck) m_kind[i] = Kind::Member;
    m_struck.clear();
    const double start = input.part * input.substep, end = start + input.substep;
    for (const BodyIndex i : m_meeting) {
        if (!has(i) || !(m_flight[i].due < end)) continue; // others may have been struck since
        m_kind[i] = Kind::Member;
        m_landing[i] = {std::max(0.0, m_flight[i].due - start), 0, input.part};
        due.push_back(i);
    }
    land(input, due);
}

void FreeFlight::strikeAll(const SolverInput& input, Neighbours& neighbours, std::vector<BodyIndex>& met) {
    met.clear();
    bool covered = true;
    for (const Strike& by : m_strikes)
        covered = neighbours.coversAhead(by.body, roomAfter(input, by)) && covered;
    if (!covered) neighbours.search(input.bodies, input.state, input.broadphase);
    std::size_t begin = 0;
    while (begin < m_strikes.size()) { // the list grows
        const std::size_t end = m_strikes.size();
        if (begin > 0) coverStruck(input, begin, neighbours);
        m_hits.clear();
        input.workers.forLists(end - begin, fewStrikes, m_hits,
                               [&](std::size_t first, std::size_t last, std::vector<Hit>& hits) {
                                   for (std::size_t n = begin + first; n < begin + last; ++n)
                                       if (!isOutdated(m_strikes[n])) findHits(input, n, neighbours, hits);
                               });
        for (const Hit& hit : m_hits) take(input, hit, met);
        begin = end;
    }
    m_struck.insert(m_struck.end(), met.begin(), met.end());
    land(input, met);
}

// Ensures that the lists have what those may strike that have been struck, and are in the list from here on.
void FreeFlight::coverStruck(const SolverInput& input, std::size_t begin, Neighbours& neighbours) {
    bool covered = true;
    for (const Strike& by : std::span(m_strikes).subspan(begin)) {
        if (isOutdated(by)) continue;
        neighbours.noteMoved(input.bodies, input.state, by.body);
        covered = neighbours.coversAhead(by.body, roomAfter(input, by)) && covered;
    }
    if (!covered) neighbours.search(input.bodies, input.state, input.broadphase);
}

// How far a body may come in the substep once it is struck, its boxes included [m].
double FreeFlight::roomAfter(const SolverInput& input, const Strike& by) const {
    return by.speed * input.substep + m_flight[by.body].turn + leastRoom(input.bodies, by.body);
}

// Finds the bodies in flight that this one may strike after it has been struck, as if all strikes before it
// in this round had hit nobody; take() looks again.
void FreeFlight::findHits(const SolverInput& input, std::size_t number, const Neighbours& neighbours,
                          std::vector<Hit>& hits) const {
    const Strike& by = m_strikes[number];
    const BodyIndex i = by.body;
    const double time = by.time, speed = by.speed;
    const double left = input.substep - time, fall = input.gravity.norm() * input.substep;
    const auto placeAt = [&](BodyIndex body) -> Vec3 {
        return input.state.pose[body].position +
               time * (input.state.velocity[body] + 0.5 * time * input.gravity);
    };
    const auto isFlying = [this](BodyIndex k) { return has(k) || m_kind[k] == Kind::Struck; };
    const Near near = neighbours.around(i, input.substep);
    Near::Iterator next = near.begin();
    while (next != near.end() && !isFlying(*next)) ++next;
    if (next == near.end()) return; // nearly always
    const Vec3 from = placeAt(i), comesBy = (time + 0.5 * left) * input.gravity;
    for (; next != near.end(); ++next) {
        const BodyIndex k = *next;
        if (!isFlying(k) || isStruckBefore(k, by)) continue;
        const Vec3 between = placeAt(k) - from;
        const double contact = touching(input.bodies, i, k);
        const double meeting =
            firstWithin(between, input.state.velocity[k] + comesBy, left, contact + speed * left);
        if (!(meeting < noMeeting)) continue;
        if ((!isSphere(input.bodies, i) || !isSphere(input.bodies, k)) &&
            !meetOnTheWay(grown(input.bodies.boxAt(k, input.state.pose[k]), roomOf(input, k)),
                          grown(input.bodies.boxAt(i, input.state.pose[i]), roomAfter(input, by)),
                          input.substep * (input.state.velocity[k] + 0.5 * input.substep * input.gravity)))
            continue;
        const double own = Neighbours::surfaceSpeed(input.bodies, input.state, k) + fall;
        const double gap = between.norm() - contact;
        const double at = time + std::max(meeting, gap > 0 ? gap / (speed + own) : 0);
        hits.push_back({number, k, at, Neighbours::speedAfter(input.bodies, k, own, i, speed)});
    }
}

// Ends the flight of what is hit, unless it has been hit as hard before.
void FreeFlight::take(const SolverInput& input, const Hit& hit, std::vector<BodyIndex>& met) {
    const Strike& by = m_strikes[hit.strike];
    const BodyIndex k = hit.body;
    if (isOutdated(by) || isStruckBefore(k, by)) return;
    Landing& landing = m_landing[k];
    if (m_kind[k] != Kind::Struck) {
        m_kind[k] = Kind::Struck;
        landing = {hit.at, hit.after, input.part};
        met.push_back(k);
    } else if (landing.time <= hit.at && (1 + Neighbours::worthANewLook) * landing.speed >= hit.after) {
        return;
    }
    landing.time = std::min(landing.time, hit.at);
    landing.speed = std::max(landing.speed, hit.after);
    m_strikes.push_back({k, landing.time, landing.speed});
}

// Ends the flights of bodies that are members now.
void FreeFlight::land(const SolverInput& input, std::vector<BodyIndex>& landed) {
    if (landed.empty()) return;
    std::sort(landed.begin(), landed.end());
    remove(landed, m_bodies);
    finish(input, input.part, landed);
}

// Moves bodies, whose flights end, from where these began through so many substeps.
void FreeFlight::finish(const SolverInput& input, int parts, std::span<const BodyIndex> landed) {
    if (parts == 0) return;
    input.workers.forRanges(landed.size(), fewMoved, [&](std::size_t begin, std::size_t end) {
        const Flight* const flights = m_flight.data();
        Pose* const poses = input.state.pose.data();
        Vec3* const velocities = input.state.velocity.data();
        for (const BodyIndex i : landed.subspan(begin, end - begin)) {
            poses[i].position = flights[i].position;
            velocities[i] = flights[i].velocity;
        }
    });
    m_coasting.move(input.lasting(parts), landed);
}

void FreeFlight::end(const SolverInput& input) {
    finish(input, input.parts, m_bodies);
    clear();
}

} // namespace carom
