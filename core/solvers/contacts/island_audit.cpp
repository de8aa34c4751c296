// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/audit.h"
#include "core/solvers/contacts/island_motion.h"

// Records an island's motion in the ledger; called only if there is one. Everything is recorded from
// velocities at the island's present poses, or if contacts turn, at those of the part's end: the impulses of
// a part of the substep lead from m_start to the velocities of m_problem. The rotation follows, and its
// change of the energy of bodies with unequal moments is recorded separately, as the difference.

namespace carom {

void IslandMotion::recordForces(const MotionInput& input, double duration) {
    Ledger& ledger = *input.ledger;
    m_mean.resize(m_problem.bodies.size());
    LedgerEntry& gravity = ledger[LedgerAccount::Gravity];
    for (std::size_t i = 0; i < m_problem.bodies.size(); ++i) {
        const ContactBody& body = m_problem.bodies[i];
        m_mean[i] = 0.5 * (m_start[i].velocity + body.velocity);
        if (!m_pushes.empty()) { // turning first, then the torques at the end
            const Vec3& momentum = m_start[i].angularMomentum;
            m_mean[i].tail<3>() = 0.5 * (body.freeVelocity + body.velocity).tail<3>();
            ledger[LedgerAccount::Rotation].energy +=
                0.5 * momentum.dot((body.freeVelocity - m_start[i].velocity).tail<3>());
        }
        const Vec3 impulse = (body.mass * duration) * input.gravity;
        gravity.energy += impulse.dot(m_mean[i].head<3>());
        gravity.momentum += impulse;
    }
    swapPushes();
    recordRows(m_problem, m_mean, 1, LedgerAccount::Contact, ledger);
    swapPushes();
    recordSprings(m_problem, m_mean, ledger);
    if (!m_forced.isEmpty()) recordTerms(input);
}

// Exchanges the Jacobians of rows with those along which their impulses act.
void IslandMotion::swapPushes() {
    for (std::size_t i = 0; i < m_pushes.size(); ++i) {
        ContactRow& row = m_problem.rows[i];
        std::swap(row.jacobianA, m_pushes[i].a);
        std::swap(row.jacobianB, m_pushes[i].b);
        std::swap(row.frame, m_pushes[i].frame);
    }
}

void IslandMotion::recordTurning(const MotionInput& input, const Island& island) {
    double before = 0;
    for (const ContactBody& body : m_problem.bodies) {
        const Vec3 spin = body.velocity.tail<3>();
        before += 0.5 * spin.dot(body.inertia * spin);
    }
    (*input.ledger)[LedgerAccount::Rotation].energy +=
        spinEnergy(input.bodies, island.bodies, input.state) - before;
}

// Kinetic energies stay (turnWithVelocity), so only heights can change the energy.
void IslandMotion::recordPositionCorrection(const MotionInput& input, const Island& island) {
    for (std::size_t i = 0; i < island.bodies.size(); ++i)
        input.ledger->lifted -= input.bodies.mass[island.bodies[i]] *
                                input.gravity.dot(m_correction.bodies[i].velocity.head<3>());
}

} // namespace carom
