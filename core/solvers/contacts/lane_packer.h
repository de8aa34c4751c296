// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/wide.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

// Puts pairs into groups of four, no body twice in one, so that four lanes can be solved at once. A pair goes
// into the first of the open groups that has neither of its bodies. Each body keeps the open groups it is in
// as a mask of 64 bits, so the search is one operation. What comes out depends on the order of pairs alone.

namespace carom {

class LanePacker {
  public:
    struct Place {
        std::uint32_t group = 0, lane = 0;
        bool isNew = false; ///< the group was not there before
    };

    void begin(std::size_t bodies) {
        closeAll();
        m_oldest = 0;
        m_open.resize(openGroups);
        m_masks.resize(bodies, 0); // those of what was closed are 0
    }
    /// Bodies without motion do not exclude each other: `shared` is one.
    Place place(std::uint32_t a, std::uint32_t b, std::uint32_t shared, std::size_t newGroup) {
        const std::uint64_t taken = (a == shared ? 0 : m_masks[a]) | (b == shared ? 0 : m_masks[b]);
        const std::uint64_t free = m_used & ~taken;
        const bool isNew = free == 0;
        if (isNew && m_used == ~std::uint64_t{0}) {
            close(m_oldest);
            m_oldest = (m_oldest + 1) % openGroups;
        }
        const std::size_t slot =
            static_cast<std::size_t>(isNew ? std::countr_one(m_used) : std::countr_zero(free));
        Open& open = m_open[slot];
        if (isNew) {
            m_used |= std::uint64_t{1} << slot;
            open = {.group = static_cast<std::uint32_t>(newGroup)};
        }
        const Place place{open.group, open.filled, isNew};
        open.bodies[2 * open.filled] = a;
        open.bodies[2 * open.filled + 1] = b;
        m_masks[a] |= std::uint64_t{1} << slot;
        m_masks[b] |= std::uint64_t{1} << slot;
        if (++open.filled == wideLanes) close(slot);
        return place;
    }
    /// No group takes any more.
    void closeAll() {
        while (m_used != 0) close(static_cast<std::size_t>(std::countr_zero(m_used)));
    }

  private:
    static constexpr std::size_t openGroups = 64;
    struct Open {
        std::uint32_t group = 0, filled = 0;
        std::array<std::uint32_t, 2 * wideLanes> bodies{};
    };
    void close(std::size_t slot) {
        const std::uint64_t others = ~(std::uint64_t{1} << slot);
        for (std::size_t k = 0; k < 2 * m_open[slot].filled; ++k) m_masks[m_open[slot].bodies[k]] &= others;
        m_used &= others;
    }

    std::vector<Open> m_open;           // openGroups of them, once there is something to pack
    std::uint64_t m_used = 0;           // bit k: m_open[k] is one
    std::vector<std::uint64_t> m_masks; // by body: the open groups it is in
    std::size_t m_oldest = 0;           // closed next where no other has room
};

} // namespace carom
