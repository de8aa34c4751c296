// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/aabb.h"
#include "core/solvers/events/event_record.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <span>
#include <vector>

// Cells that hold every ball whose centre they contain, so that a ball can only touch balls of its own and
// the 26 cells around it before one of them crosses into another cell. Which cell a ball is in is part of its
// state, changed by crossing events and never derived from its position again; so rounding at a face cannot
// lose it. Space is unbounded and the tables are not: cells repeat after `extent` of them along each axis,
// so a list may have distant balls in it, but no neighbour is missed.
//
// Balls of very different sizes live on levels of cells that are twice as wide each; a ball on the level
// whose cells are as wide as the ball. Cells of all levels begin at the same faces, so the cell around a
// fine one is `place >> levels up`. A search for balls of the same level takes the 27 cells of that level,
// for larger ones the 27 coarser cells around, for smaller ones all the finer cells that those 27 cells
// consist of.
//
// Most cells are empty. So a bit for every cell says whether it has balls: the 27 cells around a ball are
// nine rows of three bits, each read at once; the first and the last bit of a row stand for its other end.

namespace carom {

class EventCells {
  public:
    static constexpr std::uint32_t nobody = EventRecord::nobody;
    using Place = std::array<std::int32_t, 3>;

    /// Empty cells, their `side` [m] doubling from level to level, enough to tile `region` without repeating
    /// if the budget of some dozens of cells a ball allows it. Sets the level of each of the `records`;
    /// radii are those of `origins`.
    void restart(EventRecords records, std::span<const TrajectoryOrigin> origins, const Aabb& region);

    /// Names the cells from which a ball of their level can reach the half-space normal·x < offset before it
    /// leaves its cell. Walls are numbered in the order of the calls.
    void addWall(const Vec3& normal, double offset);

    /// Takes all balls out of the cells.
    void clear();
    /// A quarter of the balls is beyond the region the cells were made for.
    bool areOutgrown(ConstEventRecords records) const;
    void insert(EventRecords records, std::uint32_t i, const Vec3& position);
    /// Moves ball i one cell along an axis, in direction +1 or −1.
    void cross(EventRecords records, std::uint32_t i, int axis, int direction);

    /// Bits of a cell's walls: one byte. With more walls the later ones share the last bit; at half, with
    /// more than four; at twice, a cell takes one byte more.
    static constexpr unsigned wallBits = 8;
    /// One bit a wall that a ball can reach from its cell; the last one means all from there on. All where
    /// the cell is none that the tables were made for, but one they stand for too.
    unsigned wallsNear(const EventRecord& record) const {
        const Level& level = m_levels[record.level];
        const Place& place = record.place;
        return isRepeated(level, place) ? (1U << wallBits) - 1
                                        : m_walls[slotOf(level, rowOf(level, place[1], place[2]), place[0])];
    }
    /// Whether a ball's cell along an axis is so far out that the ball never leaves it; only repeated cells
    /// are.
    static bool isOutermost(const EventRecord& record, int axis) {
        return std::abs(record.place[index(axis)]) >= farthest >> record.level;
    }

    /// Calls visit(j) for every other ball in the cells around ball i.
    template<class Visit>
    void aroundBall(ConstEventRecords records, std::uint32_t i, const Visit& visit) const {
        const EventRecord& record = records[i];
        const Level& own = m_levels[record.level];
        visitAround(own, record.place, [&](std::uint32_t j) {
            if (j != i) visit(j);
        });
        if (m_levels.size() > 1) visitOtherLevels(records, record, -1, 0, visit);
    }

    /// Calls visit(j) for every ball in the cells that came into view when ball i crossed, as cross() did.
    template<class Visit>
    void newlyAround(ConstEventRecords records, std::uint32_t i, int axis, int direction,
                     const Visit& visit) const {
        const EventRecord& record = records[i];
        visitSlab(m_levels[record.level], record.place, axis, direction, visit);
        if (m_levels.size() > 1) visitOtherLevels(records, record, axis, direction, visit);
    }

    /// How far a ball may be from its cell [m]: of two that are in no cells next to each other the surfaces
    /// are so far apart twice.
    double tolerance(std::uint8_t level) const { return m_levels[level].tolerance; }
    /// The lower face of a ball's cell across an axis [m], and how far the upper one is from it.
    double lowerFaceOf(const EventRecord& record, int axis) const {
        return m_origin[axis] + m_levels[record.level].side * record.place[index(axis)];
    }
    double sideOf(const EventRecord& record) const { return m_levels[record.level].side; }
    std::size_t bytes() const;

