// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/broadphase/box_columns.h"
#include "core/math/aabb.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace carom {

/// Boxes of which single ones change and are compared with all others: in blocks of boxes near each other,
/// each with a box around it; these are in larger blocks, and so on. A search compares with the boxes in
/// those blocks that it overlaps, from the largest down: O(log n + hits).
class BoxBlocks {
  public:
    /// Takes all boxes anew. Sorts them into blocks, O(n log n), unless those of the last time, if there were
    /// as many boxes, are still about as good, O(n).
    void build(std::span<const Aabb> boxes);
    /// Replaces a box. Its blocks only grow: what moves far makes searches slower until the next build().
    void set(std::size_t entry, const Aabb& box);
    /// What a search needs besides the boxes. Threads that search at the same time have one each.
    struct Search {
        std::vector<BoxRange> ranges;
        std::vector<std::uint32_t> hits;
    };
    /// The entries whose boxes overlap `box`, in no particular order; until the next call with this search.
    std::span<const std::uint32_t> overlapping(const Aabb& box, Search& search) const;

  private:
    /// Boxes in a block. At half, a search takes as many instructions and build() a few more; at twice, a
    /// search among 2,000 boxes takes a third more.
    static constexpr std::size_t size = 16;

    /// All boxes, or one around each block of the level below. Those of one block follow each other.
    struct Level {
        BoxColumns boxes;
        std::size_t count = 0;
    };
    /// Boxes are sorted anew where more than one block in so many has become wider by this factor.
    static constexpr std::size_t fewWorn = 8;
    static constexpr double worn = 1.5;

    struct Centre {
        Vec3 at = Vec3::Zero(); // [m]
        std::uint32_t entry = 0;
    };
    void makeLevels(std::size_t count);
    void sort(std::span<const Aabb> boxes);
    void fill(std::span<const Aabb> boxes);
    bool areWorn() const;
    double widthOf(std::size_t block) const;
    static void arrange(std::span<Centre> centres, const Aabb& around);
    BoxRange rangeOf(std::size_t level, std::size_t block) const;

    std::vector<Level> m_levels;
    std::vector<std::uint32_t> m_place; // by entry: where its box is in the first level
    std::vector<std::uint32_t> m_entry; // and back
    std::vector<Centre> m_centres;      // by place
    std::vector<double> m_widths;       // of blocks of boxes when these were sorted [m]
};

} // namespace carom
