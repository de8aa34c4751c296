// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/stepped_motion.h"

#include "core/dynamics/contact_memory.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/free_rotation.h"
#include "core/math/rotation.h"
#include "core/solvers/contact_settings.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace carom {
namespace {

/// Steps between two looks at the contacts. With two, a frame of four substeps has the eight steps that a
/// tower of ten cubes needs to stand still; with one, it sways. Where there are few points there are twice as
/// many: what a blow leaves of overlaps falls with the step.
constexpr int steps = 2;
/// Contacts of few points are swept there and back: a chain of bodies passes an impact on by a few of them a
/// pass.
constexpr std::size_t fewPoints = 256;
/// Passes in which impacts rebound.
constexpr int reboundPasses = 2;
/// How often a step is solved on with contacts of bodies that were struck within it.
constexpr int mostRounds = 4;

void setInverseInertia(const Vec3& principal, const Quat& orientation, SolverBody& body) {
    if (isIsotropic(principal)) {
        body.xx = body.yy = body.zz = principal.x();
        body.xy = body.xz = body.yz = 0;
        return;
    }
    const Mat3 turn = orientation.toRotationMatrix();
    const Mat3 inverse = turn * principal.asDiagonal() * turn.transpose();
    body.xx = inverse(0, 0);
    body.xy = inverse(0, 1);
    body.xz = inverse(0, 2);
    body.yy = inverse(1, 1);
    body.yz = inverse(1, 2);
    body.zz = inverse(2, 2);
}

} // namespace

SteppedReport SteppedMotion::advance(const SteppedInput& input, std::span<const BodyIndex> list,
                                     std::span<const std::uint32_t> places, Manifolds& manifolds) {
    SteppedReport report;
    Invariants before;
    if (input.ledger != nullptr) before = invariantsOf(input.bodies, list, input.state, input.gravity);
    loadBodies(input, list);
    loadRows(input, places, manifolds, report);
    const bool few = m_rows.points().size() * wideLanes <= fewPoints;
    const int count = few ? 2 * steps : steps;
    const double duration = input.duration / count;
    m_rows.scaleImpulses(duration);
    m_passes = input.passes * (few ? 2 : 1);
    for (int k = 0; k < count; ++k) {
        step(input, list, duration, k == 0, manifolds, report);
        if (report.loss) return report;
    }
    storeForces(duration, manifolds);
    if (input.ledger != nullptr) { // a sweep's impulses are never apart: contact stands for all of them
        const Invariants after = invariantsOf(input.bodies, list, input.state, input.gravity);
        bookDifference(before, after, weightOf(input.bodies, list, input.duration * input.gravity),
                       LedgerAccount::Contact, *input.ledger);
    }
    return report;
}

void SteppedMotion::loadBodies(const SteppedInput& input, std::span<const BodyIndex> list) {
    m_local.resize(input.bodies.count());
    m_bodies.assign(list.size() + 1, {});
    m_moved.assign(list.size() + 1, {});
    m_before.reserve(m_bodies.capacity());
    m_free.resize(list.size());
    m_struck.assign(list.size(), 0);
    for (std::size_t i = 0; i < list.size(); ++i) {
        const BodyIndex body = list[i];
        m_local[body] = static_cast<std::uint32_t>(i);
        SolverBody& to = m_bodies[i];
        to.velocity = arrayOf(input.state.velocity[body]);
        to.spin = arrayOf(input.state.angularVelocity[body]);
        to.inverseMass = input.bodies.inverseMass[body];
        setInverseInertia(input.bodies.inverseInertia[body], input.state.pose[body].orientation, to);
    }
}

void SteppedMotion::loadRows(const SteppedInput& input, std::span<const std::uint32_t> places,
                             const Manifolds& manifolds, SteppedReport& report) {
    m_rows.begin(m_bodies.size() - 1);
    m_watched.clear();
    if (m_watched.capacity() < places.size()) m_watched.reserve(2 * places.size());
    const ManifoldInput here{input.bodies, input.state, input.gravity, input.duration};
    for (const std::uint32_t place : places) {
        if (manifolds[place].open) {
            watch(input, place, manifolds);
            continue;
        }
        const PlacedManifold contact = placed(here, manifolds[place]);
        for (std::size_t k = 0; k < static_cast<std::size_t>(contact.count); ++k)
            report.maxPenetration = std::max(report.maxPenetration, -contact.points[k].separation);
        addRow(input, place, contact, manifolds);
    }
    m_rows.end();
}

