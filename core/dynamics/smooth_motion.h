// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/dynamics/bodies.h"
#include "core/dynamics/spring_network.h"
#include "core/dynamics/state.h"

#include <span>

namespace carom {

/// How bodies move where nothing collides: what integrators provide and solvers call, without knowing each
/// other. Bodies in all but `moveOnSprings` do not know each other either: a call for two bodies is two
/// calls. Every function advances the state by h seconds.
struct SmoothMotion {
    bool isExactInFreeFall = false;     ///< several substeps of free fall are one, but for rounding
    bool isExactInFreeRotation = false; ///< and several of rotation free of torque
    /// Moves the centres of `bodies` under an acceleration [m/s²] that is constant over the substep.
    void (*move)(std::span<const BodyIndex> bodies, const Vec3& acceleration, double h,
                 State& state) = nullptr;
    /// Turns `bodies` about their angular velocities, which stay: for methods that leave inertia out.
    void (*turn)(std::span<const BodyIndex> bodies, double h, State& state) = nullptr;
    /// Turns `list` free of torque; each body's angular momentum stays as it is to rounding.
    void (*rotateFreely)(const Bodies& bodies, std::span<const BodyIndex> list, double h,
                         State& state) = nullptr;
    /// Moves and turns bodies that force terms act on and no spring holds.
    void (*moveUnderForces)(SpringNetwork& network, double h, State& state) = nullptr;
    /// Moves and turns bodies that springs couple, and that force terms may act on. Null: left to the
    /// method's own solve of coupled motion.
    void (*moveOnSprings)(SpringNetwork& network, double h, State& state) = nullptr;
};

/// Moves bodies by the mean of the velocities at both ends: SmoothMotion::move of every scheme that is exact
/// in free fall.
void moveOnParabola(std::span<const BodyIndex> bodies, const Vec3& acceleration, double h, State& state);

/// Turns bodies by exactly h|ω| about ω, which stays as it is: the SmoothMotion::turn of every scheme better
/// than the reference's. A body without spin keeps its orientation to the bit.
void turnBySpin(std::span<const BodyIndex> bodies, double h, State& state);

} // namespace carom
