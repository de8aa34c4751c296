// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/work_counters.h"

// The work of the method `contacts` is counted, never timed: a scene takes the same decisions on every
// machine. The unit is an operation of about half a nanosecond on a processor of 2020; the figures below were
// measured with callgrind and rounded. What is refined beyond the base path (refinement.h) is bounded by a
// budget in this unit. A figure that is twice or half of what it should be moves the limit at which islands
// of that work are left to the base path by as much, and the time of a frame with it.

namespace carom {

namespace work {
inline constexpr double row = 120;          ///< looking at one contact point: velocity, cone, gradient
inline constexpr double body = 60;          ///< the same of a body
inline constexpr double block = 110;        ///< a product of two 6 × 6 blocks
inline constexpr double apply = 25;         ///< a product of such a block and a vector
inline constexpr double ordering = 500;     ///< a coupling, in choosing the order of elimination
inline constexpr double collide = 2500;     ///< a pair of cylinders or cuboids
inline constexpr double look = 3;           ///< comparing a remembered figure of a row
inline constexpr double pull = 60;          ///< a spring in a round of its iteration
inline constexpr double swept = 10;         ///< a row in a pass of the base path
inline constexpr double carried = 500;      ///< a pair of bodies on the base path, in a substep
inline constexpr double collideRound = 150; ///< a pair with a sphere, or with a wall
} // namespace work

/// What counters stand for [operations]: refinement, rows swept, and shapes compared, all as dear as the
/// dearest.
inline double operationsOf(const WorkCounters& counters) {
    return counters.operations + work::swept * static_cast<double>(counters.rowsSwept) +
           work::collide * static_cast<double>(counters.pairsCollided);
}

} // namespace carom
