// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/world.h"
#include "core/study/cases/generated.h"
#include "core/study/trial.h"

#include "core/simulation/touching.h"

#include <algorithm>

// The pyramid of the reference, whose steps must carry the spheres that fall on them.

namespace carom {

namespace {

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
    trial.run(world, trial.shortOrLong(trial.byDefault() ? 360 : 240, 3600), [&] {
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

} // namespace

extern const HardCase pyramidCase;

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

} // namespace carom
