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

/// The queue of the statistics of all frames from the simulation to the panels, taken in batches; none is
/// lost. A batch belongs to one run; the first push of another run discards the rest of the old one.
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

    /// Frames after which the simulation waits for the panels: as fast as possible it makes half a million a
    /// second, more than panels can always take. At half, it waits while panels draw; at twice, the queue
    /// takes twice the memory and panels are further behind.
    static constexpr std::size_t mostWaiting = 10'000;
    /// Memory of the frames between the simulation and the panels, at most [bytes]: as many in this queue as
    /// with the pictures that show them, in vectors that may have twice the capacity.
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
