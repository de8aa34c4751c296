// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/integrators/integrator.h"

// The reference's scheme (its chapter 3.6.1): explicit Euler,
//
//     x(t+h) = x + h v          v(t+h) = v + h g          q(t+h) = normalised(q + h/2 ω q)
//
// Every right-hand side is the state at t, so x takes the velocity from before the substep: after n steps of
// free fall x = x0 + n h v0 + n(n−1)/2 h² g, where the closed form has n² for n(n−1). The error in x is of
// order h, and a bouncing body's energy grows.
//
// ω is a quaternion without a real part, in world coordinates, hence on the left. The norm of q + h/2 ω q is
// sqrt(1 + h²ω²/4), so the body turns by 2 atan(h|ω|/2) a step in place of h|ω|: 2 % less at h|ω| = 1/2.
// Without torque ω is constant. That is exact for bodies with isotropic inertia and for spin about a
// principal axis; elsewhere a free body's ω precesses, which the reference did not simulate either.

namespace carom {
namespace {

void move(std::span<const BodyIndex> bodies, const Vec3& acceleration, double h, State& state) {
    const Vec3 change = h * acceleration;
    for (const BodyIndex i : bodies) {
        state.pose[i].position += h * state.velocity[i];
        state.velocity[i] += change;
    }
}

void turn(std::span<const BodyIndex> bodies, double h, State& state) {
    for (const BodyIndex i : bodies) {
        const Vec3& spin = state.angularVelocity[i];
        if (spin == Vec3::Zero()) continue; // nothing to turn, and no rounding either
        Quat& q = state.pose[i].orientation;
        const Vec3 half = 0.5 * h * spin;
        const Quat change = Quat(0, half.x(), half.y(), half.z()) * q;
        q.coeffs() += change.coeffs();
        q.normalize();
    }
}

} // namespace

extern const IntegratorRow eulerRow;
constinit const IntegratorRow eulerRow = {
    .name = "euler",
    .title = "Explicit Euler",
    .order = 1,
    .help = "Moves by the velocity at the beginning of the substep; the error is proportional to the step.",
    .source = "L. Euler, Institutiones calculi integralis, 1768; rotation as in the reference work, 3.6.1",
    .motion = {.move = move, .turn = turn},
};

} // namespace carom
