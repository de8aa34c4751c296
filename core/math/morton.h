// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/types.h"

#include <algorithm>
#include <cstdint>

namespace carom {

/// Bits of an axis that a place on Morton's curve can have.
inline constexpr unsigned mortonBits = 21;

/// How far along Morton's curve a place comes, in cells from the lowest corner; what lies outside counts as
/// the nearest cell, what is not a number as the first. `bits` are those of an axis, up to mortonBits; the
/// code has three times as many (G. M. Morton, "A computer oriented geodetic data base", 1966).
inline std::uint64_t mortonCode(const Vec3& cells, unsigned bits) {
    const double most = static_cast<double>((std::uint64_t{1} << bits) - 1);
    const auto spread = [](std::uint64_t v) { // two zeros after each bit
        v = (v | v << 32) & 0x1f00000000ffff;
        v = (v | v << 16) & 0x1f0000ff0000ff;
        v = (v | v << 8) & 0x100f00f00f00f00f;
        v = (v | v << 4) & 0x10c30c30c30c30c3;
        return (v | v << 2) & 0x1249249249249249;
    };
    std::uint64_t code = 0;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
        code |= spread(static_cast<std::uint64_t>(cells[axis] > 0 ? std::min(cells[axis], most) : 0)) << axis;
    return code;
}

} // namespace carom
