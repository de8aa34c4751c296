// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/integrators/integrator.h"

#include "core/dynamics/free_rotation.h"
#include "core/math/rotation.h"

// The reference's scheme (its chapter 3.6.1): explicit Euler,
//
//     x(t+h) = x + h v          v(t+h) = v + h F/m          q(t+h) = normalised(q + h/2 ω q)
//
// Every right-hand side is the state at t, so x takes the velocity from before the substep: after n steps of
// free fall x = x0 + n h v0 + n(n−1)/2 h² g, where the closed form has n² for n(n−1). The error in x is of
// order h, and a bouncing body's energy grows; so does that of an oscillation at any step, by the factor
// 1 + (ωh)² a step.
//
// ω is a quaternion without a real part, in world coordinates, hence on the left. The norm of q + h/2 ω q is
// sqrt(1 + h²ω²/4), so the body turns by 2 atan(h|ω|/2) a step in place of h|ω|: 2 % less at h|ω| = 1/2. By
// `turn` ω is constant, as in the reference: exact for isotropic inertia and for spin about a principal axis.
// By `rotateFreely` and `moveOnSprings` the angular momentum is kept or changed by torques, and ω follows
// from it.

namespace carom {
namespace {

void move(std::span<const BodyIndex> bodies, const Vec3& acceleration, double h, State& state) {
    const Vec3 change = h * acceleration;
    for (const BodyIndex i : bodies) {
        state.pose[i].position += h * state.velocity[i];
        state.velocity[i] += change;
    }
}

void turnExplicitly(const Vec3& spin, double h, Quat& orientation) {
    if (spin == Vec3::Zero()) return; // nothing to turn, and no rounding either
    orientation.coeffs() += h * orientationRate(spin, orientation);
    orientation.normalize();
}

void turn(std::span<const BodyIndex> bodies, double h, State& state) {
    for (const BodyIndex i : bodies) turnExplicitly(state.angularVelocity[i], h, state.pose[i].orientation);
}

void rotateFreely(const Bodies& bodies, std::span<const BodyIndex> list, double h, State& state) {
    for (const BodyIndex i : list) {
        const Vec3 momentum = angularMomentumOf(bodies, i, state);
        turnExplicitly(state.angularVelocity[i], h, state.pose[i].orientation);
        keepAngularMomentum(bodies, i, momentum, state);
    }
}

void moveOnSprings(SpringNetwork& network, double h, State& state) {
    readMotion(network, state, network.scratch.start);
    ratesOf(network, state, network.scratch.rate);
    applyRates(network, network.scratch.start, network.scratch.rate, h, state);
}

} // namespace

extern const IntegratorRow eulerRow;
constinit const IntegratorRow eulerRow = {
    .name = "euler",
    .title = "Explicit Euler",
    .order = 1,
    .orderOnSprings = 1,
    .help = "Moves by the velocity at the beginning of the substep; the error is proportional to the step.",
    .source = "L. Euler, Institutiones calculi integralis, 1768; rotation as in the reference work, 3.6.1",
    .stableUpTo = 0,
    .decaysUpTo = 2,
    .motion = {.move = move,
               .turn = turn,
               .rotateFreely = rotateFreely,
               .moveUnderForces = moveOnSprings,
               .moveOnSprings = moveOnSprings},
};

} // namespace carom
