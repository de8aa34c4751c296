// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/broadphase/box_blocks.h"

#include <algorithm>

// Blocks are the leaves of a k-d tree (J. L. Bentley, "Multidimensional binary search trees used for
// associative searching", 1975): the boxes are halved at the median of their centres, across the longest side
// of the space that they share, until they are one block. Along Morton's curve, where blocks are longer, a
// search compares with twice as many.

namespace carom {

void BoxBlocks::build(std::span<const Aabb> boxes) {
    if (boxes.size() == m_entry.size() && !boxes.empty()) {
        fill(boxes);
        if (!areWorn()) return;
    }
    sort(boxes);
    fill(boxes);
    m_widths.clear();
    if (m_levels.size() < 2) return;
    for (std::size_t block = 0; block < m_levels[1].count; ++block) m_widths.push_back(widthOf(block));
}

void BoxBlocks::sort(std::span<const Aabb> boxes) {
    const std::size_t count = boxes.size();
    m_place.resize(count);
    m_entry.resize(count);
    makeLevels(count);
    m_centres.clear();
    if (count == 0) return;
    Aabb around{boxes[0].centre(), boxes[0].centre()};
    for (std::size_t entry = 0; entry < count; ++entry) {
        const Vec3 centre = boxes[entry].centre();
        m_centres.push_back({centre, static_cast<std::uint32_t>(entry)});
        around = united(around, {centre, centre});
    }
    arrange(m_centres, around);
    for (std::size_t place = 0; place < count; ++place) {
        const std::uint32_t entry = m_centres[place].entry;
        m_place[entry] = static_cast<std::uint32_t>(place);
        m_entry[place] = entry;
    }
}

// Puts the boxes in their places, and boxes around blocks.
void BoxBlocks::fill(std::span<const Aabb> boxes) {
    for (std::size_t place = 0; place < boxes.size(); ++place)
        m_levels[0].boxes.set(place, boxes[m_entry[place]]);
    for (std::size_t level = 1; level < m_levels.size(); ++level) {
        const BoxColumns& below = m_levels[level - 1].boxes;
        for (std::size_t block = 0; block < m_levels[level].count; ++block) {
            const BoxRange range = rangeOf(level, block);
            Aabb all = below.box(range.begin);
            for (std::size_t k = range.begin + 1; k < range.end; ++k) all = united(all, below.box(k));
            m_levels[level].boxes.set(block, all);
        }
    }
}

// The sum of its three widths [m].
double BoxBlocks::widthOf(std::size_t block) const { return m_levels[1].boxes.box(block).size().sum(); }

// One box that moves far is in one block: its own.
bool BoxBlocks::areWorn() const {
    std::size_t count = 0;
    for (std::size_t block = 0; block < m_widths.size(); ++block)
        count += static_cast<std::size_t>(widthOf(block) > worn * m_widths[block]);
    return count * fewWorn > m_widths.size();
}

void BoxBlocks::makeLevels(std::size_t count) {
    const auto blocksOf = [](std::size_t boxes) { return (boxes + size - 1) / size; };
    std::size_t levels = 1;
    for (std::size_t boxes = count; boxes > size; boxes = blocksOf(boxes)) ++levels;
    m_levels.resize(levels);
    for (Level& level : m_levels) {
        level.count = count;
        level.boxes.resize(count);
        count = blocksOf(count);
    }
}

// Divides between whole blocks of the highest level that has more than one, so that these hold neighbours,
// too.
void BoxBlocks::arrange(std::span<Centre> centres, const Aabb& around) {
    if (centres.size() <= size) return;
    std::size_t block = size;
    while (block * size < centres.size()) block *= size;
    const std::size_t middle = (centres.size() + block - 1) / block / 2 * block;
    Eigen::Index axis = 0;
    around.size().maxCoeff(&axis);
    std::nth_element(centres.begin(), centres.begin() + static_cast<std::ptrdiff_t>(middle), centres.end(),
                     [axis](const Centre& a, const Centre& b) { return a.at[axis] < b.at[axis]; });
    Aabb lower = around, upper = around;
    lower.upper[axis] = upper.lower[axis] = centres[middle].at[axis];
    arrange(centres.first(middle), lower);
    arrange(centres.subspan(middle), upper);
}

// What is in a block, in the level below.
BoxRange BoxBlocks::rangeOf(std::size_t level, std::size_t block) const {
    const std::size_t begin = block * size, end = std::min(begin + size, m_levels[level - 1].count);
    return {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
}

void BoxBlocks::set(std::size_t entry, const Aabb& box) {
    std::size_t place = m_place[entry];
    m_levels[0].boxes.set(place, box);
    for (Level& level : std::span(m_levels).subspan(1)) {
        place /= size;
        level.boxes.set(place, united(level.boxes.box(place), box));
    }
}

std::span<const std::uint32_t> BoxBlocks::overlapping(const Aabb& box, Search& search) const {
    auto& [ranges, hits] = search;
    hits.resize(m_entry.size() + wideLanes);
    ranges.assign(1, {0, static_cast<std::uint32_t>(m_levels.back().count)});
    std::size_t level = m_levels.size() - 1;
    std::size_t found = carom::overlapping(m_levels[level].boxes, box, ranges, hits.data());
    for (; level > 0; --level) {
        ranges.clear();
        for (const std::uint32_t block : std::span(hits).first(found))
            ranges.push_back(rangeOf(level, block));
        found = carom::overlapping(m_levels[level - 1].boxes, box, ranges, hits.data());
    }
    for (std::uint32_t& hit : std::span(hits).first(found)) hit = m_entry[hit];
    return {hits.data(), found};
}

} // namespace carom
