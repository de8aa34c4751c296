// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace carom {

/// Sorts what has a `pair`, ascending: a counting sort by the first body, whose few pairs are then put in
/// order one by one. No pair may occur twice.
template<class Entry>
class PairSort {
  public:
    /// `bodies` are those of the scene.
    void sort(std::vector<Entry>& entries, std::size_t bodies) {
        m_first.assign(bodies + 1, 0);
        for (const Entry& entry : entries) ++m_first[entry.pair.a + 1];
        for (std::size_t i = 0; i < bodies; ++i) m_first[i + 1] += m_first[i];
        if (m_sorted.capacity() < entries.capacity()) m_sorted.reserve(entries.capacity());
        m_sorted.resize(entries.size());
        for (const Entry& entry : entries) m_sorted[m_first[entry.pair.a]++] = entry;
        for (std::size_t i = 1; i < m_sorted.size(); ++i)
            for (std::size_t k = i; k > 0 && m_sorted[k].pair < m_sorted[k - 1].pair; --k)
                std::swap(m_sorted[k], m_sorted[k - 1]);
        std::swap(entries, m_sorted);
    }

  private:
    std::vector<std::uint32_t> m_first; // by body: where its next pair goes
    std::vector<Entry> m_sorted;
};

} // namespace carom
