// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/generated.h"
#include "core/study/cases/scene_text.h"
#include "core/study/trial.h"

#include "core/simulation/touching.h"

#include <algorithm>
#include <cmath>
#include <vector>

// What falls over: a row of dominoes, which must not care how large they are, and a dry-stone wall, which may
// lose energy but never gain it.

namespace carom {
namespace {

std::string dominoRow(std::int64_t count, double size) {
    return generated("dominoes", {.n = count, .options = {{"size", size}, {"speed", 0.3 * std::sqrt(size)}}});
}

constexpr double dominoHeight = 0.048; ///< at size 1 [m]

/// Cosine of a body's lean.
double uprightness(const World& world, BodyIndex i) {
    return world.state().pose[i].directionToWorld(Vec3::UnitY()).y();
}

struct Wave {
    double speed = NAN;  ///< over the middle half, in sqrt(g h)
    double standing = 0; ///< dominoes that have not fallen by the end
};

// A domino has been reached when it leans by 5°; the moment is interpolated between frames.
Wave waveOf(Trial& trial, std::int64_t count, double size) {
    World world = trial.world(dominoRow(count, size));
    const std::vector<BodyIndex>& mobile = world.pipeline().bodies().mobileBodies; // the first one pushes
    const auto n = static_cast<std::size_t>(count);
    constexpr double reached = 0.99619469809174555; // cos 5°
    constexpr double fallen = 0.7;
    std::vector<double> when(n, NAN), before(n, 1);
    const double fallTime = std::sqrt(size) * (1 + 0.03 * static_cast<double>(count));
    const auto frames = static_cast<std::int64_t>(fallTime * 60);
    Wave wave{.standing = static_cast<double>(count)};
    // None that has fallen stands up again, and what lies in a heap takes most of the time.
    for (std::int64_t frame = 0; frame < frames && wave.standing > 0 && trial.step(world); ++frame) {
        wave.standing = 0;
        for (std::size_t k = 0; k < n; ++k) {
            const double now = uprightness(world, mobile[k + 1]);
            if (std::isnan(when[k]) && now < reached)
                when[k] = world.state().time -
                          world.pipeline().settings().step * (reached - now) / (before[k] - now);
            before[k] = now;
            if (!(now < fallen)) ++wave.standing;
        }
    }
    const std::size_t from = n / 4, to = 3 * n / 4;
    const double way = static_cast<double>(to - from) * 0.024 * size;
    wave.speed = way / (when[to] - when[from]) / std::sqrt(9.8 * dominoHeight * size);
    return wave;
}

/// States that differ in a bit when lengths are four times and times twice as large.
double scaledDifferences(Trial& trial, std::int64_t count) {
    World common = trial.world(dominoRow(count, 1), "step 0.015625");
    World large = trial.world(dominoRow(count, 4), "step 0.03125");
    double differing = 0;
    for (int frame = 0; frame < 40 && trial.step(common) && trial.step(large); ++frame)
        for (const BodyIndex i : common.pipeline().bodies().mobileBodies)
            if (common.state().pose[i].position * 4 != large.state().pose[i].position ||
                common.state().pose[i].orientation.coeffs() != large.state().pose[i].orientation.coeffs())
                ++differing;
    return differing;
}

void runDominoes(Trial& trial) {
    const std::int64_t count = trial.shortOrLong(trial.byDefault() ? 12 : 4, 200);
    const Wave common = waveOf(trial, count, 1), large = waveOf(trial, count, 10);
    trial.expectNone("standing at the end", common.standing + large.standing);
    trial.expect("speed of the wave at size 10 against size 1", std::abs(large.speed / common.speed - 1),
                 {0.05, 0.05});
    if (!trial.byDefault())
        trial.expectNone("bits that differ at four times the size",
                         scaledDifferences(trial, trial.shortOrLong(4, 20)));
}

std::string dominoScene() { return dominoRow(200, 1); }

std::string stoneWall(std::int64_t stones) { return generated("stone_wall", {.n = stones, .options = {}}); }
std::string stoneWallScene() { return stoneWall(30); }

void runStoneWall(Trial& trial) {
    World world = trial.world(stoneWall(trial.shortOrLong(6, 30)));
    const double start = world.statistics().kinetic;
    double least = energyOf(world), growth = 0;
    trial.run(world, trial.shortOrLong(trial.byDefault() ? 60 : 20, 1200), [&] {
        growth = std::max(growth, energyOf(world) - least);
        least = std::min(least, energyOf(world));
    });
    double deepest = world.health().finite ? 0 : NAN;
    for (const TouchingPair& touching : touchingPairs(world.pipeline().bodies(), world.state()))
        deepest = std::max(deepest, -touching.manifold.deepest().separation);
    constexpr double course = 0.2; // height of a stone [m]
    trial.expect("energy gained between frames, of the blow's", growth / start, {1e-6, 1e-9});
    trial.expect("overlap in the end, of a stone's height", deepest / course, {1e-2, 1e-3});
}

} // namespace

extern const HardCase dominoCase, stoneWallCase;

constinit const HardCase dominoCase = {
    .number = 31,
    .name = "dominoes",
    .title = "a row of 200 dominoes of 48 × 24 × 7.5 mm, pitch 24 mm, and ten times as large",
    .answer = "all fall, and v/√(g h) is the same at both sizes",
    .byDefault = "5 % apart with the step kept",
    .accurate = "bitwise under 4× length, 2× time",
    .aim = "within 10 % of published speeds",
    .columns = steppingColumns,
    .declarations = dominoScene,
    .run = runDominoes,
};

constinit const HardCase stoneWallCase = {
    .number = 32,
    .name = "stone_wall",
    .title = "a dry-stone wall hit by a heavy sphere",
    .answer = "it topples, and the energy never grows",
    .byDefault = "overlap after rest 1 %",
    .accurate = "1e-3",
    .aim = "1e-3",
    .columns = steppingColumns,
    .declarations = stoneWallScene,
    .run = runStoneWall,
};

} // namespace carom
