// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace carom {

/// Sorts what has a `pair`, ascending: two counting sorts, by the second body and then by the first, which
/// keeps those of one first body in order. No pair may occur twice.
template<class Entry>
class PairSort {
  public:
    /// `bodies` are those of the scene.
    void sort(std::vector<Entry>& entries, std::size_t bodies) {
        if (entries.empty()) return;
        m_first.assign(bodies + 1, 0);
        m_second.assign(bodies + 1, 0);
        for (const Entry& entry : entries) {
            ++m_first[entry.pair.a + 1];
            ++m_second[entry.pair.b + 1];
        }
        for (std::size_t i = 0; i < bodies; ++i) {
            m_first[i + 1] += m_first[i];
            m_second[i + 1] += m_second[i];
        }
        if (m_sorted.capacity() < entries.capacity()) m_sorted.reserve(entries.capacity());
        m_sorted.resize(entries.size());
        for (const Entry& entry : entries) m_sorted[m_second[entry.pair.b]++] = entry;
        for (const Entry& entry : m_sorted) entries[m_first[entry.pair.a]++] = entry;
    }
    /// Those of which this is the first body, of the entries sorted last.
    std::span<const Entry> of(BodyIndex first, const std::vector<Entry>& entries) const {
        if (entries.empty()) return {};
        const std::uint32_t begin = first > 0 ? m_first[first - 1] : 0;
        return std::span(entries).subspan(begin, m_first[first] - begin);
    }

  private:
    // By body: where its next pair goes, as the first or the second one; when sorted, where they end.
    std::vector<std::uint32_t> m_first, m_second;
    std::vector<Entry> m_sorted;
};

} // namespace carom
