// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/energy_guard.h"

#include "core/base/figures.h"
#include "core/simulation/pipeline.h"

#include <algorithm>
#include <cmath>

namespace carom {

EnergyGuard::EnergyGuard(const Pipeline& pipeline, const FrameStatistics& start)
    : m_start(start.kinetic + start.potential), m_potential(start.potential), m_least(start.potential),
      m_scale(start.kinetic) {
    const Bodies& bodies = pipeline.bodies();
    for (const StoredEnergy& stored : pipeline.stored())
        if (!stored.ofHeight) m_scale += stored.of(pipeline.scene(), bodies, pipeline.initialState());
    const double gravity = bodies.gravity.norm();
    for (const BodyIndex i : bodies.mobileBodies)
        m_scale += bodies.mass[i] * gravity * bodies.boundingRadius[i];
    for (const auto& term : bodies.forces.terms) m_suppliers.push_back(term->account());
    if (m_suppliers.empty()) return;
    for (const BodyIndex i : bodies.mobileBodies)
        m_carried += 0.5 * bodies.mass[i] * std::pow(bodies.forces.gain[i].speed, 2);
}

std::optional<EnergyRise> EnergyGuard::look(const FrameStatistics& frame) {
    m_given.add(frame.ledger);
    m_least = std::min(m_least, frame.potential);
    const double corrected = std::max(0.0, m_given[LedgerAccount::PositionCorrection].energy);
    double supplied = 0;
    for (const LedgerAccount account : m_suppliers) supplied += std::max(0.0, m_given[account].energy);
    supplied = std::min(supplied, m_carried + std::max(0.0, frame.potential - m_potential));
    const double rise = frame.kinetic + frame.potential - m_start - corrected - supplied;
    const double scale = m_scale + (m_potential - m_least) + supplied;
    if (m_hasRisen || !(rise > mostEnergyRise * scale)) return std::nullopt;
    m_hasRisen = true;
    EnergyRise found{.frame = frame.frame, .energy = rise, .scale = scale, .account = {}};
    double most = 0;
    for (std::size_t k = 0; k < ledgerAccounts; ++k) {
        const LedgerAccount account = static_cast<LedgerAccount>(k);
        if (account == LedgerAccount::PositionCorrection || !(m_given[account].energy > most)) continue;
        most = m_given[account].energy;
        found.account = account;
    }
    return found;
}

std::string describe(const EnergyRise& rise) {
    std::string text = "gained " + figure(rise.energy) + " J by frame " + std::to_string(rise.frame) +
                       ", where it had " + figure(rise.scale) + " J to spend";
    if (rise.account) text += "; most of it by " + std::string(nameOf(*rise.account));
    return text;
}

} // namespace carom
