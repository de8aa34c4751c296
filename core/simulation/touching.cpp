// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/touching.h"

#include "core/broadphase/broadphase.h"
#include "core/narrowphase/narrowphase.h"

#include <algorithm>

namespace carom {
namespace {

/// Pairs whose boxes overlap, and every mobile body with every wall.
std::vector<BodyPair> candidates(const Bodies& bodies, const State& state) {
    std::vector<Aabb> boxes;
    std::vector<std::uint8_t> mobile;
    for (const BodyIndex i : bodies.bounded) {
        boxes.push_back(boundsOf(bodies.shape[i], state.pose[i]));
        mobile.push_back(bodies.mobile[i]);
    }
    const BroadphaseInput input{boxes, bodies.bounded, mobile};
    const std::unique_ptr<Broadphase> search = chooseBroadphase(input).row->create();
    search->update(input);
    std::vector<BodyPair> pairs(search->pairs().begin(), search->pairs().end());
    for (const BodyIndex wall : bodies.walls)
        for (const BodyIndex body : bodies.mobileBodies)
            pairs.push_back({std::min(wall, body), std::max(wall, body)});
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

} // namespace

std::vector<TouchingPair> touchingPairs(const Bodies& bodies, const State& state) {
    std::vector<TouchingPair> result;
    Manifold manifold;
    for (const BodyPair pair : candidates(bodies, state)) {
        const PlacedShape a{&bodies.shape[pair.a], &state.pose[pair.a]};
        const PlacedShape b{&bodies.shape[pair.b], &state.pose[pair.b]};
        if (collide(a, b, 0, manifold)) result.push_back({pair, manifold});
    }
    return result;
}

} // namespace carom
