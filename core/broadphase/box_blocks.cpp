// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/broadphase/box_blocks.h"

#include "core/math/morton.h"

#include <algorithm>

namespace carom {

void BoxBlocks::build(std::span<const Aabb> boxes) {
    const std::size_t count = boxes.size();
    m_blockCount = (count + size - 1) / size;
    m_place.resize(count);
    m_entry.resize(count);
    m_boxes.resize(count);
    m_blocks.resize(m_blockCount);
    if (count == 0) return;
    Vec3 lowest = boxes[0].centre();
    double extent = 0;
    for (const Aabb& box : boxes) {
        lowest = lowest.cwiseMin(box.centre());
        extent += box.size().maxCoeff();
    }
    const double cell = extent > 0 ? extent / static_cast<double>(count) : 1;
    m_order.clear();
    for (std::size_t entry = 0; entry < count; ++entry)
        m_order.emplace_back(mortonCode((boxes[entry].centre() - lowest) / cell, mortonBits),
                             static_cast<std::uint32_t>(entry));
    std::sort(m_order.begin(), m_order.end());
    for (std::size_t block = 0; block < m_blockCount; ++block) {
        const std::size_t begin = block * size, end = std::min(begin + size, count);
        Aabb around = boxes[m_order[begin].second];
        for (std::size_t place = begin; place < end; ++place) {
            const std::uint32_t entry = m_order[place].second;
            m_place[entry] = static_cast<std::uint32_t>(place);
            m_entry[place] = entry;
            m_boxes.set(place, boxes[entry]);
            around = united(around, boxes[entry]);
        }
        m_blocks.set(block, around);
    }
}

void BoxBlocks::set(std::size_t entry, const Aabb& box) {
    const std::size_t block = m_place[entry] / size;
    m_boxes.set(m_place[entry], box);
    m_blocks.set(block, united(m_blocks.box(block), box));
}

std::span<const std::uint32_t> BoxBlocks::overlapping(const Aabb& box, Search& search) const {
    auto& [ranges, hits] = search;
    hits.resize(std::max(m_entry.size(), m_blockCount) + wideLanes);
    const BoxRange all{0, static_cast<std::uint32_t>(m_blockCount)};
    const std::size_t blocks = carom::overlapping(m_blocks, box, {&all, 1}, hits.data());
    ranges.clear();
    for (std::size_t k = 0; k < blocks; ++k) {
        const std::uint32_t begin = hits[k] * static_cast<std::uint32_t>(size);
        const std::uint32_t end =
            std::min(begin + static_cast<std::uint32_t>(size), static_cast<std::uint32_t>(m_entry.size()));
        ranges.push_back({begin, end});
    }
    const std::size_t found = carom::overlapping(m_boxes, box, ranges, hits.data());
    for (std::size_t k = 0; k < found; ++k) hits[k] = m_entry[hits[k]];
    return {hits.data(), found};
}

} // namespace carom
