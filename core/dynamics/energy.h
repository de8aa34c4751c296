// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"

#include <span>

namespace carom {

/// What a closed system keeps, summed over mobile bodies.
struct Invariants {
    double kinetic = 0;           ///< [J] = Σ m v²/2 + ω·Iω/2
    double potential = 0;         ///< [J] = −Σ m g·x, zero at the world's origin
    Vec3 momentum = Vec3::Zero(); ///< [kg m/s] = Σ m v
};

/// The same without what the bodies store.
struct MotionTotals {
    double kinetic = 0;           ///< [J]
    Vec3 momentum = Vec3::Zero(); ///< [kg m/s]
};

/// Summed like invariantsOf(), to the same bits.
MotionTotals motionTotalsOf(const Bodies& bodies, const State& state);

/// `gravity` is the acceleration g [m/s²]. Summed in the order of the bodies: the same bits every time.
Invariants invariantsOf(const Bodies& bodies, const State& state, const Vec3& gravity);

/// The same of `list`, mobile bodies that may all turn.
Invariants invariantsOf(const Bodies& bodies, std::span<const BodyIndex> list, const State& state,
                        const Vec3& gravity);

/// Angular momentum about the world's origin [kg m²/s] = Σ x × m v + Iω.
Vec3 angularMomentumOf(const Bodies& bodies, const State& state);

} // namespace carom
