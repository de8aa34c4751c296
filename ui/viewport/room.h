// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/aabb.h"
#include "core/scene/scene.h"
#include "ui/viewport/camera.h"

#include <vector>

// Walls are half-spaces without end; what can be shown of them are the faces of the free space between them.
// Each wall's plane starts as a large square around the scene and is cut by every other wall, so that four
// walls and a floor are seen as the box they enclose.

namespace carom {

struct RoomFace {
    BodyIndex body = noBody;
    Wall wall;
    std::vector<Vec3> polygon; ///< convex, at least three corners [m], counter-clockwise from the free side
};

struct Room {
    std::vector<RoomFace> faces; ///< walls of which nothing borders free space have none
    Vec3 centre = Vec3::Zero();  ///< of the bodies [m]
    double extent = 1;           ///< an unbounded face has faded away at this distance from the centre [m]
};

/// `around`: the box of all bounded bodies, or any box where there are none.
Room roomOf(const Scene& scene, const Aabb& around);

/// The part of a convex polygon on the free side of a wall, or up to `tolerance` [m] behind it (Sutherland
/// and Hodgman's clipping by one plane).
std::vector<Vec3> cut(const std::vector<Vec3>& polygon, const Wall& wall, double tolerance = 0);

/// Distance along the ray to the nearest face seen from its free side, and its body.
struct FaceHit {
    BodyIndex body = noBody;
    double distance = 0; ///< [m]
};
FaceHit firstFace(const Room& room, const Ray& ray);

} // namespace carom
