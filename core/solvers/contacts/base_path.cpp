// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/base_path.h"

#include "core/base/shared_extremes.h"

#include <algorithm>
#include <utility>

namespace carom {
namespace {

/// Islands of up to so many contact points, but for balls with fewer than four, make eight sweeps a substep
/// or more, larger ones three or fewer. At twice, those in between cost nearly three times as much; at half,
/// they rest deeper in each other.
constexpr std::size_t fewPoints = 192;
/// Islands of balls with more contact points than this take one step a substep, smaller ones two. At twice,
/// those in between make twice as many sweeps; at half, one in place of two.
constexpr std::size_t manyPoints = 4 * fewPoints;
/// Contact points of an island, not one of balls alone, that is updated once a substep. With half or a
/// quarter of them it is updated two or four times, each time with all its sweeps. At twice, islands of 17 to
/// 64 points make twice as many sweeps; at half, those of 9 to 32 half as many.
constexpr std::size_t pointsOfOneLook = 64, mostLooks = 4;
/// An island of few balls moves to another block if it needs this many times the sweeps that its block makes.
/// At half, islands change blocks more often; at twice, an impact may pass on through fewer contacts.
constexpr int tooFew = 4;

/// Where more than one body in so many of an island gets new neighbours, what is to be put in order is so
/// before the next substep, otherwise when the next frame begins. At half, that happens more often; at twice,
/// passes go through more pairs out of order.
constexpr std::size_t fewRenewed = 4;
/// A body whose reach is this many times what it needs gets a new one when a frame begins. At half, more
/// bodies do; at twice, heaps that came to rest keep a fifth more pairs.
constexpr double tooFar = 3;
/// Bodies that one thread looks at least at; one takes some 30 ns. At half, waking a thread costs nearly what
/// it saves; at twice, a thousand bodies are looked at by one.
constexpr std::size_t fewBodies = 512;
/// The same of those whose neighbours are looked at; one takes some .5 us.
constexpr std::size_t fewSearched = 64;

/// Bodies get new neighbours only where at least one mobile body in so many takes the base path, because
/// those of all bodies may have to be found; else islands leave. At twice, a search for all is made for fewer
/// bodies; at half, islands leave more often.
constexpr std::size_t partHere = 4;

/// An impact passes on from one contact to the next in each sweep, so balls need as many sweeps as they have
/// contacts, and nearly twice as many from three on, up to those of an island with few points: with as many,
/// of 81 columns of balls that land one is a tenth of a radius in another. Bodies of other shapes turn and
/// touch at other points, so their contacts are updated the more often, the fewer they are. Large islands of
/// such bodies take three steps of one pass: overlaps at rest fall with the square of the step. With two
/// steps of two passes, which cost more, heaps of a hundred bodies come to rest as late, with overlaps twice
/// as deep; with two of one pass, three times as many frames of their fall have an overlap of more than a
/// tenth of a body's half size.
constexpr std::array<Division, 8> divisionsOfSubstep{Division{4, 4, 2}, {2, 4, 2}, {1, 4, 2}, {1, 2, 2},
                                                     {1, 1, 2},         {1, 2, 1}, {1, 1, 1}, {1, 3, 1}};

constexpr int sweepsOf(std::size_t number) {
    const Division& division = divisionsOfSubstep[number];
    return division.looks * division.steps * division.passes;
}

/// Only islands of few balls use these; contacts that they get later may need more sweeps.
constexpr bool isForFewBalls(std::size_t number) { return number == 3 || number == 4 || number == 6; }

/// The number of the division for an island.
std::uint8_t divisionNumber(const ContactCount& count) {
    if (count.points > fewPoints) return !count.round ? 7 : count.points > manyPoints ? 6 : 5;
    if (count.points == 0) return 2; // not known yet
    if (count.round) return count.points >= 4 ? 2 : count.points >= 3 ? 3 : count.points >= 2 ? 4 : 6;
    const std::size_t looks = std::clamp(pointsOfOneLook / count.points, std::size_t{1}, mostLooks);
    return looks >= 4 ? 0 : looks >= 2 ? 1 : 2;
}

/// Whether this division makes more sweeps than the island needs, or far fewer.
bool isWrong(std::size_t number, const ContactCount& count) {
    if (count.points == 0) return false;
    const int sweeps = sweepsOf(number), needed = sweepsOf(divisionNumber(count));
    return needed < sweeps || (isForFewBalls(number) && needed >= tooFew * sweeps);
}

/// Whether the island cannot keep this division until the next frame. Too many sweeps are accepted while it
/// has few points.
bool isFarWrong(std::size_t number, const ContactCount& count) {
    return isWrong(number, count) &&
           (count.points > fewPoints || sweepsOf(divisionNumber(count)) > sweepsOf(number));
}

Division divisionOf(std::uint8_t number, int passes) {
    Division division = divisionsOfSubstep[number];
    division.passes *= passes;
    return division;
}

} // namespace

Division BasePath::divisionFor(const ContactCount& count, int passes) {
    return divisionOf(divisionNumber(count), passes);
}

Division BasePath::divisionFor(const Island& island, const ContactCount& count) const {
    const std::uint8_t last = m_lastBlock[island.bodies.front()];
    if (last == noBlock) return divisionFor(count, m_passes);
    return divisionOf(static_cast<std::uint8_t>(last - 1), m_passes);
}

std::size_t BasePath::islands() const {
    std::size_t sum = 0;
    for (const SteppedMotion& block : m_blocks)
        if (!block.isEmpty()) sum += block.islands();
    return sum;
}

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

bool BasePath::markIfMoved(const State& state) {
    const bool isMoved = std::any_of(m_blocks.begin(), m_blocks.end(), [&](const SteppedMotion& block) {
        return !block.isEmpty() && !block.isUnchanged(state);
    });
    if (isMoved) markIslands([](BodyIndex) { return true; });
    return isMoved;
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
        outrun[number].assign(block(number).isEmpty() ? 0 : block(number).islandNumbers(), 0);
    for (const Renewed& renewed : m_renewed) {
        SteppedMotion& block = blockWith(renewed.body);
        const std::uint32_t island = block.islandOf(renewed.body);
        if (fewRenewed * ++outrun[m_block[renewed.body] - 1u][island] > block.bodiesOf(island))
            block.orderSoon();
    }
    const auto leaves = [this](const Renewed& renewed) {
        const bool is = blockWith(renewed.body).isMarked(renewed.body);
        if (is) m_renewal[renewed.body] = 0;
        return is;
    };
    std::erase_if(m_renewed, leaves);
}

// Finds the bodies that may move beyond their reach, and gives them a new one: not those that have settled.
void BasePath::findOutrun(const SteppedInput& input, double time, double skin, const Neighbours& neighbours) {
    m_room.resize(input.bodies.count());
    for (const SteppedMotion& block : m_blocks) {
        m_active.clear();
        for (const BodyIndex i : block.bodies())
            if (!neighbours.settled().has(i)) m_active.push_back(i);
        m_isOutrun.resize(m_active.size());
        input.workers.forRanges(m_active.size(), fewBodies, [&](std::size_t begin, std::size_t end) {
            for (std::size_t n = begin; n < end; ++n) {
                const BodyIndex i = m_active[n];
                m_room[i] = roomOf(input, i);
                m_isOutrun[n] = neighbours.reach(i) > m_room[i] ? 1 : 0;
            }
        });
        for (std::size_t n = 0; n < m_active.size(); ++n) {
            const BodyIndex i = m_active[n];
            if (block.isMarked(i)) continue;
            const bool isOutrun = m_isOutrun[n] != 0;
            if (!isOutrun && !input.isFirst) continue;
            const double reach = ownReach(input, i, time, skin, neighbours);
            if (!isOutrun && m_reach[i] <= tooFar * reach) continue;
            m_renewed.push_back({i, reach, !isOutrun});
            m_renewal[i] = static_cast<std::uint32_t>(m_renewed.size());
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
                    Neighbours::reachAfter(bodies, body, own, striker, neighbours.reach(striker)) - own);
}

// Extends the reach of bodies that one of these may strike, as prepare() would.
void BasePath::findStruck(const SteppedInput& input, double time, double skin, const Neighbours& neighbours) {
    for (std::size_t n = 0, outrun = m_renewed.size(); n < outrun; ++n) {
        const auto [i, reach, isNarrowed] = m_renewed[n];
        for (const BodyIndex k : neighbours.around(i)) {
            if (input.bodies.mobile[k] == 0 || !has(k)) continue;
            if (isNarrowed && areWithin(input.bodies, input.state, {i, k}, reach + m_reach[k]))
                raiseTo(m_renewed[n].reach, reach + kickOf(input, i, k, neighbours));
            const double room = m_renewal[k] > 0 ? m_renewed[m_renewal[k] - 1].reach : m_room[k];
            if (!areWithin(input.bodies, input.state, {i, k}, reach + room)) continue;
            const double kick = kickOf(input, k, i, neighbours);
            if (!(kick > 0)) continue;
            const double after = ownReach(input, k, time, skin, neighbours) + kick;
            if (room >= after) continue;
            if (m_renewal[k] == 0) {
                m_renewed.push_back({k, after});
                m_renewal[k] = static_cast<std::uint32_t>(m_renewed.size());
            } else {
                m_renewed[m_renewal[k] - 1].reach = after;
            }
        }
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
        const auto isRenewed = [this](const Entry& entry) {
            return m_renewal[entry.pair.a] != 0 || m_renewal[entry.pair.b] != 0;
        };
        const auto cannotMeet = [&](const Entry& entry) {
            return isRenewed(entry) &&
                   !areWithin(input.bodies, input.state, entry.pair, marginOf(input, entry.pair));
        };
        if (input.isFirst) block.drop(cannotMeet, manifolds, m_newNumbers);
        block.forEachEntry([&](Entry& entry) {
            if (!isRenewed(entry)) return;
            entry.margin = std::max(entry.margin, marginOf(input, entry.pair));
            m_present.push_back({entry.pair});
        });
    }
    m_sort.sort(m_present, input.bodies.count());
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
            return blockWith(body).isMarked(body);
        });
    std::swap(static_cast<std::vector<Entry>&>(m_entering), m_missing.entries);
    std::sort(m_entering.begin(), m_entering.end());
    for (const Entry& entry : m_entering) {
        const auto [a, b] = entry.pair;
        SteppedMotion& block = blockWith(hereOf(entry.pair));
        if (has(a) && has(b)) block.joinIslands(block.islandOf(a), block.islandOf(b));
        block.addLate(input, entry, manifolds);
    }
}

