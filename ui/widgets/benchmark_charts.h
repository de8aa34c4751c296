// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/benchmark.h"
#include "ui/widgets/plot.h"

namespace carom {

struct NamedChart {
    QString name; ///< of a file, without its ending: "frame_rate_pyramid"
    ChartSpec chart;
};

/// The figures of the reference's evaluation, as far as they were measured:
///   frame_rate_SCENE            its 4.10 to 4.12, for every algorithm
///   naive_and_baraff_SCENE      4.14 and 4.15: all pairs and sweep and sort, with their parabolas
///   trace_all_pairs             4.16: the course of a run
///   trace_first_frame           4.17: sweep and sort, the first frame among the others
///   trace_sweep_and_sort        4.18: the same without the first frame
///   trace                       every algorithm, without the first frame
std::vector<NamedChart> chartsOf(const Benchmark& benchmark);

} // namespace carom
