// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/neighbours.h"

#include "core/base/reserve.h"
#include "core/base/wide.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace carom {
namespace {

/// A skin this many times as wide as what is asked for is made anew. At 1.5, lists are a twentieth shorter;
/// at twice, a quarter longer.
constexpr double tooWide = 2;
/// At most one body in so many is found anew by itself, at about twice the cost of its part in a search for
/// all. At half, such searches cost more than one for all; at twice, all are searched for the sake of a few.
constexpr std::size_t fewOutrun = 8;
/// But always so many, where the scene has not many more. Twice or half has the same effects.
constexpr std::size_t alwaysFew = 16;
/// Others around a body for which there is room from the start; there are nearly always fewer. Twice or half
/// changes memory only, and how often lists grow.
constexpr std::size_t usualAround = 16;

/// Bodies whose neighbours one thread finds at least; bodies whose skin it renews; pairs of which it finds
/// when they meet, and of which it tells the other body.
constexpr std::size_t fewFound = Workers::enoughOf(1000), fewRenewed = Workers::enoughOf(30),
                      fewMeetings = Workers::enoughOf(10), fewTold = Workers::enoughOf(20);
/// Bodies of which it finds how near they come to a wall.
constexpr std::size_t fewByWalls = Workers::enoughOf(5);

constexpr TimeSpan always{0, std::numeric_limits<double>::infinity()};

auto placeIn(std::vector<Neighbour>& list, BodyIndex body) {
    return std::ranges::lower_bound(list, body, {}, &Neighbour::body);
}

} // namespace

double boundingGap(const Bodies& bodies, BodyPair pair, const Pose& a, const Pose& b) {
    if (const Wall* wall = std::get_if<Wall>(&bodies.shape[pair.a]))
        return distanceTo(*wall, b.position) - bodies.boundingRadius[pair.b];
    if (const Wall* wall = std::get_if<Wall>(&bodies.shape[pair.b]))
        return distanceTo(*wall, a.position) - bodies.boundingRadius[pair.a];
    return (b.position - a.position).norm() - (bodies.boundingRadius[pair.a] + bodies.boundingRadius[pair.b]);
}

bool areBoxesWithin(const Bodies& bodies, BodyPair pair, const Pose& a, const Pose& b, double margin) {
    const Shape &shapeA = bodies.shape[pair.a], &shapeB = bodies.shape[pair.b];
    if (isWall(shapeA) || isWall(shapeB)) return true;
    if (std::holds_alternative<Sphere>(shapeA) && std::holds_alternative<Sphere>(shapeB))
        return true; // their bounding balls are within it, too
    return overlap(grown(bodies.boxAt(pair.a, a), margin), bodies.boxAt(pair.b, b));
}

Neighbours::Neighbours(const Bodies& bodies)
    : m_number(bodies.count(), 0), m_boxes(bodies.bounded.size()), m_skin(bodies.count()),
      m_extent(bodies.count(), 0.0), m_orientation(bodies.count(), Quat::Identity()),
      m_course(bodies.count()), m_settled(bodies.count()), m_isOutrun(bodies.count(), 0),
      m_around(bodies.count()) {
    for (const BodyIndex i : bodies.bounded) {
        m_number[i] = static_cast<std::uint32_t>(m_mobile.size());
        m_mobile.push_back(bodies.mobile[i]);
    }
    for (const BodyIndex i : bodies.bounded) {
        if (bodies.mobile[i] != 0) continue;
        m_skin[i].width = leastMargin * bodies.boundingRadius[i];
        m_extent[i] = bodies.boundingRadius[i] + m_skin[i].width;
    }
    for (const BodyIndex i : bodies.mobileBodies) m_around[i].reserve(usualAround);
    m_outrun.reserve(2 * bodies.count());
}

