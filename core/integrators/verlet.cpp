// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/integrators/integrator.h"

// Störmer–Verlet in velocity form (L. Verlet, "Computer experiments on classical fluids", 1967; W. Swope et
// al., 1982):
//
//     x(t+h) = x + h v + h²/2 a          v(t+h) = v + h a
//
// for the constant acceleration of a substep; the parabola of free fall is exact at any step. Rotation turns
// by exactly h|ω| about ω.

namespace carom {
namespace {

void move(std::span<const BodyIndex> bodies, const Vec3& acceleration, double h, State& state) {
    const Vec3 change = h * acceleration;
    for (const BodyIndex i : bodies) {
        state.pose[i].position += h * (state.velocity[i] + 0.5 * change);
        state.velocity[i] += change;
    }
}

} // namespace

extern const IntegratorRow verletRow;
constinit const IntegratorRow verletRow = {
    .name = "verlet",
    .title = "Velocity Verlet",
    .order = 2,
    .help = "Moves by the mean of the velocities at both ends of the substep; free fall is exact.",
    .source = "L. Verlet, Computer experiments on classical fluids, 1967",
    .motion = {.move = move, .turn = turnBySpin},
};

} // namespace carom
