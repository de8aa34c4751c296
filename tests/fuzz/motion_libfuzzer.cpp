// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/motion.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>

// The entry point libFuzzer calls. One execution is one method on a small scene, for as long as something
// touches: many cheap executions reach more than few dear ones, and what makes a frame long is more of the
// same bodies, contacts and iterations. Large scenes and all twenty frames are motion_fuzz's.
// The first byte says what is done with the text behind it:
//
//     byte        0    1    2    3    4    5    6 ...      as '0', '1', '2', ... in the seeds
//     method      1st  2nd  3rd  1st  2nd  3rd  1st ...    (of three)
//     checkpoint  no   no   no   yes  yes  yes  no ...
//
// After these six come six with bodies as fast as the text says, which may take half a second, and so on.

namespace {
constexpr carom::test::MotionLimits smallScene{
    .bodies = 4, .sizesAFrame = 1e3, .operations = 1e5, .quietFrames = 5, .comparesCheckpoint = false};
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::span<const carom::SolverRow> methods = carom::solvers();
    carom::test::MotionLimits limits = smallScene;
    limits.comparesCheckpoint = data[0] / methods.size() % 2 == 1;
    if (data[0] / methods.size() % 4 >= 2) limits.sizesAFrame = carom::test::MotionLimits().sizesAFrame;
    const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
    const std::string broken = carom::test::brokenMotion(text, methods[data[0] % methods.size()], limits);
    if (!broken.empty()) {
        std::fprintf(stderr, "%s\n", broken.c_str());
        std::abort();
    }
    return 0;
}
