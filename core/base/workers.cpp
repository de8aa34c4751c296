// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/workers.h"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

// One loop after another is opened for the other threads. Each thread that is free, the caller's among them,
// takes the next part of it until there is none; the caller then closes the loop, and waits for those that
// are still inside. So no loop waits for a thread that has not begun, and one that comes too late does
// nothing.
//
// A frame has hundreds of loops of some microseconds, with serial work between them. Waking a thread that
// sleeps takes longer than such a loop, so threads first wait awake for the next one.

namespace carom {

namespace {

/// How long a thread waits awake. A loop that wakes one takes some 12 us longer. At a tenth, threads fall
/// asleep in the serial work of most frames; at ten times, programs that do little keep processors busy.
constexpr std::chrono::microseconds patience{500};

std::size_t processors() {
    cpu_set_t available;
    if (sched_getaffinity(0, sizeof available, &available) == 0)
        return static_cast<std::size_t>(CPU_COUNT(&available));
    return std::max(1U, std::thread::hardware_concurrency());
}

/// Whether a number changes within about a microsecond.
bool changesSoon(const std::atomic<std::uint32_t>& number, std::uint32_t from) {
    for (int turn = 0; turn < 64; ++turn) {
        if (number.load(std::memory_order_acquire) != from) return true;
#ifdef __x86_64__
        __builtin_ia32_pause();
#endif
    }
    return false;
}

} // namespace

/// The threads beside the caller's.
class Workers::Team {
  public:
    explicit Team(std::size_t threads) {
        m_threads.reserve(threads - 1);
        try {
            for (std::size_t thread = 1; thread < threads; ++thread)
                m_threads.emplace_back([this, thread] { run(thread); });
        } catch (const std::exception&) { // the machine has no more: fewer do the work
        }
    }
    ~Team() {
        m_isOver = true;
        m_loop += 2;
        m_loop.notify_all();
        for (std::thread& thread : m_threads) thread.join();
    }
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;

    void share(std::size_t parts, Call work) {
        m_work = work;
        m_parts = parts;
        m_taken.store(0, std::memory_order_relaxed);
        ++m_loop;
        m_loop.notify_all();
        take(0);
        ++m_loop;
        for (std::uint32_t inside = 0; (inside = m_inside) > 0;)
            if (!changesSoon(m_inside, inside)) std::this_thread::yield();
        if (m_failure != nullptr) std::rethrow_exception(std::exchange(m_failure, nullptr));
    }

  private:
    static bool isOpen(std::uint32_t loop) { return loop % 2 == 1; }

    void run(std::size_t thread) {
        for (std::uint32_t last = 0; waitForOther(last);) {
            ++m_inside;
            const std::uint32_t loop = m_loop; // it may be closed by now, or another one: none is closed and
                                               // opened again while somebody is inside
            if (isOpen(loop)) take(thread);
            last = loop;
            --m_inside;
        }
    }

    // Waits until a loop is open that is not this one. False if there will be none.
    bool waitForOther(std::uint32_t last) const {
        using Clock = std::chrono::steady_clock;
        Clock::time_point begin = Clock::now();
        for (std::uint32_t before = last;;) {
            const std::uint32_t loop = m_loop;
            if (m_isOver) return false; // set before the loop changed for the last time
            if (isOpen(loop) && loop != last) return true;
            if (loop != before) begin = Clock::now(); // one passed by: there will be more
            before = loop;
            if (changesSoon(m_loop, loop)) continue;
            if (Clock::now() - begin < patience)
                std::this_thread::yield();
            else
                m_loop.wait(loop);
        }
    }

    void take(std::size_t thread) {
        try {
            const std::uint64_t one = thread % 2 == 0 ? 1 : fromEnd;
            while (true) {
                const std::uint64_t taken = m_taken.fetch_add(one, std::memory_order_relaxed);
                const std::size_t front = taken % fromEnd, back = taken / fromEnd;
                if (front + back >= m_parts) return;
                m_work.call(m_work.context, thread, one == 1 ? front : m_parts - 1 - back);
            }
        } catch (...) {
            m_taken = m_parts;
            const std::lock_guard lock(m_failing);
            if (m_failure == nullptr) m_failure = std::current_exception();
        }
    }

    /// Parts are taken from the front by every second thread, from the end by the others, so that in one loop
    /// after another a thread has mostly the same bodies, which its cache holds. Those from the end are
    /// counted in the upper half of the number.
    static constexpr std::uint64_t fromEnd = std::uint64_t{1} << 32;
    static constexpr std::size_t lineBytes = 64;                // of a cache: threads write these often
    alignas(lineBytes) std::atomic<std::uint32_t> m_loop = 0;   // odd while one is open
    alignas(lineBytes) std::atomic<std::uint32_t> m_inside = 0; // threads other than the caller's
    alignas(lineBytes) std::atomic<std::uint64_t> m_taken = 0;  // parts of the loop
    alignas(lineBytes) std::atomic<bool> m_isOver = false;
    Call m_work;
    std::size_t m_parts = 0;
    std::mutex m_failing;
    std::exception_ptr m_failure; // of a part
    std::vector<std::thread> m_threads;
};

Workers::Workers(int threads)
    : m_threads(static_cast<int>(
          std::clamp<std::size_t>(static_cast<std::size_t>(std::max(threads, 1)), 1, processors()))) {}

Workers::~Workers() = default;
Workers::Workers(Workers&&) noexcept = default;
Workers& Workers::operator=(Workers&&) noexcept = default;

Workers& Workers::alone() {
    static Workers workers(1);
    return workers;
}

void Workers::share(std::size_t parts, Call work) {
    if (m_team == nullptr) m_team = std::make_unique<Team>(static_cast<std::size_t>(m_threads));
    m_team->share(parts, work);
}

} // namespace carom
