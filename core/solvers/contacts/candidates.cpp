// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/candidates.h"

#include "core/base/reserve.h"
#include "core/solvers/contacts/manifolds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
namespace {

/// Bodies whose neighbours one thread looks at, at least.
constexpr std::size_t fewNeighboured = Workers::enoughOf(200);
/// And of which it notes what they are.
constexpr std::size_t fewNoted = Workers::enoughOf(3);

double roomFor(const Bodies& bodies, BodyIndex body, double reach) {
    return reach + Neighbours::leastMargin * bodies.boundingRadius[body];
}

} // namespace

Candidates::Candidates(const Bodies& bodies)
    : m_body(bodies.count()), m_box(bodies.count()), m_kind(bodies.count(), Kind::Immobile) {
    for (const BodyIndex i : bodies.bounded)
        if (bodies.mobile[i] == 0) m_immobile.push_back(i);
    for (BodyIndex i = 0; i < bodies.count(); ++i) {
        const bool wall = isWall(bodies.shape[i]);
        m_body[i].radius = wall ? std::numeric_limits<double>::infinity() : bodies.boundingRadius[i];
        setReach(i, 0);
    }
}

void Candidates::setReach(BodyIndex body, double reach) {
    Body& to = m_body[body];
    to.reach = reach;
    to.extent = to.radius + std::max(reach, Neighbours::leastMargin * to.radius);
}

// The same as carom::areWithin() for a member and a neighbour, from what is stored of them.
bool Candidates::areWithin(const Bodies& bodies, const State& state, BodyPair pair, double margin) const {
    const Body &a = m_body[pair.a], &b = m_body[pair.b];
    const double within = a.radius + b.radius + margin;
    if (!std::isfinite(within)) return boundingGap(bodies, state, pair) <= margin;
    if (!((b.centre - a.centre).squaredNorm() <= within * within)) return false;
    const bool isBallA = isSphere(bodies, pair.a), isBallB = isSphere(bodies, pair.b);
    if (isBallA && isBallB) return true;
    const auto boxOf = [&](BodyIndex i, bool isBall) {
        return isBall ? bodies.boxAt(i, state.pose[i]) : m_box[i];
    };
    return overlap(grown(boxOf(pair.a, isBallA), margin), boxOf(pair.b, isBallB));
}

void Candidates::notePlace(const Bodies& bodies, const State& state, BodyIndex body) {
    m_body[body].centre = state.pose[body].position;
    if (!isSphere(bodies, body)) m_box[body] = bodies.boxAt(body, state.pose[body]);
}

void Candidates::note(const Bodies& bodies, const State& state, std::span<const BodyIndex> members,
                      std::span<const std::uint8_t> placed) {
    for (const BodyIndex i : bodies.mobileBodies) m_kind[i] = Kind::Left;
    for (const BodyIndex i : m_immobile) notePlace(bodies, state, i);
    for (const BodyIndex i : members) m_kind[i] = kindOf(placed[i]);
}

void Candidates::lookAt(const Bodies& bodies, const State& state, std::span<const BodyIndex> active,
                        std::span<const std::uint8_t> placed, Neighbours& neighbours, Broadphase& broadphase,
                        Workers& workers) {
    m_free.clear();
    workers.forLists(active.size(), fewNoted, m_free,
                     [&](std::size_t begin, std::size_t end, std::vector<BodyIndex>& free) {
                         for (const BodyIndex i : active.subspan(begin, end - begin)) {
                             m_kind[i] = kindOf(placed[i]);
                             if (placed[i] == 0) free.push_back(i);
                         }
                     });
    m_changed.clear();
    if (!noteReach(bodies, state, active, neighbours)) neighbours.search(bodies, state, broadphase);
    if (!shareReach(bodies, state, m_free, neighbours, workers)) neighbours.search(bodies, state, broadphase);
}

void Candidates::join(const Bodies& bodies, const State& state, std::span<const BodyIndex> joined,
                      Neighbours& neighbours, Broadphase& broadphase, Workers& workers) {
    for (const BodyIndex i : joined) m_kind[i] = Kind::Member;
    m_merged.resize(m_free.size() + joined.size());
    std::merge(m_free.begin(), m_free.end(), joined.begin(), joined.end(), m_merged.begin());
    std::swap(m_free, m_merged);
    m_changed.assign(joined.begin(), joined.end());
    if (!noteReach(bodies, state, joined, neighbours)) neighbours.search(bodies, state, broadphase);
    if (!shareReach(bodies, state, joined, neighbours, workers)) neighbours.search(bodies, state, broadphase);
}

