// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/statistics.h"

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

namespace carom {

/// One simulated frame as the panels see it.
struct FrameSample {
    FrameStatistics statistics;
    double render = 0; ///< [ms]; 0 for a frame that was never on screen
};

/// The statistics of every frame on their way from the simulation to the panels: handed over in batches,
/// nothing lost. The numbers belong to the run they were pushed in; beginning another forgets the old ones.
class SampleQueue {
  public:
    struct Batch {
        std::uint64_t run = 0;
        std::vector<FrameStatistics> frames;
    };

    void push(std::uint64_t run, const FrameStatistics& frame) {
        const std::lock_guard lock(m_mutex);
        if (m_batch.run != run) m_batch = {run, {}};
        m_batch.frames.push_back(frame);
    }

    /// As many as are worth waiting for whoever takes them: a simulation as fast as possible makes half a
    /// million a second, which panels cannot always follow.
    static constexpr std::size_t mostWaiting = 10'000;
    /// What they take at most on their way, from the simulation until a panel has them: as many wait here as
    /// are with the pictures that show them, and lists that grow have room for twice as many [bytes].
    static constexpr std::size_t mostBytes =
        2 * mostWaiting * (sizeof(FrameStatistics) + sizeof(FrameSample));
    bool isFull() const {
        const std::lock_guard lock(m_mutex);
        return m_batch.frames.size() >= mostWaiting;
    }

    /// Everything since the last call, in order.
    Batch takeAll() {
        const std::lock_guard lock(m_mutex);
        return std::exchange(m_batch, Batch{m_batch.run, {}});
    }

  private:
    mutable std::mutex m_mutex;
    Batch m_batch;
};

} // namespace carom
