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
    m_order.clear();
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

// Moves the events of a list to those in order.
void EventQueue::putInOrder(EventRecords records, std::uint32_t first) {
    m_days[static_cast<std::uint32_t>(m_today) & m_mask] = nobody;
    for (std::uint32_t i = first; i != nobody;) {
        EventRecord& record = records[i];
        const std::uint32_t next = record.queueNext;
        record.queuePrevious = EventRecord::inOrder;
        m_order.emplace_back();
        rise(records, m_order.size() - 1, {record.earliest(), record.rank(i), i});
        i = next;
    }
}

void EventQueue::removeFromOrder(EventRecords records, std::uint32_t i) {
    const std::size_t place = records[i].queueNext;
    records[i].queuePrevious = nobody;
    --m_count;
    const Event last = m_order.back();
    m_order.pop_back();
    if (place == m_order.size()) return;
    if (place > 0 && last < m_order[(place - 1) / 2])
        rise(records, place, last);
    else
        sink(records, place, last);
}

// Puts an event at this place, or above it.
void EventQueue::rise(EventRecords records, std::size_t place, const Event& event) {
    while (place > 0 && event < m_order[(place - 1) / 2]) {
        put(records, place, m_order[(place - 1) / 2]);
        place = (place - 1) / 2;
    }
    put(records, place, event);
}

// Puts an event at this place, or below it.
void EventQueue::sink(EventRecords records, std::size_t place, const Event& event) {
    for (std::size_t child = 2 * place + 1; child < m_order.size(); child = 2 * place + 1) {
        if (child + 1 < m_order.size() && m_order[child + 1] < m_order[child]) ++child;
        if (!(m_order[child] < event)) break;
        put(records, place, m_order[child]);
        place = child;
    }
    put(records, place, event);
}

} // namespace carom
