// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace carom {

/// Ensures capacity for `count` elements; where that needs memory, for twice as many, so that a vector that
/// grows a little from step to step rarely allocates.
template<class Element>
void reserveFor(std::size_t count, std::vector<Element>& in) {
    if (in.capacity() < count) in.reserve(2 * count);
}

} // namespace carom
