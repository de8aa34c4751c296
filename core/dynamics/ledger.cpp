// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/ledger.h"

#include "core/dynamics/bodies.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/free_rotation.h"
#include "core/dynamics/state.h"

namespace carom {

std::string_view nameOf(LedgerAccount account) {
    static constexpr std::array<std::string_view, ledgerAccounts> names = {
#define CAROM_LEDGER_ACCOUNT(account, word) #word,
#include "core/scene/ledger_accounts.def"
#undef CAROM_LEDGER_ACCOUNT
    };
    return names[static_cast<std::size_t>(account)];
}

void Ledger::add(const Ledger& other) {
    lifted += other.lifted;
    for (std::size_t i = 0; i < ledgerAccounts; ++i) {
        entries[i].energy += other.entries[i].energy;
        entries[i].momentum += other.entries[i].momentum;
    }
}

LedgerEntry Ledger::total() const {
    LedgerEntry sum;
    for (const LedgerEntry& entry : entries) {
        sum.energy += entry.energy;
        sum.momentum += entry.momentum;
    }
    return sum;
}

void recordBallisticAdvance(const Bodies& bodies, std::span<const BodyIndex> list,
                            const BallisticAdvance& advance, const State& state, Ledger& ledger) {
    LedgerEntry& gravity = ledger[LedgerAccount::Gravity];
    LedgerEntry& wall = ledger[LedgerAccount::Contact];
    const double h = advance.duration;
    double mass = 0;
    Vec3 momentum = Vec3::Zero();
    for (const BodyIndex i : list) {
        mass += bodies.mass[i];
        momentum += bodies.mass[i] * state.velocity[i];
    }
    const Vec3 way = h * momentum + (0.5 * h * h * mass) * advance.acceleration; // of the masses together
    gravity.momentum += (mass * h) * advance.gravity;
    gravity.energy += advance.gravity.dot(way);
    wall.momentum += (mass * h) * (advance.acceleration - advance.gravity);
    wall.energy += (advance.acceleration - advance.gravity).dot(way);
}

Vec3 weightOf(const Bodies& bodies, std::span<const BodyIndex> list, const Vec3& change) {
    Vec3 sum = Vec3::Zero();
    for (const BodyIndex i : list) sum += bodies.mass[i] * change;
    return sum;
}

void recordDifference(const Invariants& before, const Invariants& after, const Vec3& weight,
                      LedgerAccount account, Ledger& ledger) {
    const double fallen = before.potential - after.potential;
    ledger[LedgerAccount::Gravity].energy += fallen;
    ledger[LedgerAccount::Gravity].momentum += weight;
    ledger[account].energy += after.kinetic - before.kinetic - fallen;
    ledger[account].momentum += after.momentum - before.momentum - weight;
}

double spinEnergy(const Bodies& bodies, BodyIndex body, const State& state) {
    const Vec3& inertia = bodies.inertia[body];
    if (isIsotropic(inertia)) return 0.5 * inertia.x() * state.angularVelocity[body].squaredNorm();
    const Vec3 spin = state.pose[body].directionToBody(state.angularVelocity[body]);
    return 0.5 * spin.dot(inertia.cwiseProduct(spin));
}

double spinEnergy(const Bodies& bodies, std::span<const BodyIndex> list, const State& state) {
    double sum = 0;
    for (const BodyIndex i : list) sum += spinEnergy(bodies, i, state);
    return sum;
}

} // namespace carom
