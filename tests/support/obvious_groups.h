// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/wide.h"

#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

namespace carom::test {

/// Groups of four pairs as lane_packer.h describes them, by looking through all of them.
class ObviousGroups {
  public:
    struct Place {
        std::size_t group = 0, lane = 0;
        bool isNew = false;
    };

    /// The body `shared` may be in a group more than once.
    explicit ObviousGroups(std::uint32_t shared) : m_shared(shared) {}

    Place place(std::uint32_t a, std::uint32_t b, std::size_t kind = 0) {
        std::size_t group = m_groups.size();
        while (group > 0 && !m_groups[group - 1].bodies.contains(a) &&
               !m_groups[group - 1].bodies.contains(b))
            --group; // after the last one that has either
        while (group < m_groups.size() &&
               (m_groups[group].kind != kind || m_groups[group].filled == wideLanes))
            ++group;
        const bool isNew = group == m_groups.size();
        if (isNew) m_groups.push_back({kind, {}, 0});
        for (const std::uint32_t body : {a, b})
            if (body != m_shared) m_groups[group].bodies.insert(body);
        return {group, m_groups[group].filled++, isNew};
    }

  private:
    struct Group {
        std::size_t kind;
        std::set<std::uint32_t> bodies;
        std::size_t filled;
    };

    std::uint32_t m_shared;
    std::vector<Group> m_groups;
};

} // namespace carom::test
