// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/stepped_islands.h"

#include <algorithm>
#include <functional>

namespace carom {

void SteppedIslands::begin(std::size_t bodies) {
    clear();
    m_local.resize(bodies, 0);
    m_island.assign(1, 0);
    m_slab.assign(1, 0);
    m_groups.clear();
    m_joined = 0;
    m_isSettled = true;
    m_isMarked = m_isUnordered = false;
    m_plan.forget();
}

void SteppedIslands::clear() {
    for (const BodyIndex body : m_list) m_local[body] = 0;
    m_list.clear();
}

void SteppedIslands::add(std::span<const BodyIndex> list) {
    m_plan.forget();
    const std::uint32_t island = static_cast<std::uint32_t>(m_groups.size());
    m_groups.push_back({.joined = island, .bodies = list.size()});
    for (const BodyIndex body : list) {
        m_local[body] = numbers();
        m_list.push_back(body);
        m_island.push_back(island);
        m_slab.push_back(0);
    }
    if (list.size() < 2 * Slabs::fewBodies) return;
    m_groups.back().unordered = list.size(); // it is to be divided
    m_isUnordered = true;
}

void SteppedIslands::join(BodyIndex one, BodyIndex other) {
    if (of(one) == of(other)) return;
    Group &into = m_groups[of(one)], &from = m_groups[of(other)];
    from.joined = of(one);
    into.bodies += from.bodies;
    into.leaves = into.leaves || from.leaves;
    into.hasStill = into.hasStill || from.hasStill;
    into.unordered = into.bodies; // it is to be divided anew
    m_isUnordered = true;
    ++m_joined;
    m_isSettled = false;
}

void SteppedIslands::settle() {
    if (std::exchange(m_isSettled, true)) return;
    m_plan.forget();
    for (std::size_t i = 1; i < m_island.size(); ++i) m_island[i] = rootOf(m_island[i]);
}

void SteppedIslands::leave(std::vector<std::uint32_t>& bodies) {
    std::uint32_t kept = 0;
    m_newIslands.assign(m_groups.size(), gone);
    for (std::uint32_t i = 0; i < m_groups.size(); ++i) {
        if (m_groups[i].joined != i || m_groups[i].leaves) continue;
        m_groups[kept] = m_groups[i];
        m_groups[kept].joined = kept;
        m_newIslands[i] = kept++;
    }
    m_groups.resize(kept);
    m_joined = 0;
    m_isMarked = false;
    m_plan.forget();

    kept = 1;
    bodies.assign(m_island.size(), gone);
    bodies[immobile] = immobile;
    for (std::uint32_t i = 1; i < m_island.size(); ++i) {
        const BodyIndex body = bodyOf(i);
        const std::uint32_t island = m_newIslands[m_island[i]];
        m_local[body] = island == gone ? immobile : kept;
        if (island == gone) continue;
        m_list[kept - 1] = body;
        m_island[kept] = island;
        m_slab[kept] = m_slab[i];
        bodies[i] = kept++;
    }
    m_list.resize(kept - 1);
    m_island.resize(kept);
    m_slab.resize(kept);
}

void SteppedIslands::noteStill(std::span<const std::uint8_t> isStill) {
    for (Group& group : m_groups) group.hasStill = false;
    for (std::uint32_t i = 1; i < m_island.size(); ++i)
        if (isStill[i] != 0) m_groups[m_island[i]].hasStill = true;
}

bool SteppedIslands::divide(const SteppedInput& input) {
    m_divided.clear();
    if (!std::exchange(m_isUnordered, false) ||
        std::none_of(m_groups.begin(), m_groups.end(), std::mem_fn(&Group::isUnordered)))
        return false;
    m_plan.forget();
    for (std::uint32_t i = 1; i < m_island.size(); ++i)
        if (m_groups[m_island[i]].isUnordered()) m_divided.push_back(i);
    const auto isBefore = [this](std::uint32_t one, std::uint32_t other) {
        return m_island[one] < m_island[other];
    };
    if (!std::is_sorted(m_divided.begin(), m_divided.end(), isBefore))
        std::stable_sort(m_divided.begin(), m_divided.end(), isBefore);
    for (auto from = m_divided.begin(); from != m_divided.end();) {
        const std::uint32_t island = m_island[*from];
        const auto to =
            std::find_if(from, m_divided.end(), [&](std::uint32_t i) { return m_island[i] != island; });
        m_slabs.clear();
        for (auto i = from; i != to; ++i)
            m_slabs.add(input.state.pose[bodyOf(*i)].position, input.bodies.boundingRadius[bodyOf(*i)]);
        for (const std::uint8_t slab : m_slabs.divide(input.gravity, input.workers)) m_slab[*from++] = slab;
    }
    return true;
}

void SteppedIslands::noteOrdered() {
    for (Group& group : m_groups)
        if (group.isUnordered()) group.unordered = 0;
}

} // namespace carom
