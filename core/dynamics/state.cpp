// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/state.h"

#include <cmath>

namespace carom {
namespace {

// 0 while every summand is finite, else not a number: 0 · inf and 0 · NaN are NaN. One addition a number,
// where a test of each would be a branch a number.
inline double traceOfLoss(const State& state, BodyIndex body) {
    const Pose& pose = state.pose[body];
    const Quat& q = pose.orientation;
    const Vec3 sum = pose.position * 0.0 + state.velocity[body] * 0.0 +
                     (state.angularVelocity[body] * 0.0 + q.vec() * 0.0);
    return (sum.x() + sum.y()) + (sum.z() + q.w() * 0.0);
}

std::string_view lostQuantity(const State& state, BodyIndex body) {
    if (!state.pose[body].position.allFinite()) return "position";
    if (!state.velocity[body].allFinite()) return "velocity";
    if (!state.pose[body].orientation.coeffs().allFinite()) return "orientation";
    return "angular velocity";
}

} // namespace

State initialStateOf(const Scene& scene) {
    State state;
    state.pose.reserve(scene.bodies.size());
    state.velocity.reserve(scene.bodies.size());
    state.angularVelocity.reserve(scene.bodies.size());
    for (const Body& body : scene.bodies) {
        const bool mobile = body.mobile() && !isWall(body.shape);
        state.pose.push_back(body.pose);
        state.velocity.push_back(mobile ? body.velocity : Vec3::Zero());
        state.angularVelocity.push_back(mobile ? body.angularVelocity : Vec3::Zero());
    }
    return state;
}

Loss findLoss(const Bodies& bodies, const State& state) {
    double trace = 0;
    for (const BodyIndex i : bodies.mobileBodies) trace += traceOfLoss(state, i);
    if (trace == 0) return {};
    for (const BodyIndex i : bodies.mobileBodies)
        if (traceOfLoss(state, i) != 0) return {i, lostQuantity(state, i)};
    return {};
}

} // namespace carom