    /// Prefetches the memory that a search around the ball will read.
    void prefetch(const EventRecord& record) const {
        const Level& level = m_levels[record.level];
        if (!isInside(level, record.place)) return;
        __builtin_prefetch(
            &m_first[slotOf(level, rowOf(level, record.place[1], record.place[2]), record.place[0])]);
    }

  private:
    /// Number of a cell along an axis at most, in either direction, so that no sum of two overflows: it would
    /// at twice this.
    static constexpr std::int32_t farthest = 1 << 29;

    struct Level {
        double side = 0;                      ///< [m]
        double largest = 0;                   ///< radius of the balls here [m]
        double tolerance = 0;                 ///< [m]
        std::array<std::int32_t, 3> extent{}; ///< cells along each axis
        std::size_t cells = 0;                ///< the first in m_first and m_walls
        std::size_t rows = 0;                 ///< the first byte in m_bits
        std::size_t rowBytes = 0;
        /// From a cell, and from a row's bytes, to the next ones along y and z.
        std::size_t cellStep[3] = {1, 0, 0}, byteStep[3] = {0, 0, 0};
    };
    using Three = std::array<std::int32_t, 3>;

    static std::size_t index(int axis) { return static_cast<std::size_t>(axis); }
    static std::int32_t wrapped(std::int32_t place, std::int32_t extent) {
        if (static_cast<std::uint32_t>(place) < static_cast<std::uint32_t>(extent)) return place;
        const std::int32_t rest = place % extent;
        return rest < 0 ? rest + extent : rest;
    }
    static Three around(std::int32_t cell, std::int32_t extent) {
        return {cell == 0 ? extent - 1 : cell - 1, cell, cell + 1 == extent ? 0 : cell + 1};
    }
    static std::size_t rowOf(const Level& level, std::int32_t y, std::int32_t z) {
        return static_cast<std::size_t>(z) * static_cast<std::size_t>(level.extent[1]) +
               static_cast<std::size_t>(y);
    }
    static std::size_t slotOf(const Level& level, std::size_t row, std::int32_t x) {
        return level.cells + row * static_cast<std::size_t>(level.extent[0]) + static_cast<std::size_t>(x);
    }
    /// Bits x, x+1, x+2, ... of a row, of which bit x+1 stands for cell x.
    unsigned bitsFrom(const Level& level, std::size_t row, std::int32_t x) const {
        std::uint16_t bits = 0;
        std::memcpy(&bits, m_bits.data() + level.rows + row * level.rowBytes + (x >> 3), sizeof(bits));
        return static_cast<unsigned>(bits) >> (x & 7);
    }
    static unsigned bitsAt(const std::uint8_t* bytes) {
        std::uint16_t bits = 0;
        std::memcpy(&bits, bytes, sizeof(bits));
        return bits;
    }
    static bool isRepeated(const Level& level, const Place& place) {
        const auto beyond = [&](std::size_t k) {
            return static_cast<unsigned>(static_cast<std::uint32_t>(place[k]) >=
                                         static_cast<std::uint32_t>(level.extent[k]));
        };
        return (beyond(0) | beyond(1) | beyond(2)) != 0;
    }
    /// Whether no cell around this one is at the other end of the table. All balls between walls are in such
    /// cells (restart).
    static bool isInside(const Level& level, const Place& place) {
        const auto beyond = [&](std::size_t k) {
            return static_cast<unsigned>(static_cast<std::uint32_t>(place[k] - 1) >=
                                         static_cast<std::uint32_t>(level.extent[k] - 2));
        };
        return (beyond(0) | beyond(1) | beyond(2)) == 0;
    }
    struct Spot {
        std::size_t row = 0;
        std::int32_t x = 0;
        std::size_t slot = 0;
    };
    static Spot spotOf(const Level& level, const Place& place) {
        if (!isRepeated(level, place)) {
            const std::size_t row = rowOf(level, place[1], place[2]);
            return {row, place[0], slotOf(level, row, place[0])};
        }
        const std::int32_t x = wrapped(place[0], level.extent[0]);
        const std::size_t row =
            rowOf(level, wrapped(place[1], level.extent[1]), wrapped(place[2], level.extent[2]));
        return {row, x, slotOf(level, row, x)};
    }
    void link(const Level& level, const Spot& spot, std::uint32_t i);
    void unlink(const Level& level, const Spot& spot, std::uint32_t i);
    void setBits(const Level& level, std::size_t row, std::int32_t x, bool occupied);

    template<class Visit>
    void visitCell(std::size_t slot, const Visit& visit) const {
        for (std::uint32_t j = m_first[slot]; j != nobody; j = m_next[j]) visit(j);
    }

