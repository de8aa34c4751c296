// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <optional>

namespace carom {

/// Measures the speed of a running simulation: simulated seconds a second of wall time, over windows of half
/// a second. At half of that the number changes too fast to be read, at twice it follows too slowly.
class SpeedMeter {
  public:
    using Clock = std::chrono::steady_clock;

    /// Discards the window; the next note() begins a new one.
    void restart() { m_since.reset(); }

    /// The run is at `time` [s]. Tells the speed once a window is full and begins the next one; else nothing,
    /// also where the run has been moved back.
    std::optional<double> note(double time, Clock::time_point now) {
        if (!m_since || time < m_time) {
            m_since = now;
            m_time = time;
            return std::nullopt;
        }
        if (now - *m_since < window) return std::nullopt;
        const double speed = (time - m_time) / std::chrono::duration<double>(now - *m_since).count();
        m_since = now;
        m_time = time;
        return speed;
    }

  private:
    static constexpr std::chrono::milliseconds window{500};

    std::optional<Clock::time_point> m_since;
    double m_time = 0; ///< [s] of the run, when the window began
};

} // namespace carom
