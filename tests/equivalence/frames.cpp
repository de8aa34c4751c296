// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/build.h"
#include "core/simulation/world.h"

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>

// Steps the scenes on standard input, which a line of `====` parts: `frames WARMUP COUNTED`. A program of its
// own, small and without Qt, so that unused_test can have its instructions counted; only those of the COUNTED
// frames are.

namespace carom {

/// By this name the count begins and ends.
[[gnu::noinline]] void countedFrames(World& world, int frames) {
    for (int i = 0; i < frames; ++i) world.step();
}

} // namespace carom

int main(int count, char** words) {
    if (count != 3) return 2;
    for (std::string line; std::cin;) {
        std::string text;
        while (std::getline(std::cin, line) && line != "====") text += line + '\n';
        if (text.empty()) break;
        carom::World world(carom::build(text).pipeline);
        for (int i = std::atoi(words[1]); i > 0; --i) world.step();
        carom::countedFrames(world, std::atoi(words[2]));
        if (!world.health().finite) return 1;
        std::printf("%llx\n", static_cast<unsigned long long>(world.stateHash()));
    }
    return 0;
}
