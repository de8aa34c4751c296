// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/accuracy.h"
#include "core/study/run_course.h"

#include <functional>
#include <optional>

// The runs of an accuracy study: the comparison of one setting with the reference solution, and its time.

namespace carom {

struct AccuracyRun {
    const Scene& scene;
    const AccuracyStudy& study; ///< with its plan and its reference solution, whose samples are apart:
    const Trajectory& trajectory;
    const StudyClock& clock;
    double limit = 0;             ///< [s] of wall time that the run may take
    std::function<bool()> goOn{}; ///< false: stop; asked often

    /// So many make up the simulated time.
    std::int64_t frames() const;
    double step() const { return study.settings.step; } ///< a frame [s]
};

/// Measured, or broken where its energy is off by more than an invariant may.
void judge(const AccuracyStudy& study, AccuracyPoint& point);

/// The errors of a run in energy, momentum and contacts.
void addInvariants(const RunCourse& course, const World& world, AccuracyPoint& point);

/// Runs the point's setting and fills in its errors, its invariants, what became of it and, where the run is
/// one that times can be taken from, its time. False if told to stop.
bool measure(const AccuracyRun& run, AccuracyPoint& point);

/// Runs a copy of a crowd beyond the horizon with the point's setting; how it deviates from exact ones, or
/// nothing if told to stop or its state is lost.
std::optional<CrowdDeviation> measureCrowd(const AccuracyRun& run, const AccuracyPoint& point, int copy);

/// Adds a time to the point, if it is done within the limit, which its longest step is not to exceed. False
/// if told to stop.
bool timeOnce(const AccuracyRun& run, AccuracyPoint& point);

} // namespace carom
