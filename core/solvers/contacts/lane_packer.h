// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/held_bytes.h"
#include "core/base/wide.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

// Puts pairs into groups of four, so that four lanes can be solved at once. A pair goes into the first group
// that has room and that comes after all groups of both of its bodies:
//
//     pairs    (1,2)  (1,3)  (2,3)  (4,5)  (4,6)
//     groups   (1,2) (4,5)    |    (1,3) (4,6)    |    (2,3)
//
// So pairs that share a body are in the order in which they came, and pairs that share none are independent:
// a pass through the groups gives, to the bit, the result of a pass through the pairs one after the other,
// whatever other pairs there are. The cost is that a chain of pairs, each of which shares a body with the
// next, has a group for each.
//
// Which groups have room is a set of bits, so that looking for one is a step for every 64 of them.

namespace carom {

class LanePacker {
  public:
    /// Groups of different kinds are numbered together.
    static constexpr std::size_t kinds = 3;
    struct Place {
        std::uint32_t group = 0, lane = 0;
        bool isNew = false; ///< the group was not there before
    };

    /// There are so many groups, which take no pairs; bodies as before.
    void restart(std::size_t groups = 0) {
        m_free.assign(groups, 0);
        std::fill(m_next.begin(), m_next.end(), 0U);
        for (std::size_t kind = 0; kind < kinds; ++kind) {
            m_open[kind].assign((groups + wordBits - 1) / wordBits, 0);
            m_firstOpen[kind] = m_open[kind].empty() ? 0 : m_open[kind].size() - 1;
        }
    }
    void clear() {
        m_next.clear();
        restart();
    }
    std::size_t bodies() const { return m_next.size(); }
    /// Bodies are numbered below `bodies` from now on.
    void reserve(std::size_t bodies) {
        if (m_next.size() < bodies) m_next.resize(bodies, 0);
    }
    /// A body that cannot move may be in several lanes of a group: `shared` is one.
    Place place(std::uint32_t a, std::uint32_t b, std::uint32_t shared, std::size_t kind = 0) {
        const std::uint32_t first = std::max(a == shared ? 0 : m_next[a], b == shared ? 0 : m_next[b]);
        std::size_t group = openFrom(first, kind);
        const bool isNew = group == m_free.size();
        if (isNew) addGroup(kind, allLanes);
        std::uint8_t& free = m_free[group];
        const std::uint32_t lane = static_cast<std::uint32_t>(std::countr_zero(free));
        free = static_cast<std::uint8_t>(free & (free - 1U));
        if (free == 0) close(group, kind);
        m_next[a] = m_next[b] = static_cast<std::uint32_t>(group + 1);
        return {static_cast<std::uint32_t>(group), lane, isNew};
    }
    /// The next group, with pairs in some lanes: (a, b) of lane k if bit k of `used` is 1.
    void keep(const std::array<std::uint32_t, wideLanes>& a, const std::array<std::uint32_t, wideLanes>& b,
              unsigned used, std::size_t kind = 0) {
        addGroup(kind, static_cast<std::uint8_t>(allLanes & ~used));
        for (std::size_t lane = 0; lane < wideLanes; ++lane)
            if ((used >> lane & 1U) != 0)
                m_next[a[lane]] = m_next[b[lane]] = static_cast<std::uint32_t>(m_free.size());
    }
    /// Groups that there are take no more.
    void closeAll() {
        for (std::size_t kind = 0; kind < kinds; ++kind) {
            std::fill(m_open[kind].begin(), m_open[kind].end(), std::uint64_t{0});
            m_firstOpen[kind] = m_open[kind].empty() ? 0 : m_open[kind].size() - 1;
        }
    }
    std::size_t bytes() const {
        std::size_t sum = heldBytes(m_free, m_next);
        for (const std::vector<std::uint64_t>& open : m_open) sum += heldBytes(open);
        return sum;
    }

  private:
    static constexpr std::uint8_t allLanes = (1U << wideLanes) - 1;
    static constexpr std::size_t wordBits = 64;

    /// The first group from `first` on that has room, or the number of groups.
    std::size_t openFrom(std::size_t first, std::size_t kind) const {
        const std::vector<std::uint64_t>& open = m_open[kind];
        for (std::size_t word = std::max(first / wordBits, m_firstOpen[kind]); word < open.size(); ++word) {
            std::uint64_t bits = open[word];
            if (word == first / wordBits) bits &= ~std::uint64_t{0} << first % wordBits;
            if (bits != 0) return wordBits * word + static_cast<std::size_t>(std::countr_zero(bits));
        }
        return m_free.size();
    }
    void addGroup(std::size_t kind, std::uint8_t free) {
        const std::size_t group = m_free.size();
        m_free.push_back(free);
        if (group % wordBits == 0)
            for (std::vector<std::uint64_t>& open : m_open) open.push_back(0);
        if (free != 0) m_open[kind][group / wordBits] |= std::uint64_t{1} << group % wordBits;
    }
    void close(std::size_t group, std::size_t kind) {
        std::vector<std::uint64_t>& open = m_open[kind];
        open[group / wordBits] &= ~(std::uint64_t{1} << group % wordBits);
        std::size_t& first = m_firstOpen[kind];
        while (first + 1 < open.size() && open[first] == 0) ++first;
    }

    std::vector<std::uint8_t> m_free;                     // by group: its free lanes, bit by bit
    std::vector<std::uint32_t> m_next;                    // by body: the first group it may come into
    std::array<std::vector<std::uint64_t>, kinds> m_open; // bit by group: it has room
    std::array<std::size_t, kinds> m_firstOpen{};         // no word before this one has a bit
};

} // namespace carom
