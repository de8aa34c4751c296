// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/calm.h"

#include "core/dynamics/energy.h"
#include "core/solvers/contacts/neighbours.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

/// How long a body must stay, in units of √(size/|g|); a fall through its size takes 1.4 of them. At half, a
/// body that begins to topple may be put to sleep; at twice, heaps come to rest later.
constexpr double calmTime = 5;
/// A body may move by this part of its size in that time: it is slower than 0.006 √(size |g|) in the mean. At
/// twice, bodies that slide or roll twice as fast are put to sleep; at half, heaps come to rest later.
constexpr double calmWay = 0.03;
/// Forces up to this part of the weight do not keep a body up. At twice as much one that sinks slowly in
/// something dense could be taken for one at rest.
constexpr double bornePart = 0.1;

bool isLong(double time, const Bodies& bodies, BodyIndex body, const Vec3& gravity) {
    return time * time * gravity.norm() >= calmTime * calmTime * bodies.boundingRadius[body];
}

} // namespace

double slowestTime(const Bodies& bodies, const State& state, std::span<const std::uint32_t> springs,
                   double mass, const Vec3& gravity) {
    double slowest = 0;
    for (const std::uint32_t index : springs) {
        const SpringForce& spring = bodies.springs[index];
        if (!(spring.stiffness > 0)) continue; // a damper alone has no place that it moves bodies to
        slowest = std::max({slowest, std::sqrt(mass / spring.stiffness), spring.damping / spring.stiffness,
                            std::sqrt(lengthOf(spring, state) / gravity.norm())});
    }
    return slowest;
}

bool isSlowerThan(double part, const Bodies& bodies, const State& state, BodyIndex body,
                  const Vec3& gravity) {
    const double size = bodies.boundingRadius[body];
    const double speed = state.velocity[body].norm() + state.angularVelocity[body].norm() * size;
    return speed * speed <= part * part * gravity.norm() * size;
}

Calm::Calm(const Bodies& bodies)
    : m_stays(bodies.count()), m_isOnSpring(bodies.count(), 0), m_isUndamped(bodies.count(), 0),
      m_floating(bodies.count(), Floating::Unknown) {
    for (const SpringForce& spring : bodies.springs)
        for (const BodyIndex end : {spring.from, spring.to})
            if (end != noBody) {
                m_isOnSpring[end] = 1;
                if (!(spring.damping > 0)) m_isUndamped[end] = 1;
            }
}

void Calm::note(const Bodies& bodies, const State& state, std::span<const BodyIndex> list,
                const Vec3& gravity, double time) {
    for (const BodyIndex i : list) {
        Stay& stay = m_stays[i];
        const double way = Neighbours::displacement(bodies, i, stay.from, state.pose[i]);
        if (way <= calmWay * bodies.boundingRadius[i])
            stay.time += time;
        else
            stay = {.from = state.pose[i], .slow = stay.slow};
        const bool isSlow = m_isOnSpring[i] != 0 && isSlowerThan(restSpeed, bodies, state, i, gravity);
        stay.slow = isSlow ? stay.slow + time : 0;
    }
}

void Calm::noteRefined(const Bodies& bodies, const State& state, std::span<const BodyIndex> list,
                       const Vec3& gravity, double time) {
    for (const BodyIndex i : list) {
        const bool isSlow = isSlowerThan(restSpeed, bodies, state, i, gravity);
        m_stays[i].slow = isSlow ? m_stays[i].slow + time : 0;
    }
}

bool Calm::areAtRest(const Bodies& bodies, std::span<const BodyIndex> list, const Vec3& gravity) {
    return gravity.norm() > 0 && std::all_of(list.begin(), list.end(), [&](BodyIndex i) {
               return isLong(m_stays[i].slow, bodies, i, gravity) && !mayFloat(bodies, i, gravity);
           });
}

bool Calm::haveRested(std::span<const BodyIndex> list, double slowest) const {
    return std::all_of(list.begin(), list.end(), [&](BodyIndex i) {
        return m_isOnSpring[i] == 0 || m_stays[i].slow >= calmTime * slowest;
    });
}

bool Calm::isCalm(const Bodies& bodies, const State& state, BodyIndex body, const Vec3& gravity,
                  double slowest) const {
    const Stay& stay = m_stays[body];
    const double time = m_isUndamped[body] != 0 ? stay.slow : stay.time;
    return isLong(time, bodies, body, gravity) && time >= calmTime * slowest &&
           isSlowerThan(calmSpeed, bodies, state, body, gravity);
}

bool Calm::mayFloat(const Bodies& bodies, BodyIndex body, const Vec3& gravity) {
    if (!bodies.forces.actOn(body)) return false;
    Floating& floating = m_floating[body];
    if (floating == Floating::Unknown) {
        const double speed = calmSpeed * std::sqrt(gravity.norm() * bodies.boundingRadius[body]);
        const bool bears = bodies.forces.most(body, speed) > bornePart * bodies.mass[body] * gravity.norm();
        floating = bears ? Floating::Yes : Floating::No;
    }
    return floating == Floating::Yes;
}

void stop(const Bodies& bodies, std::span<const BodyIndex> list, State& state, Ledger* ledger) {
    for (const BodyIndex i : list) {
        if (ledger != nullptr) {
            LedgerEntry& entry = (*ledger)[LedgerAccount::Rest];
            entry.energy -=
                0.5 * bodies.mass[i] * state.velocity[i].squaredNorm() + spinEnergy(bodies, i, state);
            entry.momentum -= bodies.mass[i] * state.velocity[i];
        }
        state.velocity[i].setZero();
        state.angularVelocity[i].setZero();
    }
}

} // namespace carom
