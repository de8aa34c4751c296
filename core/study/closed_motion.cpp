// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/closed_motion.h"

#include "core/dynamics/free_rotation.h"
#include "core/study/references.h"

#include <cmath>

namespace carom {
namespace {

/// A point counts as on a line within this part of its distance: the rounding of numbers in a text. At a
/// tenth some such scenes have no closed form; at a thousand times the closed form would be wrong by 1e-11.
constexpr double onLine = 1e-14;

Vec3 placeOfWorldEnd(const SpringForce& spring) {
    return spring.from == noBody ? spring.fromAt : spring.toAt;
}

// The parabola, and free rotation, which rotateFreely goes through to 1e-13 rad from the start to any time;
// where moments differ it is no elementary function, and the way from the last time that was asked for is
// shorter than that from the start.
ClosedMotion freeMotion(const Pipeline& pipeline) {
    const State start = pipeline.initialState();
    const Vec3 gravity = pipeline.gravity(), inertia = pipeline.bodies().inertia[0];
    const Vec3 momentum = angularMomentumFrom(inertia, start.pose[0].orientation, start.angularVelocity[0]);
    return {Sentence{"free motion"},
            [=, last = 0.0, turned = start.pose[0].orientation](double time) mutable {
                std::vector<Pose> pose = start.pose;
                pose[0].position =
                    reference::freeFall(start.pose[0].position, start.velocity[0], gravity, time).place;
                rotateFreely(inertia, momentum, time - last, turned);
                last = time;
                pose[0].orientation = turned;
                return pose;
            }};
}

// x = equilibrium + amplitude of the harmonic oscillator, as long as the ball does not pass the anchor.
std::optional<ClosedMotion> alongSpring(const Pipeline& pipeline) {
    const SpringForce& spring = pipeline.bodies().springs.front();
    const State& start = pipeline.initialState();
    if (spring.damping > 0 || (spring.from != noBody && spring.to != noBody)) return std::nullopt;
    if ((spring.from == noBody ? spring.toAt : spring.fromAt) != Vec3::Zero()) return std::nullopt;
    if (start.angularVelocity[0] != Vec3::Zero()) return std::nullopt;
    const Vec3 anchor = placeOfWorldEnd(spring);
    const Vec3 away = start.pose[0].position - anchor;
    const double distance = away.norm();
    if (!(distance > 0)) return std::nullopt;
    const Vec3 line = away / distance;
    const auto isAlong = [&](const Vec3& v) { return v.cross(line).norm() <= onLine * v.norm(); };
    const Vec3 gravity = pipeline.gravity();
    if (!isAlong(gravity) || !isAlong(start.velocity[0])) return std::nullopt;

    const double rate = std::sqrt(spring.stiffness * pipeline.bodies().inverseMass[0]);
    const double middle = spring.length + gravity.dot(line) / (rate * rate);
    const double offset = distance - middle, speed = start.velocity[0].dot(line) / rate;
    if (!(middle - std::hypot(offset, speed) > 0)) return std::nullopt; // it would pass through the anchor
    return ClosedMotion{Sentence{"harmonic oscillation"}, [=, poses = start.pose](double time) {
                            std::vector<Pose> pose = poses;
                            const double phase = rate * time;
                            pose[0].position =
                                anchor + (middle + offset * std::cos(phase) + speed * std::sin(phase)) * line;
                            return pose;
                        }};
}

} // namespace

std::optional<ClosedMotion> closedMotionOf(const Pipeline& pipeline) {
    const Bodies& bodies = pipeline.bodies();
    if (bodies.count() != 1 || bodies.mobileBodies.size() != 1 || !bodies.forces.empty()) return std::nullopt;
    if (bodies.springs.empty()) return freeMotion(pipeline);
    return bodies.springs.size() == 1 ? alongSpring(pipeline) : std::nullopt;
}

} // namespace carom
