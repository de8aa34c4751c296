// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/scene.h"
#include "core/simulation/touching.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

// What can be drawn over the bodies to explain them. Everything is lines in world coordinates; the labels'
// texts are the viewport's own.

namespace carom {

enum class Overlay : std::uint8_t {
    Axes = 1,       ///< the world's, at its origin: x red, y green, z blue
    Boxes = 2,      ///< what the broad-phase sees of each body
    Velocities = 4, ///< where each body would be after a tenth of a second
    Contacts = 8,   ///< touching pairs: the points, and the normal as long as a ball is thick
    Labels = 16,
    Pairs = 32,     ///< boxes that overlap, and a line from centre to centre of their bodies
    Structure = 64, ///< the broad-phase's grid cells or tree nodes
};

/// A set of Overlay values, added up.
using Overlays = unsigned;

constexpr bool holds(Overlays overlays, Overlay one) { return (overlays & static_cast<unsigned>(one)) != 0; }

/// Two in a row make a line.
struct LineVertex {
    float position[3]; ///< [m]
    float colour[3];   ///< as displayed, 0..1
};

/// A state as overlays see it.
struct OverlayState {
    const Scene& scene;
    std::span<const Pose> poses;
    std::span<const Vec3> velocities;       ///< [m/s]
    std::span<const TouchingPair> touching; ///< needed for Contacts only
    std::span<const BodyPair> overlapping;  ///< needed for Pairs only
    std::span<const Aabb> structure;        ///< needed for Structure only
    double size = 1;                        ///< of the scene [m]: axes are a quarter of it long
};

std::vector<LineVertex> overlayLines(Overlays overlays, const OverlayState& state);

} // namespace carom
