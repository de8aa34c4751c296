// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/state.h"

#include <algorithm>
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

// The sum is finite only if every number is, because none with inf or NaN is; and not finite either where
// numbers are so large that it overflows. An addition a number, where a test of each would be a branch. Only
// what can change is looked at.
Loss findLoss(const Bodies& bodies, std::span<const BodyIndex> list, const State& state) {
    if (list.empty()) return {};
    Vec3 moving = Vec3::Zero(), turning = Vec3::Zero();
    double last = 0;
    for (const BodyIndex i : list) moving += state.pose[i].position + state.velocity[i];
    auto at = list.begin();
    const std::vector<BodyIndex>& rotating = bodies.rotating;
    for (auto next = std::ranges::lower_bound(rotating, list.front()); next != rotating.end(); ++next) {
        const BodyIndex i = *next;
        while (at != list.end() && *at < i) ++at;
        if (at == list.end()) break;
        if (*at != i) continue;
        const Quat& q = state.pose[i].orientation;
        turning += q.vec() + state.angularVelocity[i];
        last += q.w();
    }
    if (std::isfinite(moving.sum() + turning.sum() + last)) return {};
    for (const BodyIndex i : list)
        if (!finite(state, i)) return {i, lostQuantity(state, i)};
    return {};
}

} // namespace carom
