// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/events/event_times.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace carom {

/// What a ball is about to do, and where it stands in the lists of the queue and the cells: one cache line,
/// as the Stamp is. Ball i is row i of both.
struct alignas(64) Agenda {
    static constexpr std::uint32_t nobody = 0xffffffffU;
    /// In `last`: a wall, not a ball.
    static constexpr std::uint32_t wallMark = 0x80000000U;
    /// In `queuePrevious`: no ball but the day this one is the first of.
    static constexpr std::uint32_t dayMark = 0x80000000U;
    /// In `other`: no wall but the next border of the ball's cell.
    static constexpr std::uint16_t border = 0xffff;

    double pairTime = never;  ///< [s], the earliest meeting with another ball it has found
    double otherTime = never; ///< [s], the next wall, or a border that must be crossed before

    std::uint32_t partner = nobody;   ///< of the meeting
    std::uint32_t partnerChanges = 0; ///< how often that one had changed; if it has since, the meeting is off
    std::uint32_t changes = 0;        ///< how often this ball has got a new stamp
    std::uint32_t last = nobody;      ///< the ball or wall this ball's stamp was made at
    std::uint32_t queueNext = nobody; ///< on the same day
    std::uint32_t queuePrevious = nobody; ///< nobody: not in the queue
    std::array<std::int32_t, 3> place{};  ///< the cell, in endless space
    std::uint32_t material = 0;
    std::uint32_t rest = nobody;  ///< what it rests on, if it does not fly free
    std::uint16_t other = border; ///< what otherTime is the time of
    std::uint8_t level = 0;       ///< of its cell
    std::uint8_t tied : 1 = 0;    ///< 1: it saw another meeting at the time of `pairTime`
    std::uint8_t upwards : 3 = 0; ///< a bit an axis: the next border along it is the upper one

    double earliest() const { return std::min(pairTime, otherTime); }
    /// At equal times borders and walls come before pairs.
    bool meetsNext() const { return pairTime < otherTime; }
};
static_assert(sizeof(Agenda) == 64);

/// Of all balls. The queue and the cells keep their links in them.
using Agendas = std::span<Agenda>;
using ConstAgendas = std::span<const Agenda>;

} // namespace carom
