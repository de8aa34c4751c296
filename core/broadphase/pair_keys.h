// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/counting_sort.h"
#include "core/broadphase/broadphase.h"

#include <cstdint>
#include <vector>

namespace carom {

/// Two entries of an input, a < b, as one number that sorts as the pair does.
using PairKey = std::uint64_t;

constexpr PairKey pairKey(std::uint32_t i, std::uint32_t j) {
    return i < j ? (PairKey{i} << 32) | j : (PairKey{j} << 32) | i;
}
constexpr std::uint32_t firstOf(PairKey key) { return static_cast<std::uint32_t>(key >> 32); }
constexpr std::uint32_t secondOf(PairKey key) { return static_cast<std::uint32_t>(key); }

/// Sorts pairs into the order that all algorithms share, in O(boxes + pairs): by counting, first by the
/// second entry, then by the first, where pairs keep the order they have.
class PairOrder {
  public:
    /// Sorts `keys` and leaves out repetitions and pairs of two immobile boxes.
    void tidy(std::vector<PairKey>& keys, const BroadphaseInput& input);

    std::size_t bytes() const;

  private:
    CountingSort m_sort;
    std::vector<PairKey> m_bySecond;
};

/// The pairs of bodies that ordered keys stand for.
void translate(const std::vector<PairKey>& keys, const BroadphaseInput& input, std::vector<BodyPair>& pairs);

} // namespace carom
