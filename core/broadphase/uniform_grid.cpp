// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/broadphase/uniform_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace carom {
namespace {

// Slots of the table for each box: with fewer, more cells share a slot by chance; more take longer to clear.
// Twice or half of this and of the next three changes the time only; the pairs are the same.
constexpr std::size_t slotsPerBox = 4;
// Boxes of a level at most for which there is no grid: they are compared with all finer ones.
constexpr std::uint32_t looseBoxes = 16;
// Expected comparisons of a box in its cells from which on levels of smaller cells are faster.
constexpr double mostMet = 30;
// Levels at most; where sizes have a range of more than 2^16, the finest ones share cells.
constexpr std::size_t mostLevels = 16;
// The level that stands for no grid at all.
constexpr std::uint8_t loose = 0xff;
constexpr std::uint32_t noSlot = 0xffff'ffff;
// Cells are wider than the widest box by this factor, so that rounding of a cell's index cannot separate
// neighbours ...
constexpr double slack = 1.002;
// ... as long as indices stay below 2^40: far from the origin cells are widened to that. At 2^51 the slack
// would be less than the rounding of an index, and pairs would be lost.
constexpr double mostCells = 1.0995e12;
// Boxes of which one thread finds the pairs, at least, and those that it puts into the table.
constexpr std::size_t fewSearched = Workers::enoughOf(300), fewPlaced = Workers::enoughOf(10);

double halfWidth(const Aabb& box) { return (0.5 * box.upper - 0.5 * box.lower).maxCoeff(); }
Vec3 centreOf(const Aabb& box) { return 0.5 * box.lower + 0.5 * box.upper; } // cannot overflow

std::size_t exponentOf(double halfWidth) {
    return static_cast<std::size_t>(std::bit_cast<std::uint64_t>(halfWidth) >> 52) & 0x7ff;
}

std::int64_t floorOf(double value) {
    const std::int64_t towardsZero = static_cast<std::int64_t>(value);
    return towardsZero - static_cast<std::int64_t>(value < static_cast<double>(towardsZero));
}

} // namespace

void UniformGrid::Finds::clear() {
    pairs.clear();
    tested = cells = 0;
}

void UniformGrid::Finds::append(const Finds& others) {
    pairs.insert(pairs.end(), others.pairs.begin(), others.pairs.end());
    tested += others.tested;
    cells += others.cells;
}

std::size_t UniformGrid::Finds::bytes() const {
    return pairs.capacity() * sizeof(PairKey) + ranges.capacity() * sizeof(BoxRange) +
           hits.capacity() * sizeof(std::uint32_t);
}

void UniformGrid::update(const BroadphaseInput& input) {
    makeLevels(input);
    place(input);
    const std::span<Finds> parts = input.workers->forKeptLists(
        m_placed.size(), fewSearched, m_finds, [&](std::size_t begin, std::size_t end, Finds& finds) {
            for (std::size_t p = begin; p < end; ++p)
                find(static_cast<std::uint32_t>(p), input.boxes[m_placed[p].entry], finds);
        });
    Finds& all = parts.front();
    for (const Finds& part : parts.subspan(1)) all.append(part);
    m_order.tidy(all.pairs, input);
    translate(all.pairs, input, m_pairs);

    m_counters = {};
    m_counters.boxes = input.boxes.size();
    m_counters.pairs = m_pairs.size();
    m_counters.tested = all.tested;
    m_counters.cells = all.cells;
    m_counters.memoryBytes = m_levels.capacity() * sizeof(Level) + m_byExponent.capacity() * sizeof(Level) +
                             m_levelOf.capacity() +
                             (m_slots.capacity() + m_starts.capacity()) * sizeof(std::uint32_t) +
                             m_placed.capacity() * sizeof(Placed) + m_boxes.bytes() + m_order.bytes() +
                             m_pairs.capacity() * sizeof(BodyPair);
    for (const Finds& finds : m_finds) m_counters.memoryBytes += finds.bytes();
}

