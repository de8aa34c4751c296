// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/contact_constraint.h"

#include <span>
#include <vector>

// Bodies that touch, directly or through other mobile bodies, form an island; islands are independent and are
// moved one by one. Walls and fixed bodies transmit no motion, so they do not join islands.

namespace carom {

struct Island {
    std::span<const BodyIndex> bodies;    ///< mobile, ascending
    std::span<const std::uint32_t> pairs; ///< into ContactSet::pairs, ascending
    std::span<const std::uint32_t> links; ///< of the other couplings (springs), ascending
};

class Islands {
  public:
    /// Islands of `members`, which are mobile and ascend, in the order of their first body. `pairs` couples
    /// members among each other and to others, `links` couples further pairs of bodies; an end that is no
    /// member joins nothing. `Pair` is ContactPair or BodyPair, with at least one member in each pair. Pairs
    /// for which `isUsed` is 0 are left out; if it is empty none are.
    template<class Pair>
    void find(const Bodies& bodies, std::span<const BodyIndex> members, const std::vector<Pair>& pairs,
              std::span<const BodyPair> links, std::span<const std::uint8_t> isUsed = {});

    std::size_t count() const { return m_first.empty() ? 0 : m_first.size() - 1; }
    Island operator[](std::size_t island) const {
        const Start &from = m_first[island], &to = m_first[island + 1];
        return {std::span(m_bodies).subspan(from.body, to.body - from.body),
                std::span(m_pairs).subspan(from.pair, to.pair - from.pair),
                std::span(m_links).subspan(from.link, to.link - from.link)};
    }

  private:
    struct Start {
        std::uint32_t body = 0, pair = 0, link = 0;
    };
    std::uint32_t rootOf(std::uint32_t body);
    void join(BodyIndex a, BodyIndex b);
    bool isMember(BodyIndex body) const { return body != noBody && m_isMember[body] != 0; }

    std::vector<std::uint8_t> m_isMember; // by body
    std::vector<std::uint32_t> m_parent;  // by body
    std::vector<std::uint32_t> m_island;  // by root
    std::vector<Start> m_first;           // by island, one more at the end
    std::vector<Start> m_next;            // by island, the next free place
    std::vector<BodyIndex> m_bodies;
    std::vector<std::uint32_t> m_pairs, m_links;
};

} // namespace carom
