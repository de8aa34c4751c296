// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/family.h"
#include "core/study/cases/scene_text.h"

#include <algorithm>
#include <cmath>
#include <numbers>

// Bodies that pass each other many times over within a step: each trial has its own world and lasts until
// they must have met.

namespace carom {
namespace {

std::string ballAtWall(double thickness, double speed, double distance, const Vec3& aside) {
    return weightless() + text("cuboid { size ", Vec3(thickness, 2, 2), "  centre 0, 0, 0  fixed yes }\n",
                               "sphere { radius 0.05  mass 1  centre ", Vec3(Vec3(-distance, 0, 0) + aside),
                               "  vel ", Vec3(speed, 0, 0), " }\n");
}

void runBallAtWall(Trial& trial) {
    Random random(familySeed);
    double through = 0, worst = 0;
    const int trials = trial.shortOrLong(500, 10'000);
    for (int i = 0; i < trials; ++i) {
        const double thickness = between(random, 1e-4, 0.1), speed = between(random, 10, 1e5);
        const Vec3 aside(0, random.uniform(-0.8, 0.8), random.uniform(-0.8, 0.8));
        World world = trial.world(ballAtWall(thickness, speed, random.uniform(0.2, 1), aside));
        trial.run(world, 2 + static_cast<std::int64_t>(60 / speed));
        const bool returns = world.state().velocity[1].x() < 0 && world.state().pose[1].position.x() < 0;
        if (!returns) ++through;
        if (returns) worst = std::max(worst, std::abs(world.state().velocity[1].x() / speed + 1));
        if (trial.stopped()) return;
    }
    trial.expectNone("through the wall", through);
    trial.expect("speed of the return, error", worst, {1e-6, 1e-9});
}

std::string ballAtWallScene() { return ballAtWall(1e-3, 100, 1, Vec3::Zero()); }

std::string headOn(double speedA, double speedB, double distance) {
    const auto ball = [](double x, double speed) {
        return text("sphere { radius 0.05  mass 1  centre ", Vec3(x, 0, 0), "  vel ", Vec3(speed, 0, 0),
                    " }\n");
    };
    return weightless() + ball(-distance / 2, speedA) + ball(distance / 2, -speedB);
}

void runHeadOn(Trial& trial) {
    Random random(familySeed);
    double missed = 0, error = 0;
    const int trials = trial.shortOrLong(500, 10'000);
    for (int i = 0; i < trials; ++i) {
        const double speedA = between(random, 10, 1e5), speedB = between(random, 10, 1e5);
        World world = trial.world(headOn(speedA, speedB, random.uniform(0.2, 2)));
        trial.run(world, 2 + static_cast<std::int64_t>(120 / (speedA + speedB)));
        const double a = world.state().velocity[0].x(), b = world.state().velocity[1].x();
        if (a > 0 || b < 0)
            ++missed;
        else
            error = std::max(error, std::max(std::abs(a + speedB), std::abs(b - speedA)) / (speedA + speedB));
        if (trial.stopped()) return;
    }
    trial.expectNone("missed", missed);
    trial.expect("speeds, error", error, {1e-6, 1e-9});
}

std::string headOnScene() { return headOn(1000, 1000, 1); }

/// A ball beside a rod that turns in the plane z = 0, at an angle [rad] and a distance from its centre [m].
std::string rodAndBall(double angle, double distance) {
    return weightless() + text("cuboid { size 1, 0.01, 0.01  mass 1  centre 0, 0, 0  angvel 0, 0, 1000 }\n",
                               "sphere { radius 0.01  mass 0.01  centre ",
                               Vec3(distance * std::cos(angle), distance * std::sin(angle), 0), " }\n");
}

// A frame is two and a half turns: it hits, within the first half turn.
void runRodAndBall(Trial& trial) {
    Random random(familySeed);
    double missed = 0;
    const int trials = trial.shortOrLong(200, 1000);
    for (int i = 0; i < trials; ++i) {
        const double angle = random.uniform(0.15, std::numbers::pi - 0.15);
        World world = trial.world(rodAndBall(angle, random.uniform(0.2, 0.48)));
        trial.run(world, 1);
        if (!(world.state().velocity[1].norm() > 1)) ++missed;
        if (trial.stopped()) return;
    }
    trial.expectNone("missed", missed);
}

std::string rodAndBallScene() { return rodAndBall(1, 0.4); }

} // namespace

extern const HardCase ballAtWallCase, headOnCase, rodAndBallCase;

constinit const HardCase ballAtWallCase = {
    .number = 33,
    .name = "ball_at_wall",
    .title = "a sphere of radius 0.05 m at a cuboid 0.1 to 1e-4 m thick, 10 to 1e5 m/s",
    .answer = "none passes through",
    .byDefault = "0",
    .accurate = "0",
    .aim = "0 in 1e6",
    .columns = steppingColumns,
    .declarations = ballAtWallScene,
    .run = runBallAtWall,
};

constinit const HardCase headOnCase = {
    .number = 34,
    .name = "head_on",
    .title = "two spheres of radius 0.05 m head on, 10 to 1e5 m/s",
    .answer = "all collide and exchange their speeds",
    .byDefault = "0 missed",
    .accurate = "0, speeds 1e-9",
    .aim = "0 in 1e6",
    .columns = everyColumn,
    .declarations = headOnScene,
    .run = runHeadOn,
};

constinit const HardCase rodAndBallCase = {
    .number = 35,
    .name = "rod_and_ball",
    .title = "a rod of 1 × 0.01 m turning at 1000 rad/s past a sphere of 0.02 m",
    .answer = "it hits",
    .byDefault = "0 of 1000 missed",
    .accurate = "0",
    .aim = "0 in 1e5",
    .columns = steppingColumns,
    .declarations = rodAndBallScene,
    .run = runRodAndBall,
};

} // namespace carom
