// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/events/event_gas.h"

#include <algorithm>
#include <cmath>

// When balls leave their cells, and how they are put into the next ones. No motion depends on it: times here
// need not be the same to the bit whenever they are found, those of walls and collisions are.

namespace carom {
namespace {

/// A slice is long enough if in it one ball of so many crosses into another cell: the search costs as much as
/// one crossing then. And short enough if at most one crossing in so many must be queued. Twice or half of
/// either costs time only.
constexpr std::size_t ballsPerCrossing = 64, mostQueuedOf = 4;
/// Cells that a ball crosses at once at most; then its next crossing is queued, where the work of a call is
/// bounded. It is a few in a slice, except for a ball so fast that no time passes between two cells. Twice or
/// half changes nothing else.
constexpr int mostAtOnce = 10'000;

} // namespace

// Crossings are predicted from `now`, not from the origin, which may lie several cells away.
void EventGas::planCrossings(std::uint32_t i, double now) {
    for (int axis = 0; axis < 3; ++axis) planCrossing(i, axis, now);
    noteNextCrossing(i);
}

inline void EventGas::planCrossing(std::uint32_t i, int axis, double now) {
    EventRecord& record = m_records[i];
    const TrajectoryOrigin& origin = m_origins[i];
    const double passed = now - origin.time, a = m_weightless ? 0 : accelerationOf(i)[axis];
    const double v = origin.velocity[axis] + passed * a;
    const double place = origin.position[axis] + passed * (origin.velocity[axis] + (0.5 * passed) * a);
    const double above = place - m_cells.lowerFaceOf(record, axis), side = m_cells.sideOf(record);
    // Without an acceleration along the axis the ball leaves through the face its velocity points to. No
    // branch depends on the velocity: the processor would mispredict every second one.
    constexpr double least = 1e-300; // of a gap [m], so that no speed at all means never
    double time = std::max(0.5 * side + std::copysign(1.0, v) * (0.5 * side - above), least) / std::abs(v);
    unsigned upwards = v > 0 ? 1 : 0;
    if (a != 0 && std::isfinite(v * v)) { // else it is nothing to such a speed
        const double down = timeToPlane(above, v, a), up = timeToPlane(side - above, -v, -a);
        upwards = up < down ? 1 : 0;
        time = std::min(up, down);
    }
    if (EventCells::isOutermost(record, axis)) time = never;
    m_crossings[i][static_cast<std::size_t>(axis)] = now + time;
    const unsigned others = record.upwards & ~(1U << axis);
    record.upwards = static_cast<std::uint8_t>((others | upwards << axis) & 7U);
}

inline void EventGas::noteNextCrossing(std::uint32_t i) {
    const std::array<double, 3>& at = m_crossings[i];
    m_nextCrossings[i] = std::min(std::min(at[0], at[1]), at[2]);
}

inline EventGas::Crossing EventGas::nextCrossing(std::uint32_t i) const {
    const std::array<double, 3>& at = m_crossings[i];
    const int notX = at[0] != m_nextCrossings[i] ? 1 : 0, notY = at[1] != m_nextCrossings[i] ? 1 : 0;
    const int axis = notX * (1 + notY);
    return {axis, 2 * (m_records[i].upwards >> axis & 1) - 1};
}

// Whether the ball is so near the next cell that it may be put into it already.
inline bool EventGas::mayCrossEarly(std::uint32_t i, int axis, double now) const {
    const TrajectoryOrigin& origin = m_origins[i];
    const double until = m_nextCrossings[i] - now, a = accelerationOf(i)[axis];
    const double speed = std::abs(origin.velocity[axis] + (now - origin.time) * a) + std::abs(a) * until;
    return until * speed <= m_cells.tolerance(m_records[i].level);
}

// Into the next cell. The crossing after it is predicted from the time of this one, however early this one is
// made: otherwise a ball that is about to turn there would change cells back and forth.
inline void EventGas::crossNext(std::uint32_t i, Crossing next) {
    ++m_counts.crossings;
    const EventRecord& record = m_records[i];
    m_cells.cross(m_records, i, next.axis, next.direction);
    if (accelerationOf(i)[next.axis] != 0 || EventCells::isOutermost(record, next.axis))
        planCrossing(i, next.axis, m_nextCrossings[i]);
    else
        m_crossings[i][static_cast<std::size_t>(next.axis)] =
            m_nextCrossings[i] + m_cells.sideOf(record) / std::abs(m_origins[i].velocity[next.axis]);
    noteNextCrossing(i);
}

void EventGas::crossEarly(std::uint32_t i, double now) {
    for (int passed = 0; passed < mostAtOnce && m_nextCrossings[i] < m_sliceEnd; ++passed) {
        const Crossing next = nextCrossing(i);
        if (!mayCrossEarly(i, next.axis, now)) return;
        crossNext(i, next);
    }
}

// All crossings of this slice.
void EventGas::crossAll(std::uint32_t i, double now) {
    for (int passed = 0; m_nextCrossings[i] < m_sliceEnd; ++passed) {
        const Crossing next = nextCrossing(i);
        if (passed == mostAtOnce || !mayCrossEarly(i, next.axis, now)) return queueCrossing(i);
        const unsigned known = m_cells.wallsNear(m_records[i]);
        crossNext(i, next);
        m_cells.newlyAround(m_records, i, next.axis, next.direction,
                            [&](std::uint32_t j) { considerPair(i, j); });
        considerWalls(i, m_cells.wallsNear(m_records[i]) & ~known);
    }
}

// The next crossing as an event of its own.
void EventGas::queueCrossing(std::uint32_t i) {
    EventRecord& record = m_records[i];
    if (!(m_nextCrossings[i] < record.otherTime)) return;
    record.otherTime = m_nextCrossings[i];
    record.other = EventRecord::crossing;
    ++m_queuedCrossings;
}

void EventGas::crossCell(std::uint32_t i) {
    const double now = m_records[i].otherTime;
    const Crossing next = nextCrossing(i);
    crossNext(i, next);
    m_cells.newlyAround(m_records, i, next.axis, next.direction,
                        [&](std::uint32_t j) { considerPair(i, j); });
    planWalls(i);
    crossAll(i, now);
    m_queue.insert(m_records, i);
}

// Without a branch a ball: which of them cross cannot be predicted by the processor.
void EventGas::findCrossing() {
    m_crossing.resize(m_nextCrossings.size());
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < m_nextCrossings.size(); ++i) {
        m_crossing[count] = i;
        count += m_nextCrossings[i] < m_sliceEnd ? 1 : 0;
    }
    m_crossing.resize(count);
}

