// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"
#include "core/math/types.h"

#include <span>

// A rigid body that no torque acts on keeps its angular momentum L in the world, and only its orientation R
// changes: R' = [I⁻¹ L]× R with the world inertia I = R diag(I1, I2, I3) Rᵀ. So L is the quantity we keep and
// ω is computed from it; L never drifts, whatever the step.
//
// Isotropic inertia:  ω = L/I is constant, one rotation is exact.
// Two equal moments (a cylinder), I across and I3 along the axis:  the body turns about L at |L|/I while it
//     spins about its own axis at L3 (1/I3 − 1/I); the product of the two rotations is exact.
// Three different moments:  no elementary solution. The energy splits into pieces that are each a pure
//     rotation,
//
//         T = |L|²/(2 Im) + Σk ck Lk²/2,   ck = 1/Ik − 1/Im,   m the middle moment, k the two others,
//
//     the first about L, which commutes with all the others, and the others about the body's axis k at the
//     rate ck Lk, which they keep constant. The two are alternated symmetrically (A half, B, A half) and
//     composed to order 6 by H. Yoshida, "Construction of higher order symplectic integrators", 1990,
//     solution A; the splitting is R. McLachlan's, "Explicit Lie–Poisson integration and the Euler
//     equations", 1993, taken about the middle moment, which makes the pieces small. Every piece keeps |L|
//     and is symplectic: the energy error stays bounded.

namespace carom {

/// Turns a body free of torque through h seconds (h may be negative). `inertia` is principal [kg m²], body
/// axes, all > 0; `angularMomentum` [kg m²/s] in the world. Exact to rounding for two equal moments;
/// otherwise the error of one call is below about 1e-13 rad, because the call is cut into parts of at most
/// 1/20 rad.
void rotateFreely(const Vec3& inertia, const Vec3& angularMomentum, double h, Quat& orientation);

/// The same by one cheap composition, uncut: the pieces one after the other (order 1, "Lie–Trotter") or
/// symmetrically (order 2, "Strang", the same backwards in time). Exact for two equal moments.
void rotateInPieces(const Vec3& inertia, const Vec3& angularMomentum, double h, int order, Quat& orientation);

/// rotateInPieces for the bodies of `list`; their angular velocities follow from their angular momenta.
void tumbleInPieces(const Bodies& bodies, std::span<const BodyIndex> list, double h, int order, State& state);

/// Angular momentum of a body [kg m²/s], world, from its angular velocity [rad/s], world.
Vec3 angularMomentumFrom(const Vec3& inertia, const Quat& orientation, const Vec3& angularVelocity);

/// Angular velocity [rad/s], world, from angular momentum, world.
Vec3 angularVelocityFrom(const Vec3& inertia, const Quat& orientation, const Vec3& angularMomentum);

/// Turns a body whose angular velocity changes from `before` to `after` (both taken at its present
/// orientation) through h seconds: freely about the mean of both angular momenta. Afterwards the state has
/// the angular velocity that goes with the momentum after. Without torque this is free rotation, and momentum
/// is kept.
void rotateBetween(const Bodies& bodies, BodyIndex body, const Vec3& before, const Vec3& after, double h,
                   State& state);

} // namespace carom
