// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/scene_text.h"
#include "core/study/references.h"
#include "core/study/trial.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

// Sliding and rolling on a level floor: where a body stops, when it begins to roll, and that it then rolls on
// for ever, straight.

namespace carom {
namespace {

constexpr double pi = std::numbers::pi;
constexpr BodyIndex body = 1;

std::string slidingCube(const Vec3& velocity) {
    return falling() + levelFloor(0.5) +
           text("cuboid { size 1, 1, 1  mass 1  centre 0, 0.5, 0  vel ", velocity,
                "  friction 0.5  elastic 0 }\n");
}

std::string slidingCubeScene() { return slidingCube(Vec3(3, 0, 0)); }

void runSlidingCube(Trial& trial) {
    constexpr double speed = 3;
    const double expected = reference::SlidingBlock{speed, 0.5, standardFall}.way();
    const int directions = trial.shortOrLong(24, 360);
    double shortest = std::numeric_limits<double>::infinity(), longest = 0;
    for (int i = 0; i < directions; ++i) {
        const double angle = 2 * pi * i / directions;
        const Vec3 along(std::cos(angle), 0, std::sin(angle));
        World world = trial.world(slidingCube(speed * along));
        trial.run(world, 60);
        const double way = along.dot(world.state().pose[body].position);
        shortest = std::min(shortest, way);
        longest = std::max(longest, way);
    }
    trial.expect("stopping distance, error", std::max(longest - expected, expected - shortest), {1e-3, 1e-6},
                 "m");
    trial.expect("spread over the directions", longest - shortest, {1e-9, 1e-9}, "m");
}

enum class Round { Sphere, Cylinder };

/// I/(m r²).
double inertiaOf(Round shape) { return shape == Round::Sphere ? 0.4 : 0.5; }

/// Radius 0.5 m, rolling along x if it rolls.
std::string roller(Round shape, std::string_view motion) {
    const std::string common = text("  mass 1  centre 0, 0.5, 0  elastic 0  ", motion, " }\n");
    return (shape == Round::Sphere ? "sphere { radius 0.5"
                                   : "cylinder { radius 0.5  height 1  axis 0, 0, 1") +
           common;
}

std::string slidingRoller(Round shape) {
    return falling() + levelFloor(0.3) + roller(shape, "vel 5, 0, 0  friction 0.3");
}

void runSlidingRoller(Trial& trial, Round shape) {
    World world = trial.world(slidingRoller(shape));
    trial.run(world, 120);
    const reference::SlidingRoller expected{5, 0.3, inertiaOf(shape), standardFall};
    const double speed = world.state().velocity[body].x(), way = world.state().pose[body].position.x();
    trial.expect("rolling speed, error", std::abs(speed / expected.rollingSpeed() - 1), {1e-4, 1e-9});
    trial.expect("place after 2 s, error", std::abs(way - expected.at(2).place), {1e-4, 1e-9}, "m");
}

std::string slidingSphereScene() { return slidingRoller(Round::Sphere); }
std::string slidingCylinderScene() { return slidingRoller(Round::Cylinder); }
void runSlidingSphere(Trial& trial) { runSlidingRoller(trial, Round::Sphere); }
void runSlidingCylinder(Trial& trial) { runSlidingRoller(trial, Round::Cylinder); }

constexpr double lever = 0.02; ///< rolling resistance of case 18 [m]

std::string resistedBall() {
    return falling() + levelFloor(0.5) +
           roller(Round::Sphere, text("vel 1, 0, 0  angvel 0, 0, -2  friction 0.5  rolling ", lever));
}

void runResistedBall(Trial& trial) {
    const double slowing = reference::rollingDeceleration(lever, 0.5, inertiaOf(Round::Sphere), standardFall);
    World world = trial.world(resistedBall());
    trial.run(world, 300);
    const double way = world.state().pose[body].position.x();
    trial.expect("stopping distance, error", std::abs(way * 2 * slowing - 1), {1e-2, 1e-6});
    trial.expect("speed afterwards", world.state().velocity[body].norm(), {0, 0}, "m/s");
}

std::string rollingCylinder(double yaw) {
    const Vec3 along(std::cos(yaw), 0, -std::sin(yaw)), axis(std::sin(yaw), 0, std::cos(yaw));
    return falling() + levelFloor(0.5) +
           text("cylinder { radius 0.5  height 1  mass 1  centre 0, 0.5, 0  axis ", axis, "  vel ",
                Vec3(2 * along), "  angvel ", Vec3(-4 * axis), "  friction 0.5  elastic 0 }\n");
}

std::string rollingCylinderScene() { return rollingCylinder(0.7); }

void runRollingCylinder(Trial& trial) {
    const int yaws = trial.shortOrLong(7, 360), frames = trial.shortOrLong(180, 600);
    double aside = 0, change = 0;
    for (int i = 0; i < yaws; ++i) {
        const double yaw = 2 * pi * i / yaws;
        const Vec3 along(std::cos(yaw), 0, -std::sin(yaw));
        World world = trial.world(rollingCylinder(yaw));
        trial.run(world, frames, [&] {
            const Vec3 place = world.state().pose[body].position - Vec3(0, 0.5, 0);
            aside = std::max(aside, (place - along.dot(place) * along).norm());
            change = std::max(change, (world.state().velocity[body] - 2 * along).norm());
        });
    }
    trial.expect("way aside", aside, {1e-6, 1e-9}, "m");
    trial.expect("change of velocity", change, {1e-6, 1e-9}, "m/s");
}

} // namespace

extern const HardCase slidingCubeCase, slidingSphereCase, slidingCylinderCase, resistedBallCase,
    rollingCylinderCase;

constinit const HardCase slidingCubeCase = {
    .number = 13,
    .name = "sliding_cube",
    .title = "a cube slides to rest, friction .5, over 360 directions",
    .answer = "it stops after v²/(2 μ g), the same in all directions",
    .byDefault = "1e-3, spread 1e-9",
    .accurate = "1e-6",
    .aim = "1e-9",
    .columns = steppingColumns,
    .declarations = slidingCubeScene,
    .run = runSlidingCube,
};

constinit const HardCase slidingSphereCase = {
    .number = 14,
    .name = "sliding_sphere",
    .title = "a sphere slides, then rolls: 5 m/s, friction .3",
    .answer = "it rolls at 25/7 m/s after .4854133 s",
    .byDefault = "1e-4",
    .accurate = "1e-9",
    .aim = "1e-10",
    .columns = steppingColumns,
    .declarations = slidingSphereScene,
    .run = runSlidingSphere,
};

constinit const HardCase slidingCylinderCase = {
    .number = 15,
    .name = "sliding_cylinder",
    .title = "a cylinder on its side slides, then rolls: 5 m/s, friction .3",
    .answer = "it rolls at 10/3 m/s after .5663156 s",
    .byDefault = "1e-4",
    .accurate = "1e-9",
    .aim = "1e-10",
    .columns = steppingColumns,
    .declarations = slidingCylinderScene,
    .run = runSlidingCylinder,
};

constinit const HardCase resistedBallCase = {
    .number = 18,
    .name = "rolling_resistance",
    .title = "a rolling sphere with rolling resistance b",
    .answer = "it slows at (5/7) g b/r and stops",
    .byDefault = "1 %",
    .accurate = "1e-6",
    .aim = "1e-9",
    .columns = steppingColumns,
    .declarations = resistedBall,
    .run = runResistedBall,
};

constinit const HardCase rollingCylinderCase = {
    .number = 38,
    .name = "rolling_cylinder",
    .title = "a cylinder rolls at 2 m/s for 10 s, in every direction",
    .answer = "straight, at a constant speed",
    .byDefault = "1e-6",
    .accurate = "1e-9",
    .aim = "1e-12",
    .columns = steppingColumns,
    .declarations = rollingCylinderScene,
    .run = runRollingCylinder,
};

} // namespace carom
