// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/broadphase/box_columns.h"
#include "core/broadphase/broadphase.h"
#include "core/broadphase/pair_keys.h"

#include <cstdint>
#include <vector>

// Cells as wide as the largest box: whatever overlaps a box has its centre in the same cell as the box's or
// in a neighbouring one.
//
//   . . . . .     Cells are not stored. The three indices of a cell give its slot in a table,
//   . # # # .         slot = (x + Y y + Z z) mod slots,
//   . # A # .     so any scene, however far spread, needs a table in proportion to its number of boxes. Cells
//   . # # # .     that fall on one slot by chance cost comparisons, never pairs. Three neighbours in x are
//   . . . . .     three slots in a row, and the boxes are sorted by slot: one range holds them all.
//
// After M. Teschner, B. Heidelberger, M. Mueller, D. Pomeranets, M. Gross, "Optimized Spatial Hashing for
// Collision Detection of Deformable Objects", 2003; the hash is linear here, which keeps neighbours together.
// Sizes that differ much get levels, each with cells of its own width: a box is compared with its own level
// and, where it may reach, with the coarser ones. The table is built anew each frame; nothing is remembered.

namespace carom {

class UniformGrid final : public Broadphase {
  public:
    void update(const BroadphaseInput& input) override;
    std::vector<Aabb> structure() const override;

  private:
    /// Boxes whose widths are alike.
    struct Level {
        double largest = 0;     ///< half the width of its widest box [m]
        double inverseSide = 0; ///< of its cells [1/m]
        std::uint32_t boxes = 0;
    };
    struct Cell {
        std::int64_t x, y, z;
    };
    struct Placed {
        std::uint32_t entry; ///< of the input
        std::uint32_t level;
    };
    static constexpr std::size_t exponents = 2048; ///< of a double

    void makeLevels(const BroadphaseInput& input);
    void place(const BroadphaseInput& input);
    /// Pairs of some of the boxes.
    struct Finds {
        std::vector<PairKey> pairs;
        std::uint64_t tested = 0, cells = 0; ///< as counted (broadphase.h)
        std::vector<BoxRange> ranges;        ///< of m_placed: those that one box is compared with
        std::vector<std::uint32_t> hits;     ///< of these

        void clear();
        void append(const Finds& others);
        std::size_t bytes() const;
        void addRange(std::uint32_t begin, std::uint32_t end);
    };
    void find(std::uint32_t place, const Aabb& box, Finds& finds) const;
    void addNeighbours(std::uint32_t place, Finds& finds) const;
    void addCoarser(std::uint32_t place, const Aabb& box, Finds& finds) const;
    void addRow(std::uint64_t slot, std::uint64_t width, Finds& finds) const;
    void compare(std::uint32_t place, const Aabb& box, Finds& finds) const;
    static Cell cellOf(const Vec3& point, const Level& level);
    std::uint64_t slotOf(const Cell& cell, std::uint32_t level) const;

    std::vector<Level> m_levels;                ///< coarsest first
    std::vector<Level> m_byExponent;            ///< scratch: boxes by the binary exponent of their width
    std::vector<std::uint8_t> m_levelOf;        ///< by exponent
    std::vector<std::uint32_t> m_slots;         ///< by entry
    std::vector<std::uint32_t> m_starts;        ///< first place of a slot; one more for the end
    std::vector<Placed> m_placed;               ///< by slot, then entry; after them the loose ones
    BoxColumns m_boxes;                         ///< of m_placed
    std::uint32_t m_inTable = 0;                ///< of m_placed
    std::uint64_t m_mask = 0;                   ///< slots - 1
    std::uint64_t m_strideY = 0, m_strideZ = 0; ///< Y and Z above
    std::vector<Finds> m_finds;                 ///< by part of the boxes
    PairOrder m_order;
};

} // namespace carom
