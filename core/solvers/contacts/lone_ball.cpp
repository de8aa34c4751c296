// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/free_rotation.h"
#include "core/math/compensated.h"
#include "core/solvers/contacts/bounce_train.h"
#include "core/solvers/contacts/contact_settings.h"
#include "core/solvers/contacts/island_motion.h"

#include <algorithm>
#include <cmath>

// A lone ball that bounces on a lone wall has a closed form (bounce_train.h), however many bounces a substep
// holds. Along the normal it is exact; the friction impulse is at most μ times the whole normal impulse of
// the bounces.

namespace carom {

bool IslandMotion::bounce(const MotionInput& input, const Island& island) {
    if (island.bodies.size() != 1 || !island.links.empty() || m_contacts.points.size() != 1) return false;
    const ContactPair& pair = m_contacts.pairs.front();
    const BodyIndex ball = island.bodies.front();
    const BodyIndex other = pair.a == ball ? pair.b : pair.a;
    const Wall* wall = std::get_if<Wall>(&input.bodies.shape[other]);
    if (wall == nullptr || !std::holds_alternative<Sphere>(input.bodies.shape[ball])) return false;
    if (input.bodies.forces.actOn(ball)) return false;

    ContactConstraint& point = m_contacts.points.front();
    Vec3& velocity = input.state.velocity[ball];
    const Vec3& normal = wall->normal;
    const double speed = normal.dot(velocity), pull = -normal.dot(input.gravity);
    const double noise = std::max(elasticClosing, 10 * input.settings.tolerance) * m_scale;
    const bool touching = std::abs(point.separation) <= touchingWithin(pair);
    if (touching && std::abs(speed) <= std::max(noise, speedRounding * velocity.norm())) return false;
    if (point.separation < -touchingWithin(pair)) return false; // the overlap must be corrected first

    loadBodies(input, island);
    const double h = input.substep;
    Vec3& place = input.state.pose[ball].position;
    Vec3& placeRest = input.state.positionRest[ball];
    const double gap = exactGap(normal, wall->offset, input.bodies.boundingRadius[ball], place, placeRest);
    const Bounce after = bounceTrain(std::max(0.0, gap), speed, pull, pair.restitution, h);
    const double impulse = input.bodies.mass[ball] * (after.speed - speed + pull * h);
    ContactBody& body = m_problem.bodies.front();
    const Vec6 before = body.velocity;
    body.velocity.head<3>() += h * input.gravity;
    body.freeVelocity = body.velocity;
    if (impulse > 0 && (pair.friction > 0 || pair.rolling > 0)) {
        // The change of momentum is the whole normal impulse of the bounces; friction can take up to μ times
        // that.
        ContactRow row = rowOf(input.bodies, pair, point);
        const double arm = input.bodies.boundingRadius[ball];
        const double mass = 1 / (1 / body.mass + arm * arm * body.inverseInertia(0, 0));
        row.impulse << impulse, -mass * relativeVelocity(m_problem, row).tail<2>();
        row.rollingImpulse = -row.effectiveInertia * rollingVelocity(m_problem, row);
        const Projected across = projectOnCone(row, row.impulse, row.rollingImpulse);
        row.impulse << 0, across.impulse.tail<2>(); // the normal part is in `after`
        row.rollingImpulse = across.rolling;
        m_problem.rows.assign(1, row);
        velocitiesFromImpulses(m_problem);
    }
    // Along the normal the closed form; tangentially the mean of both ends.
    Vec3 end = body.velocity.head<3>();
    end += (after.speed - normal.dot(end)) * normal;
    Vec3 across = 0.5 * h * (before.head<3>() + end);
    across -= normal.dot(across) * normal;
    moveBy(across + (after.gap - gap) * normal, place, placeRest);
    velocity = end;
    body.velocity.head<3>() = end;
    if (input.ledger != nullptr) recordBounce(input, before, normal, after.gap - gap);
    const double inertia = input.bodies.inertia[ball].x();
    input.state.angularVelocity[ball] = body.velocity.tail<3>();
    rotateBetween(input.bodies, ball, inertia * before.tail<3>(), inertia * body.velocity.tail<3>(), h,
                  input.state);
    point.force.setZero();
    return true;
}

} // namespace carom
