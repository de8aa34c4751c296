// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/aabb.h"

#include <algorithm>
#include <span>
#include <vector>

namespace carom {

/// How many other boxes overlap a box on average, estimated from 128 boxes against all. Counting all pairs
/// would take time and memory by the square where a text puts a hundred thousand bodies in one place; the
/// estimate takes 128 n comparisons whatever the scene, and is off by about a tenth where the answer is 1.
inline double neighboursPerBox(std::span<const Aabb> boxes) {
    constexpr std::size_t wanted = 128; // samples; a quarter as many double the error of the estimate
    const std::size_t stride = std::max<std::size_t>(1, boxes.size() / wanted);
    std::vector<Aabb> samples;
    for (std::size_t i = 0; i < boxes.size(); i += stride) samples.push_back(boxes[i]);
    std::size_t neighbours = 0;
    for (const Aabb& box : boxes) // outside: the boxes go through the cache once, the samples stay in it
        for (const Aabb& sample : samples) neighbours += overlap(sample, box) ? 1 : 0;
    neighbours -= samples.size(); // themselves
    return samples.empty() ? 0 : static_cast<double>(neighbours) / static_cast<double>(samples.size());
}

} // namespace carom
