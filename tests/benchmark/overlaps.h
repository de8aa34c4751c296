// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"

#include <algorithm>
#include <cstdint>

namespace carom {

/// How far bodies overlap, by the exact distance of every pair of which one can move, relative to the half
/// thickness of the thinner body (the radius of a sphere).
struct Overlaps {
    double sum = 0;          ///< over the pairs below
    std::uint64_t pairs = 0; ///< that overlap, whatever by
    double largest = 0;

    double mean() const { return pairs == 0 ? 0 : sum / static_cast<double>(pairs); }
    void add(const Overlaps& other) {
        sum += other.sum;
        pairs += other.pairs;
        largest = std::max(largest, other.largest);
    }
};

Overlaps overlapsAt(const Bodies& bodies, const State& state);

} // namespace carom