void Neighbours::update(const Bodies& bodies, const State& state, const Followed& list, const Vec3& gravity,
                        const Times& times, Broadphase& broadphase) {
    m_frame = times.frame;
    narrow(bodies, list.all);
    if (follow(bodies, state, list.active, gravity, times.duration)) return;
    // A neighbour may need a larger skin of a body than the body itself: a skin that was asked for will be
    // asked for again.
    const auto renew = [this](BodyIndex i) {
        m_skin[i].room = roominess * std::exchange(m_skin[i].asked, 0);
    };
    if (areFewOutrun(bodies)) {
        for (const BodyIndex i : m_outrun) renew(i);
        return searchForOutrun(bodies, state);
    }
    for (const BodyIndex i : list.all) renew(i);
    searchAll(bodies, state, broadphase);
}

// Lets the skins be made anew of bodies that have needed little of theirs for a while: what fell on a heap
// asked for much, and rests.
void Neighbours::narrow(const Bodies& bodies, std::span<const BodyIndex> list) {
    if (!asksAnew(m_frame)) return;
    m_narrowed = m_now;
    for (const BodyIndex i : list) {
        const double least = leastMargin * bodies.boundingRadius[i];
        Skin& skin = m_skin[i];
        if (skin.width > tooWide * (roominess * std::max(skin.askedLately, least) + skin.drift)) {
            skin.asked = skin.askedLately;
            m_outrun.push_back(i);
        }
        skin.askedLately = 0;
    }
}

double Neighbours::surfaceSpeed(const Bodies& bodies, const State& state, BodyIndex body) {
    const double speed = state.velocity[body].norm();
    if (std::holds_alternative<Sphere>(bodies.shape[body])) return speed;
    return speed + state.angularVelocity[body].norm() * bodies.boundingRadius[body];
}

// A spring moves its ends by at most s (ωh)²/2, where s is the larger of its present stretch and that at
// unchanged velocities, and by at most twice the amplitude. A damper moves them by at most the distance that
// they move without it. Force terms give their own bound.
void Neighbours::notePulls(const Bodies& bodies, const State& state, double duration) {
    if (bodies.springs.empty() && bodies.forces.empty()) return;
    for (Skin& skin : m_skin) skin.pull = 0;
    if (!bodies.forces.empty())
        for (const BodyIndex i : bodies.mobileBodies) m_skin[i].pull = bodies.forces.reach(i, duration);
    for (const SpringForce& spring : bodies.springs) {
        const SpringPoint from = springPoint(state, spring.from, spring.fromAt),
                          to = springPoint(state, spring.to, spring.toAt);
        const double length = (to.place - from.place).norm();
        const double way = (to.velocity - from.velocity).norm() * duration;
        const double stretch = std::abs(length - spring.length) + way;
        const auto pull = [&](BodyIndex i, double arm) {
            if (i == noBody || bodies.mobile[i] == 0) return;
            const double compliance = bodies.inverseMass[i] + arm * std::max(arm, bodies.boundingRadius[i]) *
                                                                  bodies.inverseInertia[i].maxCoeff();
            const double phase = duration * std::sqrt(spring.stiffness * compliance);
            const double amplitude = phase > 1 ? stretch - way + way / phase : stretch;
            const double more = std::min(0.5 * phase * phase * stretch, 2 * amplitude) +
                                way * std::min(1.0, duration * spring.damping * compliance);
            m_skin[i].pull += std::isfinite(more) ? more : 0; // a step with such values is stopped anyway
        };
        pull(spring.from, spring.fromAt.norm());
        pull(spring.to, spring.toAt.norm());
    }
}

