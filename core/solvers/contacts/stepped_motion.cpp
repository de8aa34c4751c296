// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/stepped_motion.h"

#include "core/dynamics/contact_memory.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/free_rotation.h"
#include "core/math/rotation.h"
#include "core/solvers/contact_settings.h"

#include <algorithm>
#include <cmath>

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

Vec3 vectorOf(const std::array<double, 3>& from) { return {from[0], from[1], from[2]}; }
std::array<double, 3> arrayOf(const Vec3& from) { return {from.x(), from.y(), from.z()}; }

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
        step(input, list, duration, k == 0, report);
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
    m_free.resize(list.size());
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
    const ManifoldInput here{input.bodies, input.state, input.gravity, input.duration};
    const auto localOf = [&](BodyIndex i) {
        return input.bodies.mobile[i] != 0 ? m_local[i] : m_rows.immobile();
    };
    for (const std::uint32_t place : places) {
        const PersistentManifold& manifold = manifolds[place];
        if (manifold.open) continue;
        PlacedManifold contact = placed(here, manifold);
        const ContactPair laws = pairOf(input.bodies, manifold.pair, 0);
        for (std::size_t k = 0; k < static_cast<std::size_t>(contact.count); ++k) {
            report.maxPenetration = std::max(report.maxPenetration, -contact.points[k].separation);
        }
        m_rows.add({.a = localOf(manifold.pair.a),
                    .b = localOf(manifold.pair.b),
                    .normal = contact.normal,
                    .friction = laws.friction,
                    .restitution = laws.restitution,
                    .rolling = laws.rolling,
                    .push = mostParting * laws.size / input.duration,
                    .points = std::span(contact.points).first(static_cast<std::size_t>(contact.count))},
                   place, m_bodies);
    }
    m_rows.end();
}

void SteppedMotion::step(const SteppedInput& input, std::span<const BodyIndex> list, double duration,
                         bool first, SteppedReport& report) {
    const Vec3 fall = duration * input.gravity;
    const StepSettings settings{.duration = duration, .resting = 2 * fall.norm()};
    const std::span<SolverBody> bodies = m_bodies;
    const bool bounces = recordApproach(m_rows, bodies, settings);
    for (std::size_t i = 0; i < list.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) bodies[i].velocity[k] += fall[static_cast<Eigen::Index>(k)];
        m_free[i] = bodies[i].velocity;
    }
    warmStart(m_rows, bodies);
    for (RollingRow& row : m_rows.rolling()) row.torque.setZero();
    prepareSprings(input.bodies, input.state, input.springs, m_local, m_rows.immobile(), duration, bodies,
                   m_springs);
    const std::size_t points = m_rows.points().size() * wideLanes;
    for (int pass = 0; pass < m_passes; ++pass) {
        solveVelocities(m_rows, bodies, first ? std::span<const Displacement>() : m_moved, settings,
                        pass % 2 != 0);
        resistRolling(m_rows, bodies);
        solveSprings(m_springs, bodies);
    }
    report.work.rowsSwept += static_cast<std::size_t>(m_passes) * points;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const Vec3 velocity = vectorOf(bodies[i].velocity), spin = vectorOf(bodies[i].spin);
        if (velocity.allFinite() && spin.allFinite()) continue;
        report.loss = {list[i], velocity.allFinite() ? "angular velocity" : "velocity"};
        return;
    }
    move(input, list, duration);
    for (int pass = 0; pass < m_passes; ++pass) {
        report.residual = relaxVelocities(m_rows, bodies, m_moved, settings, pass % 2 != 0);
        resistRolling(m_rows, bodies);
        solveSprings(m_springs, bodies);
        report.work.rowsSwept += points;
        if (report.residual <= input.tolerance) break;
    }
    if (bounces)
        report.work.impacts +=
            static_cast<std::uint64_t>(rebound(m_rows, bodies, m_moved, settings, reboundPasses));
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
        if (from.velocity == m_free[i]) shift -= half;
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
