// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/integrators/integrator.h"

#include "core/dynamics/free_rotation.h"

#include <algorithm>

// Störmer–Verlet in velocity form (L. Verlet, "Computer experiments on classical fluids", 1967; W. Swope et
// al., 1982): half the change of velocity, the whole displacement, the other half,
//
//     v½ = v + h/2 F(t)/m          x(t+h) = x + h v½          v(t+h) = v½ + h/2 F(t+h)/m
//
// which for a constant acceleration is x + h v + h²/2 a: the parabola of free fall is exact at any step. The
// same backwards in time, so that energy errors stay bounded while ωh < 2; the phase of an oscillation is
// ahead by (ωh)²/24 of it. A body's angular momentum is treated as the velocity is; its free rotation is
// split symmetrically into pure rotations (dynamics/free_rotation.h), as in A. Dullweber, B. Leimkuhler, R.
// McLachlan, "Symplectic splitting methods for rigid body molecular dynamics", 1997. Where springs are
// damped, or bodies move through air, the force at t+h depends on v(t+h): it is found by iteration, and the
// order stays two.

namespace carom {
namespace {

/// Iterations at most. Each reduces the error by the factor c h/(2m): ten digits in all at a step that
/// resolves the damping, half of them at half as many.
constexpr int mostRounds = 20;
constexpr double roundsEnd =
    1e-15; ///< relative to the fastest body's speed, the change at which they end: rounding

void rotateFreely(const Bodies& bodies, std::span<const BodyIndex> list, double h, State& state) {
    rotateInPieces(bodies, list, h, 2, state);
}

// The second half of the change of velocities, by the forces at its end.
void kickToEnd(SpringNetwork& network, double h, State& state) {
    std::vector<BodyMotion>& middle = network.scratch.start;
    readMotion(network, state, middle);
    const int rounds = isDamped(network) ? mostRounds : 1;
    for (int round = 0; round < rounds; ++round) {
        ratesOf(network, state, network.scratch.rate);
        double change = 0, fastest = 0;
        for (std::size_t k = 0; k < network.moving.size(); ++k) {
            const BodyIndex i = network.moving[k];
            const BodyMotion& rate = network.scratch.rate[k];
            const Vec3 velocity = middle[k].velocity + h * rate.velocity;
            change = std::max(change, (velocity - state.velocity[i]).norm());
            fastest = std::max(fastest, velocity.norm());
            state.velocity[i] = velocity;
            if (rate.angularMomentum == Vec3::Zero()) continue;
            state.angularVelocity[i] =
                angularVelocityFrom(network.bodies.inertia[i], state.pose[i].orientation,
                                    middle[k].angularMomentum + h * rate.angularMomentum);
        }
        if (change <= roundsEnd * fastest) break;
    }
}

void moveOnSprings(SpringNetwork& network, double h, State& state) {
    ratesOf(network, state, network.scratch.rate);
    kick(network, network.scratch.rate, 0.5 * h, state);
    for (const BodyIndex i : network.moving) state.pose[i].position += h * state.velocity[i];
    rotateFreely(network.bodies, network.moving, h, state);
    kickToEnd(network, 0.5 * h, state);
}

} // namespace

extern const IntegratorRow verletRow;
constinit const IntegratorRow verletRow = {
    .name = "verlet",
    .title = "Velocity Verlet",
    .order = 2,
    .orderOnSprings = 2,
    .help = "Moves by the velocity in the middle of the substep; free fall is exact, energy errors stay "
            "bounded.",
    .source = "L. Verlet, Computer experiments on classical fluids, 1967",
    .stableUpTo = 2,
    .decaysUpTo = 2, // beyond, the iteration for the velocity at the end diverges
    .motion = {.isExactInFreeFall = true,
               .move = moveOnParabola,
               .turn = turnBySpin,
               .rotateFreely = rotateFreely,
               .moveUnderForces = moveOnSprings,
               .moveOnSprings = moveOnSprings},
};

} // namespace carom
