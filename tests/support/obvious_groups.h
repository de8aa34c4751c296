// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/wide.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>

namespace carom::test {

/// Groups of four pairs as lane_packer.h describes them, by looking through all open ones.
class ObviousGroups {
  public:
    struct Place {
        std::size_t group = 0, lane = 0;
        bool isNew = false;
    };

    /// The body `shared` may be in a group more than once.
    explicit ObviousGroups(std::uint32_t shared) : m_shared(shared) {}

    Place place(std::uint32_t a, std::uint32_t b, std::size_t newGroup) {
        std::size_t slot = 0;
        while (slot < mostOpen && !(m_open[slot] && isFree(*m_open[slot], a, b))) ++slot;
        const bool isNew = slot == mostOpen;
        if (isNew) {
            slot = 0;
            while (slot < mostOpen && m_open[slot]) ++slot;
            if (slot == mostOpen) { // all are open: the next in turn is closed
                slot = m_turn;
                m_turn = (m_turn + 1) % mostOpen;
            }
            m_open[slot] = Group{newGroup, {}, 0};
        }
        Group& group = *m_open[slot];
        const Place place{group.number, group.filled++, isNew};
        for (const std::uint32_t body : {a, b})
            if (body != m_shared) group.bodies.insert(body);
        if (group.filled == wideLanes) m_open[slot].reset();
        return place;
    }

  private:
    static constexpr std::size_t mostOpen = 64;
    struct Group {
        std::size_t number;
        std::set<std::uint32_t> bodies;
        std::size_t filled;
    };
    bool isFree(const Group& group, std::uint32_t a, std::uint32_t b) const {
        return !group.bodies.contains(a) && !group.bodies.contains(b);
    }

    std::uint32_t m_shared;
    std::array<std::optional<Group>, mostOpen> m_open;
    std::size_t m_turn = 0;
};

} // namespace carom::test
