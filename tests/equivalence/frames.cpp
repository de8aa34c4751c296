// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/build.h"
#include "core/simulation/world.h"

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <string>

// Steps the scene on standard input: `frames WARMUP COUNTED`. A program of its own, small and without Qt, so
// that unused_test can have its instructions counted; only those of the COUNTED frames are.

namespace carom {

/// By this name the count begins and ends.
[[gnu::noinline]] void countedFrames(World& world, int frames) {
    for (int i = 0; i < frames; ++i) world.step();
}

} // namespace carom

int main(int count, char** words) {
    if (count != 3) return 2;
    const std::string text{std::istreambuf_iterator<char>(std::cin), {}};
    const carom::Build built = carom::build(text);
    if (!built.pipeline) return 1;
    carom::World world(built.pipeline);
    for (int i = std::atoi(words[1]); i > 0; --i) world.step();
    carom::countedFrames(world, std::atoi(words[2]));
    std::printf("%llx\n", static_cast<unsigned long long>(world.stateHash()));
    return world.health().finite ? 0 : 1;
}
