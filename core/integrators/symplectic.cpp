// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/integrators/integrator.h"

#include "core/dynamics/free_rotation.h"

// Semi-implicit Euler (R. de Vogelaere, 1956): the velocity first, then the position with the new velocity,
//
//     v(t+h) = v + h F/m          x(t+h) = x + h v(t+h)
//
// as cheap as explicit Euler and of the same order, but symplectic: energy errors stay bounded while ωh < 2.
// Free fall is h t a/2 too far where explicit Euler is as much too short. A body's angular momentum is
// treated as the velocity is; its free rotation is split into pure rotations, one after the other
// (dynamics/free_rotation.h).

namespace carom {
namespace {

void move(std::span<const BodyIndex> bodies, const Vec3& acceleration, double h, State& state) {
    const Vec3 change = h * acceleration;
    for (const BodyIndex i : bodies) {
        state.velocity[i] += change;
        state.pose[i].position += h * state.velocity[i];
    }
}

void rotateFreely(const Bodies& bodies, std::span<const BodyIndex> list, double h, State& state) {
    rotateInPieces(bodies, list, h, 1, state);
}

void moveOnSprings(SpringNetwork& network, double h, State& state) {
    ratesOf(network, state, network.scratch.rate);
    kick(network, network.scratch.rate, h, state);
    for (const BodyIndex i : network.moving) state.pose[i].position += h * state.velocity[i];
    rotateFreely(network.bodies, network.moving, h, state);
}

} // namespace

extern const IntegratorRow symplecticRow;
constinit const IntegratorRow symplecticRow = {
    .name = "symplectic",
    .title = "Semi-implicit Euler",
    .order = 1,
    .orderOnSprings = 1,
    .help = "Moves by the velocity at the end of the substep; energy errors stay bounded.",
    .source =
        "R. de Vogelaere, Methods of integration which preserve the contact transformation property of the "
        "Hamilton equations, 1956",
    .stableUpTo = 2,
    .decaysUpTo = 2,
    .motion = {.move = move,
               .turn = turnBySpin,
               .rotateFreely = rotateFreely,
               .moveUnderForces = moveOnSprings,
               .moveOnSprings = moveOnSprings},
};

} // namespace carom
