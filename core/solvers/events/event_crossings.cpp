// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/events/event_gas.h"

#include <algorithm>
#include <cmath>

// When balls leave their cells, and how they are put into the next ones. No motion depends on it: times here
// need not be the same to the bit whenever they are found, those of walls and meetings are.

namespace carom {
namespace {

/// A slice is long enough if in it one ball of so many passes a border: looking for them costs as much as
/// passing one then. And short enough if most of those that do can do so at its beginning.
constexpr std::size_t ballsPerBorder = 64, mostQueuedOf = 4;

} // namespace

// Borders are seen from `now`, not from the stamp: the stamp may lie cells away, on the other side of one.
void EventGas::planBorders(std::uint32_t i, double now) {
    for (int axis = 0; axis < 3; ++axis) planBorder(i, axis, now);
    noteNextBorder(i);
}

inline void EventGas::planBorder(std::uint32_t i, int axis, double now) {
    Agenda& agenda = m_agendas[i];
    const Stamp& stamp = m_stamps[i];
    const double passed = now - stamp.time, a = m_weightless ? 0 : accelerationOf(i)[axis];
    const double v = stamp.velocity[axis] + passed * a;
    const double place = stamp.position[axis] + passed * (stamp.velocity[axis] + (0.5 * passed) * a);
    const double above = place - m_cells.borderOf(agenda, axis), side = m_cells.sideOf(agenda);
    // Without an acceleration along the axis the ball leaves by the border its velocity points to. No branch
    // depends on the velocity: that would be a coin's toss to the processor.
    constexpr double least = 1e-300; // of a gap [m], so that no speed at all means never
    double time = std::max(0.5 * side + std::copysign(1.0, v) * (0.5 * side - above), least) / std::abs(v);
    unsigned upwards = v > 0 ? 1 : 0;
    if (a != 0 && std::isfinite(v * v)) { // else it is nothing to such a speed
        const double down = timeToPlane(above, v, a), up = timeToPlane(side - above, -v, -a);
        upwards = up < down ? 1 : 0;
        time = std::min(up, down);
    }
    if (EventCells::isOutermost(agenda, axis)) time = never;
    m_borders[i][static_cast<std::size_t>(axis)] = now + time;
    const unsigned others = agenda.upwards & ~(1U << axis);
    agenda.upwards = static_cast<std::uint8_t>((others | upwards << axis) & 7U);
}

inline void EventGas::noteNextBorder(std::uint32_t i) {
    const std::array<double, 3>& at = m_borders[i];
    m_nextBorders[i] = std::min(std::min(at[0], at[1]), at[2]);
}

inline EventGas::Passage EventGas::nextPassage(std::uint32_t i) const {
    const std::array<double, 3>& at = m_borders[i];
    const int notX = at[0] != m_nextBorders[i] ? 1 : 0, notY = at[1] != m_nextBorders[i] ? 1 : 0;
    const int axis = notX * (1 + notY);
    return {axis, 2 * (m_agendas[i].upwards >> axis & 1) - 1};
}

// Whether the ball is so near its next border that it may count as behind it.
inline bool EventGas::mayPassEarly(std::uint32_t i, int axis, double now) const {
    const Stamp& stamp = m_stamps[i];
    const double until = m_nextBorders[i] - now, a = accelerationOf(i)[axis];
    const double speed = std::abs(stamp.velocity[axis] + (now - stamp.time) * a) + std::abs(a) * until;
    return until * speed <= m_cells.tolerance(m_agendas[i].level);
}

// Into the next cell; the border after it is seen from this one, however early it is passed: else a ball that
// is about to turn at one would be put to and fro.
inline void EventGas::passBorder(std::uint32_t i, Passage next) {
    ++m_counts.crossings;
    const Agenda& agenda = m_agendas[i];
    m_cells.cross(m_agendas, i, next.axis, next.direction);
    if (accelerationOf(i)[next.axis] != 0 || EventCells::isOutermost(agenda, next.axis))
        planBorder(i, next.axis, m_nextBorders[i]);
    else
        m_borders[i][static_cast<std::size_t>(next.axis)] =
            m_nextBorders[i] + m_cells.sideOf(agenda) / std::abs(m_stamps[i].velocity[next.axis]);
    noteNextBorder(i);
}

void EventGas::passEarly(std::uint32_t i, double now) {
    while (m_nextBorders[i] < m_sliceEnd) {
        const Passage next = nextPassage(i);
        if (!mayPassEarly(i, next.axis, now)) return;
        passBorder(i, next);
    }
}

// Whatever borders there are in this slice.
void EventGas::passBorders(std::uint32_t i, double now) {
    while (m_nextBorders[i] < m_sliceEnd) {
        const Passage next = nextPassage(i);
        if (!mayPassEarly(i, next.axis, now)) return considerBorder(i);
        const unsigned known = m_cells.wallsNear(m_agendas[i]);
        passBorder(i, next);
        m_cells.newlyAround(m_agendas, i, next.axis, next.direction,
                            [&](std::uint32_t j) { considerPair(i, j); });
        considerWalls(i, m_cells.wallsNear(m_agendas[i]) & ~known);
    }
}

// The next border as an event of its own.
void EventGas::considerBorder(std::uint32_t i) {
    Agenda& agenda = m_agendas[i];
    if (!(m_nextBorders[i] < agenda.otherTime)) return;
    agenda.otherTime = m_nextBorders[i];
    agenda.other = Agenda::border;
    ++m_queuedBorders;
}

void EventGas::crossCell(std::uint32_t i) {
    const double now = m_agendas[i].otherTime;
    const Passage next = nextPassage(i);
    passBorder(i, next);
    m_cells.newlyAround(m_agendas, i, next.axis, next.direction,
                        [&](std::uint32_t j) { considerPair(i, j); });
    planWalls(i);
    passBorders(i, now);
    m_queue.insert(m_agendas, i);
}

// Without a branch a ball: which of them pass is a toss to the processor.
void EventGas::findPassing() {
    m_passing.resize(m_nextBorders.size());
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < m_nextBorders.size(); ++i) {
        m_passing[count] = i;
        count += m_nextBorders[i] < m_sliceEnd ? 1 : 0;
    }
    m_passing.resize(count);
}

void EventGas::beginSlice() {
    m_now = m_sliceEnd;
    m_sliceEnd = m_now + m_slice;
    findPassing();
    const std::size_t queued = m_queuedBorders;
    m_queuedBorders = 0;
    for (std::size_t k = 0; k < m_passing.size(); ++k) {
        constexpr std::size_t soon = 4, later = 8; // what is far away is on its way in time
        if (k + later < m_passing.size()) {
            __builtin_prefetch(&m_agendas[m_passing[k + later]]);
            __builtin_prefetch(&m_stamps[m_passing[k + later]]);
        }
        if (k + soon < m_passing.size()) m_cells.prefetch(m_agendas[m_passing[k + soon]]);
        const std::uint32_t i = m_passing[k];
        const double before = m_agendas[i].earliest();
        passBorders(i, m_now);
        if (m_agendas[i].earliest() == before) continue;
        m_queue.remove(m_agendas, i);
        m_queue.insert(m_agendas, i);
    }
    const std::size_t passed = m_passing.size();
    m_lookedAt += passed + m_stamps.size() / ballsPerBorder;
    if (ballsPerBorder * (passed + queued) < m_stamps.size())
        m_slice = std::min(2 * m_slice, m_clockTurn);
    else if (mostQueuedOf * queued > passed)
        m_slice *= 0.5;
}

} // namespace carom
