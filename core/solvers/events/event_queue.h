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
// Time is divided into equal days; a day is a list of the events on it; the year is a ring buffer of days. An
// event beyond the year is kept in a separate list, which is sorted into days every half year.
//
//     today
//       v
//     [ 3 ][   ][ 7 1 ][   ][ 0 ] ...    beyond: 2 5
//
// Setting and removing an event take a few writes. When a day comes that has more than a few events, those
// are put in order, in a heap: they may be thousands where a scene repeats itself, as racks that are broken
// at one time. The links are in the records, where the times are; every call gets the same ones.

namespace carom {

class EventQueue {
  public:
    static constexpr std::uint32_t nobody = EventRecord::nobody;

    /// Empties the queue. `daysPerSecond` [1/s]: best about one or two events a day. Nothing happens before
    /// `now` [s].
    void restart(EventRecords records, double daysPerSecond, double now);

    /// Takes body i out; its times may then change.
    void remove(EventRecords records, std::uint32_t i) {
        EventRecord& record = records[i];
        if (record.queuePrevious == nobody) return;
        if (record.queuePrevious == EventRecord::inOrder) return removeFromOrder(records, i);
        if ((record.queuePrevious & EventRecord::dayMark) != 0)
            m_days[record.queuePrevious & ~EventRecord::dayMark] = record.queueNext;
        else
            records[record.queuePrevious].queueNext = record.queueNext;
        if (record.queueNext != nobody) records[record.queueNext].queuePrevious = record.queuePrevious;
        record.queuePrevious = nobody;
        --m_count;
    }
    /// Puts body i, which is not in the queue, in at the earliest of its times; one that is infinite is no
    /// event.
    void insert(EventRecords records, std::uint32_t i) {
        EventRecord& record = records[i];
        const double day = record.earliest() * m_daysPerSecond;
        if (!(day < never)) return;
        std::uint32_t slot = m_beyond;
        if (day < m_yearEnd) // a day past can only be meant where rounding put an event just before now
            slot = static_cast<std::uint32_t>(std::max(static_cast<std::int64_t>(day), m_today)) & m_mask;
        std::uint32_t& first = m_days[slot];
        record.queueNext = first;
        record.queuePrevious = slot | EventRecord::dayMark;
        if (first != nobody) records[first].queuePrevious = i;
        first = i;
        ++m_count;
    }

    /// The body with the earliest event not after `limit`, or nobody. Of equal times the one of lowest rank
    /// wins, and of several pairs the one that `before(i, j)` says; a strict order. The first events of later
    /// days are passed to `preview(i, soon)`: once some days before, and again when they are near.
    template<class Before, class Preview>
    std::uint32_t earliest(EventRecords records, double limit, const Before& before, const Preview& preview) {
        if (m_count == 0) return nobody;
        const double lastDay = limit * m_daysPerSecond;
        for (;;) {
            const std::uint32_t first = m_days[static_cast<std::uint32_t>(m_today) & m_mask];
            if (first != nobody && m_order.empty() && isFew(records, first))
                return earliestOf(records, first, limit, before);
            if (first != nobody) putInOrder(records, first);
            if (!m_order.empty()) {
                m_second = never;
                for (std::size_t k = 1; k < std::min<std::size_t>(3, m_order.size()); ++k)
                    m_second = std::min(m_second, m_order[k].time);
                if (!(m_order.front().time <= limit)) return nobody;
                std::uint32_t best = m_order.front().body;
                for (const std::size_t child : {1, 2}) findBest(child, before, best);
                return best;
            }
            if (static_cast<double>(m_today) >= lastDay) return nobody;
            if (++m_today >= m_sorted) sortBeyond(records);
            for (const std::int64_t days : ahead) {
                const std::uint32_t later = m_days[static_cast<std::uint32_t>(m_today + days) & m_mask];
                if (later != nobody) preview(later, days == ahead.back());
            }
        }
    }
    /// Just after earliest(): whether it may not have been the only event up to `limit`, which is a little
    /// later.
    bool mayHaveMore(double limit) const {
        return m_second <= limit || limit * m_daysPerSecond >= static_cast<double>(m_today + 1);
    }

    std::size_t bytes() const { return heldBytes(m_days, m_order); }

  private:
    /// Days ahead of which events are passed to `preview`. Twice or half changes the time only: at half what
    /// is fetched may arrive late, at twice it may be evicted before it is used.
    static constexpr std::array<std::int64_t, 2> ahead = {4, 2};

    /// An event of today, as it was when it was put in order.
    struct Event {
        double time = 0;
        std::uint64_t rank = 0;
        std::uint32_t body = 0;

        bool operator<(const Event& other) const {
            return time != other.time ? time < other.time : rank < other.rank;
        }
    };

    /// Days of up to so many events are looked through each time, as most have one or two. At half or twice,
    /// a gas takes a hundredth more.
    static constexpr int few = 4;
    static bool isFew(EventRecords records, std::uint32_t first) {
        int count = 1;
        for (std::uint32_t i = records[first].queueNext; i != nobody; i = records[i].queueNext)
            if (++count > few) return false;
        return true;
    }
    template<class Before>
    std::uint32_t earliestOf(EventRecords records, std::uint32_t first, double limit, const Before& before) {
        std::uint32_t best = first;
        double bestTime = records[best].earliest(), second = never;
        const auto isBefore = [&](std::uint32_t i) {
            const std::uint64_t rank = records[i].rank(i), bestRank = records[best].rank(best);
            return rank != bestRank ? rank < bestRank : before(i, best);
        };
        for (std::uint32_t i = records[first].queueNext; i != nobody; i = records[i].queueNext) {
            const double time = records[i].earliest();
            if (time > bestTime || (time == bestTime && !isBefore(i))) {
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
    void sortBeyond(EventRecords records);
    void putInOrder(EventRecords records, std::uint32_t first);
    void removeFromOrder(EventRecords records, std::uint32_t i);
    void rise(EventRecords records, std::size_t place, const Event& event);
    void sink(EventRecords records, std::size_t place, const Event& event);
    void put(EventRecords records, std::size_t place, const Event& event) {
        m_order[place] = event;
        records[event.body].queueNext = static_cast<std::uint32_t>(place);
    }
    /// Of the events at this place and below that are equal to the first one.
    template<class Before>
    void findBest(std::size_t place, const Before& before, std::uint32_t& best) const {
        if (place >= m_order.size() || m_order.front() < m_order[place]) return;
        if (before(m_order[place].body, best)) best = m_order[place].body;
        findBest(2 * place + 1, before, best);
        findBest(2 * place + 2, before, best);
    }

    std::vector<std::uint32_t> m_days; ///< first body of each day; the last list is `beyond`
    std::vector<Event> m_order;        ///< of today: a heap, each no later than those at 2k + 1 and 2k + 2
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
