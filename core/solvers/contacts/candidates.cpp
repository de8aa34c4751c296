// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/candidates.h"

#include "core/base/reserve.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
namespace {

double roomFor(const Bodies& bodies, BodyIndex body, double reach) {
    return reach + Neighbours::leastMargin * bodies.boundingRadius[body];
}

} // namespace

Candidates::Candidates(const Bodies& bodies)
    : m_kind(bodies.count(), Kind::Immobile), m_reach(bodies.count(), 0.0), m_ball(bodies.count()) {
    for (BodyIndex i = 0; i < bodies.count(); ++i) {
        const bool wall = isWall(bodies.shape[i]);
        m_ball[i].radius = wall ? std::numeric_limits<double>::infinity() : bodies.boundingRadius[i];
    }
}

// The same as boundingGap() for a member and a neighbour, from stored radii, without reading their shapes.
double Candidates::gapOf(const Bodies& bodies, const State& state, BodyPair pair) const {
    const Ball &a = m_ball[pair.a], &b = m_ball[pair.b];
    const double radii = a.radius + b.radius;
    return std::isfinite(radii) ? (b.centre - a.centre).norm() - radii : boundingGap(bodies, state, pair);
}

bool Candidates::look(const Bodies& bodies, const State& state, std::span<const BodyIndex> members,
                      std::span<const std::uint8_t> placed, Neighbours& neighbours) {
    for (const BodyIndex i : bodies.mobileBodies) m_kind[i] = Kind::Left;
    bool covered = true;
    double farthest = 0;
    for (const BodyIndex i : bodies.bounded) m_ball[i].centre = state.pose[i].position;
    for (const BodyIndex i : members) {
        m_kind[i] = placed[i] != 0 ? Kind::Placed : Kind::Member;
        m_reach[i] = neighbours.reach(i);
        farthest = std::max(farthest, m_reach[i]);
        covered = neighbours.covers(i, roomFor(bodies, i, m_reach[i])) && covered;
    }
    if (!covered) return false;
    m_upward.clear();
    m_downward.clear();
    reserveFor(neighbours.ends(), m_upward);
    reserveFor(neighbours.ends(), m_downward);
    for (const BodyIndex i : members) {
        if (placed[i] != 0) continue;
        const Ball ball = m_ball[i];
        for (const BodyIndex k : neighbours.around(i)) {
            const Kind kind = m_kind[k];
            if (kind == Kind::Left || (kind == Kind::Member && k < i)) continue;
            const Ball& other = m_ball[k];
            const BodyPair pair{std::min(i, k), std::max(i, k)};
            const double margin = std::max(2 * farthest, leastMarginOf(pair));
            const double within = ball.radius + other.radius + margin;
            if ((other.centre - ball.centre).squaredNorm() > within * within) continue;
            const Near near{pair, gapOf(bodies, state, pair)};
            if (near.gap > margin) continue;
            (i < k ? m_upward : m_downward).push_back(near);
            if (kind != Kind::Immobile) covered = shareReach(bodies, state, near, neighbours) && covered;
        }
    }
    return covered;
}

bool Candidates::shareReach(const Bodies& bodies, const State& state, const Near& near,
                            Neighbours& neighbours) {
    const auto [a, b] = near.pair;
    const double reachA = neighbours.reach(a), reachB = neighbours.reach(b);
    if (!(near.gap <= reachA + reachB)) return true;
    const BodyIndex slower = reachA < reachB ? a : b;
    const BodyIndex faster = slower == a ? b : a;
    const double reach =
        Neighbours::reachAfter(bodies, slower, std::min(reachA, reachB), faster, std::max(reachA, reachB));
    if (!(m_reach[slower] < reach)) return true;
    if (!areBoxesWithin(bodies, state, near.pair, reachA + reachB)) return true;
    m_reach[slower] = reach;
    return neighbours.covers(slower, roomFor(bodies, slower, reach));
}

// Members and their neighbours are in ascending order, and so are all pairs but the few with an immobile or a
// base-path body of smaller index.
std::span<const BodyPair> Candidates::find(const Bodies& bodies, const State& state) {
    const auto choose = [&](const std::vector<Near>& from, std::vector<BodyPair>& chosen) {
        chosen.clear();
        reserveFor(from.size(), chosen);
        for (const Near& near : from)
            if (const double margin = marginOf(near.pair);
                near.gap <= margin && areBoxesWithin(bodies, state, near.pair, margin))
                chosen.push_back(near.pair);
    };
    choose(m_upward, m_up);
    choose(m_downward, m_down);
    mergeAscending(m_up, m_down, m_pairs);
    return m_pairs;
}

double Candidates::leastMarginOf(BodyPair pair) const {
    return Neighbours::leastMargin * std::min(m_ball[pair.a].radius, m_ball[pair.b].radius);
}

double Candidates::marginOf(BodyPair pair) const {
    return std::max(leastMarginOf(pair), m_reach[pair.a] + m_reach[pair.b]);
}

} // namespace carom
