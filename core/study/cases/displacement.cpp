// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/displacement.h"

#include "core/math/rotation.h"

#include <algorithm>
#include <cmath>

namespace carom {

Displacement displacementOver(Trial& trial, World& world, std::int64_t frames) {
    const State start = world.state();
    Displacement most;
    trial.run(world, frames, [&] {
        for (const BodyIndex i : world.pipeline().bodies().mobileBodies) {
            const Pose& pose = world.state().pose[i];
            const Vec3 moved = pose.position - start.pose[i].position;
            const Quat turned = pose.orientation * start.pose[i].orientation.conjugate();
            most.aside = std::max(most.aside, std::hypot(moved.x(), moved.z()));
            most.down = std::max(most.down, -moved.y());
            most.yaw = std::max(most.yaw, std::abs(toRotationVector(turned).y()));
        }
    });
    if (!world.health().finite) most = {.aside = NAN, .down = NAN, .yaw = NAN};
    return most;
}

} // namespace carom