    // The cells whose bits are set: four bits a row, cell (k, row) at `first` + k + offsets[row].
    template<std::size_t count, class Visit>
    void visitBits(std::uint64_t bits, std::size_t first, const std::array<std::size_t, count>& offsets,
                   const Visit& visit) const {
        for (; bits != 0; bits &= bits - 1) {
            const unsigned bit = static_cast<unsigned>(std::countr_zero(bits));
            visitCell(first + (bit & 3U) + offsets[bit >> 2], visit);
        }
    }

    // The rows' bits are put together first, so that the loop runs over the few cells that are not empty.
    template<class Visit>
    void visitAround(const Level& level, const Place& place, const Visit& visit) const {
        if (!isInside(level, place)) return visitAroundWrapped(level, place, visit);
        const std::size_t row = rowOf(level, place[1] - 1, place[2] - 1);
        const std::uint8_t* const bytes =
            m_bits.data() + level.rows + row * level.rowBytes + static_cast<std::size_t>(place[0] >> 3);
        const int shift = place[0] & 7;
        std::array<std::size_t, 9> offsets;
        std::uint64_t occupied = 0;
        for (unsigned k = 0; k < 9; ++k) {
            const unsigned bits = bitsAt(bytes + (k % 3) * level.byteStep[1] + (k / 3) * level.byteStep[2]);
            occupied |= std::uint64_t{bits >> shift & 7U} << (4 * k);
            offsets[k] = (k % 3) * level.cellStep[1] + (k / 3) * level.cellStep[2];
        }
        visitBits(occupied, slotOf(level, row, place[0] - 1), offsets, visit);
    }

    template<class Visit>
    void visitAroundWrapped(const Level& level, const Place& place, const Visit& visit) const {
        const std::int32_t x = wrapped(place[0], level.extent[0]);
        const Three xs = around(x, level.extent[0]);
        const Three ys = around(wrapped(place[1], level.extent[1]), level.extent[1]);
        const Three zs = around(wrapped(place[2], level.extent[2]), level.extent[2]);
        std::array<std::size_t, 9> rows;
        std::uint64_t occupied = 0;
        for (unsigned k = 0; k < 9; ++k) {
            rows[k] = rowOf(level, ys[k % 3], zs[k / 3]);
            occupied |= std::uint64_t{bitsFrom(level, rows[k], x) & 7U} << (4 * k);
        }
        for (; occupied != 0; occupied &= occupied - 1) {
            const unsigned bit = static_cast<unsigned>(std::countr_zero(occupied));
            visitCell(slotOf(level, rows[bit / 4], xs[bit % 4]), visit);
        }
    }

    // The nine cells on one side of the one at `place`.
    template<class Visit>
    void visitSlab(const Level& level, const Place& place, int axis, int direction,
                   const Visit& visit) const {
        if (!isInside(level, place)) return visitSlabWrapped(level, place, axis, direction, visit);
        Place from = place; // the first row, and the cell before its bits
        from[index(axis)] += direction;
        for (int k = 1; k < 3; ++k)
            if (k != axis) --from[index(k)];
        const std::size_t row = rowOf(level, from[1], from[2]);
        const std::uint8_t* const bytes =
            m_bits.data() + level.rows + row * level.rowBytes + static_cast<std::size_t>(from[0] >> 3);
        const int shift = from[0] & 7;
        std::uint64_t occupied = 0;
        if (axis == 0) {
            std::array<std::size_t, 9> offsets;
            for (unsigned k = 0; k < 9; ++k) {
                const unsigned bits =
                    bitsAt(bytes + (k % 3) * level.byteStep[1] + (k / 3) * level.byteStep[2]);
                occupied |= std::uint64_t{bits >> shift & 2U} << (4 * k);
                offsets[k] = (k % 3) * level.cellStep[1] + (k / 3) * level.cellStep[2];
            }
            visitBits(occupied, slotOf(level, row, from[0] - 1), offsets, visit);
            return;
        }
        const std::size_t other = index(3 - axis);
        std::array<std::size_t, 3> offsets;
        for (unsigned k = 0; k < 3; ++k) {
            occupied |= std::uint64_t{bitsAt(bytes + k * level.byteStep[other]) >> shift & 7U} << (4 * k);
            offsets[k] = k * level.cellStep[other];
        }
        visitBits(occupied, slotOf(level, row, from[0] - 1), offsets, visit);
    }

