// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/broadphase/box_columns.h"
#include "core/broadphase/pair_keys.h"

#include <cstdint>
#include <span>
#include <vector>

namespace carom {

/// The axis along which the boxes' centres have the largest variance: a sweep along it compares the fewest.
std::size_t axisOfLargestVariance(std::span<const Aabb> boxes);

/// Sorts boxes by their lower ends along one axis and traverses them once: a box is compared with those that
/// begin before it ends. The order is kept between sweeps, so a scene that moves little sorts quickly.
class AxisSweep {
  public:
    /// Appends the keys of all overlapping pairs, mobile or not, to `pairs` in no particular order and
    /// returns how many boxes were compared.
    std::uint64_t collect(std::span<const Aabb> boxes, std::size_t axis, std::vector<PairKey>& pairs);

    std::size_t bytes() const;

  private:
    struct Start {
        double at;           ///< [m]
        std::uint32_t entry; ///< of the input
    };
    void sortStarts(std::span<const Aabb> boxes, std::size_t axis);

    std::vector<Start> m_starts; ///< ascending
    BoxColumns m_columns;        ///< in the order of m_starts
    std::vector<std::uint32_t> m_hits;
};

} // namespace carom