// Pairs of a body with a new reach that are not there. Bodies of different blocks that may meet must part
// with these.
void BasePath::findMissing(const SteppedInput& input, BodyIndex i, const Neighbours& neighbours,
                           Missing& missing) const {
    for (const BodyIndex k : neighbours.around(i)) {
        const bool mobile = input.bodies.mobile[k] != 0;
        if (mobile && (!has(k) || (m_renewal[k] > 0 && k < i) || blockWith(k).isMarked(k))) continue;
        const BodyPair pair{std::min(i, k), std::max(i, k)};
        if (std::ranges::binary_search(m_sort.of(pair.a, m_present), pair, {}, &Present::pair)) continue;
        const double margin = marginOf(input, pair);
        if (!areWithin(input.bodies, input.state, pair, margin)) continue;
        if (mobile && m_block[i] != m_block[k])
            missing.parting.insert(missing.parting.end(), {i, k});
        else
            missing.entries.push_back(
                {.pair = pair, .margin = margin, .isNear = SteppedMotion::isNear(input, pair)});
    }
}

bool BasePath::prepare(const SteppedInput& input, std::span<const BodyIndex> list, double time, double skin,
                       Neighbours& neighbours) {
    const Bodies& bodies = input.bodies;
    bool covered = coversThoseHere(neighbours);
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
    for (const BodyIndex i : list) covered = neighbours.covers(i, m_reach[i]) && covered;
    if (!covered) return false;
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
    for (const BodyIndex i : list) {
        m_reach[i] += m_kick[i];
        covered = neighbours.covers(i, m_reach[i]) && covered;
    }
    return covered;
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
        for (const BodyIndex i : block.bodies())
            if (m_renewal[i] == 0) covered = neighbours.covers(i, std::max(0.0, m_room[i])) && covered;
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
                            {.pair = pair, .margin = margin, .isNear = SteppedMotion::isNear(input, pair)});
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

