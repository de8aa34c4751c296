// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/sweep_summary.h"
#include "ui/widgets/benchmark_charts.h"

#include <vector>

namespace carom {

/// A chart of a sweep, and which points stand where in it.
struct SweepChart : NamedChart {
    std::size_t measure = 0; ///< of the sweep's
    /// By series and mark of the chart, or by row and column of its map: a point's first run.
    std::vector<std::vector<std::size_t>> runs;
};

/// Whose words a chart has.
enum class ChartWords {
    OfWindow,      ///< in its language
    OfCommandLine, ///< English, whatever the window speaks: its files are the same for everybody
};

/// A chart a measure, `sweep-1`, `sweep-2`, ...: over one axis a line, with bands of the quartiles and of 90
/// % where a point has several runs; over several a line for each combination of the shorter ones, or, where
/// these are too many, a map of colours over the two longest. Of more axes there is a map for each
/// combination of the others, `sweep-1-1`, `sweep-1-2`, ..., as long as they are few. None where nothing is
/// listed to be varied.
std::vector<SweepChart> chartsOf(const Sweep& sweep, const std::vector<SweepPoint>& points,
                                 ChartWords words = ChartWords::OfWindow);

} // namespace carom
