// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/pool_rack.h"

#include <array>
#include <cmath>

// Many pool breaks on one plane. Each has a square of its own, large enough that none overlaps another at the
// start, and a random position and direction in it; the balls of different breaks meet later.

namespace carom {

GeneratorRow poolBreaksGenerator();

namespace poolBreaksScene {
namespace {

constexpr std::int64_t ballsPerBreak = 16;
/// Every ball of a break is within this of its centre, which lies halfway between the cue ball and the apex
/// [m]: the corner of the widest rack (jitter .005 m) is .79 m away.
constexpr double reach = 0.85;

constexpr std::array<GeneratorOption, 3> rackOptions = poolRackOptions(0.01);
constexpr std::array<GeneratorOption, 4> options = {{
    rackOptions[0],
    rackOptions[1],
    rackOptions[2],
    {.name = "spacing",
     .unit = "m",
     .defaultValue = 2.2,
     .minimum = 1.8,
     .maximum = 100,
     .help = "side of the square each break has to itself"},
}};

/// A random horizontal direction, drawn by rejection: no sine or cosine, whose last digit may differ.
Vec3 randomDirection(Random& random) {
    for (;;) {
        const double x = random.uniform(-1, 1);
        const double z = random.uniform(-1, 1);
        const double s = x * x + z * z;
        if (s > 0.01 && s <= 1) return Vec3(x, 0, z) / std::sqrt(s);
    }
}

std::string generatePoolBreaks(const GeneratorRequest& request) {
    const GeneratorRow row = poolBreaksGenerator();
    const std::int64_t breaks = countOf(row, request) / ballsPerBreak;
    const auto columns = static_cast<std::int64_t>(std::ceil(std::sqrt(static_cast<double>(breaks))));
    const double spacing = optionOf(row, request, "spacing");
    const double side = spacing * static_cast<double>(columns);
    PoolRack rack = rackFor(row, request);
    rack.labels = false;

    SceneWriter scene =
        sceneFor(row, request,
                 "Pool breaks: " + std::to_string(breaks) + " breaks of sixteen balls on one large table.",
                 "the time a frame takes as the number of balls grows. Detection has to find\n"
                 "the few pairs that meet among the many that cannot.");
    scene.camera(toMillionths(Vec3(0, 0.55 * side, 0.75 * side)), {0, 0, 0}, 50);
    writePoolTable(scene, rack.speed);
    for (std::int64_t i = 0; i < breaks; ++i) {
        Random random(request.seed, static_cast<std::uint64_t>(i)); // a stream each: more breaks change none
        rack.direction = randomDirection(random);
        const double freedom = spacing / 2 - reach;
        const double x = (static_cast<double>(i % columns) + 0.5) * spacing - side / 2;
        const double z = (static_cast<double>(i / columns) + 0.5) * spacing - side / 2;
        const Vec3 centre(x + random.uniform(-freedom, freedom), 0, z + random.uniform(-freedom, freedom));
        rack.apex = centre + rack.cueDistance / 2 * rack.direction;
        scene.blankLine();
        writePoolRack(scene, rack, random);
    }
    return scene.take();
}

} // namespace
} // namespace poolBreaksScene

GeneratorRow poolBreaksGenerator() {
    using namespace poolBreaksScene;
    return {.name = "pool_breaks",
            .help = "N/16 pool breaks on one large table (N balls, whole racks)",
            .defaultN = 160,
            .minimumN = ballsPerBreak,
            .maximumN = 10'000'000,
            .options = options,
            .generate = generatePoolBreaks};
}

} // namespace carom
