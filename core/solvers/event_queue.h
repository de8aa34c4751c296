// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
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
// Setting and removing an event take a few writes; finding the earliest takes a walk over one short list.

namespace carom {

class EventQueue {
  public:
    static constexpr std::uint32_t nobody = 0xffffffffU;

    /// Empties the queue, for bodies 0 .. count-1. `daysPerSecond` is whole, so that a shift of the clock by
    /// a second moves every event by the same number of days.
    void restart(std::size_t count, std::uint32_t daysPerSecond);

    /// Gives body i its next event at `time` [s], which replaces the one it had; an infinite time is none.
    void set(std::uint32_t i, double time);
    double timeOf(std::uint32_t i) const { return m_entries[i].time; }

    /// The body with the earliest event not after `limit`, or nobody. Of equal times the one wins that
    /// `before(i, j)` says; a strict order.
    template<class Before>
    std::uint32_t earliest(double limit, const Before& before) {
        if (m_count == 0) return nobody;
        for (;;) {
            std::uint32_t best = nobody;
            for (std::uint32_t i = m_days[slotOf(m_today)]; i != nobody; i = m_entries[i].next) {
                const bool wins = best == nobody || m_entries[i].time < m_entries[best].time ||
                                  (m_entries[i].time == m_entries[best].time && before(i, best));
                if (wins) best = i;
            }
            if (best != nobody) return m_entries[best].time <= limit ? best : nobody;
            if (m_today >= dayOf(limit)) return nobody;
            nextDay();
        }
    }

    /// Sets the clock back: every event is now `seconds` earlier. The events' own times are exact to
    /// rounding.
    void shift(std::int32_t seconds);

    std::size_t memoryBytes() const;

  private:
    struct Entry {
        double time = 0;
        std::uint32_t next = nobody;
        std::uint32_t previous = nobody; ///< nobody: the first of its day
        std::uint32_t slot = nobody;     ///< nobody: not in the queue
    };

    std::int64_t dayOf(double time) const;
    std::uint32_t slotOf(std::int64_t day) const { return static_cast<std::uint32_t>(day) & m_mask; }
    void remove(std::uint32_t i);
    void insert(std::uint32_t i, double time);
    void nextDay();
    void sortBeyond();

    std::vector<Entry> m_entries;
    std::vector<std::uint32_t> m_days; ///< first body of each day; the last list is `beyond`
    std::uint32_t m_mask = 0;
    std::uint32_t m_beyond = 0;
    std::uint32_t m_daysPerSecond = 1;
    std::size_t m_count = 0; ///< events in the queue
    std::int64_t m_today = 0;
    std::int64_t m_sorted = 0; ///< the day up to which `beyond` has been looked through
};

} // namespace carom
