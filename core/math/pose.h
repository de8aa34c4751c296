// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/types.h"

namespace carom {

/// Where a body is: world = position + orientation · body.
struct Pose {
    Vec3 position = Vec3::Zero();        ///< centre of mass [m], world
    Quat orientation = Quat::Identity(); ///< unit quaternion, body to world

    Vec3 toWorld(const Vec3& pointInBody) const { return position + orientation * pointInBody; }
    Vec3 toBody(const Vec3& pointInWorld) const {
        return orientation.conjugate() * (pointInWorld - position);
    }
    Vec3 directionToWorld(const Vec3& direction) const { return orientation * direction; }
    Vec3 directionToBody(const Vec3& direction) const { return orientation.conjugate() * direction; }
};

} // namespace carom
