// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/pool_rack.h"

#include <array>

namespace carom {

GeneratorRow poolBreakGenerator();

namespace poolBreakScene {
namespace {

constexpr std::array<GeneratorOption, 3> options = poolRackOptions(0.05);

std::string generatePoolBreak(const GeneratorRequest& request) {
    const GeneratorRow row = poolBreakGenerator();
    const PoolRack rack = rackFor(row, request);

    SceneWriter scene = sceneFor(
        row, request, "Pool break: the opening shot of a game of pool.",
        "the white ball scatters the triangle. How depends on the last hundredth of a\n"
        "millimetre: another seed, another break. The front ball hops a little, because the white ball is\n"
        "smaller and meets it below its middle.");
    scene.camera({0.4, 0.42, 1.45}, {-0.03, 0, 0.34}, 38);
    writePoolTable(scene, rack.speed);
    scene.blankLine();
    Random random(request.seed);
    writePoolRack(scene, rack, random);
    return scene.take();
}

} // namespace
} // namespace poolBreakScene

GeneratorRow poolBreakGenerator() {
    using namespace poolBreakScene;
    return {.name = "pool_break",
            .help = "the opening shot of a game of pool: fifteen racked balls and the cue ball",
            .options = options,
            .generate = generatePoolBreak};
}

} // namespace carom
