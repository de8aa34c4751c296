// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/math/types.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

// The audit of energy and momentum. Each part of the motion records its work and impulse, computed from the
// impulses it applied and the velocities before and after them, never from the energy of the state:
//
//     impulse p at a point that moves with u before and u' after      work  p · (u + u')/2
//
// which is exact for any number of impulses at one instant. So the entries of a frame add up to the change
// of the state's energy and momentum, within rounding, if and only if the motion did nothing else.

namespace carom {

struct Bodies;
struct Invariants;
struct State;

/// What is recorded separately (scene/ledger_accounts.def).
enum class LedgerAccount : std::uint8_t {
#define CAROM_LEDGER_ACCOUNT(account, word) account,
#include "core/scene/ledger_accounts.def"
#undef CAROM_LEDGER_ACCOUNT
};
inline constexpr std::size_t ledgerAccounts = 0
#define CAROM_LEDGER_ACCOUNT(account, word) +1
#include "core/scene/ledger_accounts.def"
#undef CAROM_LEDGER_ACCOUNT
    ;

/// "gravity", "restitution", ...: as columns name them. Position correction is "parting": the name is kept
/// because files of users have it.
std::string_view nameOf(LedgerAccount account);

struct LedgerEntry {
    double energy = 0;            ///< [J] given to the bodies, potential energy included
    Vec3 momentum = Vec3::Zero(); ///< [kg m/s] given to the mobile bodies together
};

struct Ledger {
    std::array<LedgerEntry, ledgerAccounts> entries{};
    double lifted = 0; ///< potential energy [J] that position corrections gave; the frame records it as
                       ///< PositionCorrection

    LedgerEntry& operator[](LedgerAccount account) { return entries[static_cast<std::size_t>(account)]; }
    const LedgerEntry& operator[](LedgerAccount account) const {
        return entries[static_cast<std::size_t>(account)];
    }
    void add(const Ledger& other);
    LedgerEntry total() const;
};

/// How bodies move between contacts: under gravity alone, or along a wall that bears a part of their weight.
struct BallisticAdvance {
    Vec3 gravity;      ///< [m/s²]
    Vec3 acceleration; ///< that they really have [m/s²]; the wall gives the difference
    double duration;   ///< [s]
};

/// Records the advance of `list`: to be called before it, as the velocities at its start are needed.
/// Gravity's momentum and work on kinetic energy; its potential energy is recorded by the frame, for all
/// bodies at once.
void recordBallisticAdvance(const Bodies& bodies, std::span<const BodyIndex> list,
                            const BallisticAdvance& advance, const State& state, Ledger& ledger);

/// Momentum that `change` of velocity gives to `list`: of gravity's, their weight times the time.
Vec3 weightOf(const Bodies& bodies, std::span<const BodyIndex> list, const Vec3& change);

/// Records a motion that only gravity and one other thing can have made, by what it changed: gravity by the
/// height lost and the momentum of the weight, `account` by the rest.
void recordDifference(const Invariants& before, const Invariants& after, const Vec3& weight,
                      LedgerAccount account, Ledger& ledger);

/// Kinetic energy of rotation of a body [J].
double spinEnergy(const Bodies& bodies, BodyIndex body, const State& state);
/// The same of `list`, to be recorded as the difference of two.
double spinEnergy(const Bodies& bodies, std::span<const BodyIndex> list, const State& state);

} // namespace carom
