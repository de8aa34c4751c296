// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/integrators/integrator.h"

#include "core/math/rotation.h"

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

void turn(std::span<const BodyIndex> bodies, double h, State& state) {
    for (const BodyIndex i : bodies) {
        const Vec3& spin = state.angularVelocity[i];
        if (spin == Vec3::Zero()) continue; // nothing to turn, and no rounding either
        Quat& q = state.pose[i].orientation;
        q = (fromRotationVector(h * spin) * q).normalized();
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
    .motion = {.move = move, .turn = turn},
};

} // namespace carom
