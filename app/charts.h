// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/accuracy.h"
#include "core/study/benchmark.h"
#include "core/study/gas.h"
#include "core/study/sweep_summary.h"

#include <string>
#include <vector>

namespace carom {

/// Draws what a study found into a folder, each chart as SVG and PNG, or into one file by its ending, without
/// any display. Throws FileError.
struct ChartDrawer {
    void (*benchmark)(const Benchmark& benchmark, const std::string& folder) = nullptr;
    /// `scene` is the title; `path` ends in .svg, .png or .pdf.
    void (*accuracy)(const AccuracyStudy& study, const std::string& scene, const std::string& path) = nullptr;
    void (*gas)(const GasStudy& study, const std::string& folder) = nullptr;
    void (*sweep)(const Sweep& sweep, const std::vector<SweepPoint>& points,
                  const std::string& folder) = nullptr;
};

/// The drawer of this build. It needs Qt, which the subcommands do without, so main sets it; empty in a build
/// without the IDE, whose studies write their figures only.
ChartDrawer& chartDrawer();

/// In app/charts.cpp, which uses Qt.
void drawBenchmark(const Benchmark& benchmark, const std::string& folder);
void drawAccuracy(const AccuracyStudy& study, const std::string& scene, const std::string& path);
void drawGas(const GasStudy& study, const std::string& folder);
void drawSweep(const Sweep& sweep, const std::vector<SweepPoint>& points, const std::string& folder);

} // namespace carom
