// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/scene_text.h"
#include "core/study/references.h"
#include "core/study/trial.h"

#include <algorithm>
#include <cmath>

// A ball on a floor: nothing is simpler to say, and most engines lose energy, or never bounce below 1 m/s.

namespace carom {
namespace {

std::string ballOver(double height, double radius, double elastic) {
    return text(levelFloor(0, 1), "sphere ball { radius ", radius, "  mass 1  centre ", Vec3(0, height, 0),
                "  elastic ", elastic, " }\n");
}

constexpr BodyIndex ball = 1;

std::string ballFromFiveMetres() { return falling() + ballOver(5, 0.1, 1); }

void runElasticBall(Trial& trial) {
    World world = trial.world(ballFromFiveMetres());
    const double start = energyOf(world);
    double worst = 0;
    trial.run(world, 1200, [&] { worst = std::max(worst, std::abs(energyOf(world) / start - 1)); });
    trial.expect("energy error", worst, {1e-5, 1e-12});
}

// A frame spans some hundred bounces; their number, and the time of the last one as the state at the end
// gives it, are compared with the closed form.
void runMillionBounces(Trial& trial) {
    const double frame = trial.shortOrLong(10.0, 1000.0);
    World world = trial.world(ballFromFiveMetres(), text("step ", frame));
    const reference::BouncingPoint point{4.9, standardFall, 1};
    const double end = point.impactTime(trial.shortOrLong(10'000, 1'000'000));
    const double start = energyOf(world) - standardFall * 0.1;
    double bounces = 0, worst = 0;
    trial.run(world, static_cast<std::int64_t>(std::ceil(end / frame)), [&] {
        bounces += static_cast<double>(world.statistics().contacts);
        worst = std::max(worst, std::abs((energyOf(world) - standardFall * 0.1) / start - 1));
    });
    const double time = world.state().time, flight = 2 * point.firstContact();
    const double expected = std::floor((time / flight) + 0.5);
    const double landing = standardFall * point.firstContact();
    const double sinceLast = (landing - world.state().velocity[ball].y()) / standardFall;
    trial.expect("energy error", worst, {1e-10, 1e-10});
    trial.expect("bounces amiss", std::abs(bounces - expected), {0, 0});
    trial.expect("time of the last bounce, error",
                 std::abs((time - sinceLast) / point.impactTime(static_cast<int>(expected)) - 1),
                 {1e-10, 1e-10});
}

/// How far the ball, of radius .5, is above the floor: its place with all digits that the world has of it.
double gapOf(const World& world) {
    return (world.state().pose[ball].position.y() - 0.5) + world.state().positionRest[ball].y();
}

// Energy measured from the floor, as gap and speed give it: its root is the speed at which the ball lands, so
// the rebound's height ratio is the energy's.
void runDropHeights(Trial& trial) {
    double worst = 0;
    for (double height = 1e-9; height < 2e3; height *= 10) {
        World world = trial.world(falling() + ballOver(0.5 + height, 0.5, 1));
        const double start = standardFall * gapOf(world);
        const double fall = std::sqrt(2 * height / standardFall);
        trial.run(world, 20 + static_cast<std::int64_t>(2.5 * fall * 60), [&] {
            const double gap = gapOf(world);
            const double speed = world.state().velocity[ball].y();
            const double energy = 0.5 * speed * speed + standardFall * gap;
            worst = std::max(worst, std::abs(energy / start - 1));
        });
    }
    trial.expect("rebound ratio, error", worst, {1e-3, 1e-9});
}

constexpr double g4 = 9.80665; ///< of case 4 [m/s²]

bool restsAtEnd(Trial& trial, double elastic, double end) {
    constexpr int frames = 4000;
    World world = trial.world(falling(g4) + ballOver(1.5, 0.5, elastic), text("step ", end / frames));
    trial.run(world, frames);
    return world.state().velocity[ball] == Vec3::Zero();
}

/// The way up and down until the flights are shorter than a frame, and from there the closed form of what
/// the state still has in it.
double pathOf(Trial& trial, double elastic) {
    World world = trial.world(falling(g4) + ballOver(1.5, 0.5, elastic));
    const double frame = world.pipeline().settings().step;
    double path = 0, gap = 1, speed = 0;
    while (trial.step(world)) {
        const double nextGap = gapOf(world);
        const double next = world.state().velocity[ball].y();
        const bool bounced = next > speed - g4 * frame * 0.5;
        const double apex = speed > 0 && (bounced || next < 0) ? 0.5 * speed * speed / g4 : 0;
        path += apex + (bounced ? gap + apex + nextGap : std::abs(nextGap - gap - apex));
        gap = nextGap;
        speed = next;
        const double landing = std::sqrt(speed * speed + 2 * g4 * gap);
        if (elastic * landing * 2 / g4 < 2 * frame) {
            // Down to the floor (over the apex where it rises), then the series of the bounces.
            const double rise = speed > 0 ? 0.5 * speed * speed / g4 : 0;
            const double e2 = elastic * elastic;
            return path + rise + rise + gap + landing * landing / g4 * e2 / (1 - e2);
        }
    }
    return path;
}

void runBouncesToRest(Trial& trial) {
    double late = 0, longer = 0;
    for (const double elastic : {0.5, 0.9, 0.99}) {
        const reference::BouncingPoint point{1, g4, elastic};
        // The narrowest bracket that holds: still moving before it, at rest behind it.
        double bracket = 1;
        for (int digits = 1; digits <= 12; ++digits) {
            const double part = std::pow(10.0, -digits);
            if (restsAtEnd(trial, elastic, point.restTime() * (1 - part)) ||
                !restsAtEnd(trial, elastic, point.restTime() * (1 + part)))
                break;
            bracket = part;
        }
        late = std::max(late, bracket);
        longer = std::max(longer, std::abs(pathOf(trial, elastic) / point.path() - 1));
    }
    trial.expect("time to rest, error", late, {1e-2, 1e-9});
    trial.expect("path, error", longer, {1e-2, 1e-9});
}

std::string bouncesToRestScene() { return falling(g4) + ballOver(1.5, 0.5, 0.9); }

std::string laidBall() { return falling() + ballOver(0.5, 0.5, 1); }

void runLaidBall(Trial& trial) {
    World world = trial.world(laidBall());
    const State start = world.state();
    double moved = 0;
    trial.run(world, trial.shortOrLong(20'000, 1'000'000), [&] {
        const bool still = world.state().pose[ball].position == start.pose[ball].position &&
                           world.state().velocity[ball] == start.velocity[ball];
        if (!still) ++moved;
    });
    trial.expectNone("frames in which a bit moved", moved);
}

} // namespace

extern const HardCase elasticBallCase, millionBouncesCase, dropHeightsCase, bouncesToRestCase, laidBallCase;

constinit const HardCase elasticBallCase = {
    .number = 1,
    .name = "elastic_ball",
    .title = "an elastic ball dropped from 5 m bounces for 20 s",
    .answer = "its energy is constant",
    .byDefault = "1e-5",
    .accurate = "1e-12",
    .aim = "1e-12 everywhere",
    .columns = everyColumn,
    .declarations = ballFromFiveMetres,
    .run = runElasticBall,
};

constinit const HardCase millionBouncesCase = {
    .number = 2,
    .name = "million_bounces",
    .title = "the elastic ball bounces a million times",
    .answer = "its energy is constant, and the number and times of the bounces are the closed form's",
    .byDefault = "–",
    .accurate = "1e-10",
    .aim = "1e-11",
    .columns = exactColumn,
    .declarations = ballFromFiveMetres,
    .run = runMillionBounces,
};

constinit const HardCase dropHeightsCase = {
    .number = 3,
    .name = "drop_heights",
    .title = "elastic drops from 1e-9 m to 1e3 m",
    .answer = "every rebound is as high as the drop",
    .byDefault = "1e-3",
    .accurate = "1e-9",
    .aim = "15 decades",
    .columns = everyColumn,
    .declarations = ballFromFiveMetres,
    .run = runDropHeights,
};

constinit const HardCase bouncesToRestCase = {
    .number = 4,
    .name = "bounces_to_rest",
    .title = "drops from 1 m with restitution .5, .9 and .99",
    .answer = "rest after t0 (1+e)/(1-e) and a path of h (1+e²)/(1-e²)",
    .byDefault = "rests, time 1 %",
    .accurate = "1e-9",
    .aim = "1e-9",
    .columns = everyColumn,
    .declarations = bouncesToRestScene,
    .run = runBouncesToRest,
};

constinit const HardCase laidBallCase = {
    .number = 5,
    .name = "laid_ball",
    .title = "an elastic sphere laid on a floor",
    .answer = "nothing moves",
    .byDefault = "0, bitwise",
    .accurate = "0, bitwise",
    .aim = "0, bitwise",
    .columns = everyColumn,
    .declarations = laidBall,
    .run = runLaidBall,
};

} // namespace carom