bool Neighbours::follow(const Bodies& bodies, const State& state, std::span<const BodyIndex> list,
                        const Vec3& gravity, double duration) {
    const double fall = 0.5 * gravity.norm() * duration * duration;
    m_duration = duration;
    notePulls(bodies, state, duration);
    const double fallInFrame = 0.5 * gravity.norm() * m_frame * m_frame, times = durationsIn(m_frame);
    serveAll(list, [&](BodyIndex i) {
        const double radius = bodies.boundingRadius[i];
        const double turns = turnIn(bodies, state, i, duration);
        Skin& skin = m_skin[i];
        skin.path = state.velocity[i].norm() * duration + turns + fall + skin.pull;
        skin.drift = turnIn(bodies, state, i, m_frame) + fallInFrame + skin.pull * times * times;
        skin.moved = movedFrom(bodies, state, i);
        const double leaves =
            (state.velocity[i] - m_course[i].velocityAt(m_now)).norm() * duration + turns + fall + skin.pull;
        return skin.moved + leaves + leastMargin * radius <= skin.width;
    });
    return m_outrun.empty() && !m_isForgotten;
}

void Neighbours::stay(std::span<const BodyIndex> list) {
    for (const BodyIndex i : list)
        if (m_course[i].velocityAt(m_now) != Vec3::Zero() ||
            m_skin[i].width > tooWide * roominess * leastMargin * (m_extent[i] - m_skin[i].width)) {
            m_skin[i].asked = 0;
            m_outrun.push_back(i);
        }
}

void Neighbours::forget() {
    m_isForgotten = true;
    m_settled.wakeAll();
    m_outrun.clear();
}

void Neighbours::noteMoved(const Bodies& bodies, const State& state, BodyIndex body) {
    m_skin[body].moved = movedFrom(bodies, state, body);
}

bool Neighbours::coversAhead(BodyIndex body, double room) {
    return covers(body, room + m_duration * m_course[body].velocityAt(m_now).norm());
}

bool Neighbours::servesFlight(const Bodies& bodies, const State& state, BodyIndex body,
                              const Flight& flight) {
    const auto [room, time, fall] = flight;
    const Course& course = m_course[body];
    Skin& skin = m_skin[body];
    noteMoved(bodies, state, body);
    skin.drift = turnIn(bodies, state, body, m_frame) + fall;
    const double leaves = time * (state.velocity[body] - course.velocityAt(m_now)).norm() + fall;
    // By gravity alone it is so far from its course in the end.
    const double since = std::min(m_now - course.begins, framesOfCourse * m_frame) / time + 1;
    const double fallen = since * since * fall;
    ask(body, room + fallen);
    if (m_now + time <= course.ends && skin.moved + leaves + room <= skin.width) return true;
    skin.room = std::max(skin.room, roominess * (room + fallen));
    return false;
}

void Neighbours::search(const Bodies& bodies, const State& state, Broadphase& broadphase) {
    if (areFewOutrun(bodies))
        searchForOutrun(bodies, state);
    else
        searchAll(bodies, state, broadphase);
}

bool Neighbours::areFewOutrun(const Bodies& bodies) const {
    return m_searches > 0 && !m_isForgotten &&
           m_outrun.size() <= std::max(bodies.mobileBodies.size() / fewOutrun, alwaysFew);
}

void Neighbours::renewSkin(const Bodies& bodies, const State& state, BodyIndex body) {
    Skin& skin = m_skin[body];
    skin.room = std::max(skin.room, roominess * leastMargin * bodies.boundingRadius[body]);
    skin.width = skin.room + skin.drift;
    m_extent[body] = bodies.boundingRadius[body] + skin.width;
    skin.moved = 0;
    const double horizon = framesOfCourse * m_frame;
    m_orientation[body] = state.pose[body].orientation;
    m_course[body] = {state.pose[body].position, state.velocity[body], m_now, m_now + horizon};
    m_boxes[m_number[body]] =
        swept(grown(bodies.boxAt(body, state.pose[body]), skin.width), horizon * state.velocity[body]);
}

void Neighbours::Finds::clear() {
    told.clear();
    before.clear();
    ends = endsBefore = 0;
}

