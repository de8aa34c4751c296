// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/family.h"
#include "core/study/cases/generated.h"
#include "core/study/cases/scene_text.h"

#include "core/simulation/build.h"
#include "core/simulation/touching.h"
#include "core/solvers/contacts/work_budget.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

// Bodies as they are dropped and thrown about: thin ones that land, heaps, corners, far bystanders. Costs are
// counted in operations, so that they are the same on every machine.

namespace carom {
namespace {

/// A body of one of the shapes, its smallest and largest edge 1 : `slender`, the largest `size` [m].
std::string thinBody(int shape, double size, double slender, const std::string& further) {
    const double thin = size / slender;
    switch (shape) {
    case 0:
        return text("cylinder { radius ", size / 2, "  height ", thin, "  axis ", further);
    case 1:
        return text("cylinder { radius ", thin / 2, "  height ", size, "  axis ", further);
    case 2:
        return text("cuboid { size ", Vec3(size, thin, size), "  rotation ", further);
    default:
        return text("cuboid { size ", Vec3(size, thin, thin), "  rotation ", further);
    }
}
constexpr int thinShapes = 4;

std::string thinScene(int member, Random& random) {
    const double slender = member / thinShapes % 2 == 0 ? 10 : 100;
    const Vec3 turn = uniformDirection(random), spin = random.uniform(0, 20) * uniformDirection(random);
    const Vec3 attitude = member % thinShapes < 2 ? turn : Vec3(random.uniform(0, 180) * turn);
    return falling() + levelFloor(0.5, 0.3) +
           thinBody(member % thinShapes, 0.2, slender,
                    text(attitude, "  mass 1  centre ", Vec3(0, random.uniform(0.2, 0.6), 0), "  vel ",
                         Vec3(random.uniform(-2, 2), random.uniform(-3, 0), random.uniform(-2, 2)),
                         "  angvel ", spin, "  friction 0.5  elastic 0.3 }\n"));
}

void runThin(Trial& trial) {
    Worst deepest, gained;
    forMembers(trial, 24, 500, [&](int member, Random& random) {
        World world = trial.world(thinScene(member, random));
        const double thickness = 0.2 / (member / thinShapes % 2 == 0 ? 10 : 100);
        const double start = energyOf(world);
        double least = start, rise = 0, depth = 0;
        trial.run(world, trial.shortOrLong(90, 600), [&] {
            rise = std::max(rise, energyOf(world) - least);
            least = std::min(least, energyOf(world));
            for (const TouchingPair& touching : touchingPairs(world.pipeline().bodies(), world.state()))
                depth = std::max(depth, -touching.manifold.deepest().separation);
        });
        if (!world.health().finite) rise = depth = NAN;
        deepest.note(depth / thickness, member);
        gained.note(rise / start, member);
    });
    trial.expect(deepest.named("overlap, of the thickness"), deepest.value(), {1e-2, 1e-4});
    trial.expect(gained.named("energy gained between frames"), gained.value(), {1e-3, 1e-6});
}

std::string thinDisc() {
    Random random(familySeed, 4);
    return thinScene(4, random);
}

struct Settling {
    double atRestAfter = NAN; ///< [s], no body of the scene moves from then on
    double lastWork = 0;      ///< of the last frame [operations]
    double deepest = 0;       ///< overlap at rest [m]
};

Settling settle(Trial& trial, const std::string& scene, double seconds) {
    World world = trial.world(scene);
    const std::size_t mobile = world.pipeline().bodies().mobileBodies.size();
    Settling settling;
    trial.run(world, static_cast<std::int64_t>(60 * seconds), [&] {
        if (world.statistics().resting < mobile)
            settling.atRestAfter = NAN;
        else if (std::isnan(settling.atRestAfter))
            settling.atRestAfter = world.state().time;
    });
    settling.lastWork = operationsOf(world.statistics().work);
    for (const TouchingPair& touching : touchingPairs(world.pipeline().bodies(), world.state()))
        settling.deepest = std::max(settling.deepest, -touching.manifold.deepest().separation);
    return settling;
}

/// A little rolling resistance: a cylinder in a groove between two others would roll to and fro for ever.
std::string heap(std::int64_t n, double cuboids) {
    constexpr std::string_view friction = "friction 0.5";
    std::string scene = generated("heap", {.n = n, .seed = 3, .options = {{"cuboids", cuboids}}});
    for (std::size_t at = scene.find(friction); at != scene.npos; at = scene.find(friction, at + 20))
        scene.insert(at, "rolling 0.0005  ");
    return scene;
}

void runHeaps(Trial& trial) {
    Worst rest, cost, depth;
    int member = 0;
    for (const std::int64_t n : {std::int64_t{50}, std::int64_t{100}, std::int64_t{200}, std::int64_t{400}})
        for (const double cuboids : {0.0, 0.5, 1.0}) {
            if (!trial.isLong() && (n > 50 || (!trial.byDefault() && cuboids != 0.5))) continue;
            const Settling settling = settle(trial, heap(n, cuboids), 10);
            rest.note(settling.atRestAfter, member);
            cost.note(settling.lastWork, member);
            depth.note(settling.deepest / 0.1, member++);
        }
    trial.expect(rest.named("time to rest"), rest.value(), {10, 10}, "s");
    trial.expect(cost.named("work at rest"), cost.value(), {0, 0}, "operations");
    trial.expect(depth.named("overlap at rest, of the size"), depth.value(), {1e-2, 1e-2});
}

std::string heapScene() { return heap(100, 0.5); }

/// Twelve bodies of any shape thrown into a corner of three walls.
std::string cornerScene(int member, Random& random) {
    std::string scene = falling();
    const double elastic = random.uniform(0, 0.8), friction = random.uniform(0, 1);
    const std::string surface = text("  friction ", friction, "  elastic ", elastic, " }\n");
    for (const Vec3& normal : {Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 1)})
        scene += text("wall { normal ", normal, "  toOrig 0", surface);
    for (int i = 0; i < 12; ++i) {
        const Vec3 centre(1 + 0.7 * (i % 2), 0.5 + 0.7 * (i / 4), 1 + 0.7 * (i / 2 % 2));
        const Vec3 velocity = Vec3(-5, -2, -5) + 2 * uniformDirection(random);
        const std::string further = text("  mass ", between(random, 0.3, 3), "  centre ", centre, "  vel ",
                                         velocity, "  angvel ", Vec3(10 * uniformDirection(random)), surface);
        const double size = random.uniform(0.1, 0.4);
        switch ((member + i) % 4) {
        case 0:
            scene += text("sphere { radius ", size / 2, further);
            break;
        case 1:
            scene += text("cuboid { size ", Vec3(size, 0.3, random.uniform(0.02, 0.4)), further);
            break;
        case 2:
            scene += text("cylinder { radius ", size / 2, "  height 0.3  axis 0, 1, 0", further);
            break;
        default:
            scene += text("cylinder { radius 0.15  height 0.02  axis 1, 1, 0", further);
            break;
        }
    }
    return scene;
}

/// Three bodies that share most of their place.
std::string burstScene(int member, Random& random) {
    std::string scene = falling() + levelFloor(0.5);
    for (int i = 0; i < 3; ++i) {
        const std::string further =
            text("  mass 1  centre ", Vec3(Vec3(0, 1, 0) + 0.05 * uniformDirection(random)),
                 "  friction 0.5  elastic 0 }\n");
        switch ((member + i) % 3) {
        case 0:
            scene += "sphere { radius 0.2" + further;
            break;
        case 1:
            scene += "cuboid { size 0.4, 0.4, 0.4" + further;
            break;
        default:
            scene += "cylinder { radius 0.2  height 0.4  axis 0, 1, 0" + further;
            break;
        }
    }
    return scene;
}

// What one millisecond buys is 2e6 operations (work_budget.h): such small scenes hold 60 frames a second,
// however their bodies meet, if no frame takes 16 times that.
constexpr double realTime = 16 * 2e6;

void runCorners(Trial& trial) {
    Worst dearest, gained;
    forMembers(trial, trial.byDefault() ? 20 : 2, 500, [&](int member, Random& random) {
        for (const bool isBurst : {false, true}) {
            World world = trial.world(isBurst ? burstScene(member, random) : cornerScene(member, random));
            const double start = energyOf(world);
            double rise = 0, most = 0, least = start;
            trial.run(world, trial.shortOrLong(60, 300), [&] {
                most = std::max(most, operationsOf(world.statistics().work));
                rise = std::max(rise, energyOf(world) - least);
                least = std::min(least, energyOf(world));
            });
            dearest.note(world.health().finite ? most : NAN, 2 * member + (isBurst ? 1 : 0));
            if (!isBurst) gained.note(rise / start, member);
        }
    });
    trial.expect(dearest.named("work of a frame"), dearest.value(), {realTime, 30 * realTime}, "operations");
    trial.expect(gained.named("energy gained between frames"), gained.value(), {1e-3, 1e-3});
}

std::string cornerOfMember0() {
    Random random(familySeed, 0);
    return cornerScene(0, random);
}

std::string grooves(int member, Random& random) {
    std::string scene = falling();
    const int walls = 2 + member % 2;
    const double elastic = member % 4 < 2 ? random.uniform(0, 1) : 0;
    for (int w = 0; w < walls; ++w) {
        const double turn = 2 * std::numbers::pi * w / walls + random.uniform(0, 1);
        scene += text("wall { normal ", Vec3(std::cos(turn), random.uniform(0.3, 1.5), std::sin(turn)),
                      "  toOrig 0  elastic ", elastic, " }\n");
    }
    for (int i = 0; i < 1 + member % 5; ++i)
        scene += text("sphere { radius 0.1  mass 1  centre ",
                      Vec3(random.uniform(-0.1, 0.1), 1 + 0.25 * i, random.uniform(-0.1, 0.1)), "  elastic ",
                      elastic, " }\n");
    return scene;
}

void runGrooves(Trial& trial) {
    double lost = 0;
    forMembers(trial, 24, 500, [&](int member, Random& random) {
        const Build built = build(grooves(member, random) + "simulation { method events }\n");
        if (built.hasErrors()) return; // the line that rules it out is named
        World world(built.pipeline);
        for (int frame = 0; frame < trial.shortOrLong(45, 1200) && trial.goesOn(); ++frame) world.step();
        if (!world.health().finite) ++lost;
    });
    trial.expectNone("runs that lost their state", lost);
}

std::string grooveScene() {
    Random random(familySeed, 0);
    return grooves(0, random);
}

/// Bodies of 1 mm that fall on each other, and what is far from them.
std::string nearBodies(Random& random) {
    std::string scene = falling() + levelFloor(0.5, 0.3);
    for (int i = 0; i < 6; ++i)
        scene += text(i % 2 == 0 ? "sphere { radius 0.0005" : "cuboid { size 0.001, 0.001, 0.001",
                      "  mass 1e-6  centre ",
                      Vec3(random.uniform(-3e-4, 3e-4), 0.001 + 0.0015 * i, random.uniform(-3e-4, 3e-4)),
                      "  friction 0.5  elastic 0.3 }\n");
    return scene;
}
std::string bystander(int member, Random& random) {
    const Vec3 centre(between(random, 2e3, 1e5), 600, random.uniform(-1e3, 1e3));
    if (member % 2 == 0) return text("sphere { radius 500  fixed yes  centre ", centre, "  elastic 0.3 }\n");
    return text("cuboid { size 1000, 1000, 1000  mass 1e12  centre ", centre, "  elastic 0.3 }\n");
}

void runBystanders(Trial& trial) {
    double unlike = 0;
    forMembers(trial, 20, 500, [&](int member, Random& random) {
        const std::string near = nearBodies(random), far = near + bystander(member, random);
        World alone = trial.world(near), beside = trial.world(far);
        for (int frame = 0; frame < trial.shortOrLong(3, 60) && trial.step(alone) && trial.step(beside);
             ++frame)
            for (const BodyIndex i : alone.pipeline().bodies().mobileBodies)
                if (alone.state().pose[i].position != beside.state().pose[i].position) ++unlike;
    });
    trial.expectNone("places that a far bystander changes", unlike);
}

std::string bystanderScene() {
    Random random(familySeed, 0);
    return nearBodies(random) + bystander(0, random);
}

} // namespace

