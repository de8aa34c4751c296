// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/base_path.h"

#include "core/solvers/contacts/calm.h"

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

/// Islands of more than so many levels make two passes a step. In a column of n bodies one pass suffices up
/// to n = π/√r = 11.6 (velocity_solve.h), where r is what feedback takes of a gap in a step: with one, brick
/// walls of twenty courses sway for ever, and rise by some 1e-3 of a brick in a second. At half, heaps of a
/// hundred bodies make twice the passes; at twice, such walls sway.
constexpr std::uint32_t fewLevels = 10;
/// Bodies bear levels up to this part of √(size g): what is faster falls or slides, and does not sway. At
/// half, walls that sway by more than that do so for longer; at twice, heaps make two passes while they fall.
constexpr double bearing = 5 * calmSpeed;
/// A block that is tall remains so down to this part of it.
constexpr double stillTall = 0.75;
constexpr int passesOfTall = 2; // times those of others
/// Levels are counted once in so many frames. At half, heaps that stand still cost more; at twice, a wall
/// that has just been built sways for longer.
constexpr int framesOfLevels = 16;

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

constexpr std::size_t ofMany = 7; // of large islands that are not of balls alone

constexpr int sweepsOf(std::size_t number) {
    const Division& division = divisionsOfSubstep[number];
    return division.looks * division.steps * division.passes;
}

/// Only islands of few balls use these; contacts that they get later may need more sweeps.
constexpr bool isForFewBalls(std::size_t number) { return number == 3 || number == 4 || number == 6; }

/// The number of the division for an island.
std::uint8_t divisionNumber(const ContactCount& count) {
    if (count.points > fewPoints) return !count.round ? ofMany : count.points > manyPoints ? 6 : 5;
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
        if (!block.isEmpty()) sum += block.islands().count();
    return sum;
}

bool BasePath::markIfMoved(const State& state, Workers& workers) {
    const bool isMoved = std::any_of(m_blocks.begin(), m_blocks.end(), [&](const SteppedMotion& block) {
        return !block.isEmpty() && !block.isUnchanged(state, workers);
    });
    if (isMoved) markIslands([](BodyIndex) { return true; });
    return isMoved;
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
        m_numbers.push_back(numberFor(island, manifolds, input.workers));
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
std::uint8_t BasePath::numberFor(const Island& island, const Manifolds& manifolds, Workers& workers) {
    ContactCount count = countOf(island, manifolds);
    for (const std::uint32_t index : island.pairs) {
        const BodyIndex here = hereOf(m_entering[index].pair);
        if (here == noBody) continue;
        const std::size_t number = m_block[here] - 1u;
        std::array<std::vector<ContactCount>, divisions>& counts = m_counts;
        if (counts[number].empty()) countContacts(number, manifolds, workers);
        count.add(counts[number][block(number).islands().of(here)]);
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
        block.islands().mark(block.islands().of(member));
        if (entry.place != Manifolds::none) manifolds.remove(entry.place);
        return;
    }
    block.addPair(input, entry, manifolds);
    if (here == noBody) return;
    block.islands().join(here, member);
}

SteppedReport BasePath::advance(const SteppedInput& input, Manifolds& manifolds) {
    SteppedReport report;
    for (std::size_t number = 0; number < divisions; ++number) {
        SteppedMotion& block = m_blocks[number];
        if (block.isEmpty() || report.loss) continue;
        if (number == ofMany) block.setPasses(m_passes * (m_isTall ? passesOfTall : 1));
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
void BasePath::countContacts(std::size_t number, const Manifolds& manifolds, Workers& workers) {
    std::array<std::vector<ContactCount>, divisions>& all = m_counts;
    using Counts = std::vector<ContactCount>;
    const Counts none(block(number).islands().islandNumbers());
    Counts& counts = all[number];
    counts = none;
    block(number).count(
        manifolds, counts, none,
        [](Counts& to, std::uint32_t island, int points, bool isRound) { to[island].add(points, isRound); },
        [&counts](const Counts& part) {
            for (std::size_t island = 0; island < part.size(); ++island) counts[island].add(part[island]);
        },
        workers);
}

void BasePath::countLevels(const SteppedInput& input, const Manifolds& manifolds) {
    if (m_untilLevels-- > 0) return;
    m_untilLevels = framesOfLevels - 1;
    SteppedMotion& block = this->block(ofMany);
    const double most = m_isTall ? stillTall * fewLevels : fewLevels;
    m_isTall = !block.isEmpty() && levelsOf(input, block, manifolds) > most;
}

// How many levels the bodies of a block lie in, as of the last substep: those that bear each other.
std::uint32_t BasePath::levelsOf(const SteppedInput& input, SteppedMotion& block,
                                 const Manifolds& manifolds) {
    const auto bears = [&](BodyIndex body) {
        return input.bodies.mobile[body] == 0 ||
               isSlowerThan(bearing, input.bodies, input.state, body, input.gravity);
    };
    m_touching.clear();
    for (const Entry& entry : block.entries())
        if (entry.place != Manifolds::none && manifolds[entry.place].count > 0 &&
            !manifolds[entry.place].open && bears(entry.pair.a) && bears(entry.pair.b))
            m_touching.push_back(entry.pair);
    const auto numberOf = [&](BodyIndex body) { return input.bodies.mobile[body] != 0 ? body + 1 : 0; };
    m_ends.make(m_touching.size(), m_block.size() + 1, [&](std::size_t pair) {
        return PairEnds::Ends{numberOf(m_touching[pair].a), numberOf(m_touching[pair].b)};
    });
    m_level.assign(m_block.size() + 1, 0);
    m_reached.clear();
    const auto reach = [&](std::uint32_t body, std::uint32_t level) {
        if (body == 0 || m_level[body] != 0) return;
        m_level[body] = level;
        m_reached.push_back(body);
    };
    for (const auto& [a, b] : m_ends.all())
        if (a == 0 || b == 0) reach(std::max(a, b), 1);
    for (std::size_t i = 0; i < m_reached.size(); ++i)
        for (const std::uint32_t pair : m_ends.pairsOf(m_reached[i]))
            for (const std::uint32_t body : {m_ends.of(pair).first, m_ends.of(pair).second})
                reach(body, m_level[m_reached[i]] + 1);
    return m_reached.empty() ? 0 : m_level[m_reached.back()];
}

bool BasePath::markOutgrown(const Manifolds& manifolds, Workers& workers) {
    const std::array<std::vector<ContactCount>, divisions>& counts = m_counts;
    bool any = false;
    for (std::size_t number = 0; number < divisions; ++number) {
        SteppedMotion& block = m_blocks[number];
        if (block.isEmpty()) continue;
        countContacts(number, manifolds, workers);
        for (std::uint32_t island = 0; island < counts[number].size(); ++island) {
            if (!isWrong(number, counts[number][island])) continue;
            block.islands().mark(island);
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
