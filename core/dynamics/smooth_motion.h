// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/dynamics/state.h"

#include <span>

namespace carom {

/// How bodies move between impacts, under an acceleration that is constant over the substep: what integrators
/// provide and solvers call, without knowing each other. Bodies do not know each other either: a call for two
/// bodies is two calls.
struct SmoothMotion {
    /// Moves the centres of `bodies` through h seconds under the acceleration [m/s²].
    void (*move)(std::span<const BodyIndex> bodies, const Vec3& acceleration, double h,
                 State& state) = nullptr;
    /// Turns `bodies` through h seconds free of torque.
    void (*turn)(std::span<const BodyIndex> bodies, double h, State& state) = nullptr;
};

} // namespace carom
