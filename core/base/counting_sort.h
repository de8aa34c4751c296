// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/held_bytes.h"
#include "core/base/workers.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace carom {

/// Sorts by a key below a known number, and leaves what has the same key in the order that it has. Each
/// thread counts and places what is in its part.
class CountingSort {
  public:
    /// Calls put(i, place) for every i below `count` and each of its keys, which forKeysOf(i, visit) visits:
    /// that is its place when sorted by them.
    template<class ForKeysOf, class Put>
    void sort(std::size_t count, std::size_t keys, const ForKeysOf& forKeysOf, const Put& put,
              Workers& workers = Workers::alone()) {
        const std::size_t least = std::max(fewCounted, keys);
        m_keys = keys;
        m_parts = std::clamp(count / least, std::size_t{1}, static_cast<std::size_t>(workers.threads()));
        m_next.resize(m_parts * keys);
        const auto forParts = [&](const auto& work) {
            workers.forEach(m_parts, [&](std::size_t, std::size_t part) {
                work(part, part * count / m_parts, (part + 1) * count / m_parts);
            });
        };
        forParts([&](std::size_t part, std::size_t begin, std::size_t end) {
            std::uint32_t* const counts = row(part);
            std::fill_n(counts, keys, 0U);
            for (std::size_t i = begin; i < end; ++i)
                forKeysOf(i, [counts](std::size_t key) { ++counts[key]; });
        });
        findPlaces();
        forParts([&](std::size_t part, std::size_t begin, std::size_t end) {
            std::uint32_t* const next = row(rowToPlace(part));
            for (std::size_t i = begin; i < end; ++i)
                forKeysOf(i, [&](std::size_t key) { put(i, next[key]++); });
        });
    }
    /// Where what has this key ends, of what was sorted last.
    std::uint32_t endOf(std::size_t key) const { return m_next[rowToPlace(m_parts - 1) * m_keys + key]; }
    std::size_t bytes() const { return heldBytes(m_next); }

  private:
    /// Items that one thread sorts at least; and no fewer than there are keys, which are counted for each.
    static constexpr std::size_t fewCounted = Workers::enoughOf(5);

    std::uint32_t* row(std::size_t part) { return m_next.data() + part * m_keys; }
    static void add(const std::uint32_t* from, std::size_t count, std::uint32_t* to) {
        for (std::size_t i = 0; i < count; ++i) to[i] += from[i];
    }
    // To the counts of a part are added those before it, by key. Where a key begins is then in the last row,
    // and where that of a later part does in the row of the one before.
    void findPlaces() {
        for (std::size_t part = 1; part < m_parts; ++part) add(row(part - 1), m_keys, row(part));
        std::uint32_t* const begin = row(m_parts - 1);
        std::uint32_t sum = 0;
        for (std::size_t key = 0; key < m_keys; ++key) sum += std::exchange(begin[key], sum);
        for (std::size_t part = 1; part < m_parts; ++part) add(begin, m_keys, row(part - 1));
    }
    std::size_t rowToPlace(std::size_t part) const { return part > 0 ? part - 1 : m_parts - 1; }

    std::size_t m_keys = 0, m_parts = 1;
    std::vector<std::uint32_t> m_next; // by row and key: where the next one goes
};

} // namespace carom