ContactCount BasePath::countOf(const Island& island, const Manifolds& manifolds) const {
    ContactCount count;
    for (const std::uint32_t index : island.pairs)
        if (const std::uint32_t place = m_entering[index].place; place != Manifolds::none)
            count.add(manifolds[place].count, manifolds[place].round);
    return count;
}

void BasePath::enter(const SteppedInput& input, std::span<const BodyIndex> list, const Neighbours& neighbours,
                     std::span<const BodyPair> links, double substep, std::span<Manifolds::Entry> known,
                     Manifolds& manifolds) {
    findPairs(input, list, neighbours, known);
    m_pairs.clear();
    for (const Entry& entry : m_entering) m_pairs.push_back(entry.pair);
    m_islands.find(input.bodies, list, m_pairs, links);
    m_isEmpty = m_isEmpty && list.empty();
    m_numbers.clear();
    std::array<std::vector<ContactCount>, divisions>& counts = m_counts;
    for (std::vector<ContactCount>& ofBlock : counts) ofBlock.clear();
    for (std::size_t i = 0; i < m_islands.count(); ++i) {
        const Island island = m_islands[i];
        m_numbers.push_back(numberFor(island, manifolds));
        addIsland(input, island, m_numbers[i], substep);
    }
    // Pairs that touch come first, so that groups of four hold either active or idle pairs.
    for (const bool near : {true, false})
        for (std::size_t i = 0; i < m_islands.count(); ++i)
            for (const std::uint32_t index : m_islands[i].pairs)
                if (m_entering[index].isNear == near)
                    loadMember(input, m_islands[i].bodies.front(), m_numbers[i], m_entering[index],
                               manifolds);
    for (std::size_t i = 0; i < m_islands.count(); ++i)
        for (const BodyIndex body : m_islands[i].bodies) {
            m_block[body] = m_numbers[i];
            m_room[body] = roomOf(input, body);
        }
}

