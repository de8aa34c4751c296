// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/scene.h"
#include "core/simulation/snapshot.h"
#include "core/simulation/touching.h"
#include "ui/viewport/line_pen.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

// What is drawn with lines: springs, and what can be shown over the bodies to explain them. Everything is
// lines in world coordinates; the labels' texts are the viewport's own.

namespace carom {

enum class Overlay : std::uint16_t {
    Axes = 1,       ///< the world's, at its origin: x red, y green, z blue
    Boxes = 2,      ///< what the broad-phase sees of each body
    Velocities = 4, ///< where each body would be after a tenth of a second, times the scale
    Contacts = 8,   ///< of touching pairs: the points, the normals and the forces
    Labels = 16,
    Pairs = 32,         ///< boxes that overlap, and a line from centre to centre of their bodies
    Structure = 64,     ///< the broad-phase's grid cells or tree nodes
    Trails = 128,       ///< the way each body has come lately
    CentreOfMass = 256, ///< of all mobile bodies
};

/// A velocity's arrow is the way of this time [s].
inline constexpr double velocityTime = 0.1;

/// A set of Overlay values, added up.
using Overlays = unsigned;

constexpr bool holds(Overlays overlays, Overlay one) { return (overlays & static_cast<unsigned>(one)) != 0; }

/// Another run of much the same scene, to compare with.
struct GhostState {
    const Scene* scene = nullptr; ///< null: none
    std::span<const Pose> poses;
};

/// A state as overlays see it.
struct OverlayState {
    const Scene& scene;
    std::span<const Pose> poses;
    std::span<const Vec3> velocities;               ///< [m/s]
    std::span<const TouchingPair> touching;         ///< needed for Contacts only
    std::span<const ContactForce> forces = {};      ///< likewise, where the method solves for them
    std::span<const BodyPair> overlapping;          ///< needed for Pairs only
    std::span<const Aabb> structure;                ///< needed for Structure only
    std::span<const std::vector<Vec3>> trails = {}; ///< needed for Trails only; positions, oldest first [m]
    GhostState ghost = {};                          ///< drawn where there is one
    BoxKind boxes = BoxKind::Tight;                 ///< that the broad-phase works on
    std::span<const BodyIndex> warned = {};         ///< drawn in the colour of warnings
    double size = 1;                                ///< of the scene [m]: axes are a quarter of it long
    double arrows = 1;          ///< how much longer the arrows of velocities and forces are than usual
    BodyIndex partner = noBody; ///< outlined as what the selected body met
};

/// Of the legend: colours as displayed, 0..1.
Vec3 colourOfVelocities();
Vec3 colourOfContacts();
Vec3 colourOfForces();

std::vector<LineVertex> overlayLines(Overlays overlays, const OverlayState& state);

} // namespace carom
