// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/statistics.h"
#include "core/study/sweep_run.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace carom {

/// The distribution of one measure over the runs of a point. All NaN if no run gave a figure.
struct FigureSpread {
    std::size_t runs = 0;           ///< that gave a figure
    double mean = 0, deviation = 0; ///< of a sample; the deviation of one run is NaN
    Interval meanAt95;              ///< Student's, of the mean; NaN of one run
    /// Nearest ranks, as in statistics.h.
    double least = 0, q05 = 0, q25 = 0, median = 0, q75 = 0, q95 = 0, most = 0;
};
FigureSpread spreadOf(std::vector<double> figures);

/// A point of a sweep: the runs with the same listed values, over all draws and seeds.
struct SweepPoint {
    std::size_t firstRun = 0;
    std::size_t runs = 0, lost = 0, faulty = 0;
    std::vector<FigureSpread> spreads; ///< one a measure
};

/// Totals over all runs.
struct SweepTotals {
    std::size_t runs = 0, lost = 0, faulty = 0;
    double seconds = 0; ///< processor time
    double longest = 0; ///< run [s]
};

/// Takes results in the order of the runs and passes on one point after the other. It stores the runs of one
/// point only.
class SweepSummary {
  public:
    using Sink = std::function<void(const SweepPoint& point)>;
    SweepSummary(const Sweep& sweep, Sink sink);

    void add(const SweepResult& result);
    /// To be called after the last run.
    void finish();
    const SweepTotals& totals() const { return m_totals; }

  private:
    std::size_t m_runsOfPoint;
    Sink m_sink;
    SweepPoint m_point;
    std::vector<std::vector<double>> m_figures; ///< by measure
    SweepTotals m_totals;
};

/// The numbers of the parameters by which points differ.
std::vector<std::size_t> pointParameters(const Sweep& sweep);

/// The table of points, with a row for each point and measure: the parameters, then
/// `measure,runs,lost,faulty,mean,deviation,mean_low,mean_high,least,q05,q25,median,q75,q95,most`. If a point
/// has one run, its figure is the mean, and the other cells are empty.
std::string summaryColumns(const Sweep& sweep);
std::string summaryRows(const Sweep& sweep, const SweepPoint& point);

/// The cost of a sweep, in a few lines: "400 runs ...", and runs an hour by number of cores.
std::string summaryOf(const SweepTotals& totals, std::size_t allRuns);

} // namespace carom
