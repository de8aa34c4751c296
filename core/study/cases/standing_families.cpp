// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/family.h"
#include "core/study/cases/scene_text.h"

#include "core/math/rotation.h"
#include "core/simulation/touching.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

// What stands where statics says that it does, and falls where it does not: cylinders on slopes, boxes that
// tip, ladders, towers of bricks, overhangs, slabs on discs and on balls.

namespace carom {
namespace {

/// How far a body is from where it was at the start at most [m], and how far it has turned [rad].
struct Departure {
    double shift = 0, turn = 0;
};

Departure departureOf(const World& world, BodyIndex i) {
    const Pose &start = world.pipeline().initialState().pose[i], &now = world.state().pose[i];
    return {(now.position - start.position).norm(),
            toRotationVector(now.orientation * start.orientation.conjugate()).norm()};
}

/// Runs a scene; how far the mobile body that has gone furthest is in the end, or on the way.
Departure departure(Trial& trial, const std::string& scene, double seconds) {
    World world = trial.world(scene);
    Departure most;
    trial.run(world, static_cast<std::int64_t>(seconds / world.pipeline().settings().step), [&] {
        for (const BodyIndex i : world.pipeline().bodies().mobileBodies) {
            const Departure now = departureOf(world, i);
            most = {std::max(most.shift, now.shift), std::max(most.turn, now.turn)};
        }
    });
    return world.health().finite ? most : Departure{NAN, NAN};
}

/// Whether a mobile body leaves its place by more than this within so many seconds; no longer followed then.
bool leaves(Trial& trial, const std::string& scene, double seconds, const Departure& beyond) {
    World world = trial.world(scene);
    const std::span<const BodyIndex> mobile = world.pipeline().bodies().mobileBodies;
    const double frames = seconds / world.pipeline().settings().step;
    for (int frame = 0; frame < frames && trial.step(world); ++frame)
        for (const BodyIndex i : mobile) {
            const Departure now = departureOf(world, i);
            if (now.shift > beyond.shift && now.turn > beyond.turn) return true;
        }
    return false;
}

/// Gravity tilted by `angle` [rad] about an axis in the floor: a slope in every direction.
std::string tilted(double angle, double heading) {
    const Vec3 down(std::sin(angle) * std::cos(heading), -std::cos(angle),
                    std::sin(angle) * std::sin(heading));
    return text("gravity { accel ", Vec3(standardFall * down), " }\n");
}

// The line of gravity through the centre leaves the disc where tan θ = 2 r/h, whatever the heading.
std::string cylinderOnSlope(double radius, double height, double tangent, double heading) {
    return tilted(std::atan(tangent), heading) + levelFloor(4) +
           text("cylinder c { radius ", radius, "  height ", height, "  axis 0, 1, 0  mass 1  centre ",
                Vec3(0, height / 2, 0), "  friction 4  elastic 0 }\n");
}

void runCylinders(Trial& trial) {
    Worst creep;
    double standing = 0;
    const double seconds = trial.shortOrLong(2.0, 60.0);
    forMembers(trial, 24, 500, [&](int member, Random& random) {
        const double radius = random.uniform(0.05, 0.3), height = random.uniform(0.2, 0.6);
        const double limit = 2 * radius / height, heading = 2 * std::numbers::pi * member / 24;
        const Departure stays =
            departure(trial, cylinderOnSlope(radius, height, 0.999 * limit, heading), seconds);
        creep.note(stays.shift, member);
        if (!leaves(trial, cylinderOnSlope(radius, height, 1.001 * limit, heading), 4, {0, 0.1})) ++standing;
    });
    trial.expect(creep.named("creep below the limit"), creep.value(), {1e-6, 1e-9}, "m");
    trial.expectNone("standing beyond the limit", standing);
}

std::string cylinderScene() { return cylinderOnSlope(0.1, 0.4, 0.4995, 1); }

// A box of width w and height h on a slope tips where tan θ > w/h.
std::string boxOnSlope(double width, double height, double tangent) {
    return tilted(std::atan(tangent), 0) + levelFloor(4) +
           text("cuboid box { size ", Vec3(width, height, width), "  mass 1  centre ", Vec3(0, height / 2, 0),
                "  friction 4  elastic 0 }\n");
}

// A ladder of length l at the angle φ to the floor, against a smooth wall: the wall pushes with N, the floor
// with m g and its friction must be N; about the foot N l sin φ = m g (l/2) cos φ. So it stands where
// tan φ > 1/(2 μ), with the friction of the pair of foot and floor. A thin rod has its foot at its end.
std::string ladder(double length, double friction, double tangent) {
    const double angle = std::atan(tangent), radius = 1e-3 * length;
    const Vec3 along(-std::cos(angle), std::sin(angle), 0);
    const Vec3 centre = 0.5 * length * along + Vec3(length * std::cos(angle), 0, 0) +
                        radius * Vec3(std::sin(angle), std::cos(angle), 0);
    return falling() + levelFloor(friction) + "wall { normal 1, 0, 0  toOrig 0  friction 0  elastic 0 }\n" +
           text("cylinder ladder { radius ", radius, "  height ", length, "  axis ", along,
                "  mass 1  centre ", centre, "  friction ", friction, "  elastic 0 }\n");
}

/// A chimney of square courses, four bricks each, laid around a hole, each turned against the one below.
std::string chimney(int courses) {
    constexpr double length = 0.3, width = 0.1, height = 0.1;
    std::string scene = falling() + levelFloor(0.6);
    for (int course = 0; course < courses; ++course)
        for (int side = 0; side < 4; ++side) {
            const double turn = 0.5 * std::numbers::pi * side;
            const double aside = course % 2 == 0 ? 0.5 * width : -0.5 * width;
            const Vec3 centre(0.5 * length * std::cos(turn) - aside * std::sin(turn), (course + 0.5) * height,
                              0.5 * length * std::sin(turn) + aside * std::cos(turn));
            const bool isAlongX = side % 2 == 1;
            scene +=
                text("cuboid { size ", isAlongX ? Vec3(length, height, width) : Vec3(width, height, length),
                     "  mass 5  centre ", centre, "  friction 0.6  elastic 0 }\n");
        }
    return scene;
}

void runStatics(Trial& trial) {
    Worst drift;
    double standing = 0, fallen = 0;
    const double seconds = trial.shortOrLong(2.0, 60.0);
    forMembers(trial, 10, 250, [&](int member, Random& random) {
        const double width = random.uniform(0.1, 0.3), height = random.uniform(0.3, 1);
        const double tips = width / height;
        const Departure box = departure(trial, boxOnSlope(width, height, 0.99 * tips), seconds);
        drift.note(box.shift / width, member);
        if (!leaves(trial, boxOnSlope(width, height, 1.01 * tips), 4, {0, 0.1})) ++standing;
        const double length = random.uniform(1, 4), friction = random.uniform(0.2, 0.7);
        const double slips = 1 / (2 * friction);
        const Departure steep = departure(trial, ladder(length, friction, 1.02 * slips), seconds);
        if (!(steep.shift < 0.01 * length)) ++fallen;
        if (!leaves(trial, ladder(length, friction, 0.98 * slips), 4, {0.1 * length, 0})) ++standing;
    });
    const Departure bricks = departure(trial, chimney(trial.shortOrLong(8, 30)), trial.shortOrLong(5, 60));
    trial.expect(drift.named("drift of a box within its limit, of its width"), drift.value(), {1e-4, 1e-6});
    trial.expect("drift of a chimney, of a brick's height", bricks.shift / 0.1, {1e-4, 1e-6});
    trial.expectNone("ladders that slip within their limit", fallen);
    trial.expectNone("boxes and ladders that stand beyond it", standing);
}

std::string chimneyScene() { return chimney(12); }

/// Boards of length 1 that overhang by 1/2, 1/4, 1/6, ... of it, times a factor: the centre of what is above
/// each edge is just within it (the harmonic series).
std::string overhang(int boards, double factor) {
    std::string scene = falling() + levelFloor(0.7);
    double x = 0;
    for (int i = 0; i < boards; ++i) {
        scene += text("cuboid { size 1, 0.05, 0.3  mass 1  centre ", Vec3(x, 0.025 + 0.05 * i, 0),
                      "  friction 0.7  elastic 0 }\n");
        x += factor / (2.0 * (boards - 1 - i));
    }
    return scene;
}

/// A slab that rests on a disc, upright on its face, and on it another.
std::string boxesOnDiscs(double radius, int count) {
    std::string scene = falling() + levelFloor(0.6);
    double y = 0;
    for (int i = 0; i < count; ++i) {
        scene += text("cylinder { radius ", radius, "  height 0.05  axis 0, 1, 0  mass 1  centre ",
                      Vec3(0, y + 0.025, 0), "  friction 0.6  elastic 0 }\n");
        scene += text("cuboid { size 0.6, 0.2, 0.6  mass 2  centre ", Vec3(0, y + 0.15, 0),
                      "  friction 0.6  elastic 0 }\n");
        y += 0.25;
    }
    return scene;
}

/// A slab on four balls, layer on layer.
std::string slabsOnBalls(double radius, int layers) {
    std::string scene = falling() + levelFloor(0.6);
    double y = 0;
    for (int layer = 0; layer < layers; ++layer) {
        for (const double x : {-0.3, 0.3})
            for (const double z : {-0.2, 0.2})
                scene += text("sphere { radius ", radius, "  mass 1  centre ", Vec3(x, y + radius, z),
                              "  friction 0.6  elastic 0 }\n");
        scene += text("cuboid { size 1, 0.1, 0.6  mass 5  centre ", Vec3(0, y + 2 * radius + 0.05, 0),
                      "  friction 0.6  elastic 0 }\n");
        y += 2 * radius + 0.1;
    }
    return scene;
}

void runBalance(Trial& trial) {
    Worst drift;
    double fallen = 0, standing = 0;
    const double seconds = trial.shortOrLong(2.0, 60.0);
    for (const int boards : {2, 3, 5, 8}) {
        const Departure within = departure(trial, overhang(boards, 0.999), seconds);
        if (!(within.turn < 1e-2)) ++fallen;
        if (!leaves(trial, overhang(boards, 1.001), 5, {0, 0.05})) ++standing;
    }
    forMembers(trial, 8, 250, [&](int member, Random& random) {
        const double radius = random.uniform(0.02, 0.25);
        drift.note(departure(trial, boxesOnDiscs(radius, 1 + member % 4), seconds).shift, member);
        drift.note(departure(trial, slabsOnBalls(random.uniform(0.02, 0.2), 1 + member % 3), seconds).shift,
                   member);
    });
    trial.expectNone("overhangs of 0.999 that fall", fallen);
    trial.expectNone("overhangs of 1.001 that stand", standing);
    trial.expect(drift.named("drift of boxes on discs and slabs on balls"), drift.value(), {1e-4, 1e-6}, "m");
}

std::string balanceScene() { return slabsOnBalls(0.1, 3); }

} // namespace

extern const HardCase cylinderOnSlopeCase, staticsCase, balanceCase;

constinit const HardCase cylinderOnSlopeCase = {
    .number = 53,
    .name = "cylinder_on_slope",
    .title = "standing cylinders on slopes in 24 directions",
    .answer = "they stand to tan θ = 2 r/h (1 - 1e-3), and tip at 1 + 1e-3",
    .byDefault = "creep 1e-6 m",
    .accurate = "1e-9 m",
    .aim = "1e-9 m",
    .columns = steppingColumns,
    .declarations = cylinderScene,
    .run = runCylinders,
};

constinit const HardCase staticsCase = {
    .number = 58,
    .name = "statics",
    .title = "boxes that tip, ladders that slip, a chimney of bricks",
    .answer = "they stand inside their limit and fall outside it, within 1 or 2 %",
    .byDefault = "drift 1e-4 of the size",
    .accurate = "1e-6",
    .aim = "1e-6, 1 h",
    .columns = steppingColumns,
    .declarations = chimneyScene,
    .run = runStatics,
};

constinit const HardCase balanceCase = {
    .number = 61,
    .name = "balance",
    .title = "harmonic overhangs of 0.999 and 1.001, boxes on discs, slabs on balls",
    .answer = "what is balanced stands",
    .byDefault = "drift 1e-4 m",
    .accurate = "1e-6 m",
    .aim = "1e-6 m",
    .columns = steppingColumns,
    .declarations = balanceScene,
    .run = runBalance,
};

} // namespace carom
