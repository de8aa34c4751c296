// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/shard.h"
#include "core/study/sweep.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

// Makes the runs of a sweep on as many threads as are given. Each run has one thread, so that its result does
// not depend, to the bit, on the number of threads.

namespace carom {

enum class SweepOutcome : std::uint8_t {
    Done,
    Lost,   ///< the state was not finite any more; the figures are those up to that time
    Faulty, ///< its values make a text with errors; nothing was run
};
std::string_view nameOf(SweepOutcome outcome); ///< "done", "lost", "faulty"
std::optional<SweepOutcome> outcomeNamed(std::string_view name);

/// The result of one run.
struct SweepResult {
    std::size_t run = 0;
    SweepOutcome outcome = SweepOutcome::Done;
    std::vector<double> figures; ///< one a measure; NaN where there was nothing to measure
    std::uint64_t stateHash = 0; ///< at the end of the frames that were run
    std::int64_t frames = 0;
    /// The work counted over all frames: bodies × substeps, pairs compared, rows swept, events, and
    /// operations of refinement.
    double work = 0;
    double seconds = 0; ///< processor time of reading, building and running
};

/// Told between frames, from the threads that run; false ends the run.
using SweepGoOn = std::function<bool()>;

/// Makes one run; nothing if it was ended.
std::optional<SweepResult> runOf(const Sweep& sweep, std::size_t run, const SweepGoOn& goOn);

/// The receiver of results. Both are called from the threads that run; `ended` by one at a time, as they end,
/// in whatever order that is.
struct SweepListener {
    SweepGoOn goOn;
    std::function<void(const SweepResult& result)> ended;
};

/// Runs that may begin ahead of the first one that has not ended: code that sorts rows holds no more of them.
/// At a tenth, fast runs wait for a slow one on a machine of many cores; at ten times, rows take megabytes.
inline constexpr std::size_t mostRunsAhead = 4096;

/// Makes the runs of a range, except those that `isKnown` names. False if it was ended before all were made.
/// An exception from a listener ends it and is thrown again from here.
bool runSweep(const Sweep& sweep, const ItemRange& part, int threads,
              const std::function<bool(std::size_t run)>& isKnown, const SweepListener& listener);

} // namespace carom
