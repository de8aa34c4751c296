// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/math/pose.h"

namespace carom {

/// A body at the end of a frame, and how fast it was before.
struct FrameMotion {
    BodyIndex body = noBody;
    Pose pose;
    Vec3 before = Vec3::Zero(), after = Vec3::Zero(); ///< velocities [m/s]
    Vec3 angularVelocity = Vec3::Zero();              ///< [rad/s]
};

/// What force terms do to the body [N], the mean of both velocities; zero where none acts.
Vec3 meanForceOn(const Bodies& bodies, const FrameMotion& motion);

} // namespace carom
