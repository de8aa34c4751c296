// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/checkpoint.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>

// Seeking in a run. Keeping every frame would need gigabytes, so only checkpoints are kept, and a frame
// between two of them is simulated again, with the same bits:
//
//     frame     0 . . . . 5 . . . . 10 . . . . 15 . .
//     kept      #         #         #          #            seek(12) = restore 10, two steps
//
// A checkpoint is due when re-simulating the frames since the last one would take noticeably long. When they
// need more memory than the budget, their spacing is doubled: for new ones at once, and each new one replaces
// an old one, every second from the start on. So memory is reused at once, in blocks of the same size;
// deleting every second one together would leave the heap fragmented.

namespace carom {

class World;

class Recording {
  public:
    /// `budget` bounds the checkpoints' memory [bytes]; the one at the start is always kept.
    explicit Recording(std::size_t budget) : m_budget(budget) {}

    /// Discards everything; the world is at the start of its run.
    void restart(const World& world);
    /// To be called after every step. True if the frame is a new one.
    bool note(const World& world);
    void setBudget(std::size_t budget);

    /// Called after each step of a seek, with whether its frame is a new one; false ends the seek.
    using AfterStep = std::function<bool(bool isNew)>;
    /// Brings the world to `frame`, which must not be before the first one but may be a new one. If the seek
    /// is ended, or the world loses its finite state, it stays at the frame it has reached. True if that is
    /// `frame`.
    bool seek(World& world, std::int64_t frame, const AfterStep& goesOn);

    /// The last checkpoint before a frame that is not the first.
    std::int64_t keptBefore(std::int64_t frame) const;

    std::int64_t first() const { return m_checkpoints.empty() ? 0 : m_checkpoints.begin()->first; }
    /// The last frame the run has been at.
    std::int64_t furthest() const { return m_furthest; }
    std::size_t count() const { return m_checkpoints.size(); }
    std::size_t bytes() const { return m_bytes; }

  private:
    bool isDue(const World& world) const;
    void keep(const World& world);
    void thinOut();

    std::size_t m_budget;
    std::size_t m_bytes = 0;
    std::int64_t m_furthest = 0;
    std::int64_t m_apart = 1;      ///< doubled whenever all are thinned out
    std::int64_t m_thinnedTo = 0;  ///< the frame up to which every second checkpoint is gone
    std::int64_t m_thinnedEnd = 0; ///< the last frame whose checkpoint may go before that begins anew
    double m_costSince = 0;        ///< of the frames since the last checkpoint [ms]
    std::map<std::int64_t, Checkpoint> m_checkpoints; ///< by frame
};

} // namespace carom
