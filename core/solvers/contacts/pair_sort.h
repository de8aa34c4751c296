// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/counting_sort.h"
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
    void sort(std::vector<Entry>& entries, std::size_t bodies, Workers& workers = Workers::alone()) {
        if (entries.empty()) return;
        if (m_sorted.capacity() < entries.capacity()) m_sorted.reserve(entries.capacity());
        m_sorted.resize(entries.size());
        const auto sortBy = [&](CountingSort& sort, BodyIndex BodyPair::*body, const Entry* from, Entry* to) {
            sort.sort(
                entries.size(), bodies, [=](std::size_t i, const auto& visit) { visit(from[i].pair.*body); },
                [=](std::size_t i, std::size_t place) { to[place] = from[i]; }, workers);
        };
        sortBy(m_bySecond, &BodyPair::b, entries.data(), m_sorted.data());
        sortBy(m_byFirst, &BodyPair::a, m_sorted.data(), entries.data());
    }
    /// Those of which this is the first body, of the entries sorted last.
    std::span<const Entry> of(BodyIndex first, const std::vector<Entry>& entries) const {
        if (entries.empty()) return {};
        const std::uint32_t begin = first > 0 ? m_byFirst.endOf(first - 1) : 0;
        return std::span(entries).subspan(begin, m_byFirst.endOf(first) - begin);
    }

  private:
    CountingSort m_bySecond, m_byFirst;
    std::vector<Entry> m_sorted;
};

} // namespace carom
