// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/scene_text.h"
#include "core/study/trial.h"

#include "core/simulation/touching.h"
#include "core/solvers/contact_settings.h"

#include <algorithm>
#include <array>
#include <cmath>

// Scenes that are wrong from the start: bodies deep in each other, and many with one centre.

namespace carom {
namespace {

const std::array<std::string, 3>& deepPairs() {
    static const std::array<std::string, 3> pairs = {
        weightless() + "cuboid { size 1, 1, 1  mass 1  centre 0, 0, 0  elastic 0 }\n"
                       "cuboid { size 1, 1, 1  mass 1  centre 0, 0.1, 0  elastic 0 }\n",
        weightless() + "cuboid { size 1, 1, 1  mass 1  centre 0, 0, 0  elastic 0 }\n"
                       "sphere { radius 0.5  mass 1  centre 0.1, 0.2, 0  elastic 0 }\n",
        weightless() +
            "cuboid { size 2, 2, 2  mass 1  centre 0, 0, 0  elastic 0 }\n"
            "cylinder { radius 0.3  height 1  mass 1  axis 0, 1, 0  centre 0.1, 0.3, 0  elastic 0 }\n"};
    return pairs;
}

std::string deepScene() { return deepPairs().front(); }

double deepestOf(const World& world) {
    double deepest = 0;
    for (const TouchingPair& touching : touchingPairs(world.pipeline().bodies(), world.state()))
        deepest = std::max(deepest, -touching.manifold.deepest().separation);
    return deepest;
}

// The speed is that of the places: parting does not show in the velocities. Two bodies that part share the
// way between them, and the cap is for both together.
void runDeep(Trial& trial) {
    double hurry = 0, left = 0;
    for (const std::string& scene : deepPairs()) {
        World world = trial.world(scene);
        const Bodies& bodies = world.pipeline().bodies();
        const double size = std::min(bodies.boundingRadius[0], bodies.boundingRadius[1]);
        const double cap = mostParting * size / world.pipeline().settings().substep();
        State before = world.state();
        trial.run(world, 120, [&] {
            for (const BodyIndex i : bodies.mobileBodies) {
                const Vec3 way = world.state().pose[i].position - before.pose[i].position;
                hurry = std::max(hurry, way.norm() / world.pipeline().settings().step / cap);
                hurry = std::max(hurry, world.state().velocity[i].norm() / cap);
            }
            before = world.state();
        });
        left = std::max(left, world.health().finite ? deepestOf(world) / size : NAN);
    }
    trial.expect("greatest speed, of the documented cap", hurry, {1 + 1e-9, 1 + 1e-9});
    trial.expect("overlap after 2 s, of the smaller body's size", left, {1e-6, 1e-6});
}

constexpr std::array<std::string_view, 3> shapes = {"sphere { radius 0.5", "cuboid { size 1, 1, 1",
                                                    "cylinder { radius 0.5  height 1  axis 0, 1, 0"};

std::string oneCentre(std::string_view shape, int count) {
    std::string scene = weightless();
    for (int i = 0; i < count; ++i)
        scene += text(shape, "  mass 1  centre 0, 0, 0  friction 0.5  elastic 0.5 }\n");
    return scene;
}

std::string oneCentreScene() { return oneCentre(shapes[1], 20); }

void runOneCentre(Trial& trial) {
    double lost = 0, unlike = 0;
    const int most = trial.shortOrLong(10, 100);
    for (const std::string_view shape : shapes)
        for (const int count : {2, 3, 5, 10, 30, 100}) {
            if (count > most) continue;
            World world = trial.world(oneCentre(shape, count)), again = trial.world(oneCentre(shape, count));
            for (int frame = 0; frame < 60 && trial.step(world) && trial.step(again);) ++frame;
            if (!world.health().finite) ++lost;
            if (world.stateHash() != again.stateHash()) ++unlike;
        }
    trial.expectNone("runs that lost their state", lost);
    trial.expectNone("runs that differ from their repetition", unlike);
}

} // namespace

extern const HardCase deepCase, oneCentreCase;

constinit const HardCase deepCase = {
    .number = 39,
    .name = "deep_overlap",
    .title = "a cube 90 % in a cube, a sphere's centre inside a cuboid, a cylinder inside a cuboid",
    .answer = "they are parted gently, within 2 s, for good",
    .byDefault = "holds",
    .accurate = "holds",
    .aim = "holds",
    .columns = steppingColumns,
    .declarations = deepScene,
    .run = runDeep,
};

constinit const HardCase oneCentreCase = {
    .number = 40,
    .name = "one_centre",
    .title = "2 to 100 bodies with one centre, every shape",
    .answer = "the state stays finite and is the same in every run",
    .byDefault = "holds",
    .accurate = "holds",
    .aim = "holds",
    .columns = steppingColumns,
    .declarations = oneCentreScene,
    .run = runOneCentre,
};

} // namespace carom
