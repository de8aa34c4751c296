// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/convergence.h"
#include "ui/widgets/plot.h"

#include <QString>

#include <vector>

namespace carom {

/// A study as a work–precision diagram: error across, time up, a line a family in the order of substeps.
/// Hollow marks ran but broke an invariant, crosses failed, grey ones are below what the reference solution
/// can tell; the dashed line is the Pareto front, the rings the scene's own setting and the recommended one,
/// which a sentence below the title names.
struct AccuracyChart {
    ChartSpec spec;
    /// By series, the index in AccuracyStudy::points of each of its points; empty for series that only mark.
    std::vector<std::vector<std::size_t>> points;
};
AccuracyChart accuracyChart(const AccuracyStudy& study, const QString& title);

/// Two studies in one diagram, each line with its study's name: the first dashed and without points to
/// choose, the second as it is alone.
AccuracyChart comparedAccuracy(const AccuracyStudy& first, const QString& firstName,
                               const AccuracyStudy& second, const QString& secondName);

/// A ring around a point that somebody chose, as one more series.
void markChosen(const AccuracyStudy& study, const AccuracyPoint& point, ChartSpec& chart);

/// A point in words: its setting, error, time, and what is wrong with it.
QString describe(const AccuracyStudy& study, const AccuracyPoint& point);

} // namespace carom
