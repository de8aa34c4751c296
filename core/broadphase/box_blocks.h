// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/broadphase/box_columns.h"
#include "core/math/aabb.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace carom {

/// Boxes of which single ones change and are compared with all others: in blocks of boxes near each other,
/// each with a box around it. A search compares with all blocks, and with the boxes of those that it
/// overlaps: O(n / size + hits).
class BoxBlocks {
  public:
    /// Sorts the boxes into blocks.
    void build(std::span<const Aabb> boxes);
    /// Replaces a box. Its block only grows: what moves far makes searches slower until the next build().
    void set(std::size_t entry, const Aabb& box);
    /// What a search needs besides the boxes. Threads that search at the same time have one each.
    struct Search {
        std::vector<BoxRange> ranges;
        std::vector<std::uint32_t> hits;
    };
    /// The entries whose boxes overlap `box`, in no particular order; until the next call with this search.
    std::span<const std::uint32_t> overlapping(const Aabb& box, Search& search) const;

  private:
    /// Boxes in a block. At half, searches among 10,000 boxes take three tenths more instructions; at twice,
    /// as many.
    static constexpr std::size_t size = 32;

    std::vector<std::uint32_t> m_place; // by entry: where its box is in m_boxes
    std::vector<std::uint32_t> m_entry; // and back
    BoxColumns m_boxes, m_blocks;
    std::size_t m_blockCount = 0;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> m_order; // by place in space; entries
};

} // namespace carom
