// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/aabb.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

/// Boxes turned on their side: one array a coordinate, so that one box is compared with many at once.
struct BoxColumns {
    std::array<std::vector<double>, 3> lower, upper; ///< [m], by axis, then by entry

    void resize(std::size_t count);
    std::size_t size() const { return lower[0].size(); }
    void set(std::size_t entry, const Aabb& box);
    Aabb box(std::size_t entry) const;
    std::size_t bytes() const;
};

/// Writes the entries in begin .. end-1 whose boxes overlap `box` to `hits`, ascending, and returns how many
/// there are. `hits` must have room for end - begin.
std::size_t overlapping(const BoxColumns& columns, const Aabb& box, std::size_t begin, std::size_t end,
                        std::uint32_t* hits);

} // namespace carom
