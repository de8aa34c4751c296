// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/balls_on_walls.h"

#include "core/base/reserve.h"
#include "core/dynamics/contact_memory.h"
#include "core/dynamics/free_rotation.h"
#include "core/math/compensated.h"
#include "core/solvers/contacts/bounce_train.h"
#include "core/solvers/contacts/calm.h"
#include "core/solvers/contacts/contact_settings.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace carom {
namespace {

/// Balls whose work is added up together, by one thread: a fixed number, so that sums do not depend on how
/// many threads there are. At half, more sums are added than the threads need; at twice, some hundred balls
/// have one thread.
constexpr std::size_t fewBalls = 128;

using Ball = BallsOnWalls::Ball;

const Vec3& normalOf(const Bodies& bodies, const Ball& ball) {
    return std::get<Wall>(bodies.shape[ball.wall]).normal;
}

/// Finds where a ball is when the substep begins. False if it overlaps the wall.
bool place(const SolverInput& input, const SolverSettings& settings, Ball& ball) {
    const Wall& wall = std::get<Wall>(input.bodies.shape[ball.wall]);
    const Vec3& velocity = input.state.velocity[ball.body];
    const Vec3& position = input.state.pose[ball.body].position;
    const double radius = input.bodies.boundingRadius[ball.body];
    ball.gap = exactGap(wall.normal, wall.offset, radius, position, input.state.positionRest[ball.body]);
    ball.speed = wall.normal.dot(velocity);
    ball.pull = -wall.normal.dot(input.gravity);
    const double touching =
        std::max(contactSlop * radius, coordinateRounding * position.cwiseAbs().maxCoeff());
    const double scale = input.gravity.norm() * input.substep;
    const double noise =
        std::max(std::max(elasticClosing, 10 * settings.tolerance) * scale, speedRounding * velocity.norm());
    ball.lies = ball.pull > 0 && std::abs(ball.gap) <= touching && std::abs(ball.speed) <= noise;
    return !(ball.gap < -touching);
}

/// Shortens a vector to this length at most.
Vec3 limited(const Vec3& vector, double most) {
    const double size = vector.norm();
    return size > most ? Vec3(most / size * vector) : vector;
}

/// The velocity of the surface of a ball against a wall at rest, where they touch.
Vec3 slipOf(const Vec3& normal, double radius, const Vec3& velocity, const Vec3& spin) {
    const Vec3 across = velocity - normal.dot(velocity) * normal;
    return across - radius * spin.cross(normal);
}

/// How a ball moves through a substep, and what the wall does to it.
struct BallMotion {
    Vec3 velocity = Vec3::Zero(), end = Vec3::Zero(); ///< at both ends [m/s]
    Vec3 spin = Vec3::Zero(), turned = Vec3::Zero();  ///< the same [rad/s]
    double pressed = 0;                               ///< along the normal [N s]
    Vec3 impulse = Vec3::Zero();                      ///< across it [N s]
    Vec3 turning = Vec3::Zero();                      ///< of rolling resistance [N m s]
    double rise = 0;                                  ///< from the wall [m]
};

BallMotion motionOf(const SolverInput& input, const ContactPair& pair, const Ball& ball) {
    const Vec3& normal = normalOf(input.bodies, ball);
    const double h = input.substep, radius = input.bodies.boundingRadius[ball.body];
    const double mass = input.bodies.mass[ball.body], inertia = input.bodies.inertia[ball.body].x();
    const Bounce after =
        ball.lies ? Bounce{.gap = ball.gap, .rests = true}
                  : bounceTrain(std::max(0.0, ball.gap), ball.speed, ball.pull, pair.restitution, h);
    BallMotion motion{.velocity = input.state.velocity[ball.body],
                      .spin = input.state.angularVelocity[ball.body]};
    motion.end = motion.velocity + h * input.gravity;
    motion.turned = motion.spin;
    motion.rise = after.gap - ball.gap;
    motion.pressed = mass * (after.speed - ball.speed + ball.pull * h);
    if (motion.pressed > 0) {
        const double atSurface = 1 / (1 / mass + radius * radius / inertia); // [kg]
        const Vec3 slip = slipOf(normal, radius, motion.end, motion.spin);
        const Vec3 rolls = motion.spin - normal.dot(motion.spin) * normal;
        motion.impulse = limited(-atSurface * slip, pair.friction * motion.pressed);
        motion.turning = limited(-inertia * rolls, pair.rolling * motion.pressed);
        motion.end += motion.impulse / mass;
        motion.turned += (motion.turning - radius * normal.cross(motion.impulse)) / inertia;
    }
    motion.end += (after.speed - normal.dot(motion.end)) * normal;
    return motion;
}

void record(const SolverInput& input, const Ball& ball, const BallMotion& motion, Ledger& ledger) {
    const Vec3& normal = normalOf(input.bodies, ball);
    const double radius = input.bodies.boundingRadius[ball.body], mass = input.bodies.mass[ball.body];
    const Vec3 weight = mass * input.substep * input.gravity;
    const Vec3 twiceMean = motion.velocity + motion.end, twiceSpin = motion.spin + motion.turned;
    const double fallen = mass * input.gravity.dot(normal) * motion.rise;
    LedgerEntry& fall = ledger[LedgerAccount::Gravity];
    fall.energy += fallen + 0.5 * (weight - normal.dot(weight) * normal).dot(twiceMean);
    fall.momentum += weight;
    const double before = normal.dot(motion.velocity), after = normal.dot(motion.end);
    LedgerEntry& pushes = ledger[ball.lies ? LedgerAccount::Contact : LedgerAccount::Restitution];
    pushes.energy += 0.5 * mass * (after * after - before * before) - fallen;
    pushes.momentum += motion.pressed * normal;
    LedgerEntry& friction = ledger[LedgerAccount::Friction];
    friction.energy += 0.5 * motion.impulse.dot(slipOf(normal, radius, twiceMean, twiceSpin));
    friction.momentum += motion.impulse;
    ledger[LedgerAccount::Rolling].energy += 0.5 * motion.turning.dot(twiceSpin);
}

/// Stops one that is no faster than the tolerance. Nothing acts on a spin about the normal: a slow one ends,
/// too.
void settle(const SolverInput& input, const SolverSettings& settings, const Ball& ball, BallMotion& motion,
            Ledger* ledger) {
    const Vec3& normal = normalOf(input.bodies, ball);
    const double gravity = input.gravity.norm(), radius = input.bodies.boundingRadius[ball.body];
    const double still = std::max(settings.tolerance, leastTolerance) * gravity * input.substep;
    const Vec3 rolls = motion.turned - normal.dot(motion.turned) * normal;
    if (motion.end.norm() > still || radius * rolls.norm() > still ||
        radius * motion.turned.squaredNorm() > calmSpeed * calmSpeed * gravity)
        return;
    if (ledger != nullptr) {
        const double mass = input.bodies.mass[ball.body], inertia = input.bodies.inertia[ball.body].x();
        LedgerEntry& rest = (*ledger)[LedgerAccount::Rest];
        rest.energy -= 0.5 * (mass * motion.end.squaredNorm() + inertia * motion.turned.squaredNorm());
        rest.momentum -= mass * motion.end;
    }
    motion.end.setZero();
    motion.turned.setZero();
}

void moveOne(const SolverInput& input, const SolverSettings& settings, const ContactPair& pair, Ball& ball,
             Ledger* ledger) {
    const BodyIndex i = ball.body;
    const Vec3& normal = normalOf(input.bodies, ball);
    BallMotion motion = motionOf(input, pair, ball);
    // Along the normal the closed form, across it the mean of both ends.
    const Vec3 way = 0.5 * input.substep * (motion.velocity + motion.end);
    moveBy(way + (motion.rise - normal.dot(way)) * normal, input.state.pose[i].position,
           input.state.positionRest[i]);
    if (ledger != nullptr) record(input, ball, motion, *ledger);
    if (ball.lies) settle(input, settings, ball, motion, ledger);
    ball.isStill = motion.velocity == Vec3::Zero() && motion.spin == Vec3::Zero() &&
                   motion.end == Vec3::Zero() && motion.turned == Vec3::Zero();
    if (ball.lies) ball.force = (motion.pressed * normal + motion.impulse) / input.substep;
    const double inertia = input.bodies.inertia[i].x();
    input.state.velocity[i] = motion.end;
    input.state.angularVelocity[i] = motion.turned;
    rotateBetween(input.bodies, i, inertia * motion.spin, inertia * motion.turned, input.substep,
                  input.state);
}

} // namespace

