// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/scene_text.h"
#include "core/study/trial.h"

#include "core/simulation/build.h"

#include <algorithm>
#include <cmath>
#include <numbers>

// Undamped springs: the amplitude stays, however many periods and however stiff, and the error of the path
// shrinks with the square of the step.

namespace carom {
namespace {

constexpr double rate = 10; ///< ω of case 43 [rad/s]

std::string ballOnSpring(const Vec3& centre, double stiffness) {
    return text("sphere bob { radius 0.1  mass 1  centre ", centre,
                " }\nspring { from world  to bob  stiffness ", stiffness, "  length 1 }\n");
}

std::string oscillator() { return weightless() + ballOnSpring(Vec3(1.1, 0, 0), rate * rate); }

// The midpoint rule turns the phase by 2 atan(ω h/2) a substep. The body is read at whole frames, and its
// phase there is that of place and velocity in the ellipse of the rule, which is the true one: it keeps
// (ω x)² + v² exactly.
void runOscillator(Trial& trial) {
    World world = trial.world(oscillator());
    const double h = world.pipeline().settings().substep();
    const double discrete = 2 / h * std::atan(rate * h / 2);
    const std::int64_t periods = trial.shortOrLong(100, 10'000);
    const auto frames =
        static_cast<std::int64_t>(static_cast<double>(periods) * 2 * std::numbers::pi / rate * 60);
    const double start = energyOf(world);
    double worst = 0;
    trial.run(world, frames, [&] { worst = std::max(worst, std::abs(energyOf(world) / start - 1)); });
    const double x = world.state().pose[0].position.x() - 1, v = world.state().velocity[0].x();
    const double phase = std::atan2(-v, rate * x);
    const double off = std::remainder(phase - discrete * world.state().time, 2 * std::numbers::pi);
    trial.expect("amplitude error", worst / 2, {1e-9, 1e-9});
    trial.expect("phase off its own rule's, of the whole phase",
                 std::abs(off) / (discrete * world.state().time), {1e-6, 1e-6});
}

std::string stiff(double stiffness) { return falling() + ballOnSpring(Vec3(0, -1.01, 0), stiffness); }
std::string stiffScene() { return stiff(1e6); }

/// Whether the build warns of the spring before the run.
bool isWarnedOf(const std::string& declarations, std::string_view simulation) {
    const Build built = build(declarations + text("simulation { ", simulation, " }\n"));
    return std::ranges::any_of(built.diagnostics, [](const Diagnostic& diagnostic) {
        return diagnostic.code == DiagnosticCode::UnstableSpring;
    });
}

void runStiff(Trial& trial) {
    double furthest = 0, unwarned = 0;
    const double most = trial.shortOrLong(1e3, 1e6);
    for (double phase = 0.1; phase <= most * 1.01; phase *= 10) {
        const double h = trial.world(stiff(1)).pipeline().settings().substep();
        World world = trial.world(stiff(std::pow(phase / h, 2)));
        trial.run(world, trial.shortOrLong(300, 6000),
                  [&] { furthest = std::max(furthest, world.state().pose[0].position.norm()); });
        for (const std::string_view integrator : {"euler", "symplectic", "verlet"}) {
            const std::string explicitly =
                text("method microcollisions  substeps 1  step ", h, "  integrator ", integrator);
            if (phase > 2 && !isWarnedOf(stiff(std::pow(phase / h, 2)), explicitly)) ++unwarned;
        }
    }
    trial.expect("furthest from the anchor", furthest, {5, 5}, "m");
    trial.expectNone("explicit integrators not warned about", unwarned);
}

std::string pendulum() { return falling() + ballOnSpring(Vec3(1, 0, 0), 100); }

/// Part of the energy that a kept one may be off by rounding in 100,000 steps of some roundings each, which
/// add up as a random walk does: no trend.
constexpr double rounding = 1e-12;

Vec3 placeAfterASecond(Trial& trial, int substeps) {
    World world = trial.world(pendulum(), text("substeps ", substeps));
    trial.run(world, 60);
    return world.state().pose[0].position;
}

void runPendulum(Trial& trial) {
    World world = trial.world(pendulum());
    const std::int64_t frames = trial.shortOrLong(3000, 100'000);
    const double start = energyOf(world);
    double early = 0, late = 0;
    std::int64_t frame = 0;
    trial.run(world, frames, [&] {
        double& worst = 2 * frame++ < frames ? early : late;
        worst = std::max(worst, std::abs(energyOf(world) - start) / standardFall);
    });
    const Vec3 coarse = placeAfterASecond(trial, 16), middle = placeAfterASecond(trial, 32),
               fine = placeAfterASecond(trial, 64);
    const double order = std::log2((coarse - middle).norm() / (middle - fine).norm());
    trial.expect("energy error", std::max(early, late), {1e-2, 1e-2});
    trial.expect("energy error, second half against the first",
                 std::max(late, rounding) / std::max(early, rounding), {1.5, 1.5});
    trial.expect("order, distance from 2", std::abs(order - 2), {0.05, 0.05});
}

} // namespace

extern const HardCase oscillatorCase, stiffCase, pendulumCase;

constinit const HardCase oscillatorCase = {
    .number = 43,
    .name = "spring",
    .title = "an undamped spring, 10,000 periods",
    .answer = "the amplitude stays, and the phase is that of the integration rule",
    .byDefault = "amplitude 1e-9",
    .accurate = "phase 1e-6",
    .aim = "100,000 periods",
    .columns = steppingColumns,
    .declarations = oscillator,
    .run = runOscillator,
};

constinit const HardCase stiffCase = {
    .number = 44,
    .name = "stiff_spring",
    .title = "springs with ω h from .1 to 1000",
    .answer = "the motion is bounded, and explicit integrators are warned about before the run",
    .byDefault = "holds",
    .accurate = "holds",
    .aim = "1e6",
    .columns = steppingColumns,
    .declarations = stiffScene,
    .run = runStiff,
};

constinit const HardCase pendulumCase = {
    .number = 45,
    .name = "spring_pendulum",
    .title = "a spring pendulum, 100,000 steps",
    .answer = "its energy is bounded without a trend, and half the step gives a quarter of the error",
    .byDefault = "holds",
    .accurate = "holds",
    .aim = "order 2.00 ± .05",
    .columns = steppingColumns,
    .declarations = pendulum,
    .run = runPendulum,
};

} // namespace carom
