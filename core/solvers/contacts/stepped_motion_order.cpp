// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/contact_settings.h"
#include "core/solvers/contacts/neighbours.h"
#include "core/solvers/contacts/stepped_motion.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>

// The order in which passes of the base path go through its pairs.

namespace carom {
namespace {

/// A pair is near that is nearer than this part of the smaller one's size: twice the gap at which it may
/// touch however slow it is. Half would be that gap, which a pair can close at once; twice keeps more pairs.
constexpr double nearPart = 2 * slackPart;
/// Groups of balls of which one thread looks at the pairs, at least.
constexpr std::size_t fewPlaced = Workers::enoughOf(50);

} // namespace

// Passes solve for pairs in the order of their bodies' numbers, from the top to the ground, not in that in
// which they were added: a heap whose lowest contacts are solved first does not come to rest.
void SteppedMotion::order(const SteppedInput& input) {
    const bool isUnordered = m_islands.divide(input.bodies, input.state, input.gravity);
    for (const std::uint32_t i : m_islands.divided()) m_bodies.noteFar(i); // rows follow suit
    if (m_ascending < m_general.size()) orderGeneral();
    if (isUnordered) orderBalls(input);
}

// Inserts the pairs that were added among those that are in order.
void SteppedMotion::orderGeneral() {
    forgetPairs();
    const auto isBefore = [this](std::uint32_t one, std::uint32_t other) {
        return m_entries[one] < m_entries[other];
    };
    m_added.assign(m_general.begin() + static_cast<std::ptrdiff_t>(m_ascending), m_general.end());
    std::sort(m_added.begin(), m_added.end(), isBefore);
    std::size_t end = m_ascending, to = m_general.size(); // from the end on, so that each moves once
    while (!m_added.empty()) {
        const std::uint32_t entry = m_added.back();
        const std::size_t place = static_cast<std::size_t>(
            std::upper_bound(m_general.begin(), m_general.begin() + static_cast<std::ptrdiff_t>(end), entry,
                             isBefore) -
            m_general.begin());
        while (end > place) renumberGeneral(--end, --to);
        m_general[--to] = entry;
        m_open[to] = {};
        m_heldDepth[to] = -1;
        m_added.pop_back();
    }
    m_ascending = m_general.size();
}

void SteppedMotion::renumberGeneral(std::size_t from, std::size_t to) {
    m_general[to] = m_general[from];
    m_open[to] = m_open[from];
    m_heldDepth[to] = m_heldDepth[from];
    m_open[to].watched.open = static_cast<std::uint32_t>(to);
}

// Removes pairs whose new number is `gone`; the others get theirs.
void SteppedMotion::renumberEntries(std::vector<std::uint32_t>& numbers) {
    std::uint32_t kept = 0;
    for (std::uint32_t i = 0; i < m_entries.size(); ++i) {
        if (numbers[i] == gone) continue;
        m_entries[kept] = m_entries[i];
        m_isFlipped[kept] = m_isFlipped[i];
        if (i < m_laws.size()) m_laws[kept] = m_laws[i];
        numbers[i] = kept++;
    }
    m_entries.resize(kept);
    m_isFlipped.resize(kept);
    m_laws.resize(std::min<std::size_t>(m_laws.size(), kept));
    std::size_t general = 0, ascending = 0;
    for (std::size_t number = 0; number < m_general.size(); ++number) {
        const std::uint32_t entry = numbers[m_general[number]];
        if (entry == gone) continue;
        ascending += number < m_ascending ? 1 : 0;
        renumberGeneral(number, general);
        m_general[general] = m_open[general].watched.entry = entry;
        ++general;
    }
    m_general.resize(general);
    m_open.resize(general);
    m_heldDepth.resize(general);
    m_ascending = ascending;
}

// Sorts the pairs of balls of islands that are not in order. In the others, which have other rows then, all
// stay in the order that they have, so that it depends on no other island.
void SteppedMotion::orderBalls(const SteppedInput& input) {
    auto& [near, far, late] = static_cast<PlacedPairs&>(m_placedPairs);
    m_placedPairs.clear();
    input.workers.forLists(
        m_balls.groups(), fewPlaced, static_cast<PlacedPairs&>(m_placedPairs),
        [&](std::size_t begin, std::size_t end, PlacedPairs& part) {
            m_balls.forEachPlace(begin, end, [&](std::uint32_t index, std::uint32_t place) {
                Entry& entry = m_entries[index];
                if (m_islands.isUnordered(entry.pair)) {
                    entry.isNear = isNear(input, entry.pair);
                    entry.isLate = false;
                }
                (entry.isLate   ? part.late
                 : entry.isNear ? part.near
                                : part.far)
                    .push_back({entry.pair, place});
            });
        },
        [this](const PlacedPairs& part) { m_placedPairs.append(part); });
    m_islands.noteOrdered();
    for (std::vector<PlacedPair>* list : {&near, &far}) m_sort.sort(*list, input.bodies.count());
    near.insert(near.end(), far.begin(), far.end());
    const std::span<const SectionEnd> sections = m_islands.plan().sort(
        near, far, [this](const PlacedPair& placed) { return m_islands.numbersOf(placed.pair); });
    m_order.clear();
    for (const std::vector<PlacedPair>* list : {&near, &late})
        for (const PlacedPair& placed : *list) m_order.push_back(placed.place);
    m_balls.reorder(m_order, immobile, sections, input.workers);
}

bool SteppedMotion::isNear(const SteppedInput& input, BodyPair pair) {
    const double a = input.bodies.boundingRadius[pair.a], b = input.bodies.boundingRadius[pair.b];
    if (!(a > 0 && b > 0)) // a wall has no radius
        return boundingGap(input.bodies, input.state, pair) <= nearPart * std::max(a, b);
    const double distance = (input.state.pose[pair.b].position - input.state.pose[pair.a].position).norm();
    return distance - (a + b) <= nearPart * std::min(a, b);
}

} // namespace carom
