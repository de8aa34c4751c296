// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/impulse_reach.h"

#include "core/base/reserve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace carom {
namespace {

/// Visits of a body, in the mean, for which there is room from the start. Twice or half changes memory only,
/// and how often the list grows.
constexpr std::size_t lookedAt = 4;
/// Pairs that one thread looks at at least, in the end.
constexpr std::size_t fewReached = Workers::enoughOf(5);
constexpr double never = std::numeric_limits<double>::infinity();

/// The least distance of a pair after `time` if nothing strikes it, less the slack within which bodies may
/// touch [m].
double gapAfter(const ManifoldInput& here, BodyPair pair, double gap, double speeds, double time) {
    const Bodies& bodies = here.bodies;
    const double radii = bodies.boundingRadius[pair.a] + bodies.boundingRadius[pair.b];
    double then = gap - speeds * time;
    const bool isBallistic = !bodies.forces.actOn(pair.a) && !bodies.forces.actOn(pair.b);
    if (isBallistic && time > 0 && isSphere(bodies, pair.a) && isSphere(bodies, pair.b)) {
        const Vec3 between = here.state.pose[pair.b].position - here.state.pose[pair.a].position +
                             time * (here.state.velocity[pair.b] - here.state.velocity[pair.a]);
        then = between.norm() - radii;
    }
    return std::max(0.0, then - slackPart * radii);
}

/// Speed of a body's surface while nothing strikes it [m/s]; 0 for immobile bodies.
double freeSpeed(const ImpulseReach::Input& input, BodyIndex body) {
    if (input.here.bodies.mobile[body] == 0) return 0;
    return input.neighbours.reach(body) / (Neighbours::reachFactor * input.here.duration);
}

} // namespace

void ImpulseReach::reach(BodyIndex body, double time, double speed) {
    if (m_time[body] <= time && (1 + Neighbours::worthANewLook) * m_speed[body] >= speed) return;
    m_time[body] = std::min(m_time[body], time);
    m_speed[body] = std::max(m_speed[body], speed);
    m_queue.push_back(body);
}

// Lists the pairs of each body, by counting sort.
void ImpulseReach::listAround(const Input& input) {
    for (const BodyIndex i : input.members) m_end[i] = 0;
    const auto forEachEnd = [&](const auto& visit) {
        for (std::uint32_t p = 0; p < input.pairs.size(); ++p)
            for (const BodyIndex end : {input.pairs[p].a, input.pairs[p].b})
                if (input.here.bodies.mobile[end] != 0) visit(end, p);
    };
    forEachEnd([&](BodyIndex end, std::uint32_t) { ++m_end[end]; });
    std::uint32_t ends = 0;
    for (const BodyIndex i : input.members) {
        m_first[i] = ends;
        ends += std::exchange(m_end[i], ends);
    }
    reserveFor(ends, m_around);
    m_around.resize(ends);
    forEachEnd([&](BodyIndex end, std::uint32_t p) { m_around[m_end[end]++] = p; });
}

void ImpulseReach::spread(const Input& input, BodyIndex body, std::uint32_t p) {
    const BodyPair pair = input.pairs[p].bodies();
    const BodyIndex other = pair.a == body ? pair.b : pair.a;
    if (input.here.bodies.mobile[other] == 0) return;
    if (m_time[other] <= m_time[body] && m_speed[other] >= m_speed[body]) return;
    const double own = freeSpeed(input, body), others = freeSpeed(input, other);
    const double gap = gapAfter(input.here, pair, input.gaps[p], own + others, m_time[body]);
    const double time = gap > 0 ? m_time[body] + gap / (m_speed[body] + others) : m_time[body];
    if (time <= input.here.duration)
        reach(other, time, Neighbours::speedAfter(input.here.bodies, other, others, body, m_speed[body]));
}

// Handles a pair whose bodies meet as they move.
void ImpulseReach::meet(const Input& input, std::uint32_t p) {
    const auto [a, b] = input.pairs[p].bodies();
    const double ofA = freeSpeed(input, a), ofB = freeSpeed(input, b);
    const double gap = std::max(0.0, input.gaps[p]);
    const double time = gap > 0 ? std::min(gap / (ofA + ofB), input.here.duration) : 0;
    const bool movesA = input.here.bodies.mobile[a] != 0, movesB = input.here.bodies.mobile[b] != 0;
    const Bodies& bodies = input.here.bodies;
    if (movesA) reach(a, time, movesB ? Neighbours::speedAfter(bodies, a, ofA, b, ofB) : ofA);
    if (movesB) reach(b, time, movesA ? Neighbours::speedAfter(bodies, b, ofB, a, ofA) : ofB);
}

void ImpulseReach::find(const Input& input) {
    m_isReached.clear();
    if (input.pairs.empty()) return;
    for (const BodyIndex i : input.members) {
        m_time[i] = never;
        m_speed[i] = 0;
    }
    m_queue.clear();
    m_queue.reserve(lookedAt * m_time.size());
    reserveFor(input.pairs.size(), m_isReached);
    for (const BodyIndex i : input.members)
        if (input.isOnSpring[i] != 0 || input.isPlaced[i] != 0)
            reach(i, 0, Neighbours::reachFactor * freeSpeed(input, i));
    for (std::uint32_t p = 0; p < input.pairs.size(); ++p)
        if (input.canMeet[p] != 0) meet(input, p);
    if (!m_queue.empty()) listAround(input);
    for (std::size_t k = 0; k < m_queue.size(); ++k)
        for (std::uint32_t at = m_first[m_queue[k]]; at < m_end[m_queue[k]]; ++at)
            spread(input, m_queue[k], m_around[at]);
    m_isReached.resize(input.pairs.size());
    const auto isReached = [&](BodyIndex i) { return input.here.bodies.mobile[i] == 0 || m_time[i] < never; };
    input.workers.forRanges(input.pairs.size(), fewReached, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p)
            m_isReached[p] = isReached(input.pairs[p].a) && isReached(input.pairs[p].b) ? 1 : 0;
    });
}

} // namespace carom
