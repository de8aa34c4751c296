// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/displacement.h"
#include "core/study/cases/generated.h"
#include "core/study/cases/scene_text.h"
#include "core/study/trial.h"

#include "core/simulation/touching.h"

#include <algorithm>

// What is stacked and leant by hand in the world: logs, steps, cards.

namespace carom {

namespace {

std::string logPile() { return generated("log_pile", {.n = 6, .options = {}}); }

void runLogPile(Trial& trial) {
    World world = trial.world(logPile());
    const Displacement moved = displacementOver(trial, world, trial.shortOrLong(180, 3600));
    trial.expect("yaw", moved.yaw, {1e-3, 1e-6}, "rad");
    trial.expect("way aside", moved.aside, {1e-3, 1e-5}, "m");
}

std::string logTower() {
    std::string scene = falling() + levelFloor(0.6);
    for (int layer = 0; layer < 10; ++layer)
        for (const double side : {-3.5, 3.5}) {
            const bool alongX = layer % 2 == 0;
            scene += text("cylinder { radius 1  height 10  axis ", alongX ? Vec3(1, 0, 0) : Vec3(0, 0, 1),
                          "  mass 1  centre ",
                          alongX ? Vec3(0, 1 + 2 * layer, side) : Vec3(side, 1 + 2 * layer, 0),
                          "  friction 0.6  elastic 0 }\n");
        }
    return scene;
}

void runLogTower(Trial& trial) {
    World world = trial.world(logTower());
    const Displacement moved = displacementOver(trial, world, trial.shortOrLong(180, 3600));
    trial.expect("drift", std::max(moved.aside, moved.down), {1e-2, 1e-4}, "m");
}

// How deep the steps are in each other and in the floor, looked at ten times a second: the spheres and the
// heavy one throw them about, but must not press them into each other.
void runPyramid(Trial& trial) {
    World world = trial.world(generated("pyramid", {.n = trial.shortOrLong(30, 500), .options = {}}));
    const Bodies& bodies = world.pipeline().bodies();
    const auto radiusOf = [&](BodyIndex i) {
        const Cylinder* step = std::get_if<Cylinder>(&bodies.shape[i]);
        return step != nullptr ? step->radius : 0;
    };
    double deepest = 0;
    trial.run(world, trial.shortOrLong(360, 3600), [&] {
        if (world.state().frame % 6 != 0) return;
        for (const TouchingPair& touching : touchingPairs(bodies, world.state())) {
            const double a = radiusOf(touching.pair.a), b = radiusOf(touching.pair.b);
            const bool areSteps = (a > 0 || isWall(bodies.shape[touching.pair.a])) && b > 0;
            if (areSteps)
                deepest = std::max(deepest, -touching.manifold.deepest().separation / std::max(a, b));
        }
    });
    trial.expect("overlap of steps, in radii", deepest, {1e-3, 1e-6});
}

std::string pyramidScene() { return generated("pyramid", {.n = 500, .options = {}}); }

std::string cardHouse() { return generated("card_house", {.n = 5, .options = {}}); }

void runCardHouse(Trial& trial) {
    World world = trial.world(cardHouse());
    const std::int64_t seconds = trial.byDefault() ? trial.shortOrLong(3, 20) : trial.shortOrLong(2, 60);
    const Displacement moved = displacementOver(trial, world, seconds * 60);
    trial.expect("displacement", std::max(moved.aside, moved.down), {1e-3, 1e-4}, "m");
}

} // namespace

extern const HardCase logPileCase, logTowerCase, pyramidCase, cardHouseCase;

constinit const HardCase logPileCase = {
    .number = 26,
    .name = "log_pile",
    .title = "six logs in each other's grooves, 3-2-1, friction 0.6",
    .answer = "they lie still",
    .byDefault = "60 s, yaw 1e-3",
    .accurate = "yaw 1e-6",
    .aim = "1e-9",
    .columns = steppingColumns,
    .declarations = logPile,
    .run = runLogPile,
};

constinit const HardCase logTowerCase = {
    .number = 27,
    .name = "log_tower",
    .title = "a cross-laid tower of logs, 10 layers of 2, radius 1 m, length 10 m",
    .answer = "it stands",
    .byDefault = "60 s, drift 1 cm",
    .accurate = "1e-4 m",
    .aim = "1e-6",
    .columns = steppingColumns,
    .declarations = logTower,
    .run = runLogTower,
};

constinit const HardCase pyramidCase = {
    .number = 29,
    .name = "pyramid",
    .title = "spheres rain on a pyramid of cylinders",
    .answer = "the cylinders do not sink into each other",
    .byDefault = "1e-3 radius",
    .accurate = "1e-6 radius",
    .aim = "1e-6 radius",
    .columns = steppingColumns,
    .declarations = pyramidScene,
    .run = runPyramid,
};

constinit const HardCase cardHouseCase = {
    .number = 30,
    .name = "card_house",
    .title = "a house of cards of 5 storeys, leaning by 25°, friction 0.7",
    .answer = "it stands",
    .byDefault = "20 s",
    .accurate = "60 s, 1e-4 m",
    .aim = "1 h",
    .columns = steppingColumns,
    .declarations = cardHouse,
    .run = runCardHouse,
};

} // namespace carom