    template<class Visit>
    void visitSlabWrapped(const Level& level, const Place& place, int axis, int direction,
                          const Visit& visit) const {
        const auto shown = [&](int k) {
            return wrapped(place[index(k)] + (k == axis ? direction : 0), level.extent[index(k)]);
        };
        const std::int32_t x = shown(0), y = shown(1), z = shown(2);
        const Three xs = around(x, level.extent[0]);
        const Three ys = around(y, level.extent[1]), zs = around(z, level.extent[2]);
        if (axis == 0) {
            std::array<std::size_t, 9> rows;
            std::uint32_t occupied = 0;
            for (unsigned k = 0; k < 9; ++k) {
                rows[k] = rowOf(level, ys[k % 3], zs[k / 3]);
                occupied |= (bitsFrom(level, rows[k], x) >> 1U & 1U) << k;
            }
            for (; occupied != 0; occupied &= occupied - 1)
                visitCell(slotOf(level, rows[static_cast<unsigned>(std::countr_zero(occupied))], x), visit);
            return;
        }
        std::array<std::size_t, 3> rows;
        std::uint32_t occupied = 0;
        for (unsigned k = 0; k < 3; ++k) {
            rows[k] = axis == 1 ? rowOf(level, y, zs[k]) : rowOf(level, ys[k], z);
            occupied |= (bitsFrom(level, rows[k], x) & 7U) << (4 * k);
        }
        for (; occupied != 0; occupied &= occupied - 1) {
            const unsigned bit = static_cast<unsigned>(std::countr_zero(occupied));
            visitCell(slotOf(level, rows[bit / 4], xs[bit % 4]), visit);
        }
    }

    // Larger balls, and smaller ones; `axis` −1: everything around, not only what a crossing brought.
    template<class Visit>
    void visitOtherLevels(ConstEventRecords records, const EventRecord& record, int axis, int direction,
                          const Visit& visit) const {
        for (std::size_t l = 0; l < m_levels.size(); ++l) {
            if (l > record.level) {
                const unsigned up = static_cast<unsigned>(l - record.level);
                Place place{};
                for (std::size_t k = 0; k < 3; ++k) place[k] = record.place[k] >> up;
                if (axis < 0)
                    visitAround(m_levels[l], place, visit);
                else if ((record.place[index(axis)] - direction) >> up != place[index(axis)])
                    visitSlab(m_levels[l], place, axis, direction, visit);
            } else if (l < record.level) {
                visitFiner(records, l, record, axis, direction, visit);
            }
        }
    }
    template<class Visit>
    void visitFiner(ConstEventRecords records, std::size_t l, const EventRecord& record, int axis,
                    int direction, const Visit& visit) const;

    std::vector<Level> m_levels;
    std::vector<std::uint32_t> m_first; ///< ball of each cell
    std::vector<std::uint32_t> m_next;  ///< ball of the same cell
    std::vector<std::uint8_t> m_bits;   ///< cells that are not empty
    std::vector<std::uint8_t> m_walls;  ///< near each cell
    std::vector<std::uint32_t> m_count; ///< balls of each level
    unsigned m_wallCount = 0;
    Vec3 m_origin = Vec3::Zero();
};

// Cells of a finer level, row by row; where they are more than its balls, the balls themselves.
template<class Visit>
void EventCells::visitFiner(ConstEventRecords records, std::size_t l, const EventRecord& record, int axis,
                            int direction, const Visit& visit) const {
    const Level& level = m_levels[l];
    const unsigned down = record.level - static_cast<unsigned>(l);
    std::array<std::int32_t, 3> begin{}, count{};
    double cells = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const bool crossed = axis >= 0 && k == index(axis);
        begin[k] = (record.place[k] + (crossed ? direction : -1)) * (1 << down);
        count[k] = std::min((crossed ? 1 : 3) << down, level.extent[k]);
        cells *= count[k];
    }
    if (cells > static_cast<double>(m_count[l])) {
        for (std::uint32_t j = 0; j < records.size(); ++j)
            if (records[j].level == l) visit(j);
        return;
    }
    for (std::int32_t z = 0; z < count[2]; ++z)
        for (std::int32_t y = 0; y < count[1]; ++y) {
            const std::size_t row =
                rowOf(level, wrapped(begin[1] + y, level.extent[1]), wrapped(begin[2] + z, level.extent[2]));
            for (std::int32_t x = 0; x < count[0]; ++x) {
                const std::int32_t cell = wrapped(begin[0] + x, level.extent[0]);
                if ((bitsFrom(level, row, cell) & 2U) != 0) visitCell(slotOf(level, row, cell), visit);
            }
        }
}

} // namespace carom
