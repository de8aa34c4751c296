// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/event_queue.h"

#include "core/base/assert.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace carom {

void EventQueue::restart(std::size_t count, std::uint32_t daysPerSecond) {
    constexpr std::size_t daysPerBody = 4; // half an event a day: most of the year's tail fits
    m_entries.assign(count, Entry{});
    const std::size_t days = std::bit_ceil(std::max<std::size_t>(64, daysPerBody * count));
    m_days.assign(days + 1, nobody);
    m_mask = static_cast<std::uint32_t>(days - 1);
    m_beyond = static_cast<std::uint32_t>(days);
    m_daysPerSecond = std::max(1U, daysPerSecond);
    m_today = 0;
    m_count = 0;
    m_sorted = static_cast<std::int64_t>(days / 2);
}

std::int64_t EventQueue::dayOf(double time) const {
    constexpr double farAway = 0x1p60;
    const double day = std::floor(time * m_daysPerSecond);
    if (!(day < farAway)) return std::numeric_limits<std::int64_t>::max() / 2;
    return static_cast<std::int64_t>(day);
}

void EventQueue::set(std::uint32_t i, double time) {
    if (m_entries[i].slot != nobody) remove(i);
    m_entries[i].time = time;
    if (time < std::numeric_limits<double>::infinity()) insert(i, time);
}

void EventQueue::remove(std::uint32_t i) {
    Entry& entry = m_entries[i];
    if (entry.previous == nobody)
        m_days[entry.slot] = entry.next;
    else
        m_entries[entry.previous].next = entry.next;
    if (entry.next != nobody) m_entries[entry.next].previous = entry.previous;
    entry.slot = nobody;
    --m_count;
}

void EventQueue::insert(std::uint32_t i, double time) {
    const std::int64_t day = std::max(dayOf(time), m_today);
    const bool thisYear = day - m_today <= m_mask;
    Entry& entry = m_entries[i];
    entry.slot = thisYear ? slotOf(day) : m_beyond;
    entry.previous = nobody;
    entry.next = m_days[entry.slot];
    if (entry.next != nobody) m_entries[entry.next].previous = i;
    m_days[entry.slot] = i;
    ++m_count;
}

void EventQueue::nextDay() {
    ++m_today;
    if (m_today >= m_sorted) sortBeyond();
}

void EventQueue::sortBeyond() {
    m_sorted = m_today + (m_mask + 1) / 2;
    std::uint32_t i = m_days[m_beyond];
    while (i != nobody) {
        const std::uint32_t next = m_entries[i].next;
        if (dayOf(m_entries[i].time) - m_today <= m_mask) {
            remove(i);
            insert(i, m_entries[i].time);
        }
        i = next;
    }
}

std::size_t EventQueue::memoryBytes() const {
    return m_entries.capacity() * sizeof(Entry) + m_days.capacity() * sizeof(std::uint32_t);
}

} // namespace carom
