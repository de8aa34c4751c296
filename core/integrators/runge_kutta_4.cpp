// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/integrators/integrator.h"

#include "core/dynamics/free_rotation.h"
#include "core/math/rotation.h"

#include <array>
#include <cmath>

// The classical method of order four (W. Kutta, "Beitrag zur näherungsweisen Integration totaler
// Differentialgleichungen", 1901): four rates a step,
//
//     k1 = f(y)   k2 = f(y + h/2 k1)   k3 = f(y + h/2 k2)   k4 = f(y + h k3)
//     y(t+h) = y + h (k1 + 2 k2 + 2 k3 + k4)/6
//
// for y = (x, v, q, L) of all bodies of a network (dynamics/spring_network.h); f takes q
// normalised. Not symplectic: an oscillation loses (ωh)⁶/72 of its energy a step, and grows beyond
// ωh = 2√2. Free fall is exact: its fourth derivative vanishes.

namespace carom {
namespace {

/// Where a stage is, as a part of the step along the rate before, and its weight in the sum.
struct Stage {
    double place, weight;
};
constexpr std::array<Stage, 4> tableau = {{{0, 1.0 / 6}, {0.5, 1.0 / 3}, {0.5, 1.0 / 3}, {1, 1.0 / 6}}};

void rotateFreely(const Bodies& bodies, std::span<const BodyIndex> list, double h, State& state) {
    for (const BodyIndex i : list) {
        const Vec3& inertia = bodies.inertia[i];
        Quat& orientation = state.pose[i].orientation;
        if (state.angularVelocity[i] == Vec3::Zero()) continue; // nothing to turn, and no rounding either
        const Vec3 momentum = angularMomentumOf(bodies, i, state);
        const Vec4 start = orientation.coeffs();
        Vec4 rate = Vec4::Zero(), sum = Vec4::Zero();
        for (const Stage& stage : tableau) {
            orientation.coeffs() = start + (stage.place * h) * rate;
            orientation.normalize();
            rate = orientationRate(angularVelocityFrom(inertia, orientation, momentum), orientation);
            sum += stage.weight * rate;
        }
        orientation.coeffs() = start + h * sum;
        orientation.normalize();
        keepAngularMomentum(bodies, i, momentum, state);
    }
}

void moveOnSprings(SpringNetwork& network, double h, State& state) {
    std::vector<BodyMotion>& start = network.scratch.start;
    std::vector<BodyMotion>& rate = network.scratch.rate;
    std::vector<BodyMotion>& sum = network.scratch.sum;
    readMotion(network, state, start);
    sum.assign(start.size(), BodyMotion{});
    for (const Stage& stage : tableau) {
        if (stage.place > 0) applyRates(network, start, rate, stage.place * h, state);
        ratesOf(network, state, rate);
        for (std::size_t k = 0; k < sum.size(); ++k) {
            sum[k].position += stage.weight * rate[k].position;
            sum[k].velocity += stage.weight * rate[k].velocity;
            sum[k].orientation += stage.weight * rate[k].orientation;
            sum[k].angularMomentum += stage.weight * rate[k].angularMomentum;
        }
    }
    applyRates(network, start, sum, h, state);
}

} // namespace

extern const IntegratorRow rungeKutta4Row;
constinit const IntegratorRow rungeKutta4Row = {
    .name = "rk4",
    .title = "Runge–Kutta of order 4",
    .order = 4,
    .orderOnSprings = 4,
    .help = "Four evaluations of the forces a substep; the most accurate where steps are small against an "
            "oscillation.",
    .source = "W. Kutta, Beitrag zur näherungsweisen Integration totaler Differentialgleichungen, 1901",
    .stableUpTo = 2.8284271247461903, // 2√2
    .decaysUpTo = 2.785293563405282,  // z with 1 − z + z²/2 − z³/6 + z⁴/24 = 1
    .motion = {.isExactInFreeFall = true,
               .move = moveOnParabola,
               .turn = turnBySpin,
               .rotateFreely = rotateFreely,
               .moveUnderForces = moveOnSprings,
               .moveOnSprings = moveOnSprings},
};

} // namespace carom
