// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/candidates.h"

#include <algorithm>

namespace carom {
namespace {

double roomFor(const Bodies& bodies, BodyIndex body, double reach) {
    return reach + Neighbours::leastMargin * bodies.boundingRadius[body];
}

} // namespace

bool Candidates::look(const Bodies& bodies, const State& state, std::span<const BodyIndex> members,
                      std::span<const std::uint8_t> placed, Neighbours& neighbours) {
    std::fill(m_isMember.begin(), m_isMember.end(), std::uint8_t{0});
    bool covered = true;
    for (const BodyIndex i : members) {
        m_isMember[i] = 1;
        m_reach[i] = neighbours.reach(i);
        covered = neighbours.covers(i, roomFor(bodies, i, m_reach[i])) && covered;
    }
    if (!covered) return false;
    m_upward.clear();
    m_downward.clear();
    for (const BodyIndex i : members) {
        if (placed[i] != 0) continue;
        for (const BodyIndex k : neighbours.around(i)) {
            const bool mobile = bodies.mobile[k] != 0;
            if (mobile && ((k < i && placed[k] == 0) || m_isMember[k] == 0)) continue;
            const BodyPair pair{std::min(i, k), std::max(i, k)};
            const Near near{pair, boundingGap(bodies, state, pair)};
            (i < k ? m_upward : m_downward).push_back(near);
            if (mobile) covered = shareReach(bodies, state, near, neighbours) && covered;
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
    const double reach = std::max(reachA, reachB);
    if (!(m_reach[slower] < reach)) return true;
    if (!areBoxesWithin(bodies, state, near.pair, reachA + reachB)) return true;
    m_reach[slower] = reach;
    return neighbours.covers(slower, roomFor(bodies, slower, reach));
}

// Members and their others ascend: so do all but the few pairs with something immobile or placed of smaller
// index.
std::span<const BodyPair> Candidates::find(const Bodies& bodies, const State& state) {
    const auto choose = [&](const std::vector<Near>& from, std::vector<BodyPair>& chosen) {
        chosen.clear();
        if (chosen.capacity() < from.size()) chosen.reserve(2 * from.size());
        for (const Near& near : from)
            if (const double margin = marginOf(bodies, near.pair);
                near.gap <= margin && areBoxesWithin(bodies, state, near.pair, margin))
                chosen.push_back(near.pair);
    };
    choose(m_upward, m_up);
    choose(m_downward, m_down);
    mergeAscending(m_up, m_down, m_pairs);
    return m_pairs;
}

double Candidates::marginOf(const Bodies& bodies, BodyPair pair) const {
    double size = std::max(bodies.boundingRadius[pair.a], bodies.boundingRadius[pair.b]);
    if (!isWall(bodies.shape[pair.a]) && !isWall(bodies.shape[pair.b]))
        size = std::min(bodies.boundingRadius[pair.a], bodies.boundingRadius[pair.b]);
    return std::max(Neighbours::leastMargin * size, m_reach[pair.a] + m_reach[pair.b]);
}

} // namespace carom
