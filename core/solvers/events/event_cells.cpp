// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/events/event_cells.h"

#include "core/base/held_bytes.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

// A ball must not reach past the neighbouring cells: their sides are at least its diameter. 1.1 of it at 5 %
// packing means about five crossings and twenty pairs looked at per collision; in a thin gas wider cells are
// better, half the mean spacing.
constexpr double slack = 1.1, shareOfSpacing = 0.5;

// With fewer than three cells along an axis the same list would be searched twice.
constexpr std::int32_t fewestAlongAxis = 3;

// Sides up to a million to one; larger balls share the last level. With half of them scenes of sizes beyond a
// thousand to one get slow: small balls share cells with many.
constexpr std::size_t mostLevels = 20;

// Tolerance of a ball's position relative to its cell, as a part of the side: far more than rounding can put
// a ball beyond its cell. A tenth or ten times of it changes nothing.
constexpr double roundingOfPlaces = 1e-3;

std::int32_t cellsAlong(double length, double side) {
    // Far beyond the budget of cells, so that no count overflows: twice or half changes nothing.
    constexpr double most = 1 << 20;
    return static_cast<std::int32_t>(std::clamp(std::ceil(length / side) + 1, double{fewestAlongAxis}, most));
}

/// The radius the finest cells are made for: the largest if nearly all balls are about as large, else the one
/// that nine of ten do not exceed; twice as many crossings cost less than ten times as many pairs.
double finestRadius(std::span<const TrajectoryOrigin> origins) {
    // Ratio of radii, at which cells have up to 2.7 times the volume that most balls need. At twice, 22
    // times, and as many more pairs to look at; nearer to 1, the largest balls have cells of their own.
    constexpr double aboutEqual = 1.4;
    std::vector<double> radii;
    radii.reserve(origins.size());
    for (const TrajectoryOrigin& origin : origins) radii.push_back(origin.radius);
    if (radii.empty()) return 0;
    const std::ptrdiff_t ninth = static_cast<std::ptrdiff_t>(radii.size() * 9 / 10);
    std::nth_element(radii.begin(), radii.begin() + ninth, radii.end());
    const double common = radii[radii.size() * 9 / 10];
    const double largest = *std::max_element(radii.begin(), radii.end());
    return largest <= aboutEqual * common ? largest : common;
}

} // namespace

void EventCells::restart(EventRecords records, std::span<const TrajectoryOrigin> origins,
                         const Aabb& region) {
    // A cell takes five bytes and a bit: 160 bytes a ball. Where a region has more, cells repeat, and lists
    // hold balls that are far away; that costs comparisons, and no ball is missed. At half, thin gases
    // compare twice as many balls that are far away; at twice, the cells take twice the memory.
    constexpr std::size_t cellsPerBall = 32, cellsAtLeast = 4096;
    const double finest = finestRadius(origins);
    const double ballCount = static_cast<double>(std::max<std::size_t>(1, origins.size()));
    const Vec3 size = region.size().array() + 2 * finest;
    // In a unit near it, a power of two, so that no volume overflows: 1e103 m cubed does.
    const double unit = size.maxCoeff() > 0 ? std::ldexp(1.0, std::ilogb(size.maxCoeff())) : 1;
    const double volume = (size / unit).prod();
    double side = std::max(2 * slack * finest, shareOfSpacing * unit * std::cbrt(volume / ballCount));
    if (!(side > 0)) side = 1;
    // A cell more on either side: then no ball within the region is in an outermost cell.
    m_origin = region.lower - Vec3::Constant(1.5 * side);

    m_levels.clear();
    m_count.clear();
    for (std::size_t i = 0; i < origins.size(); ++i) {
        std::size_t level = 0;
        for (double width = side; width < 2 * slack * origins[i].radius && level + 1 < mostLevels; width *= 2)
            ++level;
        records[i].level = static_cast<std::uint8_t>(level);
        while (m_levels.size() <= level) {
            m_levels.push_back({.side = std::ldexp(side, static_cast<int>(m_levels.size()))});
            m_count.push_back(0);
        }
        m_levels[level].largest = std::max(m_levels[level].largest, origins[i].radius);
        ++m_count[level];
    }

    std::size_t cells = 0, bytes = 0;
    const double mostCells = static_cast<double>(cellsAtLeast + cellsPerBall * origins.size());
    for (Level& level : m_levels) {
        double count = 1;
        for (int axis = 0; axis < 3; ++axis) {
            level.extent[index(axis)] = cellsAlong(region.size()[axis] + 2.5 * side, level.side);
            count *= level.extent[index(axis)];
        }
        while (count > mostCells) { // repeat sooner along the longest axis
            std::int32_t& longest = *std::max_element(level.extent.begin(), level.extent.end());
            if (longest == fewestAlongAxis) break;
            count /= longest;
            longest = std::max(fewestAlongAxis, longest / 2);
            count *= longest;
        }
        level.tolerance = std::max(0.0, (0.5 - roundingOfPlaces) * level.side - level.largest);
        level.cells = cells;
        level.rows = bytes;
        level.rowBytes = (static_cast<std::size_t>(level.extent[0]) + 2 + 7) / 8;
        for (std::size_t k = 1; k < 3; ++k) {
            level.cellStep[k] = level.cellStep[k - 1] * static_cast<std::size_t>(level.extent[k - 1]);
            level.byteStep[k] =
                k == 1 ? level.rowBytes : level.rowBytes * static_cast<std::size_t>(level.extent[1]);
        }
        cells += static_cast<std::size_t>(count);
        bytes += rowOf(level, 0, level.extent[2]) * level.rowBytes;
    }
    m_first.assign(cells, nobody);
    m_walls.assign(cells, 0);
    m_bits.assign(bytes + 1, 0); // two bytes are read at once
    m_next.assign(records.size(), nobody);
    m_wallCount = 0;
}

