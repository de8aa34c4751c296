// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/events/event_times.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace carom {

/// The next event of a ball, and its links in the lists of the queue and the cells: one cache line, as the
/// TrajectoryOrigin is. Ball i is row i of both.
struct alignas(64) EventRecord {
    static constexpr std::uint32_t nobody = 0xffffffffU;
    /// In `last`: a wall, not a ball.
    static constexpr std::uint32_t wallMark = 0x80000000U;
    /// In `queuePrevious`: no ball but the day this one is the first of.
    static constexpr std::uint32_t dayMark = 0x80000000U;
    /// In `queuePrevious`: it is among the events of today that are in order; `queueNext` is its place there.
    static constexpr std::uint32_t inOrder = 0xfffffffeU;
    /// In `other`: no wall but the next crossing into another cell.
    static constexpr std::uint16_t crossing = 0xffff;

    double pairTime = never;  ///< [s], the earliest predicted collision with another ball
    double otherTime = never; ///< [s], the next wall, or a crossing that must be made before

    std::uint32_t partner = nobody;       ///< in that collision
    std::uint32_t partnerChanges = 0;     ///< how often that one had changed; if it has since, it is stale
    std::uint32_t changes = 0;            ///< how often this ball has got a new origin
    std::uint32_t last = nobody;          ///< the ball or wall it collided with at its origin
    std::uint32_t queueNext = nobody;     ///< on the same day
    std::uint32_t queuePrevious = nobody; ///< nobody: not in the queue
    std::array<std::int32_t, 3> place{};  ///< the cell, in endless space
    std::uint32_t material = 0;
    std::uint32_t rest = nobody;    ///< what it rests on, if it does not move freely
    std::uint16_t other = crossing; ///< what otherTime is the time of
    std::uint8_t level = 0;         ///< of its cell
    std::uint8_t tied : 1 = 0;      ///< 1: another collision was predicted for `pairTime`
    std::uint8_t upwards : 3 = 0;   ///< a bit an axis: the next crossing along it is upwards

    double earliest() const { return std::min(pairTime, otherTime); }
    /// At equal times crossings and walls come before pairs.
    bool collidesNext() const { return pairTime < otherTime; }
    /// Of equal times the event of lower rank comes first: crossings, walls, pairs; the former two by number.
    std::uint64_t rank(std::uint32_t number) const {
        if (collidesNext()) return std::uint64_t{2} << 32;
        return other == crossing ? number : (std::uint64_t{1} << 32) | number;
    }
};
static_assert(sizeof(EventRecord) == 64);

/// Of all balls. The queue and the cells keep their links in them.
using EventRecords = std::span<EventRecord>;
using ConstEventRecords = std::span<const EventRecord>;

} // namespace carom
