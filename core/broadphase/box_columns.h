// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/wide.h"
#include "core/math/aabb.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace carom {

/// Boxes as a structure of arrays, one a coordinate, so that one box is compared with many at once.
struct BoxColumns {
    std::array<std::vector<double>, 3> lower, upper; ///< [m], by axis, then by entry; wideLanes more

    void resize(std::size_t count);
    void set(std::size_t entry, const Aabb& box);
    Aabb box(std::size_t entry) const;
    std::size_t bytes() const;
};

/// Entries begin .. end-1.
struct BoxRange {
    std::uint32_t begin = 0, end = 0;
};

/// Writes the entries in `ranges` whose boxes overlap `box` to `hits`, in the order of the ranges, and
/// returns how many there are. `hits` must have room for all entries in the ranges and wideLanes more.
std::size_t overlapping(const BoxColumns& columns, const Aabb& box, std::span<const BoxRange> ranges,
                        std::uint32_t* hits);

} // namespace carom
