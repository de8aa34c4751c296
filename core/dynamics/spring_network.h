// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/dynamics/bodies.h"
#include "core/dynamics/forced_steps.h"
#include "core/dynamics/state.h"
#include "core/math/types.h"

#include <cstdint>
#include <span>
#include <vector>

// Bodies that springs couple or force terms act on, and that touch nothing: a system of ordinary differential
// equations,
//
//     x' = v      v' = F/m      q' = ½ ω q      L' = τ      ω = R I⁻¹ Rᵀ L
//
// with the forces and torques of gravity, the springs (spring_force.h) and the terms (force_term.h). L in
// place of ω is the unknown, so that a body without torque keeps it to the bit. Integrators differ in how
// they solve these equations.

namespace carom {

/// The four unknowns of one body, or their rates.
struct BodyMotion {
    Vec3 position = Vec3::Zero();        ///< x [m]
    Vec3 velocity = Vec3::Zero();        ///< v [m/s]
    Vec4 orientation = Vec4::Zero();     ///< q as x, y, z, w
    Vec3 angularMomentum = Vec3::Zero(); ///< L [kg m²/s], world
};

struct SpringNetwork {
    const Bodies& bodies;
    std::span<const BodyIndex> moving; ///< mobile bodies, those at the springs' ends among them, ascending
    std::span<const std::uint32_t> springs; ///< into Bodies::springs, ascending
    Vec3 gravity = Vec3::Zero();            ///< [m/s²]

    /// Scratch memory of integrators, kept from substep to substep; by place in `moving`.
    struct Scratch {
        std::vector<BodyMotion> start, rate, sum;
        std::vector<Vec3> force, torque; ///< by BodyIndex
        std::vector<ForceSample> samples;
        std::vector<ForceValue> values;
        ForcedSteps steps;
    };
    Scratch& scratch;
};

/// The unknowns of the moving bodies, from the state.
void readMotion(const SpringNetwork& network, const State& state, std::vector<BodyMotion>& motion);
/// Their rates at this state.
void ratesOf(const SpringNetwork& network, const State& state, std::vector<BodyMotion>& rate);
/// state := start + h rate, orientations normalised.
void applyRates(const SpringNetwork& network, const std::vector<BodyMotion>& start,
                const std::vector<BodyMotion>& rate, double h, State& state);
/// Changes velocities and angular velocities by the forces and torques of `rate` times h; positions and
/// orientations stay (the kick of a leapfrog scheme).
void kick(const SpringNetwork& network, const std::vector<BodyMotion>& rate, double h, State& state);
/// Whether forces may depend on velocities: a spring of the network is damped, or a term acts.
bool isDamped(const SpringNetwork& network);

} // namespace carom
