// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/state_between.h"

#include "core/simulation/world.h"

namespace carom {
namespace {

/// The cubic through places and velocities at both ends of a frame of `h` [s].
Vec3 placeBetween(const Vec3& x0, const Vec3& v0, const Vec3& x1, const Vec3& v1, double h, double part) {
    const double rest = 1 - part;
    return x0 + part * part * (3 - 2 * part) * (x1 - x0) + h * part * rest * (rest * v0 - part * v1);
}

} // namespace

void FrameBefore::take(const World& world) {
    const State& state = world.state();
    pose = state.pose;
    velocity = state.velocity;
    angularVelocity = state.angularVelocity;
    statistics = world.statistics();
    time = state.time;
}

Moment FrameBefore::momentOf(const World& world) const {
    Moment moment = carom::momentOf(world.pipeline(), world.state(), world.statistics());
    moment.velocityBefore = velocity;
    moment.elapsed = world.state().time - time;
    return moment;
}

StateBetween::StateBetween(const FrameBefore& before, const World& now, double at)
    : pose(now.state().pose), velocity(now.state().velocity), angularVelocity(now.state().angularVelocity),
      statistics(now.statistics()), part((at - before.time) / (now.state().time - before.time)) {
    const State& state = now.state();
    const double h = state.time - before.time;
    for (const BodyIndex i : now.pipeline().bodies().mobileBodies) {
        pose[i].position = placeBetween(before.pose[i].position, before.velocity[i], state.pose[i].position,
                                        state.velocity[i], h, part);
        pose[i].orientation = before.pose[i].orientation.slerp(part, state.pose[i].orientation);
        velocity[i] = before.velocity[i] + part * (state.velocity[i] - before.velocity[i]);
        angularVelocity[i] =
            before.angularVelocity[i] + part * (state.angularVelocity[i] - before.angularVelocity[i]);
    }
    for (double FrameStatistics::*figure : {&FrameStatistics::kinetic, &FrameStatistics::potential,
                                            &FrameStatistics::maxPenetration, &FrameStatistics::residual})
        statistics.*figure =
            before.statistics.*figure + part * (statistics.*figure - before.statistics.*figure);
    statistics.momentum =
        before.statistics.momentum + part * (statistics.momentum - before.statistics.momentum);
}

Moment StateBetween::momentOf(const World& world, const FrameBefore& before) const {
    return {.pipeline = world.pipeline(),
            .pose = pose,
            .velocity = velocity,
            .angularVelocity = angularVelocity,
            .statistics = statistics,
            .velocityBefore = before.velocity,
            .elapsed = part * (world.state().time - before.time)};
}

} // namespace carom
