// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/checkpoint.h"
#include "core/simulation/world.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>

// The way back through a run. Keeping every frame would need gigabytes, so only checkpoints are kept, and a
// frame between two of them is simulated again, bit for bit as it was:
//
//     frame     0 . . . . 5 . . . . 10 . . . . 15 . .
//     kept      #         #         #          #            seek(12) = restore 10, two steps
//
// A checkpoint is due when re-simulating what followed the last one would be felt. When they need more memory
// than they may, they stand twice as far apart: new ones at once, and for each of these one of the old ones
// goes, every second from the start on. So the memory stays in use, and what is freed has the size of what
// comes next. If every second one went at once, half of the memory would be holes between pieces that stay.

namespace carom {

class Recording {
  public:
    /// `budget` bounds the checkpoints' memory [bytes]; the one at the start is always kept.
    explicit Recording(std::size_t budget) : m_budget(budget) {}

    /// Forgets everything; the world stands where its run begins.
    void restart(const World& world);
    /// To be called after every step. True if the run had never come so far.
    bool note(const World& world);
    void setBudget(std::size_t budget);

    /// Called after each step of a seek, with whether the run had never come so far; false breaks the seek
    /// off.
    using AfterStep = std::function<bool(bool isNew)>;
    /// Brings the world to `frame`, which must not be before the first one, also where it has not been yet.
    /// Broken off, or where the world stops being healthy, it stays at the frame it has come to. True if it
    /// has arrived.
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
