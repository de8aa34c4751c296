// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/members.h"
#include "core/study/cases/scene_text.h"
#include "core/study/trial.h"

#include <algorithm>
#include <cmath>

// The pendulum of case 45 alone: whether its energy has a trend, and the orders of its path from three steps.

namespace carom {
namespace {

std::string pendulum() {
    return falling() + "sphere bob { radius 0.1  mass 1  centre 1, 0, 0 }\n"
                       "spring { from world  to bob  stiffness 100  length 1 }\n";
}

/// Part of the energy that a kept one may be off by rounding in 100,000 steps of some roundings each, which
/// add up as a random walk does: no trend.
constexpr double rounding = 1e-12;

Vec3 placeAfterASecond(Trial& trial, std::string_view further, int substeps) {
    World world = trial.world(pendulum(), text(further, "substeps ", substeps));
    trial.run(world, 60);
    return world.state().pose[0].position;
}

/// From three steps, each half the one before; `further` parameters of `simulation`.
double orderOf(Trial& trial, std::string_view further, int coarsest) {
    const auto place = [&](int substeps) { return placeAfterASecond(trial, further, substeps); };
    const Vec3 coarse = place(coarsest), middle = place(2 * coarsest), fine = place(4 * coarsest);
    return std::log2((coarse - middle).norm() / (middle - fine).norm());
}

} // namespace

void askSpringPendulum(Trial& trial) {
    World world = trial.world(pendulum());
    const std::int64_t frames = trial.shortOrLong(3000, 100'000);
    const double start = energyOf(world);
    double early = 0, late = 0;
    std::int64_t frame = 0;
    trial.run(world, frames, [&] {
        double& worst = 2 * frame++ < frames ? early : late;
        worst = std::max(worst, std::abs(energyOf(world) - start) / standardFall);
    });
    trial.expect("energy error, second half against the first",
                 std::max(late, rounding) / std::max(early, rounding), {1.5, 1.5});
    // It was 2 until springs in which nothing meets moved by five parts of a substep, of order 4, or by nine
    // in accurate runs, of order 6 (dynamics/spring_steps.h).
    const int order = trial.byDefault() ? 4 : 6;
    trial.expect("order, distance from " + std::to_string(order),
                 std::abs(orderOf(trial, "", trial.byDefault() ? 2 : 1) - order), {0.05, 0.1});
    trial.expect("order of rk4, distance from 4", std::abs(orderOf(trial, "integrator rk4  ", 8) - 4),
                 {0.1, 0.1});
}

} // namespace carom