void BasePath::enterBriefly(const SteppedInput& input, std::span<const Island> islands,
                            std::span<const Entry> pairs, double substep, Manifolds& manifolds) {
    m_isEmpty = m_isEmpty && islands.empty();
    m_numbers.clear();
    std::size_t first = 0;
    for (const Island& island : islands) {
        ContactCount count;
        for (const Entry& entry : pairs.subspan(first, island.pairs.size()))
            count.add(manifolds[entry.place].count, manifolds[entry.place].round);
        first += island.pairs.size();
        const std::uint8_t number = static_cast<std::uint8_t>(divisionNumber(count) + 1);
        m_numbers.push_back(number);
        addIsland(input, island, number, substep);
        for (const BodyIndex body : island.bodies) m_block[body] = number;
    }
    for (const bool near : {true, false})
        for (const Entry& entry : pairs)
            if (entry.isNear == near) blockWith(hereOf(entry.pair)).addPair(input, entry, manifolds);
}

void BasePath::addIsland(const SteppedInput& input, const Island& island, std::uint8_t number,
                         double substep) {
    SteppedMotion& block = m_blocks[number - 1u];
    if (block.isEmpty())
        block.begin(input.bodies, divisionOf(static_cast<std::uint8_t>(number - 1), m_passes), substep);
    block.addIsland(input, island.bodies, island.links);
}

// The block for an island that enters: that of the bodies it meets on the base path, else by its contacts.
std::uint8_t BasePath::numberFor(const Island& island, const Manifolds& manifolds) {
    ContactCount count = countOf(island, manifolds);
    for (const std::uint32_t index : island.pairs) {
        const BodyIndex here = hereOf(m_entering[index].pair);
        if (here == noBody) continue;
        const std::size_t number = m_block[here] - 1u;
        std::array<std::vector<ContactCount>, divisions>& counts = m_counts;
        if (counts[number].empty()) countContacts(number, manifolds);
        count.add(counts[number][block(number).islandOf(here)]);
        if (isFarWrong(number, count)) mark(here);
        return m_block[here];
    }
    return static_cast<std::uint8_t>(divisionNumber(count) + 1);
}

