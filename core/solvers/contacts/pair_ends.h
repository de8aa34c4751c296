// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/counting_sort.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace carom {

/// The two bodies of each pair of a list, and the pairs of each body. Bodies are numbered; number 0 is what
/// cannot move.
class PairEnds {
  public:
    using Ends = std::pair<std::uint32_t, std::uint32_t>;

    bool isKnown() const { return m_isKnown; }
    /// Pairs or bodies come or go, or get other numbers.
    void forget() { m_isKnown = false; }

    /// endsOf(pair) gives the two numbers, below `bodies`.
    template<class EndsOf>
    void make(std::size_t pairs, std::size_t bodies, const EndsOf& endsOf,
              Workers& workers = Workers::alone()) {
        m_isKnown = true;
        m_of.resize(pairs);
        workers.forRanges(pairs, fewMade, [&](std::size_t begin, std::size_t end) {
            for (std::size_t pair = begin; pair < end; ++pair) m_of[pair] = endsOf(pair);
        });
        m_pairs.resize(2 * pairs);
        m_sort.sort(
            pairs, bodies,
            [this](std::size_t pair, const auto& visit) {
                const auto [a, b] = m_of[pair];
                if (a != 0) visit(a); // nobody asks for the pairs of number 0
                if (b != 0) visit(b);
            },
            [this](std::size_t pair, std::size_t place) {
                m_pairs[place] = static_cast<std::uint32_t>(pair);
            },
            workers);
    }

    /// By pair.
    std::span<const Ends> all() const { return m_of; }
    const Ends& of(std::size_t pair) const { return m_of[pair]; }
    /// Ascending; not of number 0.
    std::span<const std::uint32_t> pairsOf(std::uint32_t body) const {
        const std::uint32_t begin = m_sort.endOf(body - 1);
        return std::span(m_pairs).subspan(begin, m_sort.endOf(body) - begin);
    }

  private:
    /// Pairs of which one thread finds the bodies at least.
    static constexpr std::size_t fewMade = Workers::enoughOf(5);

    std::vector<Ends> m_of;
    std::vector<std::uint32_t> m_pairs; // of body 1, of body 2 and so on
    CountingSort m_sort;
    bool m_isKnown = false;
};

/// A set of pairs by number, a bit for each.
class PairSet {
  public:
    /// Empty, for numbers below `pairs`.
    void clear(std::size_t pairs) { m_words.assign(pairs / bits + 1, 0); }
    void add(std::uint32_t pair) { m_words[pair / bits] |= std::uint64_t{1} << pair % bits; }
    /// visit(pair), ascending.
    template<class Visit>
    void forEach(const Visit& visit) const {
        for (std::uint32_t word = 0; word < m_words.size(); ++word)
            for (std::uint64_t left = m_words[word]; left != 0; left &= left - 1)
                visit(bits * word + static_cast<std::uint32_t>(std::countr_zero(left)));
    }

  private:
    static constexpr std::uint32_t bits = 64;
    std::vector<std::uint64_t> m_words;
};

} // namespace carom