bool Candidates::noteReach(const Bodies& bodies, const State& state, std::span<const BodyIndex> members,
                           Neighbours& neighbours) {
    return neighbours.coversAll(members, [&](BodyIndex i) {
        notePlace(bodies, state, i);
        setReach(i, neighbours.reach(i));
        return roomFor(bodies, i, m_body[i].reach);
    });
}

// What pairs of this body give a larger reach; where `isOfAll`, those that no smaller one gives.
void Candidates::findLarger(const Bodies& bodies, const State& state, BodyIndex i, bool isOfAll,
                            const Neighbours& neighbours, std::vector<Larger>& larger) const {
    const Body& body = m_body[i];
    for (const BodyIndex k : neighbours.around(i)) {
        if (m_kind[k] == Kind::Immobile || m_kind[k] == Kind::Left) continue;
        if (isOfAll && m_kind[k] == Kind::Member && k < i) continue;
        if (!mayBeWithin(body, m_body[k])) continue;
        const double reachI = neighbours.reach(i), reachK = neighbours.reach(k);
        const BodyIndex slower = reachI < reachK ? i : k, faster = slower == i ? k : i;
        const double reach = Neighbours::speedAfter(bodies, slower, std::min(reachI, reachK), faster,
                                                    std::max(reachI, reachK));
        if (!(m_body[slower].reach < reach)) continue;
        if (areWithin(bodies, state, {std::min(i, k), std::max(i, k)}, reachI + reachK))
            larger.push_back({slower, reach});
    }
}

// The larger reach that bodies have because of what may strike them: of pairs with at least one of `from`.
bool Candidates::shareReach(const Bodies& bodies, const State& state, std::span<const BodyIndex> from,
                            Neighbours& neighbours, Workers& workers) {
    const std::size_t first = m_changed.size();
    const bool isOfAll = from.size() == m_free.size();
    m_larger.clear();
    workers.forLists(from.size(), fewNeighboured, m_larger,
                     [&](std::size_t begin, std::size_t end, std::vector<Larger>& larger) {
                         for (const BodyIndex i : from.subspan(begin, end - begin))
                             findLarger(bodies, state, i, isOfAll, neighbours, larger);
                     });
    for (const Larger& larger : m_larger) {
        if (!(m_body[larger.body].reach < larger.reach)) continue;
        setReach(larger.body, larger.reach);
        m_changed.push_back(larger.body);
    }
    bool covered = true;
    for (std::size_t n = first; n < m_changed.size(); ++n)
        covered =
            neighbours.covers(m_changed[n], roomFor(bodies, m_changed[n], m_body[m_changed[n]].reach)) &&
            covered;
    return covered;
}

// Members and their neighbours are in ascending order, and so are all pairs but the few with an immobile or a
// base-path body of smaller index.
std::span<const BodyPair> Candidates::find(const Bodies& bodies, const State& state,
                                           const Neighbours& neighbours, Workers& workers) {
    m_found.clear();
    reserveFor(neighbours.ends(), m_found.up);
    workers.forLists(
        m_free.size(), fewNeighboured, m_found,
        [&](std::size_t begin, std::size_t end, Found& found) {
            for (const BodyIndex i : std::span(m_free).subspan(begin, end - begin)) {
                const Body body = m_body[i];
                for (const BodyIndex k : neighbours.around(i)) {
                    if (m_kind[k] == Kind::Left || (m_kind[k] == Kind::Member && k < i)) continue;
                    if (!mayBeWithin(body, m_body[k])) continue;
                    const BodyPair pair{std::min(i, k), std::max(i, k)};
                    if (areWithin(bodies, state, pair, marginOf(pair)))
                        (i < k ? found.up : found.down).push_back(pair);
                }
            }
        },
        [this](const Found& part) { m_found.append(part); });
    m_found.mergeInto(m_pairs);
    return m_pairs;
}

double Candidates::leastMarginOf(BodyPair pair) const {
    return Neighbours::leastMargin * std::min(m_body[pair.a].radius, m_body[pair.b].radius);
}

// The numbers of pairs are as the volumes, (r + reach)³.
bool Candidates::comeFar(std::span<const BodyIndex> members, int substeps) const {
    double reach = 0, size = 0;
    for (const BodyIndex i : members) {
        reach += m_body[i].reach;
        size += m_body[i].radius;
    }
    return std::pow((size + substeps * reach) / (size + reach), 3) > substeps;
}

double Candidates::marginOf(BodyPair pair) const {
    return std::max(leastMarginOf(pair), m_body[pair.a].reach + m_body[pair.b].reach);
}

} // namespace carom
