// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/scene.h"
#include "core/simulation/snapshot.h"
#include "ui/viewport/camera.h"
#include "ui/viewport/overlays.h"

#include <QString>

namespace carom {

/// What the overlays show at a point of the picture, in words: the contact whose point is there with its two
/// bodies, force, impulse of a frame and whether it slides; or the body whose velocity's arrow ends there.
/// Empty where there is neither.
struct TipRequest {
    const Scene& scene;
    const Snapshot& snapshot;
    Overlays overlays = 0;
    double frame = 0;     ///< [s] of a frame
    double arrowTime = 0; ///< [s] of the way that a velocity's arrow is
};
QString tipAt(const TipRequest& request, const Camera& camera, const PictureSize& picture,
              const Eigen::Vector2d& pixel);

} // namespace carom
