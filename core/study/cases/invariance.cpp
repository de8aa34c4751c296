// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/generated.h"
#include "core/study/cases/scene_text.h"
#include "core/study/trial.h"
#include "core/study/units.h"

#include "core/language/analysis.h"

#include <algorithm>
#include <array>
#include <cmath>

// Units and origins have no physical meaning: a scene in other units (units.h) must move the same to the bit,
// and one far from the origin as it does near it.

namespace carom {
namespace {

std::vector<std::string> shippedScenes(std::int64_t bodies) {
    std::vector<std::string> scenes;
    for (const GeneratorRow& row : generators()) {
        GeneratorRequest request{.n = {}, .options = {}};
        if (row.defaultN > bodies) request.n = bodies;
        if (!checkRequest(row, request)) scenes.push_back(generated(row.name, request));
    }
    return scenes;
}

/// Steps that are powers of two, so that scaling them is exact.
World worldOf(const Scene& scene, const Units& units) {
    SimulationSettings options;
    options.step = units.second() / 64;
    return World(std::make_shared<const Pipeline>(scaled(scene, units), options));
}

/// Whether the scene in other units comes to the same state, to the bit, as `world` did.
bool comesToTheSame(Trial& trial, const World& world, const Units& units) {
    World other = worldOf(world.pipeline().scene(), units);
    trial.run(other, world.state().frame);
    const State &a = world.state(), &b = other.state();
    return std::ranges::all_of(world.pipeline().bodies().mobileBodies, [&](BodyIndex i) {
        return a.pose[i].position * units.metre() == b.pose[i].position &&
               a.pose[i].orientation.coeffs() == b.pose[i].orientation.coeffs() &&
               a.velocity[i] * (units.metre() / units.second()) == b.velocity[i] &&
               a.angularVelocity[i] / units.second() == b.angularVelocity[i];
    });
}

Scene sceneIn(const Trial& trial, const std::string& declarations) {
    return analyse(declarations + simulationOf(trial.column(), "")).scene;
}

void runScaling(Trial& trial) {
    double byLength = 0, byMass = 0;
    const int frames = trial.shortOrLong(3, 120), step = trial.shortOrLong(7, 1);
    for (const std::string& text : shippedScenes(trial.shortOrLong(6, 40))) {
        World world = worldOf(sceneIn(trial, text), {});
        trial.run(world, frames);
        bool sameByLength = true, sameByMass = true;
        for (int k = -10; k <= 10; k += step) {
            sameByLength = sameByLength && comesToTheSame(trial, world, {k, 0});
            sameByMass = sameByMass && comesToTheSame(trial, world, {0, k});
        }
        if (!sameByLength) ++byLength;
        if (!sameByMass) ++byMass;
        if (trial.stopped()) return;
    }
    trial.expectNone("scenes that differ in a bit with lengths and times", byLength);
    trial.expectNone("scenes that differ in a bit with masses", byMass);
}

std::string scalingScene() { return generated("table", {.n = {}, .options = {}}); }

// Where bodies bounce off each other a difference grows by itself, however well it is computed; so these are
// scenes in which it does not: one ball, sliding, rolling, stacks, springs.
const std::array<std::string, 7>& steadyScenes() {
    const GeneratorRequest plain{.n = {}, .options = {}};
    static const std::array<std::string, 7> scenes = {
        falling() + levelFloor(0, 1) + "sphere { radius 0.5  mass 1  centre 0, 2, 0 }\n",
        falling() + levelFloor(0.5) +
            "cuboid { size 1, 1, 1  mass 1  centre 0, 0.5, 0  vel 3, 0, 1  friction 0.5  elastic 0 }\n",
        weightless() + "cuboid { size 0.2, 0.4, 0.6  mass 1  centre 0, 0, 0  angvel 1, 2, 3 }\n",
        generated("slopes", plain),
        generated("log_pile", plain),
        generated("tower", plain),
        generated("chain", plain)};
    return scenes;
}

void runFarAway(Trial& trial) {
    double deviation = 0;
    for (const std::string& text : steadyScenes()) {
        // Out there a place can only be given to 1e-10 m: both worlds start from those.
        const Vec3 away(1e6, 1e6, -1e6);
        const Scene there = moved(sceneIn(trial, text), away);
        World world(std::make_shared<const Pipeline>(moved(there, -away)));
        World far(std::make_shared<const Pipeline>(there));
        for (int frame = 0; frame < trial.shortOrLong(60, 300); ++frame) {
            if (!trial.step(world) || !trial.step(far)) break;
            for (const BodyIndex i : world.pipeline().bodies().mobileBodies) {
                const Vec3 off = far.state().pose[i].position - away - world.state().pose[i].position;
                deviation = std::max(deviation, off.norm() / world.pipeline().bodies().boundingRadius[i]);
            }
        }
        if (!far.health().finite) deviation = NAN;
        if (trial.stopped()) return;
    }
    trial.expect("difference of the motion, of the body's size", deviation, {1e-6, 1e-6});
}

std::string farAwayScene() {
    return falling() + "wall { normal 0, 1, 0  toOrig -1e6 }\nsphere { radius 0.5  mass 1  centre 1e6, "
                       "1000002, -1e6 }\n";
}

} // namespace

extern const HardCase scalingCase, farAwayCase;

constinit const HardCase scalingCase = {
    .number = 41,
    .name = "scaling",
    .title = "every generator's scene with lengths times 4^k, times times 2^k, masses times 2^j",
    .answer = "the same motion, bitwise",
    .byDefault = "holds",
    .accurate = "holds",
    .aim = "holds",
    .columns = steppingColumns,
    .declarations = scalingScene,
    .run = runScaling,
};

constinit const HardCase farAwayCase = {
    .number = 42,
    .name = "far_away",
    .title = "scenes 1e6 m from the origin",
    .answer = "the same motion",
    .byDefault = "1e-6",
    .accurate = "1e-6",
    .aim = "1e7 m",
    .columns = steppingColumns,
    .declarations = farAwayScene,
    .run = runFarAway,
};

} // namespace carom
