// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/types.h"

#include <array>
#include <cstdint>
#include <span>

// When a bouncing ball has come to rest on a wall, and how one on several walls goes on.

namespace carom {

/// A ball that does not fly free: it rests on walls and slides along them, or is fixed. Its velocity has no
/// part along the normals of its walls.
struct Rest {
    static constexpr std::size_t mostWalls = 3;

    Vec3 acceleration = Vec3::Zero(); ///< [m/s²]
    std::array<std::uint16_t, mostWalls> walls{};
    std::uint8_t count = 0;

    std::span<const std::uint16_t> on() const { return {walls.data(), count}; }
};

/// The part of gravity [m/s²] left to a ball on up to three walls: the reactions are those that push and,
/// among them, balance what pushes in. Walls that would have to pull are let go.
Vec3 supportedAcceleration(const Vec3& gravity, std::span<const Vec3> normals);

/// A ball that leaves a wall at `speed` [m/s] and is pulled back, `acceleration` [m/s²] < 0, bounces for
/// 2 speed / (|acceleration| (1 − restitution)) more seconds in all, the sum of the geometric series, and is
/// at rest then. Where that is shorter than anything one could see, a billionth of the time a fall through
/// its radius [m] takes, it is at rest now; likewise where a single bounce is a tenth of that, which ends the
/// bounces that rounding alone keeps up.
bool restsAfter(double speed, double acceleration, double restitution, double radius);

} // namespace carom
