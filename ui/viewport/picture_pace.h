// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace carom {

/// Keeps pictures out of the way where the processor draws them: it simulates and shows letters meanwhile, so
/// dear ones leave their shadows out while things move, and then leave it free for a while. With a graphics
/// card no picture is dear.
class PicturePace {
  public:
    /// Another scene: nothing is known of what its pictures cost.
    void forget() { *this = {}; }

    /// A picture took so long; `whole`: with its shadows.
    void note(double milliseconds, bool whole) {
        m_last = milliseconds;
        if (whole)
            m_plain = milliseconds > dear;
        else if (milliseconds < cheap)
            m_plain = false;
    }

    bool leavesShadowsOut() const { return m_plain; }
    /// What the next picture waits after the end of the last one [ms].
    double pause() const { return m_last > dear ? m_last / 2 : 0; }

  private:
    /// [ms]; up to this 30 pictures a second are possible, with time left for the simulation between them. At
    /// twice there is none; at half, pictures are slowed down that need not be.
    static constexpr double dear = 25;
    /// [ms]; shadows take about three times as long as the rest, so with them a picture stays below `dear`.
    /// At twice it would not, and shadows would come and go.
    static constexpr double cheap = 6;

    double m_last = 0; ///< [ms]
    bool m_plain = false;
};

} // namespace carom
