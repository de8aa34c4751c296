// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/touching.h"
#include "core/simulation/world.h"
#include "core/study/cases/scene_text.h"

#include <algorithm>

namespace carom::test {

/// How deep two bodies are in each other at most [m].
inline double deepestOverlap(const World& world) {
    double deepest = 0;
    for (const TouchingPair& pair : touchingPairs(world.pipeline().bodies(), world.state()))
        deepest = std::max(deepest, -pair.manifold.deepest().separation);
    return deepest;
}

/// What must stay small in a scene that nothing drives.
struct WorstOfRun {
    double overlap = 0; ///< [m]
    double gained = 0;  ///< the largest rise of the energy, of the energy at the start

    void include(const WorstOfRun& other) {
        overlap = std::max(overlap, other.overlap);
        gained = std::max(gained, other.gained);
    }
};
inline WorstOfRun worstOf(World& world, int frames) {
    WorstOfRun worst;
    const double start = energyOf(world);
    double least = start;
    for (int i = 0; i < frames; ++i) {
        world.step();
        const double now = energyOf(world);
        worst.include({deepestOverlap(world), (now - least) / start});
        least = std::min(least, now);
    }
    return worst;
}

} // namespace carom::test
