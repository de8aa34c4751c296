// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/broadphase/axis_sweep.h"

#include <algorithm>

namespace carom {
namespace {

// Moves an insertion sort may make for each box before a sort from scratch is the cheaper way; twice or half
// of it costs time in frames in which much moves.
constexpr std::size_t mostMovesPerBox = 16;

double component(const Vec3& v, std::size_t axis) { return v[static_cast<Eigen::Index>(axis)]; }

} // namespace

std::size_t axisOfLargestVariance(std::span<const Aabb> boxes) {
    if (boxes.empty()) return 0;
    const double share = 1.0 / static_cast<double>(boxes.size());
    Vec3 mean = Vec3::Zero(), variance = Vec3::Zero();
    for (const Aabb& box : boxes) mean += share * box.centre();
    for (const Aabb& box : boxes) variance += share * (box.centre() - mean).cwiseAbs2();
    Eigen::Index axis = 0;
    variance.maxCoeff(&axis);
    return static_cast<std::size_t>(axis);
}

void AxisSweep::sortStarts(std::span<const Aabb> boxes, std::size_t axis) {
    const bool fresh = m_starts.size() != boxes.size();
    if (fresh) {
        m_starts.resize(boxes.size());
        for (std::size_t i = 0; i < boxes.size(); ++i) m_starts[i].entry = static_cast<std::uint32_t>(i);
    }
    for (Start& start : m_starts) start.at = component(boxes[start.entry].lower, axis);

    const auto sortAll = [this] {
        std::sort(m_starts.begin(), m_starts.end(),
                  [](const Start& a, const Start& b) { return a.at < b.at; });
    };
    if (fresh) return sortAll();
    std::size_t moves = 0;
    for (std::size_t p = 1; p < m_starts.size(); ++p) {
        const Start start = m_starts[p];
        std::size_t q = p;
        for (; q > 0 && start.at < m_starts[q - 1].at; --q) m_starts[q] = m_starts[q - 1];
        m_starts[q] = start;
        moves += p - q;
        if (moves > mostMovesPerBox * m_starts.size()) return sortAll();
    }
}

std::uint64_t AxisSweep::collect(std::span<const Aabb> boxes, std::size_t axis, std::vector<PairKey>& pairs) {
    const std::size_t count = boxes.size();
    sortStarts(boxes, axis);
    m_columns.resize(count);
    m_hits.resize(count + wideLanes);
    for (std::size_t p = 0; p < count; ++p) m_columns.set(p, boxes[m_starts[p].entry]);

    std::uint64_t tested = 0;
    const std::vector<double>& upper = m_columns.upper[axis];
    for (std::size_t p = 0; p < count; ++p) {
        const std::vector<Start>::const_iterator past =
            std::upper_bound(m_starts.cbegin() + static_cast<std::ptrdiff_t>(p) + 1, m_starts.cend(),
                             upper[p], [](double end, const Start& start) { return end < start.at; });
        const BoxRange later{static_cast<std::uint32_t>(p + 1),
                             static_cast<std::uint32_t>(past - m_starts.cbegin())};
        const std::uint32_t entry = m_starts[p].entry;
        const std::size_t found = overlapping(m_columns, boxes[entry], {&later, 1}, m_hits.data());
        for (std::size_t k = 0; k < found; ++k) pairs.push_back(pairKey(entry, m_starts[m_hits[k]].entry));
        tested += later.end - later.begin;
    }
    return tested;
}

std::size_t AxisSweep::bytes() const {
    return m_starts.capacity() * sizeof(Start) + m_columns.bytes() +
           m_hits.capacity() * sizeof(std::uint32_t);
}

} // namespace carom