// From the widest down: a class of widths (one binary exponent) joins the level above if, by the density of
// the scene at large, a box of its would meet few others in such wide cells, or if the class is small;
// otherwise it opens a level, which makes each of its boxes look into the coarser ones.
void UniformGrid::makeLevels(const BroadphaseInput& input) {
    m_byExponent.assign(exponents, {});
    m_levelOf.assign(exponents, loose);
    std::size_t least = exponents, most = 0;
    double farthest = 0;
    Vec3 sum = Vec3::Zero(), squares = Vec3::Zero();
    for (const Aabb& box : input.boxes) {
        const double half = halfWidth(box);
        const std::size_t exponent = exponentOf(half);
        Level& widths = m_byExponent[exponent];
        widths.largest = std::max(widths.largest, half);
        ++widths.boxes;
        least = std::min(least, exponent);
        most = std::max(most, exponent);
        farthest = std::max({farthest, -box.lower.minCoeff(), box.upper.maxCoeff()});
        const Vec3 fromFirst = centreOf(box) - centreOf(input.boxes[0]);
        sum += fromFirst;
        squares += fromFirst.cwiseAbs2();
    }
    const double share = 1 / static_cast<double>(std::max<std::size_t>(1, input.boxes.size()));
    const Vec3 variance = (share * squares - (share * sum).cwiseAbs2()).cwiseMax(0);
    const Vec3 spread = std::sqrt(12.0) * variance.cwiseSqrt(); // of a uniform distribution

    m_levels.clear();
    m_levels.reserve(mostLevels);
    for (std::size_t exponent = most + 1; exponent-- > least;) {
        const Level& widths = m_byExponent[exponent];
        if (widths.boxes == 0) continue;
        bool joins = m_levels.size() == mostLevels;
        if (!m_levels.empty() && !joins) {
            const Level& above = m_levels.back();
            const double side = 2 * above.largest;
            const double cells = (spread.array() / side + 1).prod();
            joins =
                widths.boxes < above.boxes / 8 || 0.5 * 27 * (above.boxes + widths.boxes) < mostMet * cells;
        }
        if (joins) {
            m_levels.back().boxes += widths.boxes;
        } else if (widths.boxes > looseBoxes) {
            m_levels.push_back(widths);
        } else {
            continue;
        }
        m_levelOf[exponent] = static_cast<std::uint8_t>(m_levels.size() - 1);
    }
    for (Level& level : m_levels) {
        const double side = std::max(
            {2 * slack * level.largest, farthest / mostCells, std::numeric_limits<double>::min() * 4});
        level.inverseSide = 1 / side;
    }
}

// A counting sort by slot.
void UniformGrid::place(const BroadphaseInput& input) {
    const std::size_t count = input.boxes.size();
    const std::size_t slots = std::bit_ceil(std::max<std::size_t>(64, slotsPerBox * count));
    m_mask = slots - 1;
    // Fractions of the table that no small multiples bring close together (powers of the plastic number).
    m_strideY = static_cast<std::uint64_t>(0.7548776662466927 * static_cast<double>(slots)) | 1;
    m_strideZ = static_cast<std::uint64_t>(0.5698402909980532 * static_cast<double>(slots)) | 1;

    m_slots.resize(count);
    m_starts.assign(slots + 2, 0); // shifted by one more while filling
    m_placed.resize(count);
    m_boxes.resize(count);
    const auto levelOf = [this](const Aabb& box) { return m_levelOf[exponentOf(halfWidth(box))]; };
    input.workers->forRanges(count, fewPlaced, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Aabb& box = input.boxes[i];
            const std::uint8_t level = levelOf(box);
            m_slots[i] =
                level == loose
                    ? noSlot
                    : static_cast<std::uint32_t>(slotOf(cellOf(centreOf(box), m_levels[level]), level));
        }
    });
    for (const std::uint32_t slot : m_slots)
        if (slot != noSlot) ++m_starts[slot + 2];
    for (std::size_t slot = 2; slot < m_starts.size(); ++slot) m_starts[slot] += m_starts[slot - 1];
    std::size_t atEnd = count;
    for (std::uint32_t i = 0; i < count; ++i)
        m_placed[m_slots[i] == noSlot ? --atEnd : m_starts[m_slots[i] + 1]++].entry = i;
    m_inTable = static_cast<std::uint32_t>(atEnd);
    input.workers->forRanges(count, fewPlaced, [&](std::size_t begin, std::size_t end) {
        for (std::size_t place = begin; place < end; ++place) {
            const Aabb& box = input.boxes[m_placed[place].entry];
            m_placed[place].level = levelOf(box);
            m_boxes.set(place, box);
        }
    });
}

UniformGrid::Cell UniformGrid::cellOf(const Vec3& point, const Level& level) {
    return {floorOf(point.x() * level.inverseSide), floorOf(point.y() * level.inverseSide),
            floorOf(point.z() * level.inverseSide)};
}

std::uint64_t UniformGrid::slotOf(const Cell& cell, std::uint32_t level) const {
    // Levels begin at different places of the table, or the middle of all would crowd the same slots.
    return (static_cast<std::uint64_t>(cell.x) + static_cast<std::uint64_t>(cell.y) * m_strideY +
            static_cast<std::uint64_t>(cell.z) * m_strideZ + level * (m_strideY >> 3)) &
           m_mask;
}

