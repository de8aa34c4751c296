// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/audit.h"

namespace carom {
namespace {

/// Velocity of B's point relative to A's in the row's frame.
template<class Row>
Vec3 meanVelocity(const Row& row, std::span<const Vec6> mean) {
    Vec3 u = Vec3::Zero();
    if (row.a != immobile) u += row.jacobianA * mean[static_cast<std::size_t>(row.a)];
    if (row.b != immobile) u += row.jacobianB * mean[static_cast<std::size_t>(row.b)];
    return u;
}

/// The momentum that an impulse on B, in world coordinates, gives to all mobile bodies together.
template<class Row>
Vec3 givenFromOutside(const Row& row, const Vec3& impulse) {
    if (row.a == immobile && row.b != immobile) return impulse;
    if (row.b == immobile && row.a != immobile) return -impulse;
    return Vec3::Zero();
}

} // namespace

void recordRows(const ContactProblem& problem, std::span<const Vec6> mean, double part, LedgerAccount normal,
                Ledger& ledger) {
    for (const ContactRow& row : problem.rows) {
        const Vec3 u = meanVelocity(row, mean);
        const Vec3 p = part * row.impulse;
        recordNormal(row, p.x(), u.x(), normal, ledger);
        if (row.friction > 0) {
            const Vec3 tangential(0, p.y(), p.z());
            LedgerEntry& friction = ledger[LedgerAccount::Friction];
            friction.energy += tangential.dot(u);
            friction.momentum += givenFromOutside(row, row.frame.transpose() * tangential);
        }
        if (row.rolling == 0) continue;
        Vec3 spin = Vec3::Zero();
        if (row.a != immobile) spin -= mean[static_cast<std::size_t>(row.a)].tail<3>();
        if (row.b != immobile) spin += mean[static_cast<std::size_t>(row.b)].tail<3>();
        ledger[LedgerAccount::Rolling].energy +=
            part * row.rollingImpulse.dot(row.frame.bottomRows<2>() * spin);
    }
}

void recordNormal(const ContactRow& row, double impulse, double meanSpeed, LedgerAccount normal,
                  Ledger& ledger) {
    LedgerEntry& entry = ledger[normal];
    entry.energy += impulse * meanSpeed;
    entry.momentum += givenFromOutside(row, impulse * row.frame.row(0).transpose());
}

void recordSprings(const ContactProblem& problem, std::span<const Vec6> mean, Ledger& ledger) {
    LedgerEntry& entry = ledger[LedgerAccount::Spring];
    for (const SoftRow& row : problem.springs) {
        entry.energy += row.impulse.dot(meanVelocity(row, mean));
        // A spring tied to the world gives momentum, in world coordinates: the linear part of its Jacobian.
        if (row.a == immobile) entry.momentum += (row.jacobianB.transpose() * row.impulse).head<3>();
        if (row.b == immobile) entry.momentum += (row.jacobianA.transpose() * row.impulse).head<3>();
    }
}

void recordMotion(const ContactProblem& problem, double sign, LedgerAccount account, Ledger& ledger) {
    LedgerEntry& entry = ledger[account];
    for (const ContactBody& body : problem.bodies) {
        const Vec3 momentum = body.mass * body.velocity.head<3>();
        const Vec3 spin = body.velocity.tail<3>();
        entry.energy += 0.5 * sign * (momentum.dot(body.velocity.head<3>()) + spin.dot(body.inertia * spin));
        entry.momentum += sign * momentum;
    }
}

} // namespace carom
