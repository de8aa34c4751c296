// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/neighbours.h"

#include "core/base/reserve.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace carom {
namespace {

/// A skin is this many times what the body needs in one substep. At twice, lists last longer and hold more
/// pairs; near 1, the list is made anew in every substep.
constexpr double roominess = 2;
/// And at least this many times what was asked for beyond it before the list was made: twice or half has the
/// same effects.
constexpr double lentAgain = 1.5;
/// Up to so many bodies are compared with all others, a few instructions for each of these; a search for all
/// costs some thousands for every body of the scene. At twice, the comparisons may cost as much as the
/// search; at half, more searches are made.
constexpr std::size_t fewOutrun = 128;
/// Others around a body for which there is room from the start; there are nearly always fewer. Twice or half
/// changes memory only, and how often lists grow.
constexpr std::size_t usualAround = 16;

} // namespace

double boundingGap(const Bodies& bodies, const State& state, BodyPair pair) {
    const Vec3& a = state.pose[pair.a].position;
    const Vec3& b = state.pose[pair.b].position;
    if (const Wall* wall = std::get_if<Wall>(&bodies.shape[pair.a]))
        return distanceTo(*wall, b) - bodies.boundingRadius[pair.b];
    if (const Wall* wall = std::get_if<Wall>(&bodies.shape[pair.b]))
        return distanceTo(*wall, a) - bodies.boundingRadius[pair.a];
    return (b - a).norm() - (bodies.boundingRadius[pair.a] + bodies.boundingRadius[pair.b]);
}

bool areBoxesWithin(const Bodies& bodies, const State& state, BodyPair pair, double margin) {
    const Shape &a = bodies.shape[pair.a], &b = bodies.shape[pair.b];
    if (isWall(a) || isWall(b)) return true;
    if (std::holds_alternative<Sphere>(a) && std::holds_alternative<Sphere>(b))
        return true; // their bounding balls are within it, too
    return overlap(grown(bodies.boxAt(pair.a, state.pose[pair.a]), margin),
                   bodies.boxAt(pair.b, state.pose[pair.b]));
}

Neighbours::Neighbours(const Bodies& bodies)
    : m_number(bodies.count(), 0), m_boxes(bodies.bounded.size()), m_path(bodies.count(), 0.0),
      m_pull(bodies.count(), 0.0), m_moved(bodies.count(), 0.0), m_skin(bodies.count(), -1.0),
      m_asked(bodies.count(), 0.0), m_origin(bodies.count()), m_isOutrun(bodies.count(), 0),
      m_around(bodies.count()) {
    for (const BodyIndex i : bodies.bounded) {
        m_number[i] = static_cast<std::uint32_t>(m_mobile.size());
        m_mobile.push_back(bodies.mobile[i]);
    }
    for (const BodyIndex i : bodies.bounded)
        if (bodies.mobile[i] == 0) m_skin[i] = leastMargin * bodies.boundingRadius[i];
    for (const BodyIndex i : bodies.mobileBodies) m_around[i].reserve(usualAround);
    m_outrun.reserve(2 * bodies.count());
    m_columns.resize(bodies.bounded.size());
    m_hits.resize(bodies.bounded.size() + wideLanes);
}

void Neighbours::update(const Bodies& bodies, const State& state, std::span<const BodyIndex> list,
                        const Vec3& gravity, double duration, Broadphase& broadphase) {
    if (follow(bodies, state, list, gravity, duration)) return;
    noteTypical(bodies, list);
    // A neighbour may need a larger skin of a body than the body itself: a skin that was asked for will be
    // asked for again.
    const auto renew = [this](BodyIndex i) {
        m_skin[i] = lentAgain * m_asked[i];
        m_asked[i] = 0;
    };
    if (areFewOutrun()) {
        for (const BodyIndex i : m_outrun) renew(i);
        return searchForOutrun(bodies, state);
    }
    for (const BodyIndex i : bodies.mobileBodies) renew(i);
    searchAll(bodies, state, broadphase);
}

void Neighbours::noteTypical(const Bodies& bodies, std::span<const BodyIndex> list) {
    double sum = 0;
    for (const BodyIndex i : list) {
        const double needed = m_path[i] + leastMargin * bodies.boundingRadius[i];
        sum += needed * needed;
    }
    m_typical = std::sqrt(sum / static_cast<double>(list.size()));
}

double Neighbours::surfaceSpeed(const Bodies& bodies, const State& state, BodyIndex body) {
    const double speed = state.velocity[body].norm();
    if (std::holds_alternative<Sphere>(bodies.shape[body])) return speed;
    return speed + state.angularVelocity[body].norm() * bodies.boundingRadius[body];
}

