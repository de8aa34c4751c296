// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/members.h"
#include "core/study/cases/scene_text.h"
#include "core/study/trial.h"

#include <array>

// Many bodies with one centre: whether a second run is the same to the bit, and, in the long form, more of
// them than a readable scene can hold.

namespace carom {
namespace {

constexpr std::array<std::string_view, 3> shapes = {"sphere { radius 0.5", "cuboid { size 1, 1, 1",
                                                    "cylinder { radius 0.5  height 1  axis 0, 1, 0"};

std::string oneCentre(std::string_view shape, int count) {
    std::string scene = weightless();
    for (int i = 0; i < count; ++i)
        scene += text(shape, "  mass 1  centre 0, 0, 0  friction 0.5  elastic 0.5 }\n");
    return scene;
}

} // namespace

void askOneCentre(Trial& trial) {
    double lost = 0, unlike = 0;
    const int most = trial.shortOrLong(10, 100);
    for (const std::string_view shape : shapes)
        for (const int count : {2, 3, 5, 10, 30, 100}) {
            if (count > most) continue;
            World world = trial.world(oneCentre(shape, count)), again = trial.world(oneCentre(shape, count));
            for (int frame = 0; frame < 60 && trial.step(world) && trial.step(again);) ++frame;
            if (!world.health().finite) ++lost;
            if (world.stateHash() != again.stateHash()) ++unlike;
        }
    trial.expectNone("runs that lost their state", lost);
    trial.expectNone("runs that differ from their repetition", unlike);
}

} // namespace carom
