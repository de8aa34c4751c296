// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/build.h"
#include "core/simulation/world.h"

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include <valgrind/callgrind.h>

// Steps the scenes on standard input, which a line of `====` parts: `frames WARMUP COUNTED`. A program of its
// own, small and without Qt, so that unused_test can have its instructions counted; only those of the COUNTED
// frames are. Until all scenes have come so far valgrind runs the program without counting, in a tenth of the
// time.

namespace carom {

/// By this name the count begins and ends.
[[gnu::noinline]] void countedFrames(World& world, int frames) {
    for (int i = 0; i < frames; ++i) world.step();
}

} // namespace carom

int main(int count, char** words) {
    if (count != 3) return 2;
    std::vector<carom::World> worlds;
    for (std::string line; std::cin;) {
        std::string text;
        while (std::getline(std::cin, line) && line != "====") text += line + '\n';
        if (text.empty()) break;
        worlds.emplace_back(carom::build(text).pipeline);
        for (int i = std::atoi(words[1]); i > 0; --i) worlds.back().step();
    }
    CALLGRIND_START_INSTRUMENTATION;
    for (carom::World& world : worlds) {
        carom::countedFrames(world, std::atoi(words[2]));
        if (!world.health().finite) return 1;
        std::printf("%llx\n", static_cast<unsigned long long>(world.stateHash()));
    }
    return 0;
}
