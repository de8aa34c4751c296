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

/// One impact, ready to be applied.
struct PairImpact {
    BodyIndex a = noBody;
    BodyIndex b = noBody;
    Vec3 normal = Vec3::UnitY(); ///< n
    double inverseMass = 0;      ///< K [1/kg]

    bool turns = false; ///< false where both are spheres, walls or fixed: r and n are parallel, or no matter
    Vec3 armA = Vec3::Zero();  ///< rA×n [m]
    Vec3 armB = Vec3::Zero();  ///< rB×n [m]
    Vec3 spinA = Vec3::Zero(); ///< IA⁻¹ (rA×n), the change of ωA per unit of impulse [1/(kg m)]
    Vec3 spinB = Vec3::Zero(); ///< IB⁻¹ (rB×n)
};

PairImpact impactAt(const Bodies& bodies, const State& state, BodyPair pair, const Vec3& normal,
                    const Vec3& point);

/// u [m/s], negative while the bodies approach each other.
inline double separationSpeed(const PairImpact& impact, const State& state) {
    double speed = impact.normal.dot(state.velocity[impact.b] - state.velocity[impact.a]);
    if (impact.turns) // n·(ω×r) = ω·(r×n)
        speed += impact.armB.dot(state.angularVelocity[impact.b]) -
                 impact.armA.dot(state.angularVelocity[impact.a]);
    return speed;
}

/// Changes the velocities of both bodies, which part at `speed` (u), so that they part at −e u afterwards.
inline void apply(const PairImpact& impact, double speed, double restitution, const Bodies& bodies,
                  State& state) {
    const double j = -(1 + restitution) * speed / impact.inverseMass;
    state.velocity[impact.a] -= (j * bodies.inverseMass[impact.a]) * impact.normal;
    state.velocity[impact.b] += (j * bodies.inverseMass[impact.b]) * impact.normal;
    if (!impact.turns) return;
    state.angularVelocity[impact.a] -= j * impact.spinA;
    state.angularVelocity[impact.b] += j * impact.spinB;
}

} // namespace carom