void UniformGrid::find(std::uint32_t place, const Aabb& box, Finds& finds) const {
    finds.ranges.clear();
    if (place < m_inTable) {
        addNeighbours(place, finds);
        addCoarser(place, box, finds);
    } else {
        finds.addRange(0, place);
    }
    compare(place, box, finds);
}

// The rest of its own row, and those four of the eight neighbouring rows from which it is not itself found.
void UniformGrid::addNeighbours(std::uint32_t place, Finds& finds) const {
    const std::uint64_t slot = m_slots[m_placed[place].entry];
    finds.addRange(place + 1, m_starts[slot + 1]);
    addRow(slot + 1, 1, finds);
    addRow(slot - 1 + m_strideY, 3, finds);
    addRow(slot - 1 + m_strideZ, 3, finds);
    addRow(slot - 1 + m_strideZ + m_strideY, 3, finds);
    addRow(slot - 1 + m_strideZ - m_strideY, 3, finds);
}

void UniformGrid::addCoarser(std::uint32_t place, const Aabb& box, Finds& finds) const {
    for (std::uint32_t level = 0; level < m_placed[place].level; ++level) {
        const Vec3 reach = Vec3::Constant(slack * m_levels[level].largest);
        const Cell low = cellOf(box.lower - reach, m_levels[level]);
        const Cell high = cellOf(box.upper + reach, m_levels[level]);
        for (std::int64_t z = low.z; z <= high.z; ++z)
            for (std::int64_t y = low.y; y <= high.y; ++y)
                addRow(slotOf({low.x, y, z}, level), static_cast<std::uint64_t>(high.x - low.x + 1), finds);
    }
}

// The boxes of `width` neighbouring slots; the table is a ring.
void UniformGrid::addRow(std::uint64_t slot, std::uint64_t width, Finds& finds) const {
    const std::uint64_t first = slot & m_mask, slots = m_mask + 1;
    if (first + width <= slots) return finds.addRange(m_starts[first], m_starts[first + width]);
    finds.addRange(m_starts[first], m_starts[slots]);
    finds.addRange(0, m_starts[first + width - slots]);
}

void UniformGrid::Finds::addRange(std::uint32_t begin, std::uint32_t end) {
    ++cells;
    if (begin < end) ranges.push_back({begin, end});
}

void UniformGrid::compare(std::uint32_t place, const Aabb& box, Finds& finds) const {
    std::size_t room = wideLanes;
    for (const BoxRange& range : finds.ranges) room += range.end - range.begin;
    finds.tested += room - wideLanes;
    if (finds.hits.size() < room) finds.hits.resize(room);
    const std::size_t hits = overlapping(m_boxes, box, finds.ranges, finds.hits.data());
    const std::uint32_t entry = m_placed[place].entry;
    const std::size_t before = finds.pairs.size();
    finds.pairs.resize(before + hits);
    PairKey* to = finds.pairs.data() + before;
    for (std::size_t k = 0; k < hits; ++k) {
        *to = pairKey(entry, m_placed[finds.hits[k]].entry);
        to += static_cast<std::size_t>(finds.hits[k] != place); // on a small ring it may find itself
    }
    finds.pairs.resize(static_cast<std::size_t>(to - finds.pairs.data()));
}

std::vector<Aabb> UniformGrid::structure() const {
    std::vector<Aabb> cells;
    for (std::uint32_t p = 0; p < m_inTable; ++p) {
        const Level& level = m_levels[m_placed[p].level];
        const Cell cell = cellOf(centreOf(m_boxes.box(p)), level);
        const Vec3 lower = Vec3(double(cell.x), double(cell.y), double(cell.z)) / level.inverseSide;
        cells.push_back({lower, lower + Vec3::Constant(1 / level.inverseSide)});
    }
    std::sort(cells.begin(), cells.end(), [](const Aabb& a, const Aabb& b) {
        return std::lexicographical_compare(a.lower.data(), a.lower.data() + 3, b.lower.data(),
                                            b.lower.data() + 3);
    });
    cells.erase(
        std::unique(cells.begin(), cells.end(),
                    [](const Aabb& a, const Aabb& b) { return a.lower == b.lower && a.upper == b.upper; }),
        cells.end());
    return cells;
}

extern const BroadphaseRow uniformGridRow;
constinit const BroadphaseRow uniformGridRow = {
    .name = "uniform_grid",
    .title = "Uniform grid",
    .cost = "O(n + pairs) a frame",
    .source =
        "M. Teschner et al., Optimized Spatial Hashing for Collision Detection of Deformable Objects, 2003",
    .create = createBroadphase<UniformGrid>,
};

} // namespace carom
