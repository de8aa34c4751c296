// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/integrators/integrator.h"

// Semi-implicit Euler (R. de Vogelaere, 1956): the velocity first, then the position with the new velocity,
//
//     v(t+h) = v + h a          x(t+h) = x + h v(t+h)
//
// as cheap as explicit Euler and of the same order, but symplectic: energy errors stay bounded. Free fall is
// h t a/2 too far where explicit Euler is as much too short.

namespace carom {
namespace {

void move(std::span<const BodyIndex> bodies, const Vec3& acceleration, double h, State& state) {
    const Vec3 change = h * acceleration;
    for (const BodyIndex i : bodies) {
        state.velocity[i] += change;
        state.pose[i].position += h * state.velocity[i];
    }
}

} // namespace

extern const IntegratorRow symplecticRow;
constinit const IntegratorRow symplecticRow = {
    .name = "symplectic",
    .title = "Semi-implicit Euler",
    .order = 1,
    .help = "Moves by the velocity at the end of the substep; energy errors stay bounded.",
    .source =
        "R. de Vogelaere, Methods of integration which preserve the contact transformation property of the "
        "Hamilton equations, 1956",
    .motion = {.move = move, .turn = turnBySpin},
};

} // namespace carom
