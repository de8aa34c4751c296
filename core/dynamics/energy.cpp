// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/energy.h"

#include "core/base/shared_loops.h"
#include "core/base/wide.h"
#include "core/dynamics/free_rotation.h"
#include "core/dynamics/invariant_terms.h"
#include "core/dynamics/ledger.h"

namespace carom {
namespace {

/// Bodies whose terms one thread computes at least.
constexpr std::size_t fewTerms = Workers::enoughOf(10);

/// Of a body, without rotation.
CAROM_INLINE Invariants moved(const Bodies& bodies, BodyIndex i, const State& state, const Vec3& gravity) {
    const double mass = bodies.mass[i];
    const Vec3& velocity = state.velocity[i];
    return {0.5 * mass * velocity.squaredNorm(), -(mass * gravity.dot(state.pose[i].position)),
            mass * velocity};
}

CAROM_INLINE void add(Invariants& sum, const Invariants& term) {
    sum.kinetic += term.kinetic;
    sum.potential += term.potential;
    sum.momentum += term.momentum;
}

/// Without rotation.
Invariants moved(const Bodies& bodies, std::span<const BodyIndex> list, const State& state,
                 const Vec3& gravity) {
    Invariants sum;
    for (const BodyIndex i : list) add(sum, moved(bodies, i, state, gravity));
    return sum;
}

} // namespace

MotionTotals motionTotalsOf(const Bodies& bodies, const State& state) {
    MotionTotals sum;
    for (const BodyIndex i : bodies.mobileBodies) {
        sum.kinetic += 0.5 * bodies.mass[i] * state.velocity[i].squaredNorm();
        sum.momentum += bodies.mass[i] * state.velocity[i];
    }
    for (const BodyIndex i : bodies.rotating) sum.kinetic += spinEnergy(bodies, i, state);
    return sum;
}

Invariants invariantsOf(const Bodies& bodies, const State& state, const Vec3& gravity) {
    Invariants sum = moved(bodies, bodies.mobileBodies, state, gravity);
    for (const BodyIndex i : bodies.rotating) sum.kinetic += spinEnergy(bodies, i, state);
    return sum;
}

CAROM_WIDE Invariants invariantsOf(const Bodies& bodies, std::span<const BodyIndex> list, const State& state,
                                   const Vec3& gravity) {
    Invariants sum = moved(bodies, list, state, gravity);
    for (const BodyIndex i : list) sum.kinetic += spinEnergy(bodies, i, state);
    return sum;
}

Invariants invariantsOf(const Bodies& bodies, std::span<const BodyIndex> list, const State& state,
                        const Vec3& gravity, InvariantTerms& terms, Workers& workers) {
    if (workers.threads() == 1) return invariantsOf(bodies, list, state, gravity);
    Invariants sum;
    forTerms(
        list.size(), fewTerms, terms.moved, workers,
        [&](std::size_t k) { return moved(bodies, list[k], state, gravity); },
        [&](const Invariants& term) { add(sum, term); });
    forTerms(
        list.size(), fewTerms, terms.spin, workers,
        [&](std::size_t k) { return spinEnergy(bodies, list[k], state); },
        [&](double energy) { sum.kinetic += energy; });
    return sum;
}

Vec3 angularMomentumOf(const Bodies& bodies, const State& state) {
    Vec3 sum = Vec3::Zero();
    for (const BodyIndex i : bodies.mobileBodies) {
        const Pose& pose = state.pose[i];
        sum += pose.position.cross(bodies.mass[i] * state.velocity[i]);
        sum += angularMomentumOf(bodies, i, state);
    }
    return sum;
}

} // namespace carom
