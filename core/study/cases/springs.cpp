// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/scene_text.h"
#include "core/study/trial.h"

#include <algorithm>
#include <cmath>

// An undamped spring pendulum: its energy stays, and the error of the path shrinks with the square of the
// step.

namespace carom {
namespace {

std::string ballOnSpring(const Vec3& centre, double stiffness) {
    return text("sphere bob { radius 0.1  mass 1  centre ", centre,
                " }\nspring { from world  to bob  stiffness ", stiffness, "  length 1 }\n");
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

extern const HardCase pendulumCase;

constinit const HardCase pendulumCase = {
    .number = 45,
    .name = "spring_pendulum",
    .title = "a spring pendulum, 100,000 steps",
    .answer = "its energy is bounded without a trend, and half the step gives a quarter of the error",
    .byDefault = "holds",
    .accurate = "holds",
    .aim = "order 2.00 ± 0.05",
    .columns = steppingColumns,
    .declarations = pendulum,
    .run = runPendulum,
};

} // namespace carom
