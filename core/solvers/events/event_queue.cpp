// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/events/event_queue.h"

#include <bit>

namespace carom {

// Three days a body: with one or two events a day most of the tail of the distribution of waiting times falls
// into the year. At half, more events wait in the list of what is beyond it; at twice, the days take twice
// the memory. With few bodies there are at least `fewest` days, of four bytes each.
void EventQueue::restart(EventRecords records, double daysPerSecond, double now) {
    constexpr std::size_t daysPerBody = 3, fewest = 64;
    const std::size_t days = std::bit_ceil(std::max(fewest, daysPerBody * records.size()));
    m_days.assign(days + 1, nobody);
    for (EventRecord& record : records) record.queuePrevious = nobody;
    m_mask = static_cast<std::uint32_t>(days - 1);
    m_beyond = static_cast<std::uint32_t>(days);
    m_daysPerSecond = daysPerSecond;
    m_today = static_cast<std::int64_t>(now * daysPerSecond);
    m_count = 0;
    m_sorted = m_today + static_cast<std::int64_t>(days / 2);
    m_yearEnd = static_cast<double>(m_today) + static_cast<double>(days);
}

// The first half of the ring buffer is past, so its days are used for the next half year.
void EventQueue::sortBeyond(EventRecords records) {
    m_sorted = m_today + (m_mask + 1) / 2;
    m_yearEnd = static_cast<double>(m_today) + static_cast<double>(m_mask);
    std::uint32_t i = m_days[m_beyond];
    while (i != nobody) {
        const std::uint32_t next = records[i].queueNext;
        if (records[i].earliest() * m_daysPerSecond < m_yearEnd) {
            remove(records, i);
            insert(records, i);
        }
        i = next;
    }
}

} // namespace carom