// Adds a pair of an island whose bodies, `member` among them, are in the block already.
void BasePath::loadMember(const SteppedInput& input, BodyIndex member, std::uint8_t number, Entry& entry,
                          Manifolds& manifolds) {
    SteppedMotion& block = m_blocks[number - 1u];
    const BodyIndex here = hereOf(entry.pair);
    if (here != noBody && m_block[here] != number) {
        mark(here); // too far away for this substep, else findJoining() had marked it
        block.mark(block.islandOf(member));
        if (entry.place != Manifolds::none) manifolds.remove(entry.place);
        return;
    }
    block.addPair(input, entry, manifolds);
    if (here == noBody) return;
    block.joinIslands(block.islandOf(here), block.islandOf(member));
}

SteppedReport BasePath::advance(const SteppedInput& input, Manifolds& manifolds) {
    SteppedReport report;
    for (SteppedMotion& block : m_blocks) {
        if (block.isEmpty() || report.loss) continue;
        const SteppedReport one = block.advance(input, manifolds);
        report.residual = std::max(report.residual, one.residual);
        report.maxPenetration = std::max(report.maxPenetration, one.maxPenetration);
        report.contacts += one.contacts;
        report.work.add(one.work);
        report.loss = one.loss;
    }
    return report;
}

// Counts the contacts of the islands of a block, as of the last substep.
void BasePath::countContacts(std::size_t number, const Manifolds& manifolds) {
    std::array<std::vector<ContactCount>, divisions>& all = m_counts;
    std::vector<ContactCount>& counts = all[number];
    counts.assign(block(number).islandNumbers(), {});
    block(number).forEachCount(manifolds, [&](std::uint32_t island, int points, bool isRound) {
        counts[island].add(points, isRound);
    });
}

bool BasePath::markOutgrown(const Manifolds& manifolds) {
    const std::array<std::vector<ContactCount>, divisions>& counts = m_counts;
    bool any = false;
    for (std::size_t number = 0; number < divisions; ++number) {
        SteppedMotion& block = m_blocks[number];
        if (block.isEmpty()) continue;
        countContacts(number, manifolds);
        for (std::uint32_t island = 0; island < counts[number].size(); ++island) {
            if (!isWrong(number, counts[number][island])) continue;
            block.mark(island);
            any = true;
        }
    }
    return any;
}

std::size_t BasePath::bytes() const {
    std::size_t sum = heldBytes(m_reach, m_origin, m_block, m_lastBlock, m_renewed, m_renewal);
    for (const Block& block : m_blocks) sum += block.bytes();
    return sum;
}

void BasePath::leaveMarked(const SteppedInput& input, Manifolds& manifolds, std::vector<BodyIndex>& left,
                           std::vector<Manifolds::Entry>& carried) {
    left.clear();
    m_leaving.clear();
    m_isEmpty = true;
    for (SteppedMotion& block : m_blocks) {
        if (block.isEmpty()) continue;
        block.leave(input, manifolds, m_newNumbers, left, m_leaving);
        m_isEmpty = m_isEmpty && block.isEmpty();
    }
    for (const BodyIndex body : left) m_lastBlock[body] = std::exchange(m_block[body], noBlock);
    for (const Entry& entry : m_leaving) carried.push_back({entry.pair, entry.place});
}

void BasePath::leave(const SteppedInput& input, Manifolds& manifolds,
                     std::vector<Manifolds::Entry>& carried) {
    m_leaving.clear();
    for (SteppedMotion& block : m_blocks) {
        if (block.isEmpty()) continue;
        for (const BodyIndex body : block.bodies()) m_block[body] = noBlock;
        block.end(input, manifolds, m_leaving);
    }
    for (const Entry& entry : m_leaving) carried.push_back({entry.pair, entry.place});
    m_isEmpty = true;
}

void BasePath::clear() {
    for (SteppedMotion& block : m_blocks) {
        for (const BodyIndex body : block.bodies()) m_block[body] = noBlock;
        block.clear();
    }
    m_isEmpty = true;
}

} // namespace carom