void EventGas::beginSlice() {
    m_now = m_sliceEnd;
    m_sliceEnd = m_now + m_slice;
    findCrossing();
    const std::size_t queued = m_queuedCrossings;
    m_queuedCrossings = 0;
    for (std::size_t k = 0; k < m_crossing.size(); ++k) {
        // Balls ahead of the present one whose cells and records are prefetched: early enough to arrive in
        // time. Twice or half changes the time only.
        constexpr std::size_t soon = 4, later = 8;
        if (k + later < m_crossing.size()) {
            __builtin_prefetch(&m_records[m_crossing[k + later]]);
            __builtin_prefetch(&m_origins[m_crossing[k + later]]);
        }
        if (k + soon < m_crossing.size()) m_cells.prefetch(m_records[m_crossing[k + soon]]);
        const std::uint32_t i = m_crossing[k];
        const double before = m_records[i].earliest();
        const std::uint64_t rank = m_records[i].rank(i);
        crossAll(i, m_now);
        if (m_records[i].earliest() == before && m_records[i].rank(i) == rank) continue;
        m_queue.remove(m_records, i);
        m_queue.insert(m_records, i);
    }
    const std::size_t crossed = m_crossing.size();
    m_lookedAt += crossed + m_origins.size() / ballsPerCrossing;
    if (ballsPerCrossing * (crossed + queued) < m_origins.size())
        m_slice = std::min(2 * m_slice, m_clockTurn);
    else if (mostQueuedOf * queued > crossed)
        m_slice *= 0.5;
}

} // namespace carom
