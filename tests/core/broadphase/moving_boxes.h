// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/broadphase/broadphase.h"
#include "core/math/random.h"

namespace carom {

/// Boxes in motion, for whoever wants to feed a broad-phase.
struct MovingBoxes {
    std::vector<Aabb> boxes;
    std::vector<BodyIndex> bodies;
    std::vector<std::uint8_t> mobile;

    BroadphaseInput input() const { return {boxes, bodies, mobile}; }
    void add(const Aabb& box, bool moves = true);
};

/// Points uniform in a cube about the origin.
Vec3 uniformIn(Random& random, double half);
void shift(Aabb& box, const Vec3& by);

/// The double loop over all boxes.
std::vector<BodyPair> obviousPairs(const BroadphaseInput& input);

/// One of several kinds of scene: alike, tiny and huge, touching on a lattice, coincident, flat, with
/// outliers; at scales from 1e-6 to 1e6, near the origin or far from it.
MovingBoxes randomScene(Random& random);

/// Small steps for most, none for resting ones; now and then everything is somewhere else.
void move(MovingBoxes& scene, Random& random);

} // namespace carom
