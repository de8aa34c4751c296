// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"
#include "core/math/types.h"

// The frictionless impact of two rigid bodies A and B at one point, by the conservation of momentum and of
// angular momentum and Newton's law of restitution (any mechanics text, e.g. D. Baraff, "Physically based
// modeling: rigid body simulation", SIGGRAPH course notes 2001, part I, section 8; he writes the normal from
// B to A).
//
//     legend      n       line of action, unit, from A to B
//                 p       the point of impact;  rA = p − xA,  rB = p − xB
//                 v, ω    velocities before the impact, primed after it
//                 u       = n·(vB + ωB×rB − vA − ωA×rA), the rate at which p's two sides part
//                 e       restitution of the pair
//
//     law         u' = −e u
//     impulse     j n on B, −j n on A, with
//                 j = −(1+e) u / K,
//                 K = 1/mA + 1/mB + (rA×n)·IA⁻¹(rA×n) + (rB×n)·IB⁻¹(rB×n)
//     after       v' = v ± j n/m,   ω' = ω ± I⁻¹ (r×n) j
//
// An immobile body has 1/m = 0 and I⁻¹ = 0, and the same formulas hold. Moving p along n changes nothing, so
// it does not matter which of two witness points on the line of action is taken for p.

namespace carom {

/// One impact, ready to be applied; angular terms are zero for spheres, where r and n are parallel.
struct Impact {
    BodyIndex a = noBody;
    BodyIndex b = noBody;
    Vec3 normal = Vec3::UnitY();       ///< n
    Vec3 armA = Vec3::Zero();          ///< rA×n [m]
    Vec3 armB = Vec3::Zero();          ///< rB×n [m]
    Vec3 spinA = Vec3::Zero();         ///< IA⁻¹ (rA×n), the change of ω per unit of impulse [1/(kg m)]
    Vec3 spinB = Vec3::Zero();         ///< IB⁻¹ (rB×n)
    double inverseMassAlongNormal = 0; ///< K [1/kg]
};

Impact impactAt(const Bodies& bodies, const State& state, BodyPair pair, const Vec3& normal,
                const Vec3& point);

/// u [m/s], negative while the bodies approach each other.
double partingSpeed(const Impact& impact, const State& state);

/// Changes the velocities of both bodies so that afterwards u' = −e u.
void apply(const Impact& impact, double restitution, const Bodies& bodies, State& state);

} // namespace carom
