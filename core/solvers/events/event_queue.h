// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/held_bytes.h"
#include "core/solvers/events/event_record.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// The next event of every body, in order of time: a calendar queue (R. Brown, "Calendar queues: a fast O(1)
// priority queue implementation for the simulation event set problem", Communications of the ACM 31, 1988).
// Time is cut into equal days; a day is a list of the events that fall on it; the year is a ring of days. An
// event beyond the year waits in a list of its own that is looked through every half year.
//
//     today
//       v
//     [ 3 ][   ][ 7 1 ][   ][ 0 ] ...    beyond: 2 5
//
// Setting and removing an event take a few writes; finding the earliest takes a walk over one short list. The
// links are in the agendas, where the times are; every call gets the same ones.

namespace carom {

class EventQueue {
  public:
    static constexpr std::uint32_t nobody = Agenda::nobody;

    /// Empties the queue. `daysPerSecond` [1/s]: best about one or two events a day. Nothing happens before
    /// `now` [s].
    void restart(Agendas agendas, double daysPerSecond, double now);

    /// Takes body i out; its times may then change.
    void remove(Agendas agendas, std::uint32_t i) {
        Agenda& agenda = agendas[i];
        if (agenda.queuePrevious == nobody) return;
        if ((agenda.queuePrevious & Agenda::dayMark) != 0)
            m_days[agenda.queuePrevious & ~Agenda::dayMark] = agenda.queueNext;
        else
            agendas[agenda.queuePrevious].queueNext = agenda.queueNext;
        if (agenda.queueNext != nobody) agendas[agenda.queueNext].queuePrevious = agenda.queuePrevious;
        agenda.queuePrevious = nobody;
        --m_count;
    }
    /// Puts body i, which is not in the queue, in at the earliest of its times; one that is infinite is no
    /// event.
    void insert(Agendas agendas, std::uint32_t i) {
        Agenda& agenda = agendas[i];
        const double day = agenda.earliest() * m_daysPerSecond;
        if (!(day < never)) return;
        std::uint32_t slot = m_beyond;
        if (day < m_yearEnd) // a day past can only be meant where rounding put an event just before now
            slot = static_cast<std::uint32_t>(std::max(static_cast<std::int64_t>(day), m_today)) & m_mask;
        std::uint32_t& first = m_days[slot];
        agenda.queueNext = first;
        agenda.queuePrevious = slot | Agenda::dayMark;
        if (first != nobody) agendas[first].queuePrevious = i;
        first = i;
        ++m_count;
    }

    /// The body with the earliest event not after `limit`, or nobody. Of equal times the one wins that
    /// `before(i, j)` says; a strict order. Who is first some days later is shown to
    /// `foresee(i, soon)`: first when that is still far, then when it is soon.
    template<class Before, class Foresee>
    std::uint32_t earliest(Agendas agendas, double limit, const Before& before, const Foresee& foresee) {
        if (m_count == 0) return nobody;
        const double lastDay = limit * m_daysPerSecond;
        for (;;) {
            std::uint32_t best = m_days[static_cast<std::uint32_t>(m_today) & m_mask];
            if (best != nobody) {
                double bestTime = agendas[best].earliest(), second = never;
                for (std::uint32_t i = agendas[best].queueNext; i != nobody; i = agendas[i].queueNext) {
                    const double time = agendas[i].earliest();
                    if (time > bestTime || (time == bestTime && !before(i, best))) {
                        second = std::min(second, time);
                        continue;
                    }
                    second = bestTime;
                    best = i;
                    bestTime = time;
                }
                m_second = second;
                return bestTime <= limit ? best : nobody;
            }
            if (static_cast<double>(m_today) >= lastDay) return nobody;
            if (++m_today >= m_sorted) sortBeyond(agendas);
            for (const std::int64_t days : ahead) {
                const std::uint32_t later = m_days[static_cast<std::uint32_t>(m_today + days) & m_mask];
                if (later != nobody) foresee(later, days == ahead.back());
            }
        }
    }
    /// Just after earliest(): whether it may not have been the only event up to `limit`, a moment later.
    bool mayHaveMore(double limit) const {
        return m_second <= limit || limit * m_daysPerSecond >= static_cast<double>(m_today + 1);
    }

    std::size_t bytes() const { return heldBytes(m_days); }

  private:
    static constexpr std::array<std::int64_t, 2> ahead = {4, 2};

    void sortBeyond(Agendas agendas);

    std::vector<std::uint32_t> m_days; ///< first body of each day; the last list is `beyond`
    std::uint32_t m_mask = 0;
    std::uint32_t m_beyond = 0;
    double m_daysPerSecond = 1;
    std::size_t m_count = 0; ///< events in the queue
    std::int64_t m_today = 0;
    std::int64_t m_sorted = 0; ///< the day on which `beyond` is to be looked through again
    double m_yearEnd = 0;      ///< the first day whose events wait beyond
    double m_second = never;   ///< the time of the second earliest event of today when it was looked at last
};

} // namespace carom