void SteppedMotion::addRow(const SteppedInput& input, std::uint32_t place, const PlacedManifold& contact,
                           const Manifolds& manifolds) {
    const BodyPair pair = manifolds[place].pair;
    const ContactPair laws = pairOf(input.bodies, pair, 0);
    m_rows.add({.a = localOf(input, pair.a),
                .b = localOf(input, pair.b),
                .normal = contact.normal,
                .friction = laws.friction,
                .restitution = laws.restitution,
                .rolling = laws.rolling,
                .push = mostParting * laws.size / input.duration,
                .points = std::span(contact.points).first(static_cast<std::size_t>(contact.count))},
               place, m_bodies);
}

void SteppedMotion::watch(const SteppedInput& input, std::uint32_t place, const Manifolds& manifolds) {
    const PersistentManifold& manifold = manifolds[place];
    const auto [a, b] = manifold.pair;
    const auto turning = [&](BodyIndex i) {
        const bool turns =
            input.bodies.mobile[i] != 0 && !std::holds_alternative<Sphere>(input.bodies.shape[i]);
        return turns ? input.bodies.boundingRadius[i] : 0;
    };
    const ManifoldInput here{input.bodies, input.state, input.gravity, input.duration};
    m_watched.push_back({.place = place,
                         .a = localOf(input, a),
                         .b = localOf(input, b),
                         .normal = normalOf(here, manifold),
                         .gap = manifold.gap,
                         .radiusA = turning(a),
                         .radiusB = turning(b)});
}

// Whether a watched pair, one of which was struck, may close its gap within the step.
bool SteppedMotion::isStruck(const Watched& pair, double duration) const {
    const auto isFree = [&](std::uint32_t i) {
        return i == m_rows.immobile() || (m_struck[i] == 0 && m_bodies[i].velocity == m_free[i]);
    };
    if (isFree(pair.a) && isFree(pair.b)) return false;
    double gap = pair.gap;
    const auto come = [&](std::uint32_t i, double sign, double radius) {
        const SolverBody& body = m_bodies[i];
        const Displacement& moved = m_moved[i];
        gap += sign * pair.normal.dot(vectorOf(moved.shift) + duration * vectorOf(body.velocity));
        if (radius > 0) gap -= radius * (vectorOf(moved.turn).norm() + duration * vectorOf(body.spin).norm());
    };
    come(pair.a, -1, pair.radiusA);
    come(pair.b, 1, pair.radiusB);
    return gap < 0;
}

// Contacts of bodies that were struck become rows. True if there were any.
bool SteppedMotion::addStruck(const SteppedInput& input, double duration, Manifolds& manifolds,
                              SteppedReport& report) {
    bool any = false;
    for (Watched& pair : m_watched) {
        if (pair.place == ContactRows::noPair || !isStruck(pair, duration)) continue;
        PersistentManifold& manifold = manifolds[pair.place];
        const std::array<std::pair<BodyIndex, std::uint32_t>, 2> ends{std::pair{manifold.pair.a, pair.a},
                                                                      std::pair{manifold.pair.b, pair.b}};
        for (const auto& [body, local] : ends)
            if (local != m_rows.immobile()) input.state.velocity[body] = vectorOf(m_bodies[local].velocity);
        const ManifoldInput here{input.bodies, input.state, input.gravity, duration};
        const SolverBody &bodyA = m_bodies[pair.a], &bodyB = m_bodies[pair.b];
        const double speed = (vectorOf(bodyB.velocity) - vectorOf(bodyA.velocity)).norm() +
                             pair.radiusA * vectorOf(bodyA.spin).norm() +
                             pair.radiusB * vectorOf(bodyB.spin).norm();
        ++report.work.pairsCollided;
        if (!closeManifold(here, duration * speed, manifold)) continue;
        PlacedManifold contact = placed(here, manifold);
        for (PointInput& point :
             contact.points) { // rows count from where the bodies were when they were made
            const Displacement &a = m_moved[pair.a], &b = m_moved[pair.b];
            point.separation -= contact.normal.dot(vectorOf(b.shift) + vectorOf(b.turn).cross(point.armB) -
                                                   vectorOf(a.shift) - vectorOf(a.turn).cross(point.armA));
        }
        addRow(input, pair.place, contact, manifolds);
        pair.place = ContactRows::noPair;
        any = true;
    }
    if (any) m_rows.end();
    return any;
}

// Passes with feedback.
void SteppedMotion::sweep(const StepSettings& settings, bool first, SteppedReport& report) {
    for (int pass = 0; pass < m_passes; ++pass) {
        solveVelocities(m_rows, m_bodies, first ? std::span<const Displacement>() : m_moved, settings,
                        pass % 2 != 0);
        resistRolling(m_rows, m_bodies);
        solveSprings(m_springs, m_bodies);
    }
    report.work.rowsSwept += static_cast<std::size_t>(m_passes) * m_rows.points().size() * wideLanes;
}

