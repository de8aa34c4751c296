// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"
#include "core/solvers/contacts/contact_rows.h"

#include <span>
#include <vector>

// Springs on the base path, beside contacts: the force at the end of a step by what the length will be then
// (implicit Euler), as a constraint that gives way (E. Catto, "Soft constraints", GDC 2011):
//
//     λ ← λ − m (u + b + γ λ)      γ = 1/(h (c + h k)),  b = γ h k (l − l₀),  m = 1/(W + γ)
//
//     legend   u  rate at which the spring grows at the end of the step [m/s];  λ  its impulse [N s], on `to`
//              W  response of u to λ [1/kg];  k, c, l, l₀  as in core/dynamics/spring_force.h
//
// It is stable at any stiffness and never gains energy; an undamped spring loses some, ω h of it a radian.
// Where nothing touches, and in islands that are refined, springs keep their energy (island_springs.cpp).

namespace carom {

struct SpringRow {
    std::uint32_t a = 0, b = 0;
    Vec3 armA = Vec3::Zero(), armB = Vec3::Zero(); ///< from the bodies' centres [m]
    Vec3 along = Vec3::UnitY();                    ///< from the first end to the second
    double mass = 0;                               ///< m [kg]
    double bias = 0, yield = 0;                    ///< b [m/s], γ [1/kg]
    double speed = 0;                              ///< u before the solve [m/s]
    double impulse = 0;                            ///< λ [N s]
};

/// The rows of some of the scene's springs for a step of `duration` seconds from where the bodies are now.
/// `local` is by body of the scene; `immobile` stands for what cannot move.
void prepareSprings(const Bodies& bodies, const State& state, std::span<const std::uint32_t> springs,
                    std::span<const std::uint32_t> local, std::uint32_t immobile, double duration,
                    std::span<const SolverBody> solverBodies, std::vector<SpringRow>& rows);
/// What a spring has done to the kinetic energy since it was prepared [J].
double workOf(const SpringRow& row, std::span<const SolverBody> bodies);
/// One pass over all rows.
void solveSprings(std::span<SpringRow> rows, std::span<SolverBody> bodies);

} // namespace carom
