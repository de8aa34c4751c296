// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/types.h"

#include <array>
#include <cstdint>
#include <span>

// When a bouncing ball has come to rest on a wall or on top of another ball, and the motion of one that rests
// on several walls.

namespace carom {

/// A ball that does not move freely: it rests on walls and slides along them, stands still on top of another
/// ball, or is fixed. Its velocity has no part along the normals of its walls.
struct Rest {
    /// Walls that a ball rests on at most: three hold it still.
    static constexpr std::size_t mostWalls = 3;
    static constexpr std::uint32_t noBall = 0xffffffffU;

    Vec3 acceleration = Vec3::Zero(); ///< [m/s²]
    std::uint32_t ball = noBall;      ///< that it stands on; then walls are none
    std::array<std::uint16_t, mostWalls> walls{};
    std::uint8_t count = 0;

    std::span<const std::uint16_t> on() const { return {walls.data(), count}; }
};

/// The part of gravity [m/s²] left to a ball on up to three walls: the reactions are those that push and,
/// among them, balance what pushes in. Walls that would have to pull are let go.
Vec3 supportedAcceleration(const Vec3& gravity, std::span<const Vec3> normals);

/// A ball that leaves a wall at `speed` [m/s] and is pulled back, `acceleration` [m/s²] < 0, bounces for 2
/// speed / (|acceleration| (1 − restitution)) more seconds in all, the sum of the geometric series, and is at
/// rest then. Where that is shorter than a billionth of the time of a fall through its radius [m], it is at
/// rest now; likewise where a single bounce is a tenth of that, which ends bounces that rounding alone
/// sustains. A ball that loses no energy rests where its bounce is lower than leastHop().
bool restsAfter(double speed, double acceleration, double restitution, double radius);

/// The speed [m/s] of the lowest bounce of two balls of which one lies on the other, with relative
/// acceleration `pull` [m/s²] < 0. Where energy is lost the bounce has a height of a billionth of `radius`
/// [m]: a tenth of that costs three times as many events; ten times as much shows in measurements. Where none
/// is lost a height of 1e-10 of it is kept, in ten thousand bounces a frame of 1/60 s; a tenth of that, in
/// thirty thousand.
double leastHop(double pull, double restitution, double radius);

/// Whether a ball stands on top of one that is still and carries it, `normal` pointing up to it: gravity has
/// no part beside the normal and the ball no `velocity` [m/s] beside it, but for rounding. That is the one
/// way in which balls rest on each other in closed form.
bool isBalanced(const Vec3& gravity, const Vec3& normal, const Vec3& velocity, double radius);

/// In every other way balls slide on each other, which is no closed form. Where a pair would come to rest,
/// pulled together by `pull` [m/s²] < 0, it goes on in lowest bounces. Their energy, 1e-9 of that of a fall
/// through the radius, is added once, not at every bounce: the next impact removes it again. `after` [m/s]:
/// at which they separate by restitution; returns at which they do.
double separationSpeed(double after, double pull, double restitution, double radius);

} // namespace carom
