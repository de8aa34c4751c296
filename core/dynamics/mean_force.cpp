// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/mean_force.h"

#include <array>

namespace carom {

Vec3 meanForceOn(const Bodies& bodies, const FrameMotion& motion) {
    if (!bodies.forces.actOn(motion.body)) return Vec3::Zero();
    const std::array<ForceSample, 2> samples{
        ForceSample{motion.body, motion.pose, motion.before, motion.angularVelocity},
        ForceSample{motion.body, motion.pose, motion.after, motion.angularVelocity}};
    std::array<ForceValue, 2> values{};
    bodies.forces.evaluate(samples, values);
    return 0.5 * (values[0].force + values[1].force);
}

} // namespace carom
