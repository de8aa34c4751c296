// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace carom {

/// Sees that a vector holds `count` elements without taking memory, and when it must take some, takes it for
/// twice as many: what grows a little from step to step then takes none.
template<class Element>
void reserveFor(std::size_t count, std::vector<Element>& in) {
    if (in.capacity() < count) in.reserve(2 * count);
}

} // namespace carom
