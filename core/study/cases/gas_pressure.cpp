// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/scene_text.h"
#include "core/study/gas.h"
#include "core/study/trial.h"

#include "core/math/random.h"
#include "core/study/references.h"

#include <cmath>

// A dense gas of hard spheres, its pressure and its mean free time. In a box with walls the number density of
// the bulk is not the number of balls by the volume: the balls crowd in layers at the walls. So everything is
// measured three diameters away from edges and walls, as core/study/gas.h has it, at the density that is
// found there; theory says how little the pressure would differ at exactly .5.
//
// Z by N. Carnahan, K. Starling, 1969, good to a few tenths of a percent for the whole fluid; the mean free
// time by D. Enskog, 1922: τ = 1/(4 √(π kT/m) n σ² g), g = (Z − 1) / (2π n σ³/3).

namespace carom {
namespace {

constexpr double density = 0.5; // [1/m³], σ = 1 m
/// Between places at the start [m], and from them to the walls, beyond half of it: so the middle has its
/// density of .500 from the start. Were it pressed together while layers form at the walls, it would stay
/// hotter than they for long, and the pressure too high by 1 %.
constexpr double spacing = 1.2626, toWall = 0.205;

std::string box(int side) {
    std::string scene = weightless();
    const double width = side * spacing + 2 * toWall;
    for (int axis = 0; axis < 3; ++axis)
        for (const double way : {1.0, -1.0})
            scene += text("wall { normal ", Vec3(way * Vec3::Unit(axis)), "  toOrig ", way > 0 ? 0.0 : width,
                          " }\n");
    Random random(48);
    for (int i = 0; i < side * side * side; ++i) {
        const Vec3 cell(i % side, i / side % side, i / (side * side));
        const Vec3 place = spacing * (cell + Vec3::Constant(0.5)) + Vec3::Constant(toWall);
        const Vec3 velocity(random.gaussian(), random.gaussian(), random.gaussian());
        scene += text("sphere { radius 0.5  mass 1  centre ", place, "  vel ", velocity, " }\n");
    }
    return scene;
}

std::string denseGasScene() { return box(10); }

void runPressure(Trial& trial) {
    const World world = trial.world(box(trial.shortOrLong(14, 24)));
    GasPlan plan;
    plan.settling = trial.shortOrLong(50, 100);
    plan.measuring = trial.shortOrLong(400, 3000);
    const GasStudy study =
        studyGas(world.pipeline(), plan, [&](std::int64_t, std::int64_t) { return trial.goesOn(); });
    if (trial.stopped()) return;
    const double sphere = theory::packingOf(1, 1), found = study.packing / sphere;
    const double right = reference::hardSphereCompressibility(density);
    const auto offAt = [](const std::optional<GasEstimate>& measured, double theory) {
        return measured ? std::abs(measured->value / theory - 1) : NAN;
    };
    const double asFound = reference::hardSphereCompressibility(found);
    trial.expect("density in the middle, off 0.5", std::abs(found / density - 1), {0.01, 0.01});
    trial.expect("Z = 3.262431 from wall momentum, off", offAt(study.wallCompressibility, asFound),
                 {0.01, 0.01});
    trial.expect("Z from collisions, off", offAt(study.compressibility, asFound), {0.01, 0.01});
    trial.expect("mean free time 0.1306, off",
                 offAt(study.freeTime, theory::freeTimeOf(found, 1, 1, study.temperature)), {0.01, 0.01});
    trial.expect("Z of theory at 0.5, off 3.262431", std::abs(right - 3.262431), {1e-6, 1e-6});
    trial.expect("energy error", std::abs(study.energyDrift), {1e-12, 1e-12});
}

} // namespace

extern const HardCase pressureCase;

constinit const HardCase pressureCase = {
    .number = 48,
    .name = "gas_pressure",
    .title = "a gas of hard spheres at number density 0.5, σ = m = kT = 1",
    .answer = "Z = 3.262431 from the momentum given to the walls; the mean free time is 0.1306",
    .byDefault = "–",
    .accurate = "1 %",
    .aim = "0.3 %",
    .columns = exactColumn,
    .declarations = denseGasScene,
    .run = runPressure,
};

} // namespace carom
