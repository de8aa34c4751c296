// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace carom {

/// Sorts what has a `pair`, ascending: a counting sort by the first body, then each body's pairs by the
/// second: few for most bodies, all of them for a floor. No pair may occur twice.
template<class Entry>
class PairSort {
  public:
    /// `bodies` are those of the scene.
    void sort(std::vector<Entry>& entries, std::size_t bodies) {
        if (entries.empty()) return;
        m_first.assign(bodies + 1, 0);
        for (const Entry& entry : entries) ++m_first[entry.pair.a + 1];
        for (std::size_t i = 0; i < bodies; ++i) m_first[i + 1] += m_first[i];
        if (m_sorted.capacity() < entries.capacity()) m_sorted.reserve(entries.capacity());
        m_sorted.resize(entries.size());
        for (const Entry& entry : entries) m_sorted[m_first[entry.pair.a]++] = entry;
        const auto isBefore = [](const Entry& one, const Entry& other) { return one.pair.b < other.pair.b; };
        for (auto from = m_sorted.begin(); from != m_sorted.end();) {
            const auto to = m_sorted.begin() + m_first[from->pair.a]; // by now where the body's pairs end
            if (!std::is_sorted(from, to, isBefore)) std::sort(from, to, isBefore);
            from = to;
        }
        std::swap(entries, m_sorted);
    }
    /// Those of which this is the first body, of the entries sorted last.
    std::span<const Entry> of(BodyIndex first, const std::vector<Entry>& entries) const {
        if (entries.empty()) return {};
        const std::uint32_t begin = first > 0 ? m_first[first - 1] : 0;
        return std::span(entries).subspan(begin, m_first[first] - begin);
    }

  private:
    std::vector<std::uint32_t> m_first; // by body: where its next pair goes; when sorted, where they end
    std::vector<Entry> m_sorted;
};

} // namespace carom
