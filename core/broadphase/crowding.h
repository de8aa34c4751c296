// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/aabb.h"

#include <algorithm>
#include <span>

namespace carom {

/// How many other boxes overlap a box on average, estimated from 128 boxes against all. Counting all pairs
/// would take time and memory by the square where a text puts a hundred thousand bodies in one place; the
/// estimate takes 128 n comparisons whatever the scene, and is off by about a tenth where the answer is 1.
inline double neighboursPerBox(std::span<const Aabb> boxes) {
    constexpr std::size_t samples = 128;
    const std::size_t stride = std::max<std::size_t>(1, boxes.size() / samples);
    std::size_t tried = 0, neighbours = 0;
    for (std::size_t i = 0; i < boxes.size(); i += stride, ++tried) {
        for (const Aabb& box : boxes) neighbours += overlap(boxes[i], box) ? 1 : 0;
        --neighbours; // itself
    }
    return tried == 0 ? 0 : static_cast<double>(neighbours) / static_cast<double>(tried);
}

} // namespace carom
