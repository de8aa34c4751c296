// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/viewport/camera.h"
#include "ui/viewport/room.h"
#include "ui/viewport/view_theme.h"

#include <array>

// The lights, the part of the scene that the shadow map sees, and everything of it that shaders need: figures
// only, no OpenGL.

namespace carom {

/// Texels along a side; at half edges are coarser, at twice 4 times the time.
inline constexpr int shadowMapSize = 1024;

/// Everything a picture needs besides the scene.
struct PictureOptions {
    PictureSize size; ///< device pixels
    Camera camera;
    ViewTheme theme;
    BodyIndex selected = noBody;
    bool dimmed = false;
    bool shadows = true;
    double lineWidth = 2; ///< of wide lines and marks [device pixels]
    bool smooth = false;  ///< several samples a pixel, for the edges of meshes: spheres are smooth without
};

/// Towards the first light, a unit vector; it stands over the left shoulder of the usual camera.
Vec3 keyDirection();
/// The first light as an orthographic camera at the origin.
Camera lightCamera();

/// What the shadow map sees: a box in the light's coordinates.
struct ShadowView {
    Camera camera;
    PictureSize size; ///< [texels]; its height is the map's, its width keeps texels square
    Mat4 clipFromWorld = Mat4::Identity();
    double texel = 0;          ///< the longer side of one [m]
    std::array<Wall, 4> sides; ///< around what it sees, normals inward
};

/// As little as holds the bodies (`lightBounds`, in the light's coordinates) that are near what the camera
/// looks at: a ball that flew away must not take the texels from all others.
ShadowView shadowView(const Aabb& lightBounds, const Camera& camera, const Room& room);

/// Mirrors the block of resources/shaders/frame.glsl (std140: matrices and vectors of four only).
struct FrameUniforms {
    Eigen::Matrix4f clipFromWorld, shadowFromWorld;
    Eigen::Vector4f eye, forward, up, keyDirection, keyColour, fillDirection, fillColour;
    Eigen::Vector4f skyTop, skyHorizon, ground, floorTint, roomCentre, picture;
    Eigen::Vector4f lightAbove, lightBelow, mirrorTop, mirrorHorizon, mirrorGround;
};
static_assert(sizeof(FrameUniforms) == 2 * 64 + 18 * 16);

/// For the picture of `options`, or for the shadow map where options carry the light's camera and size.
FrameUniforms frameUniforms(const PictureOptions& options, const Mat4& clipFromWorld,
                            const ShadowView& shadow, const Room& room);

} // namespace carom
