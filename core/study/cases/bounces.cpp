// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/members.h"
#include "core/study/cases/scene_text.h"
#include "core/study/references.h"
#include "core/study/trial.h"

#include <algorithm>
#include <cmath>

// Drops from 1 m: how narrowly the time of rest is bracketed, and the length of the path. A scene has one
// step, so that the end of a frame cannot be near the time of rest of three balls that fall from the same
// height.

namespace carom {
namespace {

std::string ballOver(double height, double radius, double elastic) {
    return text(levelFloor(0, 1), "sphere ball { radius ", radius, "  mass 1  centre ", Vec3(0, height, 0),
                "  elastic ", elastic, " }\n");
}

constexpr BodyIndex theBall = 1;

/// How far the ball, of radius .5, is above the floor: its place with all digits that the world has of it.
double gapOf(const World& world) {
    return (world.state().pose[theBall].position.y() - 0.5) + world.state().positionRest[theBall].y();
}

constexpr double g4 = 9.80665; ///< of case 4 [m/s²]

bool restsAtEnd(Trial& trial, double elastic, double end) {
    constexpr int frames = 4000;
    World world = trial.world(falling(g4) + ballOver(1.5, 0.5, elastic), text("step ", end / frames));
    trial.run(world, frames);
    return world.state().velocity[theBall] == Vec3::Zero();
}

/// The way up and down until the bounces are shorter than a frame, and from there the closed form of what
/// the state still has in it [m].
double pathOf(Trial& trial, double elastic) {
    World world = trial.world(falling(g4) + ballOver(1.5, 0.5, elastic));
    const double frame = world.pipeline().settings().step;
    double path = 0, gap = 1, speed = 0;
    while (trial.step(world)) {
        const double nextGap = gapOf(world);
        const double next = world.state().velocity[theBall].y();
        const bool bounced = next > speed - g4 * frame * 0.5;
        const double apex = speed > 0 && (bounced || next < 0) ? 0.5 * speed * speed / g4 : 0;
        path += apex + (bounced ? gap + apex + nextGap : std::abs(nextGap - gap - apex));
        gap = nextGap;
        speed = next;
        const double impact = std::sqrt(speed * speed + 2 * g4 * gap);
        if (elastic * impact * 2 / g4 < 2 * frame) {
            // Down to the floor (over the apex where it rises), then the series of the bounces.
            const double rise = speed > 0 ? 0.5 * speed * speed / g4 : 0;
            const double e2 = elastic * elastic;
            return path + rise + rise + gap + impact * impact / g4 * e2 / (1 - e2);
        }
    }
    return path;
}

} // namespace

void askBouncesToRest(Trial& trial) {
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
    trial.expect("from 1 m, time to rest, error", late, {1e-2, 1e-9});
    trial.expect("from 1 m, path, error", longer, {1e-2, 1e-9});
}

} // namespace carom
