// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/broadphase/broadphase.h"

#include "core/broadphase/crowding.h"

#include "core/base/figures.h"

#include <algorithm>

// What `auto` goes by. Measured at 8 to 100,000 spheres of several size distributions, at rest, at 0.3 and at
// 3 m/s: below 64 boxes all pairs is as fast as anything; at rest or in slow motion the bounding tree is 5 to
// 30 times faster than the others; in a fast gas the grid is 2.5 times faster than the tree, unless sizes
// differ much, and up to some 1,500 boxes the single-axis sweep is a little faster still. The boxes of one
// frame do not tell how fast it goes, but bodies that lie close to each other cannot go far.

namespace carom {
namespace {

// At twice or half of a limit the scenes in between take longer, by the factors above; the pairs are the
// same.
constexpr std::size_t fewBoxes = 64;     // below: all pairs
constexpr std::size_t smallScene = 1500; // boxes; below: one sweep rather than the grid
constexpr double manySizes = 4;          // 95th over 5th percentile of the widths; above: the tree
constexpr double lyingClose = 1;         // overlapping pairs of boxes for each box; above: the tree

double widthRatio(std::span<const Aabb> boxes) {
    std::vector<double> widths;
    widths.reserve(boxes.size());
    for (const Aabb& box : boxes) widths.push_back(box.size().maxCoeff());
    std::sort(widths.begin(), widths.end());
    const double narrow = widths[widths.size() / 20], wide = widths[widths.size() - 1 - widths.size() / 20];
    return wide <= narrow ? 1 : wide / narrow;
}

/// The sentence begins with the name.
BroadphaseChoice chosen(Sentence why) { return {findBroadphase(why.values.front()), why}; }

} // namespace

BroadphaseChoice chooseBroadphase(const BroadphaseInput& input) {
    const std::size_t count = input.boxes.size();
    const std::string bodies = std::to_string(count);
    if (count == 1)
        return chosen(Sentence{"%1: %2 body, too few to be worth sorting", {"all_pairs", bodies}});
    if (count < fewBoxes)
        return chosen(Sentence{"%1: %2 bodies, too few to be worth sorting", {"all_pairs", bodies}});

    const std::size_t mobile = static_cast<std::size_t>(std::count_if(
        input.mobile.begin(), input.mobile.end(), [](std::uint8_t moves) { return moves != 0; }));
    if (mobile < count / 2)
        return chosen(Sentence{"%1: %2 bodies, of which only %3 can move",
                               {"bounding_tree", bodies, std::to_string(mobile)}});
    const double ratio = widthRatio(input.boxes);
    if (ratio > manySizes)
        return chosen(Sentence{"%1: %2 bodies, the wide ones %3 times the narrow ones",
                               {"bounding_tree", bodies, figure(ratio, 2)}});
    const double close = 0.5 * neighboursPerBox(input.boxes); // a pair has two ends
    if (close > lyingClose)
        return chosen(Sentence{"%1: %2 bodies lying close: %3 overlapping boxes for each",
                               {"bounding_tree", bodies, figure(close, 2)}});
    if (count < smallScene)
        return chosen(Sentence{"%1: %2 bodies of similar size, well apart, few enough for one sweep",
                               {"single_axis_sweep", bodies}});
    return chosen(Sentence{"%1: %2 bodies of similar size, well apart", {"uniform_grid", bodies}});
}

} // namespace carom
