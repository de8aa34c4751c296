// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/benchmark.h"
#include "ui/widgets/benchmark_charts.h"

#include <QStringList>

#include <vector>

// What the broad-phase panel shows of a comparison, as values: the rows of its table and its charts. The same
// for one scene, frame by frame, and for a generator, against the number of bodies.

namespace carom {

/// A table's figures, a row an algorithm; NaN where nothing was measured.
struct ComparisonTable {
    QStringList rows, columns;
    std::vector<int> decimals; ///< by column
    std::vector<std::vector<double>> values;
};

/// Of one scene: times and counts of each algorithm. Of generators: the median time of a frame by number.
ComparisonTable comparisonTable(const Benchmark& benchmark);

/// Of one scene: broad-phase, whole frame and pairs tested in each frame. Of generators: the reference's
/// figures, as chartsOf() draws them.
std::vector<NamedChart> comparisonCharts(const Benchmark& benchmark);

/// The algorithm with the least median time in the broad-phase, and behind it those that cannot be told apart
/// from it: their medians' intervals at 95 % overlap. Empty without points; of fewer frames than that takes,
/// and without traces, the one with the least mean.
std::vector<const BroadphaseRow*> fastestBroadphases(const Benchmark& benchmark);

} // namespace carom
