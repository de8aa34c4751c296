// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>
#include <span>

namespace carom {

/// A 64-bit hash of a sequence of words, the same on every machine. Each word is mixed by the finaliser of
/// SplitMix64 (G. L. Steele, D. Lea, C. H. Flood: "Fast splittable pseudorandom number generators", 2014).
class Hash64 {
  public:
    void add(std::uint64_t word) { m_state = mix(m_state ^ mix(word + 0x9E3779B97F4A7C15ULL)) + 1; }
    /// The exact bits of a double; +0 and -0 differ.
    void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
    void add(std::span<const double> values) {
        for (const double value : values) add(value);
    }
    std::uint64_t value() const { return mix(m_state); }

    static constexpr std::uint64_t mix(std::uint64_t z) {
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
        return z ^ (z >> 31U);
    }

  private:
    std::uint64_t m_state = 0;
};

} // namespace carom