extern const HardCase thinBodiesCase, groovesCase, heapsCase, cornersCase, bystandersCase;

constinit const HardCase thinBodiesCase = {
    .number = 54,
    .name = "thin_bodies",
    .title = "discs, rods, plates and sticks of 1:10 and 1:100, dropped at random, spinning",
    .answer = "no overlap beyond 1 % of the thickness, and energy never rises",
    .byDefault = "1e-2; 1e-3",
    .accurate = "1e-4; 1e-6",
    .aim = "1e-4; 1e-6",
    .columns = steppingColumns,
    .declarations = thinDisc,
    .run = runThin,
};

constinit const HardCase groovesCase = {
    .number = 56,
    .name = "grooves",
    .title = "spheres in grooves and corners, exact events",
    .answer = "finite, or a sentence before the run why not",
    .byDefault = "–",
    .accurate = "holds",
    .aim = "holds",
    .columns = exactColumn,
    .declarations = grooveScene,
    .run = runGrooves,
};

constinit const HardCase heapsCase = {
    .number = 57,
    .name = "heaps",
    .title = "heaps of 50 to 400 cylinders, cuboids and both, dropped in a bin",
    .answer = "at rest within 10 s, and then at no cost; overlap 1 % of the size",
    .byDefault = "holds",
    .accurate = "holds",
    .aim = "holds",
    .columns = steppingColumns,
    .declarations = heapScene,
    .run = runHeaps,
};

constinit const HardCase cornersCase = {
    .number = 59,
    .name = "corners",
    .title = "12 bodies of any shape thrown into a corner; three that share their place",
    .answer = "every frame in real time, and no energy from nothing",
    .byDefault = "16 ms of work",
    .accurate = "30 times that",
    .aim = "holds",
    .columns = steppingColumns,
    .declarations = cornerOfMember0,
    .run = runCorners,
};

constinit const HardCase bystandersCase = {
    .number = 60,
    .name = "bystanders",
    .title = "bodies of 1 mm beside one of 1 km, fixed or free, 2 to 100 km away",
    .answer = "the near ones move as without it, to the bit",
    .byDefault = "0",
    .accurate = "0",
    .aim = "0",
    .columns = steppingColumns,
    .declarations = bystanderScene,
    .run = runBystanders,
};

} // namespace carom
