// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/pipeline.h"
#include "core/simulation/snapshot.h"
#include "ui/viewport/camera.h"

#include <QRgb>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>

// Scenes for tests that look at pixels, and what to ask of a pixel.

namespace carom::test {

inline constexpr int side = 360; ///< of the picture [px]
inline constexpr PictureSize picture{side, side};
inline const Vec3 red(1, 0, 0), green(0, 1, 0), blue(0, 0, 1);

inline Body coloured(Body body, const Vec3& colour) {
    body.colour = colour;
    return body;
}

inline std::shared_ptr<const Pipeline> pipelineOf(const Scene& scene) {
    return std::make_shared<const Pipeline>(scene);
}

inline std::shared_ptr<Snapshot> startOf(const Scene& scene) {
    std::shared_ptr<Snapshot> snapshot = std::make_shared<Snapshot>();
    for (const Body& body : scene.bodies) snapshot->pose.push_back(body.pose);
    return snapshot;
}

/// Looks along -z at the origin from 10 m.
inline Camera frontCamera(bool orthographic = false) {
    Camera camera;
    camera.yaw = camera.pitch = 0;
    camera.distance = 10;
    camera.fieldOfView = 0.6;
    camera.orthographic = orthographic;
    return camera;
}

/// How far apart two colours are, 0 to 255.
inline int difference(QRgb a, QRgb b) {
    return std::max(
        {std::abs(qRed(a) - qRed(b)), std::abs(qGreen(a) - qGreen(b)), std::abs(qBlue(a) - qBlue(b))});
}

/// The strongest of red, green and blue has this index in `colour`; a highlight may share the lead.
inline bool leads(QRgb pixel, const Vec3& colour) {
    const std::array<int, 3> channels = {qRed(pixel), qGreen(pixel), qBlue(pixel)};
    Eigen::Index strongest = 0;
    colour.maxCoeff(&strongest);
    return channels[static_cast<std::size_t>(strongest)] ==
           *std::max_element(channels.begin(), channels.end());
}

} // namespace carom::test