// Cells are numbered within one repetition, the one that begins at the origin; see wallsNear for the others.
void EventCells::addWall(const Vec3& normal, double offset) {
    // Of a cell's side: far more than rounding can put a ball beyond it. At twice or half a few more or fewer
    // cells ask for the wall.
    constexpr double margin = 0.01;
    const unsigned bit = 1U << std::min(m_wallCount, wallBits - 1);
    ++m_wallCount;
    for (const Level& level : m_levels) {
        const double reach = level.largest + level.tolerance + margin * level.side;
        // Over a cell, normal·x is least in the corner against the normal.
        const Vec3 corner = m_origin + level.side * (normal.array() < 0).select(Vec3::Ones(), 0).matrix();
        for (std::int32_t z = 0; z < level.extent[2]; ++z)
            for (std::int32_t y = 0; y < level.extent[1]; ++y) {
                const std::size_t row = rowOf(level, y, z);
                for (std::int32_t x = 0; x < level.extent[0]; ++x)
                    if (normal.dot(corner + level.side * Vec3(x, y, z)) - offset <= reach)
                        m_walls[slotOf(level, row, x)] |= static_cast<std::uint8_t>(bit);
            }
    }
}

void EventCells::clear() {
    std::fill(m_first.begin(), m_first.end(), nobody);
    std::fill(m_bits.begin(), m_bits.end(), std::uint8_t{0});
}

bool EventCells::areOutgrown(ConstEventRecords records) const {
    std::size_t beyond = 0;
    for (const EventRecord& record : records)
        if (isRepeated(m_levels[record.level], record.place)) ++beyond;
    return beyond > records.size() / 4;
}

inline void EventCells::setBits(const Level& level, std::size_t row, std::int32_t x, bool occupied) {
    std::uint8_t* const bytes = m_bits.data() + level.rows + row * level.rowBytes;
    const auto setBit = [&](std::int32_t bit) {
        const unsigned mask = 1U << (bit & 7);
        std::uint8_t& byte = bytes[bit >> 3];
        byte = static_cast<std::uint8_t>(occupied ? byte | mask : byte & ~mask);
    };
    setBit(x + 1);
    if (static_cast<std::uint32_t>(x - 1) < static_cast<std::uint32_t>(level.extent[0] - 2)) return;
    if (x == 0) setBit(level.extent[0] + 1);
    if (x + 1 == level.extent[0]) setBit(0);
}

inline void EventCells::link(const Level& level, const Spot& spot, std::uint32_t i) {
    std::uint32_t& first = m_first[spot.slot];
    if (first == nobody) setBits(level, spot.row, spot.x, true);
    m_next[i] = first;
    first = i;
}

inline void EventCells::unlink(const Level& level, const Spot& spot, std::uint32_t i) {
    std::uint32_t* link = &m_first[spot.slot];
    while (*link != i) link = &m_next[*link];
    *link = m_next[i];
    if (m_first[spot.slot] == nobody) setBits(level, spot.row, spot.x, false);
}

void EventCells::insert(EventRecords records, std::uint32_t i, const Vec3& position) {
    EventRecord& record = records[i];
    const double last = farthest >> record.level;
    for (int axis = 0; axis < 3; ++axis) {
        const double cell = std::floor((position[axis] - m_origin[axis]) / m_levels[record.level].side);
        record.place[index(axis)] = static_cast<std::int32_t>(std::clamp(cell, -last, last));
    }
    const Level& level = m_levels[record.level];
    link(level, spotOf(level, record.place), i);
}

void EventCells::cross(EventRecords records, std::uint32_t i, int axis, int direction) {
    Place& place = records[i].place;
    const Level& level = m_levels[records[i].level];
    unlink(level, spotOf(level, place), i);
    place[index(axis)] += direction;
    link(level, spotOf(level, place), i);
}

std::size_t EventCells::bytes() const {
    return heldBytes(m_levels, m_first, m_next, m_bits, m_walls, m_count);
}

} // namespace carom
