// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/viewport/camera.h"
#include "ui/viewport/room.h"

#include <optional>
#include <span>

namespace carom {

/// Distance [m] along the ray to where it enters a shape; nothing where it misses, or starts inside. Walls
/// are entered from their free side only.
std::optional<double> entry(const Ray& ray, const Shape& shape, const Pose& worldFromBody);

struct Hit {
    BodyIndex body = noBody;
    double distance = 0; ///< [m] from the ray's origin

    explicit operator bool() const { return body != noBody; }
};

/// The first body that a ray meets: what is seen there. Walls count where the room shows them.
Hit pick(const Ray& ray, const Scene& scene, std::span<const Pose> poses, const Room& room);

} // namespace carom
