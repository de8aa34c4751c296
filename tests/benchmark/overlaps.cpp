// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmark/overlaps.h"

#include "core/narrowphase/narrowphase.h"
#include "core/simulation/touching.h"

#include <limits>

namespace carom {
namespace {

double halfThicknessOfThinner(const Bodies& bodies, const BodyPair& pair) {
    double least = std::numeric_limits<double>::max();
    for (const BodyIndex i : {pair.a, pair.b})
        if (!isWall(bodies.shape[i])) least = std::min(least, halfThicknessOf(bodies.shape[i]));
    return least;
}

} // namespace

Overlaps overlapsAt(const Bodies& bodies, const State& state) {
    Overlaps overlaps;
    const auto measure = [&](const BodyPair& pair) {
        const double distance = proximityOf({&bodies.shape[pair.a], &state.pose[pair.a]},
                                            {&bodies.shape[pair.b], &state.pose[pair.b]})
                                    .distance;
        if (!(distance < 0)) return;
        const double overlap = -distance / halfThicknessOfThinner(bodies, pair);
        overlaps.sum += overlap;
        ++overlaps.pairs;
        overlaps.largest = std::max(overlaps.largest, overlap);
    };
    for (const BodyPair pair : overlappingPairs(bodies, state.pose)) measure(pair);
    for (const BodyIndex wall : bodies.walls)
        for (const BodyIndex body : bodies.mobileBodies) measure({wall, body});
    return overlaps;
}

} // namespace carom
