// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/types.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

/// Balls turned on their side: one array a coordinate, so that one is compared with many at once.
struct BallColumns {
    std::array<std::vector<double>, 3> centre; ///< [m], by axis, then by entry
    std::vector<double> radius;                ///< [m]

    void resize(std::size_t count);
    std::size_t size() const { return radius.size(); }
    void set(std::size_t entry, const Vec3& place, double size) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            centre[axis][entry] = place[static_cast<Eigen::Index>(axis)];
        radius[entry] = size;
    }
};

/// Writes the entries whose balls overlap the one given to `hits`, ascending, and returns how many there are.
/// `hits` must have room for all.
std::size_t overlapping(const BallColumns& balls, const Vec3& centre, double radius, std::uint32_t* hits);

} // namespace carom
