// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/pool_rack.h"
#include "core/generators/request.h"

#include <array>

namespace carom {

GeneratorRow poolBreakGenerator();

namespace {

constexpr std::array<GeneratorOption, 3> options = {{
    {.name = "jitter",
     .unit = "m",
     .defaultValue = 2e-5,
     .minimum = 0,
     .maximum = 0.005,
     .help = "standard deviation of each racked ball's place"},
    {.name = "aim",
     .unit = "m",
     .defaultValue = 0.002,
     .minimum = 0,
     .maximum = 0.05,
     .help = "standard deviation of the cue ball's place across the table"},
    {.name = "speed",
     .unit = "m/s",
     .defaultValue = 8,
     .minimum = 0.1,
     .maximum = 30,
     .help = "speed of the cue ball"},
}};

std::string generatePoolBreak(const GeneratorRequest& request) {
    const GeneratorRow row = poolBreakGenerator();
    PoolRack rack;
    rack.jitter = optionOf(row, request, "jitter");
    rack.aim = optionOf(row, request, "aim");
    rack.speed = optionOf(row, request, "speed");

    SceneWriter scene;
    scene.comment(
        "Pool break: the opening shot of a game of pool.\n" + commandOf(row, request) +
        "\n\n"
        "What to look for: the white ball scatters the triangle. How depends on the last hundredth of a\n"
        "millimetre: another seed, another break. The front ball hops a little, because the white ball is\n"
        "smaller and meets it below its middle.");
    scene.blankLine();
    scene.camera({0.4, 0.42, 1.45}, {-0.03, 0, 0.34}, 38);
    writePoolTable(scene, rack.speed);
    scene.blankLine();
    Random random(request.seed);
    writePoolRack(scene, rack, random);
    return scene.take();
}

} // namespace

GeneratorRow poolBreakGenerator() {
    return {.name = "pool_break",
            .help = "the opening shot of a game of pool: fifteen racked balls and the cue ball",
            .options = options,
            .generate = generatePoolBreak};
}

} // namespace carom