// Keeps the lists, except for pairs of bodies that have left them; these are found again.
void Neighbours::searchForOutrun(const Bodies& bodies, const State& state) {
    if (!std::exchange(m_areBlocksBuilt, true)) m_blocks.build(m_boxes);
    m_anew.clear();
    for (const BodyIndex i : m_outrun) {
        if (std::exchange(m_isOutrun[i], std::uint8_t{1}) != 0) continue;
        m_anew.push_back(i);
        m_settled.wake(i);
    }
    m_outrun.clear();
    m_workers->forRanges(m_anew.size(), fewRenewed, [&](std::size_t begin, std::size_t end) {
        for (const BodyIndex i : std::span(m_anew).subspan(begin, end - begin)) renewSkin(bodies, state, i);
    });
    for (const BodyIndex i : m_anew) m_blocks.set(m_number[i], m_boxes[m_number[i]]);
    const std::span<const Finds> found = m_workers->forKeptLists(
        m_anew.size(), fewFound, m_finds, [&](std::size_t begin, std::size_t end, Finds& finds) {
            for (const BodyIndex i : std::span(m_anew).subspan(begin, end - begin))
                findAround(bodies, i, finds);
        });
    tellOthers(bodies, found);
    for (const BodyIndex i : m_anew) m_isOutrun[i] = 0;
}

CAROM_INLINE bool Neighbours::comesNear(const Bodies& bodies, BodyIndex body, BodyIndex wall) const {
    const Course& course = m_course[body];
    const Wall& plane = std::get<Wall>(bodies.shape[wall]);
    return std::min(distanceTo(plane, course.place), distanceTo(plane, course.placeAt(course.ends))) <=
           m_extent[body];
}

// What a body may meet that has moved beyond its list.
void Neighbours::findAround(const Bodies& bodies, BodyIndex body, Finds& finds) {
    const auto isTold = [&](BodyIndex other) { return bodies.mobile[other] != 0 && m_isOutrun[other] == 0; };
    std::vector<Neighbour>& list = m_around[body];
    finds.endsBefore += list.size();
    for (const Neighbour& neighbour : list)
        if (isTold(neighbour.body)) finds.before.push_back({body, neighbour.body});
    list.clear();

    const std::span<const std::uint32_t> entries =
        m_blocks.overlapping(m_boxes[m_number[body]], finds.search);
    finds.others.resize(entries.size());
    finds.meetings.resize(entries.size());
    BodyIndex* to = finds.others.data();
    for (const std::uint32_t entry : entries) {
        *to = bodies.bounded[entry];
        to += static_cast<std::size_t>(*to != body);
    }
    const auto others = std::span(finds.others.data(), to);
    meetingsOfSkins().findOf(body, others, finds.meetings.data());
    for (std::size_t n = 0; n < others.size(); ++n) {
        if (finds.meetings[n].isEmpty()) continue;
        list.emplace_back(others[n], finds.meetings[n]);
        if (isTold(others[n])) finds.told.push_back({others[n], {body, finds.meetings[n]}});
    }
    for (const BodyIndex w : bodies.walls)
        if (comesNear(bodies, body, w)) list.emplace_back(w, always);
    std::ranges::sort(list, {}, &Neighbour::body);
    finds.ends += list.size();
}

// Brings the lists of the other bodies up to date. Each thread does so for some of these. Most neighbours of
// a body are found again, and stand where they stood.
void Neighbours::tellOthers(const Bodies& bodies, std::span<const Finds> found) {
    std::size_t told = 0;
    for (const Finds& finds : found) {
        m_ends += finds.ends - finds.endsBefore;
        told += finds.told.size();
    }
    const auto threads = static_cast<std::size_t>(m_workers->threads());
    const std::size_t parts = told < threads * fewTold ? 1 : threads;
    m_workers->forEach(parts, [&](std::size_t, std::size_t part) {
        const auto begin = static_cast<BodyIndex>(part * bodies.count() / parts);
        const auto end = static_cast<BodyIndex>((part + 1) * bodies.count() / parts);
        std::size_t added = 0, removed = 0;
        for (const Finds& finds : found) {
            for (const Finds::Told& find : finds.told)
                if (find.to >= begin && find.to < end) added += tell(find) ? 1 : 0;
            for (const auto [body, other] : finds.before)
                if (other >= begin && other < end) removed += dropLost(body, other) ? 1 : 0;
        }
        std::atomic_ref(m_ends) += added - removed;
    });
}

