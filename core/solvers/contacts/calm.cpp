// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/calm.h"

#include "core/dynamics/energy.h"

#include <cmath>

namespace carom {
namespace {

/// In units of √(size/|g|); a fall through its size takes 1.4 of them.
constexpr double calmTime = 5;
/// Forces up to this part of the weight do not keep a body up. At twice as much one that sinks slowly in
/// something dense could be taken for one at rest.
constexpr double bornePart = 0.1;

} // namespace

void Calm::note(const Bodies& bodies, const State& state, std::span<const BodyIndex> list,
                const Vec3& gravity, double time) {
    const double most = calmSpeed * calmSpeed * gravity.norm();
    for (const BodyIndex i : list) {
        const double size = bodies.boundingRadius[i];
        const double speed = state.velocity[i].norm() + state.angularVelocity[i].norm() * size;
        m_times[i] = speed * speed <= most * size ? m_times[i] + time : 0;
    }
}

bool Calm::isCalm(const Bodies& bodies, BodyIndex body, const Vec3& gravity) const {
    return m_times[body] * m_times[body] * gravity.norm() >=
           calmTime * calmTime * bodies.boundingRadius[body];
}

bool mayFloat(const Bodies& bodies, BodyIndex body, const Vec3& gravity) {
    if (!bodies.forces.actOn(body)) return false;
    const double speed = calmSpeed * std::sqrt(gravity.norm() * bodies.boundingRadius[body]);
    return bodies.forces.most(body, speed) > bornePart * bodies.mass[body] * gravity.norm();
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
