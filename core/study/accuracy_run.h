// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/accuracy.h"

#include <functional>

// The runs of an accuracy study: one setting held against the reference solution, and the clock.

namespace carom {

struct AccuracyRun {
    const Scene& scene;
    const AccuracyStudy& study; ///< with its plan and its reference solution, whose samples are apart:
    const Trajectory& trajectory;
    std::function<bool()> goOn{}; ///< false: stop; asked often

    /// So many make up the simulated time.
    std::int64_t frames() const;
    double step() const { return study.settings.step; } ///< a frame [s]
};

/// Runs the point's setting substep by substep and fills in its errors, its invariants and what became of it.
/// False if told to stop.
bool measure(const AccuracyRun& run, AccuracyPoint& point);

/// Runs copies of a crowd beyond the horizon with the point's setting, as long as the time limit allows, and
/// fills in how they deviate from exact ones. False if told to stop.
bool measureCrowd(const AccuracyRun& run, AccuracyPoint& point);

/// Adds a time to the point. False if told to stop.
bool timeOnce(const AccuracyRun& run, AccuracyPoint& point);

} // namespace carom
