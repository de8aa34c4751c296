// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/broadphase/broadphase.h"

namespace carom {
namespace {

// Below this many boxes comparing all pairs costs less than keeping any order (about 2 microseconds).
constexpr std::size_t fewBoxes = 32;

} // namespace

BroadphaseChoice chooseBroadphase(const BroadphaseInput& input) {
    const std::string bodies =
        input.boxes.size() == 1 ? "1 body" : std::to_string(input.boxes.size()) + " bodies";
    if (input.boxes.size() < fewBoxes)
        return {findBroadphase("all_pairs"), "all_pairs: " + bodies + ", too few to be worth sorting"};
    return {findBroadphase("sweep_and_sort"),
            "sweep_and_sort: " + bodies + ", and frames that resemble each other"};
}

} // namespace carom
