// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"
#include "core/solvers/contacts/contact_rows.h"

#include <array>
#include <span>
#include <vector>

// Springs on the base path, beside contacts: the force at the end of a step is that of the places of its ends
// then (implicit Euler), solved for as a soft constraint (E. Catto, "Soft constraints", GDC 2011). It is
// linearised about the places that the ends would have without it, x̂ = x₀ + h û, not about the present ones:
//
//     d = (x̂_to − x̂_from)/l̂,  l̂ = |x̂_to − x̂_from|
//     along d     λ ← λ − m (u − û + γ (h k (l̂ − l₀) + λ) + β û)    γ = 1/(h (c + h k)),  β = h c γ
//     across      λ ← λ − m (u − û + γ λ)                            γ = 1/(h² κ),  κ = k max(0, 1 − l₀/l̂)
//     m = 1/(W + γ)
//
//     legend   u  rate at which the ends separate at the end of the step [m/s], û before the solve
//              h  the step [s];  λ  an impulse [N s], on `to`;  W  response of u to λ [1/kg]
//              κ  stiffness across, by the tension;  k, c, l₀  as in core/dynamics/spring_force.h
//
// A single spring between centres pulls along d, so one pass is the exact step of implicit Euler. Its energy
// does not grow where the potential is convex: for l₀ = 0 everywhere. Linearised about x₀ the spring would
// not respond to motion across it: a body that moves further in a step than its distance from the spring's
// other end would stretch the spring many times. The directions across matter where contacts deflect the
// bodies from their free paths. An undamped spring loses the part ω h of its energy in a radian. Where
// nothing touches, and in islands that are refined, springs keep their energy (island_springs.cpp).

namespace carom {

struct SpringRow {
    std::uint32_t a = 0, b = 0;
    Vec3 armA = Vec3::Zero(), armB = Vec3::Zero();  ///< from the bodies' centres, as they would turn [m]
    Mat3 frame = Mat3::Identity();                  ///< columns: d, from the first end to the second; across
    Vec3 mass = Vec3::Zero();                       ///< m [kg], along and across; 0: no force acts along it
    Vec3 bias = Vec3::Zero(), yield = Vec3::Zero(); ///< of u + bias + yield λ = 0 [m/s], [1/kg]
    Vec3 speed = Vec3::Zero();                      ///< û [m/s]
    Vec3 impulse = Vec3::Zero();                    ///< λ [N s]
};

/// The rows of some of the scene's springs for a step of `duration` seconds from where the bodies are now,
/// with the velocities of `solverBodies`. `local` is by body of the scene; `immobile` stands for what cannot
/// move.
void prepareSprings(const Bodies& bodies, const State& state, std::span<const std::uint32_t> springs,
                    std::span<const std::uint32_t> local, std::uint32_t immobile, double duration,
                    std::span<const SolverBody> solverBodies, std::vector<SpringRow>& rows);
/// What a spring has done to the kinetic energy since it was prepared [J].
double workOf(const SpringRow& row, std::span<const SolverBody> bodies);
/// One pass over all rows.
void solveSprings(std::span<SpringRow> rows, std::span<SolverBody> bodies);

} // namespace carom