// True if it is new to this list.
bool Neighbours::tell(const Finds::Told& told) {
    std::vector<Neighbour>& list = m_around[told.to];
    const auto place = placeIn(list, told.neighbour.body);
    const bool isNew = place == list.end() || place->body != told.neighbour.body;
    if (isNew)
        list.insert(place, told.neighbour);
    else
        *place = told.neighbour;
    return isNew;
}

// Takes a body, which was found anew, from the list of another one that it has not met again.
bool Neighbours::dropLost(BodyIndex body, BodyIndex other) {
    const std::vector<Neighbour>& found = m_around[body];
    if (std::ranges::binary_search(found, other, {}, &Neighbour::body)) return false;
    m_around[other].erase(placeIn(m_around[other], body));
    return true;
}

void Neighbours::searchAll(const Bodies& bodies, const State& state, Broadphase& broadphase) {
    ++m_searches;
    m_isForgotten = false;
    m_settled.wakeAll();
    m_outrun.clear();
    m_areBlocksBuilt = false;
    m_workers->forRanges(bodies.mobileBodies.size(), fewRenewed, [&](std::size_t begin, std::size_t end) {
        for (const BodyIndex i : std::span(bodies.mobileBodies).subspan(begin, end - begin)) {
            renewSkin(bodies, state, i);
            m_around[i].clear();
        }
    });
    if (m_searches == 1)
        for (const BodyIndex i : bodies.bounded)
            if (bodies.mobile[i] == 0) {
                m_course[i].place = state.pose[i].position;
                m_boxes[m_number[i]] = grown(bodies.boxAt(i, state.pose[i]), m_skin[i].width);
            }
    broadphase.update({m_boxes, bodies.bounded, m_mobile, m_workers});
    findWallPairs(bodies);
    m_ends = 0;
    const std::span<const BodyPair> pairs = broadphase.pairs(); // ascending, so each body's list is, too
    m_meetings.resize(pairs.size());
    m_workers->forRanges(pairs.size(), fewMeetings, [&](std::size_t begin, std::size_t end) {
        meetingsOfSkins().find(pairs.subspan(begin, end - begin), m_meetings.data() + begin);
    });
    auto wall = m_wallPairs.begin();
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        if (m_meetings[k].isEmpty()) continue;
        while (wall != m_wallPairs.end() && *wall < pairs[k]) addPair(bodies, *wall++, always);
        addPair(bodies, pairs[k], m_meetings[k]);
    }
    while (wall != m_wallPairs.end()) addPair(bodies, *wall++, always);
}

void Neighbours::addPair(const Bodies& bodies, BodyPair pair, const TimeSpan& meeting) {
    for (const auto& [i, k] : {pair, BodyPair{pair.b, pair.a}}) {
        if (bodies.mobile[i] == 0) continue;
        m_around[i].emplace_back(k, meeting);
        ++m_ends;
    }
}

void Neighbours::findWallPairs(const Bodies& bodies) {
    m_wallPairs.clear();
    for (const BodyIndex w : bodies.walls)
        m_workers->forLists(bodies.mobileBodies.size(), fewByWalls, m_wallPairs,
                            [&](std::size_t begin, std::size_t end, std::vector<BodyPair>& pairs) {
                                for (const BodyIndex i :
                                     std::span(bodies.mobileBodies).subspan(begin, end - begin))
                                    if (comesNear(bodies, i, w))
                                        pairs.push_back({std::min(w, i), std::max(w, i)});
                            });
    if (!std::is_sorted(m_wallPairs.begin(), m_wallPairs.end()))
        std::sort(m_wallPairs.begin(), m_wallPairs.end());
    reserveFor(2 * m_wallPairs.size(), m_wallPairs);
}

} // namespace carom
