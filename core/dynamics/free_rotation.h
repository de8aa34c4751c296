// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"
#include "core/math/types.h"

#include <span>

// A rigid body that no torque acts on keeps its angular momentum L in the world, and only its orientation R
// changes: R' = [I⁻¹ L]× R with the world inertia I = R diag(I1, I2, I3) Rᵀ. So L is the quantity we keep and
// ω is computed from it; L never drifts, whatever the step. (L from ω and ω from L in turn would lose 1e-16
// of it every time, and always the same way: 2e-11 in 80,000 steps.) Whatever else turns a body changes ω
// alone; so the L that was kept counts only where ω is, to the bit, what follows from it.
//
// Isotropic inertia:  ω = L/I is constant, one rotation is exact.
// Two equal moments (a cylinder), I across and I3 along the axis:  the body turns about L at |L|/I while it
//     spins about its own axis at L3 (1/I3 − 1/I); the product of the two rotations is exact.
// Three different moments:  no elementary solution. The energy is a sum of terms; each gives a rotation,
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
/// otherwise the error of one call is below about 1e-13 rad, because the call is divided into parts of at
/// most 1/20 rad.
void rotateFreely(const Vec3& inertia, const Vec3& angularMomentum, double h, Quat& orientation);

/// Into how many parts it divides the call where the three moments differ. What counts is not how fast the
/// body turns, which the rotation about L covers, but how fast its axes precess about L: a plank of 100:1
/// precesses about as slowly as a stick.
double partsOfFreeRotation(const Vec3& inertia, const Vec3& angularMomentum, double h,
                           const Quat& orientation);

/// The same by one composition, undivided: the pieces one after the other (order 1, "Lie–Trotter") or
/// symmetrically (order 2, "Strang", the same backwards in time). Exact for two equal moments.
void rotateInPieces(const Vec3& inertia, const Vec3& angularMomentum, double h, int order, Quat& orientation);

/// The same to order 2, divided into parts as by rotateFreely: each is off by some angle³/24, at most 5e-6
/// rad.
void rotateInParts(const Vec3& inertia, const Vec3& angularMomentum, double h, Quat& orientation);

/// Constant rotations of which one is about an axis of the body, which the other turns with it.
struct TwoRotations {
    Vec3 world = Vec3::Zero(); ///< [rad/s]
    Vec3 body = Vec3::Zero();  ///< [rad/s], body axes
};
/// Those that turn a body as rotateFreely does: exact for two or three equal moments, otherwise of order 2
/// over h seconds.
TwoRotations rotationsOf(const Vec3& inertia, const Vec3& angularMomentum, double h, Quat orientation);

/// rotateInPieces for the bodies of `list`; their angular velocities follow from their angular momenta.
void rotateInPieces(const Bodies& bodies, std::span<const BodyIndex> list, double h, int order, State& state);

/// Angular momentum of a body [kg m²/s], world, from its angular velocity [rad/s], world.
Vec3 angularMomentumFrom(const Vec3& inertia, const Quat& orientation, const Vec3& angularVelocity);

/// Angular velocity [rad/s], world, from angular momentum, world.
Vec3 angularVelocityFrom(const Vec3& inertia, const Quat& orientation, const Vec3& angularMomentum);

/// Whether all axes are alike to a body with these moments: a sphere, a cube.
inline bool isIsotropic(const Vec3& inertia) {
    return inertia.x() == inertia.y() && inertia.y() == inertia.z();
}

/// Whether its moments differ by rounding alone, as those of a cylinder √3 times as high as its radius do:
/// then its angular velocity does not precess.
bool hasEqualMoments(const Vec3& inertia);

/// Angular momentum of a mobile body [kg m²/s], world: the one kept, as long as the body only turned freely.
Vec3 angularMomentumOf(const Bodies& bodies, BodyIndex body, const State& state);
/// Gives a body an angular momentum; its angular velocity follows. Where the moments are equal the latter
/// stays as it is: it is constant.
void keepAngularMomentum(const Bodies& bodies, BodyIndex body, const Vec3& angularMomentum, State& state);

/// Turns the bodies of `list` by rotateFreely; their angular momenta stay to the bit.
void rotateAllFreely(const Bodies& bodies, std::span<const BodyIndex> list, double h, State& state);

/// Turns a body whose angular momentum changes from `before` to `after` through h seconds: freely about the
/// mean of both. It has the one after then, and where moments differ the angular velocity that goes with it.
void rotateBetween(const Bodies& bodies, BodyIndex body, const Vec3& before, const Vec3& after, double h,
                   State& state);

} // namespace carom
