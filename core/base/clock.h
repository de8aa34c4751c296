// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <ctime>

namespace carom {

/// Wall time since construction or the last lap, on a clock that never goes backwards.
class Stopwatch {
  public:
    Stopwatch() : m_start(Clock::now()) {}

    /// Time since the start [ms].
    double elapsed() const { return milliseconds(Clock::now() - m_start); }

    /// Time since the start [ms]; the next lap starts now.
    double lap() {
        const Clock::time_point now = Clock::now();
        const double passed = milliseconds(now - m_start);
        m_start = now;
        return passed;
    }

  private:
    using Clock = std::chrono::steady_clock;
    static double milliseconds(Clock::duration d) {
        return std::chrono::duration<double, std::milli>(d).count();
    }
    Clock::time_point m_start;
};

/// Time this thread has had a processor [ms], from some moment on. Unlike wall time it does not grow while
/// the thread waits for its turn on a busy machine.
inline double processorTimeOfThread() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

} // namespace carom
