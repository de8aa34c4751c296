// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/platforms.h"

#include "core/math/rotation.h"
#include "core/narrowphase/time_of_impact.h"

#include <algorithm>
#include <optional>

namespace carom {
namespace {

// I⁻¹ x in the world, for a body that may be fixed.
Vec3 inverseInertiaTimes(const Bodies& bodies, BodyIndex body, const Quat& orientation, const Vec3& x) {
    return orientation * bodies.inverseInertia[body].cwiseProduct(orientation.conjugate() * x);
}

} // namespace

void Platforms::clear() {
    for (const Platform& platform : m_platforms) m_at[platform.body] = none;
    m_platforms.clear();
    m_kicks.clear();
}

void Platforms::add(const State& state, BodyIndex body, double time) {
    m_at[body] = static_cast<std::uint32_t>(m_platforms.size());
    m_platforms.push_back({.body = body,
                           .time = time,
                           .pose = state.pose[body],
                           .velocity = state.velocity[body],
                           .spin = state.angularVelocity[body]});
}

void Platforms::removeLast() {
    m_at[m_platforms.back().body] = none;
    m_platforms.pop_back();
}

Platforms::Contact Platforms::contactAt(const Bodies& bodies, const Stamp& ball, const Vec3& acceleration,
                                        BodyIndex body, double time) const {
    const Platform& platform = m_platforms[m_at[body]];
    const MovingShape moving{.start = {&bodies.shape[body], &platform.pose},
                             .velocity = platform.velocity,
                             .angularVelocity = platform.spin};
    const Pose pose = poseAfter(moving, time - platform.time);
    const Shape round = Sphere{ball.radius};
    const Pose place{positionAt(ball, acceleration, time), Quat::Identity()};
    const Proximity near = proximityOf({&bodies.shape[body], &pose}, {&round, &place});
    const Vec3 arm = near.onA - pose.position;
    const Vec3 velocity =
        platform.velocity + platform.gained + (platform.spin + platform.gainedSpin).cross(arm);
    return {.gap = near.distance,
            .normal = near.normal,
            .arm = arm,
            .closing = near.normal.dot(velocity - velocityAt(ball, acceleration, time))};
}

double Platforms::timeOf(const Bodies& bodies, BodyIndex ball, const Stamp& stamp, const Vec3& acceleration,
                         BodyIndex body, double end) const {
    const Platform& platform = m_platforms[m_at[body]];
    const double start = std::max(platform.time, stamp.time);
    const MovingShape moving{.start = {&bodies.shape[body], &platform.pose},
                             .velocity = platform.velocity,
                             .angularVelocity = platform.spin};
    const Pose pose = poseAfter(moving, start - platform.time);
    const Pose place{positionAt(stamp, acceleration, start), Quat::Identity()};
    const MovingShape base{.start = {&bodies.shape[body], &pose},
                           .velocity = platform.velocity,
                           .angularVelocity = platform.spin};
    const MovingShape flying{.start = {&bodies.shape[ball], &place},
                             .velocity = velocityAt(stamp, acceleration, start),
                             .acceleration = acceleration};
    const std::optional<Impact> impact = timeOfImpact(base, flying, end - start);
    return impact ? start + impact->time : never;
}

double Platforms::strike(const Bodies& bodies, double mass, double restitution, const Contact& contact,
                         BodyIndex body, std::uint32_t log) {
    Platform& platform = m_platforms[m_at[body]];
    const Vec3 lever = contact.arm.cross(contact.normal);
    const Vec3 turned = inverseInertiaTimes(bodies, body, platform.pose.orientation, lever);
    const double compliance = 1 / mass + bodies.inverseMass[body] + lever.dot(turned);
    const double impulse = (1 + restitution) * contact.closing / compliance;
    if (bodies.mobile[body] == 0) return impulse;
    const Kick kick{.log = log,
                    .body = body,
                    .velocity = -(impulse * bodies.inverseMass[body]) * contact.normal,
                    .spin = -impulse * turned};
    platform.gained += kick.velocity;
    platform.gainedSpin += kick.spin;
    m_kicks.push_back(kick);
    return impulse;
}

void Platforms::kick(const Bodies& bodies, const Kick& kick, State& state, Ledger* ledger) const {
    Vec3& velocity = state.velocity[kick.body];
    const double spinBefore = ledger != nullptr ? spinEnergy(bodies, kick.body, state) : 0;
    if (ledger != nullptr) {
        LedgerEntry& impacts = (*ledger)[LedgerAccount::Restitution];
        const Vec3 momentum = bodies.mass[kick.body] * kick.velocity;
        impacts.energy += momentum.dot(velocity + 0.5 * kick.velocity);
        impacts.momentum += momentum;
    }
    velocity += kick.velocity;
    state.angularVelocity[kick.body] += kick.spin;
    if (ledger != nullptr)
        (*ledger)[LedgerAccount::Restitution].energy += spinEnergy(bodies, kick.body, state) - spinBefore;
}

} // namespace carom