void BallsOnWalls::find(const SolverInput& input, const SolverSettings& settings, const Islands& islands,
                        std::span<const ContactPair> pairs, std::span<const std::uint8_t> canMeet) {
    const Bodies& bodies = input.bodies;
    m_isOne.assign(islands.count(), 0);
    m_balls.clear();
    reserveFor(islands.count(), m_balls);
    reserveFor(islands.count() / fewBalls + 1, m_ledgers);
    for (std::uint32_t i = 0; i < islands.count(); ++i) {
        const Island island = islands[i];
        if (island.bodies.size() != 1 || island.pairs.size() != 1 || !island.links.empty()) continue;
        const std::uint32_t index = island.pairs.front();
        const ContactPair& pair = pairs[index];
        const BodyIndex body = island.bodies.front(), other = pair.a == body ? pair.b : pair.a;
        if (canMeet[index] == 0 || !std::holds_alternative<Sphere>(bodies.shape[body]) ||
            !isWall(bodies.shape[other]) || bodies.forces.actOn(body))
            continue;
        Ball ball{.island = i, .pair = index, .body = body, .wall = other};
        if (!place(input, settings, ball)) continue;
        if (ball.lies && (pair.rolling > 0 || settings.tolerance < accurateTolerance)) continue;
        m_isOne[i] = 1;
        m_balls.push_back(ball);
    }
}

void BallsOnWalls::move(const SolverInput& input, const SolverSettings& settings,
                        std::span<const ContactPair> pairs) {
    const std::size_t parts = (m_balls.size() + fewBalls - 1) / fewBalls;
    m_ledgers.assign(input.ledger != nullptr ? parts : 0, {});
    input.workers.forEach(parts, [&](std::size_t, std::size_t part) {
        const std::size_t end = std::min(m_balls.size(), (part + 1) * fewBalls);
        for (std::size_t n = part * fewBalls; n < end; ++n)
            moveOne(input, settings, pairs[m_balls[n].pair], m_balls[n],
                    input.ledger != nullptr ? &m_ledgers[part] : nullptr);
    });
    for (const Ledger& ledger : m_ledgers) input.ledger->add(ledger);
}

} // namespace carom
