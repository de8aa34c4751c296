// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/base_path.h"

#include "core/base/shared_extremes.h"

#include <algorithm>
#include <limits>
#include <utility>

// How far bodies on the base path may come, and the pairs that follow from it.

namespace carom {
namespace {

/// Where more than one body in so many of an island gets new neighbours, what is to be put in order is so
/// before the next substep, otherwise when the next frame begins. At half, that happens more often; at twice,
/// passes go through more pairs out of order.
constexpr std::size_t fewRenewed = 4;
/// A body whose reach is this many times what it needs gets a new one when a frame begins. At half, more
/// bodies do; at twice, heaps that came to rest keep a fifth more pairs.
constexpr double tooFar = 3;
/// Bodies that one thread looks at least at, and at the neighbours of; and pairs that it looks at.
constexpr std::size_t fewBodies = Workers::enoughOf(30), fewSearched = Workers::enoughOf(500),
                      fewPairs = Workers::enoughOf(5);

/// Bodies get new neighbours only where at least one mobile body in so many takes the base path, because
/// those of all bodies may have to be found; else islands leave. At twice, a search for all is made for fewer
/// bodies; at half, islands leave more often.
constexpr std::size_t partHere = 4;

} // namespace

// How far the surface of a body can move within `time` [m].
double BasePath::pathOf(const SteppedInput& input, BodyIndex body, double time,
                        const Neighbours& neighbours) const {
    return input.state.velocity[body].norm() * time +
           Neighbours::turnIn(input.bodies, input.state, body, time) +
           0.5 * input.gravity.norm() * time * time + neighbours.pull(body, time);
}

// How far a body comes in this time, if nothing strikes it, and a part of its size more [m].
double BasePath::ownReach(const SteppedInput& input, BodyIndex body, double time, double skin,
                          const Neighbours& neighbours) const {
    return pathOf(input, body, time, neighbours) + skin * input.bodies.boundingRadius[body];
}

bool BasePath::prepare(const SteppedInput& input, std::span<const BodyIndex> list, double time, double skin,
                       Neighbours& neighbours) {
    const Bodies& bodies = input.bodies;
    const bool covered = coversThoseHere(neighbours);
    m_kick.resize(bodies.count());
    m_room.resize(bodies.count());
    input.workers.forRanges(list.size(), fewBodies, [&](std::size_t begin, std::size_t end) {
        for (const BodyIndex i : list.subspan(begin, end - begin)) {
            m_block[i] = entering;
            m_origin[i] = input.state.pose[i];
            m_reach[i] = ownReach(input, i, time, skin, neighbours);
            m_kick[i] = 0;
        }
    });
    if (!neighbours.coversAll(list, [this](BodyIndex i) { return m_reach[i]; }) || !covered) return false;
    const auto kick = [&](BodyIndex body, BodyIndex striker) {
        raiseTo(m_kick[body], kickOf(input, body, striker, neighbours));
    };
    input.workers.forRanges(list.size(), fewSearched, [&](std::size_t begin, std::size_t end) {
        for (const BodyIndex i : list.subspan(begin, end - begin))
            for (const BodyIndex k : neighbours.around(i)) {
                if (m_block[k] != entering || k < i) continue;
                if (!areWithin(bodies, input.state, {i, k}, m_reach[i] + m_reach[k])) continue;
                kick(i, k);
                kick(k, i);
            }
    });
    return neighbours.coversAll(list, [this](BodyIndex i) { return m_reach[i] += m_kick[i]; });
}

// How far the surface of a body may still move [m]; for bodies that enter or have a new reach, all of it.
double BasePath::roomLeft(const SteppedInput& input, BodyIndex body) const {
    if (input.bodies.mobile[body] == 0) return 0;
    return isHere(m_block[body]) && m_renewal[body] == 0 ? std::max(0.0, m_room[body]) : m_reach[body];
}

double BasePath::marginOf(const SteppedInput& input, BodyPair pair) const {
    return roomLeft(input, pair.a) + roomLeft(input, pair.b);
}

// Bodies that enter or have a new reach get pairs with bodies that are on the base path already. The
// neighbour list must hold all of these, or the pairs would depend on when the list was made.
bool BasePath::coversThoseHere(Neighbours& neighbours) const {
    bool covered = true;
    for (const SteppedMotion& block : m_blocks) {
        if (block.isEmpty()) continue;
        const auto roomOf = [this](BodyIndex i) { // of those with a new reach, coversRenewed() is asked
            return m_renewal[i] == 0 ? std::max(0.0, m_room[i]) : -std::numeric_limits<double>::infinity();
        };
        covered = neighbours.coversAll(block.bodies(), roomOf) && covered;
    }
    return covered;
}

// Pairs of the bodies that enter: with each other, with bodies on the base path and with immobile ones,
// ascending.
void BasePath::findPairs(const SteppedInput& input, std::span<const BodyIndex> list,
                         const Neighbours& neighbours, std::span<Manifolds::Entry> known) {
    m_paired.clear();
    input.workers.forLists(
        list.size(), fewSearched, static_cast<Paired&>(m_paired),
        [&](std::size_t begin, std::size_t end, Paired& paired) {
            for (const BodyIndex i : list.subspan(begin, end - begin))
                for (const BodyIndex k : neighbours.around(i)) {
                    const bool mobile = input.bodies.mobile[k] != 0;
                    if (mobile && (m_block[k] == noBlock || (m_block[k] == entering && k < i))) continue;
                    const BodyPair pair{std::min(i, k), std::max(i, k)};
                    const double margin = marginOf(input, pair);
                    if (!areWithin(input.bodies, input.state, pair, margin)) continue;
                    (i < k ? paired.up : paired.down)
                        .push_back(
                            {.pair = pair, .margin = margin, .isNear = SteppedPairs::isNear(input, pair)});
                }
        },
        [this](const Paired& part) { m_paired.append(part); });
    m_paired.mergeInto(m_entering);
    auto old = known.begin();
    for (Entry& entry : m_entering) {
        while (old != known.end() && old->pair < entry.pair) ++old;
        if (old == known.end() || old->pair != entry.pair) continue;
        std::swap(entry.place, old->place);
        entry.isFresh = old->isFresh;
    }
}

bool BasePath::renew(const SteppedInput& input, double time, double skin, Neighbours& neighbours,
                     Broadphase& broadphase, Manifolds& manifolds) {
    std::size_t all = 0;
    for (const SteppedMotion& block : m_blocks) all += block.bodies().size();
    for (const Renewed& renewed : m_renewed) m_renewal[renewed.body] = 0;
    m_renewed.clear();
    findOutrun(input, time, skin, neighbours);
    if (m_renewed.empty()) return !anyMarked();
    if (partHere * all < input.bodies.mobileBodies.size()) {
        markIslands([](BodyIndex) { return true; });
        return false;
    }
    // Lists must cover all, so that the pairs depend on the poses only.
    const bool coversAll = coversThoseHere(neighbours); // notes what it does not
    if (!coversRenewed(neighbours) || !coversAll) neighbours.search(input.bodies, input.state, broadphase);
    m_outrunners.assign(m_renewed.begin(), m_renewed.end());
    while (true) {
        findStruck(input, time, skin, neighbours);
        if (coversRenewed(neighbours)) break;
        neighbours.search(input.bodies, input.state, broadphase);
        for (const Renewed& renewed : m_renewed) m_renewal[renewed.body] = 0;
        m_renewed.assign(m_outrunners.begin(), m_outrunners.end());
        for (std::uint32_t n = 0; n < m_renewed.size(); ++n) m_renewal[m_renewed[n].body] = n + 1;
    }
    orderWhereMany();
    loadPairs(input, neighbours, manifolds);
    return !anyMarked();
}

// Lets islands be put in order soon in which many bodies get new neighbours.
void BasePath::orderWhereMany() {
    std::array<std::vector<std::size_t>, divisions>& outrun = m_outrun;
    for (std::size_t number = 0; number < divisions; ++number)
        outrun[number].assign(block(number).isEmpty() ? 0 : block(number).islands().islandNumbers(), 0);
    for (const Renewed& renewed : m_renewed) {
        SteppedMotion& block = blockWith(renewed.body);
        const std::uint32_t island = block.islands().of(renewed.body);
        if (fewRenewed * ++outrun[m_block[renewed.body] - 1u][island] > block.islands().bodiesOf(island))
            block.orderSoon();
    }
    const auto leaves = [this](const Renewed& renewed) {
        const bool is = blockWith(renewed.body).islands().isMarked(renewed.body);
        if (is) m_renewal[renewed.body] = 0;
        return is;
    };
    std::erase_if(m_renewed, leaves);
}

// Finds the bodies that may move beyond their reach, and gives them a new one: not those that have settled.
void BasePath::findOutrun(const SteppedInput& input, double time, double skin, const Neighbours& neighbours) {
    m_room.resize(input.bodies.count());
    for (const SteppedMotion& block : m_blocks) {
        const std::span<const BodyIndex> bodies = block.bodies();
        m_needed.clear();
        input.workers.forLists(bodies.size(), fewBodies, static_cast<std::vector<Renewed>&>(m_needed),
                               [&](std::size_t begin, std::size_t end, std::vector<Renewed>& renewed) {
                                   for (const BodyIndex i : bodies.subspan(begin, end - begin)) {
                                       if (neighbours.settled().has(i)) continue;
                                       m_room[i] = roomOf(input, i);
                                       const bool isOutrun = neighbours.reach(i) > m_room[i];
                                       if ((!isOutrun && !input.isFirst) || block.islands().isMarked(i))
                                           continue;
                                       const double reach = ownReach(input, i, time, skin, neighbours);
                                       if (isOutrun || m_reach[i] > tooFar * reach)
                                           renewed.push_back({i, reach, !isOutrun});
                                   }
                               });
        for (const Renewed& needed : std::span<const Renewed>(m_needed)) {
            m_renewed.push_back(needed);
            m_renewal[needed.body] = static_cast<std::uint32_t>(m_renewed.size());
        }
    }
}

// How much further a body may come in the substep in which `striker` strikes it than it would by itself [m].
// In the next one it is renewed. An impact changes its velocity by no more than (1 + e) of the closing speed,
// by its part of the masses.
double BasePath::kickOf(const SteppedInput& input, BodyIndex body, BodyIndex striker,
                        const Neighbours& neighbours) {
    const Bodies& bodies = input.bodies;
    const double own = neighbours.reach(body);
    const double part = bodies.inverseMass[body] / (bodies.inverseMass[body] + bodies.inverseMass[striker]);
    const double restitution = pairRestitution(bodies.elastic[body], bodies.elastic[striker]);
    const double byImpact = Neighbours::reachFactor * (1 + restitution) * part *
                            neighbours.approach(bodies, input.state, body, striker);
    return std::min(byImpact,
                    Neighbours::speedAfter(bodies, body, own, striker, neighbours.reach(striker)) - own);
}

// Extends the reach of bodies that one of these may strike, as prepare() would: all strike with the reach
// that they have by themselves.
void BasePath::findStruck(const SteppedInput& input, double time, double skin, const Neighbours& neighbours) {
    m_raised.resize(input.bodies.count(), 0.0);
    m_struck.clear();
    input.workers.forLists(m_renewed.size(), fewSearched, m_struck,
                           [&](std::size_t begin, std::size_t end, std::vector<BodyIndex>& struck) {
                               for (std::size_t n = begin; n < end; ++n)
                                   strikeAround(input, m_renewed[n], time, skin, neighbours, struck);
                           });
    const auto raised = [this](BodyIndex body) { return std::exchange(m_raised[body], 0.0); };
    for (Renewed& renewed : m_renewed) renewed.reach = std::max(renewed.reach, raised(renewed.body));
    for (const BodyIndex k : m_struck) {
        if (m_renewal[k] > 0) continue;
        m_renewed.push_back({k, raised(k)});
        m_renewal[k] = static_cast<std::uint32_t>(m_renewed.size());
    }
}

// Adds those to `struck` that get a new reach.
void BasePath::strikeAround(const SteppedInput& input, const Renewed& renewed, double time, double skin,
                            const Neighbours& neighbours, std::vector<BodyIndex>& struck) {
    const auto [i, reach, isNarrowed] = renewed;
    for (const BodyIndex k : neighbours.around(i)) {
        if (input.bodies.mobile[k] == 0 || !has(k)) continue;
        if (isNarrowed && areWithin(input.bodies, input.state, {i, k}, reach + m_reach[k]))
            raiseTo(m_raised[i], reach + kickOf(input, i, k, neighbours));
        const double room = m_renewal[k] > 0 ? m_renewed[m_renewal[k] - 1].reach : m_room[k];
        if (!areWithin(input.bodies, input.state, {i, k}, reach + room)) continue;
        const double kick = kickOf(input, k, i, neighbours);
        if (!(kick > 0)) continue;
        const double after = ownReach(input, k, time, skin, neighbours) + kick;
        if (room >= after) continue;
        raiseTo(m_raised[k], after);
        if (m_renewal[k] == 0) struck.push_back(k);
    }
}

// False if the neighbours must be searched.
bool BasePath::coversRenewed(Neighbours& neighbours) const {
    bool covered = true;
    for (const Renewed& renewed : m_renewed)
        covered = neighbours.covers(renewed.body, renewed.reach) && covered;
    return covered;
}

// Adds the missing pairs of bodies with a new reach and removes those that can no longer meet. Marks islands
// of different blocks that such a pair would join.
void BasePath::loadPairs(const SteppedInput& input, Neighbours& neighbours, Manifolds& manifolds) {
    for (const auto& [body, reach, isNarrowed] : m_renewed) {
        m_reach[body] = reach;
        m_origin[body] = input.state.pose[body];
        neighbours.settled().wake(body);
    }
    m_present.clear();
    for (SteppedMotion& block : m_blocks) {
        if (block.isEmpty()) continue;
        const auto isRenewed = [renewal = m_renewal.data()](const Entry& entry) {
            return (renewal[entry.pair.a] | renewal[entry.pair.b]) != 0;
        };
        const auto cannotMeet = [&](const Entry& entry) {
            return isRenewed(entry) &&
                   !areWithin(input.bodies, input.state, entry.pair, marginOf(input, entry.pair));
        };
        if (input.isFirst) block.drop(cannotMeet, manifolds, m_newNumbers, input.workers);
        const std::span<Entry> entries = block.entries();
        input.workers.forLists(entries.size(), fewPairs, static_cast<std::vector<Present>&>(m_present),
                               [&](std::size_t begin, std::size_t end, std::vector<Present>& present) {
                                   for (Entry& entry : entries.subspan(begin, end - begin)) {
                                       if (!isRenewed(entry)) continue;
                                       entry.margin = std::max(entry.margin, marginOf(input, entry.pair));
                                       present.push_back({entry.pair});
                                   }
                               });
    }
    m_sort.sort(m_present, input.bodies.count(), input.workers);
    m_missing.entries.clear();
    m_missing.parting.clear();
    input.workers.forLists(
        m_renewed.size(), fewSearched, static_cast<Missing&>(m_missing),
        [&](std::size_t begin, std::size_t end, Missing& missing) {
            for (std::size_t n = begin; n < end; ++n)
                findMissing(input, m_renewed[n].body, neighbours, missing);
        },
        [this](const Missing& part) { m_missing.append(part); });
    for (const BodyIndex body : m_missing.parting) mark(body);
    if (!m_missing.parting.empty())
        std::erase_if(m_missing.entries, [this](const Entry& entry) {
            const BodyIndex body = hereOf(entry.pair);
            return blockWith(body).islands().isMarked(body);
        });
    std::swap(static_cast<std::vector<Entry>&>(m_entering), m_missing.entries);
    std::sort(m_entering.begin(), m_entering.end());
    for (const Entry& entry : m_entering) {
        const auto [a, b] = entry.pair;
        SteppedMotion& block = blockWith(hereOf(entry.pair));
        if (has(a) && has(b)) block.islands().join(a, b);
        block.addLate(input, entry, manifolds);
    }
}

// Pairs of a body with a new reach that are not there. Bodies of different blocks that may meet must part
// with these.
void BasePath::findMissing(const SteppedInput& input, BodyIndex i, const Neighbours& neighbours,
                           Missing& missing) const {
    for (const BodyIndex k : neighbours.around(i)) {
        const bool mobile = input.bodies.mobile[k] != 0;
        if (mobile && (!has(k) || (m_renewal[k] > 0 && k < i) || blockWith(k).islands().isMarked(k)))
            continue;
        const BodyPair pair{std::min(i, k), std::max(i, k)};
        if (std::ranges::binary_search(m_sort.of(pair.a, m_present), pair, {}, &Present::pair)) continue;
        const double margin = marginOf(input, pair);
        if (!areWithin(input.bodies, input.state, pair, margin)) continue;
        if (mobile && m_block[i] != m_block[k])
            missing.parting.insert(missing.parting.end(), {i, k});
        else
            missing.entries.push_back(
                {.pair = pair, .margin = margin, .isNear = SteppedPairs::isNear(input, pair)});
    }
}

} // namespace carom