void SteppedMotion::step(const SteppedInput& input, std::span<const BodyIndex> list, double duration,
                         bool first, Manifolds& manifolds, SteppedReport& report) {
    const Vec3 fall = duration * input.gravity;
    const StepSettings settings{.duration = duration, .resting = 2 * fall.norm()};
    const std::span<SolverBody> bodies = m_bodies;
    const bool bounces = recordApproach(m_rows, bodies, settings);
    for (std::size_t i = 0; i < list.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) bodies[i].velocity[k] += fall[static_cast<Eigen::Index>(k)];
        m_free[i] = bodies[i].velocity;
    }
    prepareSprings(input.bodies, input.state, input.springs, m_local, m_rows.immobile(), duration, bodies,
                   m_springs);
    const double energy = bounces ? kineticEnergyOf(bodies) : 0;
    warmStart(m_rows, bodies);
    for (RollingRow& row : m_rows.rolling()) row.torque.setZero();
    sweep(settings, first, report);
    for (int round = 0; round < mostRounds && addStruck(input, duration, manifolds, report); ++round)
        sweep(settings, first, report);
    for (std::size_t i = 0; i < list.size(); ++i) {
        const Vec3 velocity = vectorOf(bodies[i].velocity), spin = vectorOf(bodies[i].spin);
        if (velocity.allFinite() && spin.allFinite()) continue;
        report.loss = {list[i], velocity.allFinite() ? "angular velocity" : "velocity"};
        return;
    }
    move(input, list, duration);
    const std::size_t points = m_rows.points().size() * wideLanes;
    for (int pass = 0; pass < m_passes; ++pass) {
        report.residual = relaxVelocities(m_rows, bodies, m_moved, settings, pass % 2 != 0);
        resistRolling(m_rows, bodies);
        solveSprings(m_springs, bodies);
        report.work.rowsSwept += points;
        if (report.residual <= input.tolerance) break;
    }
    if (const int impacts = bounces ? struckRows(m_rows) : 0; impacts > 0) {
        report.work.impacts += static_cast<std::uint64_t>(impacts);
        const double limit = energy + workOf(m_springs, bodies);
        m_before = m_bodies;
        rebound(m_rows, bodies, m_moved, settings, reboundPasses);
        report.work.rowsSwept += reboundPasses * points;
        keepWithin(limit, m_before, bodies);
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
        input.state.velocity[list[i]] = vectorOf(bodies[i].velocity);
        input.state.angularVelocity[list[i]] = vectorOf(bodies[i].spin);
    }
    report.work.rowsSwept += points; // the warm start
}

// Bodies that nothing touched move on their parabola; the others by their velocity at the end.
void SteppedMotion::move(const SteppedInput& input, std::span<const BodyIndex> list, double duration) {
    const Vec3 half = 0.5 * duration * duration * input.gravity;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const BodyIndex body = list[i];
        SolverBody& from = m_bodies[i];
        Displacement& moved = m_moved[i];
        Vec3 shift = duration * vectorOf(from.velocity);
        if (from.velocity == m_free[i])
            shift -= half;
        else
            m_struck[i] = 1;
        input.state.pose[body].position += shift;
        const Vec3 spin = vectorOf(from.spin);
        for (std::size_t k = 0; k < 3; ++k) {
            moved.shift[k] += shift[static_cast<Eigen::Index>(k)];
            moved.turn[k] += duration * from.spin[k];
        }
        if (spin == Vec3::Zero()) continue;
        const Vec3& inertia = input.bodies.inertia[body];
        input.state.angularVelocity[body] = spin;
        const Vec3 momentum = angularMomentumOf(input.bodies, body, input.state);
        rotateBetween(input.bodies, body, momentum, momentum, duration, input.state);
        if (isIsotropic(inertia)) continue;
        from.spin = arrayOf(input.state.angularVelocity[body]);
        setInverseInertia(input.bodies.inverseInertia[body], input.state.pose[body].orientation, from);
    }
}

void SteppedMotion::storeForces(double duration, Manifolds& manifolds) const {
    const double perDuration = 1 / duration;
    for (const RowGroup& group : m_rows.groups())
        for (std::size_t lane = 0; lane < wideLanes; ++lane) {
            if (group.source[lane] == ContactRows::noPair) continue;
            PersistentManifold& manifold = manifolds[group.source[lane]];
            for (std::size_t k = 0; k < static_cast<std::size_t>(manifold.count); ++k)
                manifold.points[k].force = perDuration * m_rows.impulseOf(group, static_cast<int>(lane), k);
        }
}

} // namespace carom