double Neighbours::displacement(const Bodies& bodies, BodyIndex body, const Pose& from, const Pose& to) {
    const double shift = (to.position - from.position).norm();
    if (std::holds_alternative<Sphere>(bodies.shape[body])) return shift;
    const double cosine = from.orientation.dot(to.orientation); // of half the angle turned
    return shift + 2 * bodies.boundingRadius[body] * std::sqrt(std::max(0.0, 1 - cosine * cosine));
}

// A spring moves its ends by at most s (ωh)²/2, where s is the larger of its present stretch and that at
// unchanged velocities, and by at most twice the amplitude. A damper moves them by at most the distance that
// they move without it. Force terms give their own bound.
void Neighbours::notePulls(const Bodies& bodies, const State& state, double duration) {
    if (bodies.springs.empty() && bodies.forces.empty()) return;
    std::fill(m_pull.begin(), m_pull.end(), 0.0);
    if (!bodies.forces.empty())
        for (const BodyIndex i : bodies.mobileBodies) m_pull[i] = bodies.forces.reach(i, duration);
    for (const SpringForce& spring : bodies.springs) {
        const auto placeOf = [&](BodyIndex i, const Vec3& at) {
            return i == noBody ? at : state.pose[i].toWorld(at);
        };
        const auto velocityOf = [&](BodyIndex i, const Vec3& at) -> Vec3 {
            if (i == noBody) return Vec3::Zero();
            return state.velocity[i] + state.angularVelocity[i].cross(state.pose[i].directionToWorld(at));
        };
        const double length = (placeOf(spring.to, spring.toAt) - placeOf(spring.from, spring.fromAt)).norm();
        const double way =
            (velocityOf(spring.to, spring.toAt) - velocityOf(spring.from, spring.fromAt)).norm() * duration;
        const double stretch = std::abs(length - spring.length) + way;
        const auto pull = [&](BodyIndex i, double arm) {
            if (i == noBody || bodies.mobile[i] == 0) return;
            const double compliance = bodies.inverseMass[i] + arm * std::max(arm, bodies.boundingRadius[i]) *
                                                                  bodies.inverseInertia[i].maxCoeff();
            const double phase = duration * std::sqrt(spring.stiffness * compliance);
            const double amplitude = phase > 1 ? stretch - way + way / phase : stretch;
            const double more = std::min(0.5 * phase * phase * stretch, 2 * amplitude) +
                                way * std::min(1.0, duration * spring.damping * compliance);
            m_pull[i] += std::isfinite(more) ? more : 0; // a step with such values is stopped anyway
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
    bool serves = true;
    for (const BodyIndex i : list) {
        const double radius = bodies.boundingRadius[i];
        m_path[i] = surfaceSpeed(bodies, state, i) * duration + fall + m_pull[i];
        m_moved[i] = displacement(bodies, i, m_origin[i], state.pose[i]);
        if (m_moved[i] + m_path[i] + leastMargin * radius <= m_skin[i]) continue;
        m_outrun.push_back(i);
        serves = false;
    }
    return serves;
}

bool Neighbours::covers(BodyIndex body, double room) {
    m_asked[body] = std::max(m_asked[body], room);
    if (m_moved[body] + room <= m_skin[body]) return true;
    m_skin[body] = roominess * room;
    m_outrun.push_back(body);
    return false;
}

void Neighbours::search(const Bodies& bodies, const State& state, Broadphase& broadphase) {
    if (areFewOutrun())
        searchForOutrun(bodies, state);
    else
        searchAll(bodies, state, broadphase);
}

bool Neighbours::areFewOutrun() const { return m_searches > 0 && m_outrun.size() <= fewOutrun; }

void Neighbours::renewSkin(const Bodies& bodies, const State& state, BodyIndex body) {
    const double needed = m_path[body] + leastMargin * bodies.boundingRadius[body];
    m_skin[body] = std::max(m_skin[body], roominess * std::max(needed, m_typical));
    m_moved[body] = 0;
    m_origin[body] = state.pose[body];
}

// Keeps the lists, except for pairs of bodies that have moved beyond them; these are found again at the
// present poses.
void Neighbours::searchForOutrun(const Bodies& bodies, const State& state) {
    for (const BodyIndex i : m_outrun) {
        if (m_isOutrun[i] != 0) continue;
        m_isOutrun[i] = 1;
        renewSkin(bodies, state, i);
        m_columns.set(m_number[i], boxWithSkin(bodies, state, i));
    }
    for (const BodyIndex i : m_outrun) {
        for (const BodyIndex k : m_around[i]) {
            if (bodies.mobile[k] == 0 || m_isOutrun[k] != 0) continue;
            std::vector<BodyIndex>& others = m_around[k];
            others.erase(std::lower_bound(others.begin(), others.end(), i));
            --m_ends;
        }
        m_ends -= m_around[i].size();
        m_around[i].clear();
    }
    for (const BodyIndex i : m_outrun)
        if (std::exchange(m_isOutrun[i], std::uint8_t{2}) == 1) findAround(bodies, state, i);
    for (const BodyIndex i : m_outrun) {
        if (std::exchange(m_isOutrun[i], std::uint8_t{0}) == 0) continue;
        std::sort(m_around[i].begin(), m_around[i].end());
    }
    m_outrun.clear();
}

// A pair of two bodies that have moved beyond the list is found once, with the first of them.
void Neighbours::findAround(const Bodies& bodies, const State& state, BodyIndex body) {
    const BoxRange all{0, static_cast<std::uint32_t>(bodies.bounded.size())};
    const std::size_t count = overlapping(m_columns, m_columns.box(m_number[body]), {&all, 1}, m_hits.data());
    for (std::size_t k = 0; k < count; ++k) {
        const BodyIndex other = bodies.bounded[m_hits[k]];
        if (other == body || m_isOutrun[other] == 2 || !doSkinsTouch(bodies, state, body, other)) continue;
        m_around[body].push_back(other);
        ++m_ends;
        if (bodies.mobile[other] == 0) continue;
        ++m_ends;
        std::vector<BodyIndex>& others = m_around[other];
        others.insert(m_isOutrun[other] == 1 ? others.end()
                                             : std::lower_bound(others.begin(), others.end(), body),
                      body);
    }
    for (const BodyIndex w : bodies.walls) {
        if (!(boundingGap(bodies, state, {std::min(w, body), std::max(w, body)}) <= m_skin[body])) continue;
        m_around[body].push_back(w);
        ++m_ends;
    }
}

void Neighbours::searchAll(const Bodies& bodies, const State& state, Broadphase& broadphase) {
    ++m_searches;
    m_outrun.clear();
    for (const BodyIndex i : bodies.mobileBodies) {
        renewSkin(bodies, state, i);
        m_around[i].clear();
    }
    for (std::size_t k = 0; k < bodies.bounded.size(); ++k) {
        m_boxes[k] = boxWithSkin(bodies, state, bodies.bounded[k]);
        m_columns.set(k, m_boxes[k]);
    }
    broadphase.update({m_boxes, bodies.bounded, m_mobile});
    findWallPairs(bodies, state);
    m_ends = 0;
    auto wall = m_wallPairs.begin();
    for (const BodyPair pair : broadphase.pairs()) { // ascending, so each body's list is, too
        if (!doSkinsTouch(bodies, state, pair.a, pair.b)) continue;
        while (wall != m_wallPairs.end() && *wall < pair) addPair(bodies, *wall++);
        addPair(bodies, pair);
    }
    while (wall != m_wallPairs.end()) addPair(bodies, *wall++);
}

void Neighbours::addPair(const Bodies& bodies, BodyPair pair) {
    for (const auto& [i, k] : {pair, BodyPair{pair.b, pair.a}}) {
        if (bodies.mobile[i] == 0) continue;
        m_around[i].push_back(k);
        ++m_ends;
    }
}

Aabb Neighbours::boxWithSkin(const Bodies& bodies, const State& state, BodyIndex body) const {
    return grown(bodies.boxAt(body, state.pose[body]), m_skin[body]);
}

// Whether the skins of two bodies touch, of which one is found anew and the other is where the list found it.
bool Neighbours::doSkinsTouch(const Bodies& bodies, const State& state, BodyIndex body,
                              BodyIndex other) const {
    const bool isThere = bodies.mobile[other] == 0 || m_isOutrun[other] != 0;
    const Vec3& at = isThere ? state.pose[other].position : m_origin[other].position;
    const double within =
        bodies.boundingRadius[body] + bodies.boundingRadius[other] + m_skin[body] + m_skin[other];
    return (at - state.pose[body].position).squaredNorm() <= within * within;
}

void Neighbours::findWallPairs(const Bodies& bodies, const State& state) {
    m_wallPairs.clear();
    for (const BodyIndex w : bodies.walls) {
        for (const BodyIndex i : bodies.mobileBodies) {
            const BodyPair pair{std::min(w, i), std::max(w, i)};
            if (boundingGap(bodies, state, pair) <= m_skin[i]) m_wallPairs.push_back(pair);
        }
    }
    std::sort(m_wallPairs.begin(), m_wallPairs.end());
    reserveFor(2 * m_wallPairs.size(), m_wallPairs);
}

} // namespace carom
