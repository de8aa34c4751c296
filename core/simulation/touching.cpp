// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/touching.h"

#include "core/narrowphase/narrowphase.h"

#include <algorithm>
#include <memory>

namespace carom {
namespace {

/// What a broad-phase is given, and holds while it looks.
struct PlacedBoxes {
    std::vector<Aabb> boxes;
    std::vector<std::uint8_t> mobile;

    PlacedBoxes(const Bodies& bodies, const std::vector<Pose>& poses) {
        for (const BodyIndex i : bodies.bounded) {
            boxes.push_back(bodies.boxAt(i, poses[i]));
            mobile.push_back(bodies.mobile[i]);
        }
    }
};

std::vector<BodyPair> overlapping(const Bodies& bodies, const PlacedBoxes& placed) {
    const BroadphaseInput input{placed.boxes, bodies.bounded, placed.mobile};
    const std::unique_ptr<Broadphase> search = chooseBroadphase(input).row->create();
    search->update(input);
    return {search->pairs().begin(), search->pairs().end()};
}

/// These and every mobile body with every wall, ascending.
std::vector<BodyPair> withWalls(const Bodies& bodies, std::vector<BodyPair> pairs) {
    for (const BodyIndex wall : bodies.walls)
        for (const BodyIndex body : bodies.mobileBodies)
            pairs.push_back({std::min(wall, body), std::max(wall, body)});
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

/// Pairs whose boxes overlap, and every mobile body with every wall.
std::vector<BodyPair> candidates(const Bodies& bodies, const State& state) {
    return withWalls(bodies, overlappingPairs(bodies, state.pose));
}

} // namespace

void updateAt(const Bodies& bodies, const std::vector<Pose>& poses, Broadphase& broadphase) {
    const PlacedBoxes placed(bodies, poses);
    broadphase.update({placed.boxes, bodies.bounded, placed.mobile});
}

std::vector<BodyPair> overlappingPairs(const Bodies& bodies, const std::vector<Pose>& poses) {
    return overlapping(bodies, PlacedBoxes(bodies, poses));
}

std::vector<BodyPair> pairsNear(const Bodies& bodies, const std::vector<Pose>& poses,
                                const std::vector<double>& margins) {
    PlacedBoxes placed(bodies, poses);
    for (std::size_t k = 0; k < placed.boxes.size(); ++k)
        placed.boxes[k] = grown(placed.boxes[k], margins[bodies.bounded[k]]);
    return withWalls(bodies, overlapping(bodies, placed));
}

void forEachTouchingPair(const Bodies& bodies, const State& state,
                         const std::function<bool(const TouchingPair&)>& take) {
    TouchingPair touching;
    for (const BodyPair pair : candidates(bodies, state)) {
        const PlacedShape a{&bodies.shape[pair.a], &state.pose[pair.a]};
        const PlacedShape b{&bodies.shape[pair.b], &state.pose[pair.b]};
        touching.pair = pair;
        if (collide(a, b, 0, touching.manifold) && !take(touching)) return;
    }
}

std::vector<TouchingPair> touchingPairs(const Bodies& bodies, const State& state) {
    std::vector<TouchingPair> result;
    forEachTouchingPair(bodies, state, [&](const TouchingPair& touching) {
        result.push_back(touching);
        return true;
    });
    return result;
}

} // namespace carom
