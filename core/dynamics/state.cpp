// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/state.h"

#include <cmath>

namespace carom {
namespace {

template<class Quantity>
constexpr std::size_t bytesOf = sizeof(typename Quantity::value_type);

// What a substep reads and writes of a body: of one that only moves, as a sphere without friction does, no
// more than a cache line; of one that turns, three.
constexpr std::size_t movingBytes = sizeof(Pose::position) + bytesOf<decltype(State::velocity)>;
constexpr std::size_t turningBytes = sizeof(Pose::orientation) + bytesOf<decltype(State::angularVelocity)> +
                                     bytesOf<decltype(State::angularMomentum)> +
                                     bytesOf<decltype(Bodies::inertia)>;
static_assert(movingBytes <= 64);
static_assert(movingBytes + turningBytes <= 3 * 64);

// Finite only if every number is, because no sum with inf or NaN is; and not finite either where numbers are
// so large that their sum overflows. An addition a number, where a test of each would be a branch. Only what
// can change is looked at.
double sumOfAll(const Bodies& bodies, const State& state) {
    Vec3 moving = Vec3::Zero(), turning = Vec3::Zero();
    double last = 0;
    for (const BodyIndex i : bodies.mobileBodies) moving += state.pose[i].position + state.velocity[i];
    for (const BodyIndex i : bodies.rotating) {
        const Quat& q = state.pose[i].orientation;
        turning += q.vec() + state.angularVelocity[i];
        last += q.w();
    }
    return moving.sum() + turning.sum() + last;
}

bool finite(const State& state, BodyIndex body) {
    return state.pose[body].position.allFinite() && state.pose[body].orientation.coeffs().allFinite() &&
           state.velocity[body].allFinite() && state.angularVelocity[body].allFinite();
}

std::string_view lostQuantity(const State& state, BodyIndex body) {
    if (!state.pose[body].position.allFinite()) return "position";
    if (!state.velocity[body].allFinite()) return "velocity";
    if (!state.pose[body].orientation.coeffs().allFinite()) return "orientation";
    return "angular velocity";
}

} // namespace

void copyBody(const State& from, BodyIndex i, State& to, BodyIndex k) {
    to.pose[k] = from.pose[i];
    to.velocity[k] = from.velocity[i];
    to.angularVelocity[k] = from.angularVelocity[i];
    to.positionRest[k] = from.positionRest[i];
    to.angularMomentum[k] = from.angularMomentum[i];
}

State initialStateOf(const Scene& scene) {
    State state;
    state.pose.reserve(scene.bodies.size());
    state.velocity.reserve(scene.bodies.size());
    state.angularVelocity.reserve(scene.bodies.size());
    state.angularMomentum.assign(scene.bodies.size(), Vec3::Zero());
    for (const Body& body : scene.bodies) {
        const bool mobile = body.mobile() && !isWall(body.shape);
        state.pose.push_back(body.pose);
        state.velocity.push_back(mobile ? body.velocity : Vec3::Zero());
        state.angularVelocity.push_back(mobile ? body.angularVelocity : Vec3::Zero());
    }
    state.positionRest.assign(scene.bodies.size(), Vec3::Zero());
    return state;
}

Loss findLoss(const Bodies& bodies, const State& state) {
    if (std::isfinite(sumOfAll(bodies, state))) return {};
    for (const BodyIndex i : bodies.mobileBodies)
        if (!finite(state, i)) return {i, lostQuantity(state, i)};
    return {};
}

Loss findLoss(const Bodies& bodies, std::span<const BodyIndex> list, const State& state) {
    Vec3 sum = Vec3::Zero();
    double last = 0;
    auto rotating = bodies.rotating.begin();
    for (const BodyIndex i : list) {
        sum += state.pose[i].position + state.velocity[i];
        while (rotating != bodies.rotating.end() && *rotating < i) ++rotating;
        if (rotating == bodies.rotating.end() || *rotating != i) continue;
        const Quat& q = state.pose[i].orientation;
        sum += q.vec() + state.angularVelocity[i];
        last += q.w();
    }
    if (std::isfinite(sum.sum() + last)) return {};
    for (const BodyIndex i : list)
        if (!finite(state, i)) return {i, lostQuantity(state, i)};
    return {};
}

} // namespace carom
