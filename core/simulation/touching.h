// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/broadphase/broadphase.h"
#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"
#include "core/math/pose.h"
#include "core/shapes/manifold.h"

#include <functional>
#include <vector>

namespace carom {

struct TouchingPair {
    BodyPair pair;
    Manifold manifold; ///< A is pair.a; world coordinates
};

/// Gives a broad-phase the boxes of the bodies at these poses.
void updateAt(const Bodies& bodies, const std::vector<Pose>& poses, Broadphase& broadphase);

/// Every pair of which at least one body is mobile whose boxes overlap, ascending; walls have no box.
std::vector<BodyPair> overlappingPairs(const Bodies& bodies, const std::vector<Pose>& poses);

/// Every pair of which at least one body is mobile whose boxes overlap at these poses when each is grown by
/// the margin of its body [m], and every mobile body with every wall, ascending.
std::vector<BodyPair> pairsNear(const Bodies& bodies, const std::vector<Pose>& poses,
                                const std::vector<double>& margins);

/// Hands over every pair of which at least one body is mobile whose distance is at most 0, ascending, with
/// its contact points, until `take` returns false. For reports and pictures of one state; a run keeps its
/// own.
void forEachTouchingPair(const Bodies& bodies, const State& state,
                         const std::function<bool(const TouchingPair&)>& take);
/// The same as a list, which takes some 500 bytes a pair.
std::vector<TouchingPair> touchingPairs(const Bodies& bodies, const State& state);

} // namespace carom
