// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/still_bodies.h"

#include "core/solvers/contacts/stepped_islands.h"

#include <utility>

namespace carom {
namespace {

/// Weight of a sample in the mean; the default is four substeps a frame, so the mean is over about one frame.
/// At twice as much the errors of the sweeps wake bodies of a heap that lie still; at half, a body moves on
/// later when a load changes.
constexpr double sampleWeight = 0.25;

} // namespace

void StillBodies::begin() {
    m_is.assign(1, 1);
    m_isChanged.assign(1, 0);
    m_lasting.assign(1, {});
    m_passing.assign(1, {});
    m_pressed.isKnown = false;
    m_count = 0;
}

void StillBodies::add() {
    m_is.push_back(0);
    m_isChanged.push_back(0);
    m_lasting.emplace_back();
    m_passing.emplace_back();
    m_pressed.isKnown = false;
}

void StillBodies::leave(std::span<const std::uint32_t> newNumbers, std::size_t kept) {
    for (std::size_t i = 1; i < m_is.size(); ++i) {
        const std::uint32_t number = newNumbers[i];
        if (number == SteppedIslands::gone) continue;
        m_is[number] = m_is[i];
        m_lasting[number] = m_lasting[i];
        m_passing[number] = m_passing[i];
    }
    m_is.resize(kept);
    m_isChanged.assign(kept, 1);
    m_isChanged[0] = 0;
    m_lasting.resize(kept);
    m_passing.resize(kept);
    m_pressed.isKnown = false;
    m_count = 0;
    for (std::size_t i = 1; i < kept; ++i) m_count += m_is[i];
}

void StillBodies::findPressed() {
    if (std::exchange(m_pressed.isKnown, true)) return;
    m_pressed.list.clear();
    m_pressed.is.assign(m_is.size(), 0);
    m_sample.resize(m_is.size());
    for (std::uint32_t i = 1; i < m_is.size(); ++i)
        if (m_passing[i].borne > 0) press(i);
}

void StillBodies::beginSamples() {
    if (!m_pressed.isKnown) m_sample.clear();
    findPressed();
    for (const std::uint32_t i : m_pressed.list) m_sample[i] = {};
}

void StillBodies::takeSamples() {
    for (const std::uint32_t i : m_pressed.list) {
        if (m_is[i] == 0 || !(m_sample[i].borne > 0 || m_passing[i].borne > 0)) continue;
        m_passing[i].force += sampleWeight * (m_sample[i].force - m_passing[i].force);
        m_passing[i].borne += sampleWeight * (m_sample[i].borne - m_passing[i].borne);
        m_passing[i].torque += sampleWeight * (m_sample[i].torque - m_passing[i].torque);
    }
}

bool StillBodies::isUnbalanced(std::uint32_t number, double weight, double size, double part) const {
    const Vec3 force = m_lasting[number].force + m_passing[number].force;
    const Vec3 torque = m_lasting[number].torque + m_passing[number].torque;
    const double most = part * (weight + 0.5 * (m_lasting[number].borne + m_passing[number].borne));
    return force.norm() > most || torque.norm() > most * size;
}

} // namespace carom
