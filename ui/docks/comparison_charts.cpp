// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/comparison_charts.h"

#include "core/study/benchmark_report.h"
#include "ui/widgets/text_of.h"

#include <QCoreApplication>

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

struct ComparisonChartsTexts {
    Q_DECLARE_TR_FUNCTIONS(ComparisonCharts)
};

ComparisonTable tableOfOneScene(const Benchmark& benchmark) {
    ComparisonTable table{
        .rows = {},
        .columns = {ComparisonChartsTexts::tr("Broad [ms]"), ComparisonChartsTexts::tr("Step [ms]"),
                    ComparisonChartsTexts::tr("First [ms]"), ComparisonChartsTexts::tr("Tested"),
                    ComparisonChartsTexts::tr("Overlap"), ComparisonChartsTexts::tr("Ratio")},
        .decimals = {3, 3, 3, 1, 1, 1},
        .values = {}};
    for (const BenchmarkPoint& point : benchmark.points) {
        table.rows << textOf(point.algorithm->title);
        table.values.push_back({point.broadphase, point.simulate.mean, point.first, point.tested, point.pairs,
                                point.pairs > 0 ? point.tested / point.pairs : NAN});
    }
    return table;
}

ComparisonTable tableAgainstNumbers(const Benchmark& benchmark) {
    ComparisonTable table;
    const GeneratorRow& scene = *benchmark.plan.scenes.front();
    for (const std::int64_t n : benchmark.plan.counts) {
        table.columns << ComparisonChartsTexts::tr("N=%1").arg(n);
        table.decimals.push_back(2);
    }
    for (const BroadphaseRow* algorithm : benchmark.plan.algorithms) {
        table.rows << textOf(algorithm->title);
        std::vector<double> row(benchmark.plan.counts.size(), NAN);
        for (const BenchmarkPoint& point : pointsOf(benchmark, scene, *algorithm)) {
            const std::ptrdiff_t column =
                std::ranges::find(benchmark.plan.counts, point.n) - benchmark.plan.counts.begin();
            row[static_cast<std::size_t>(column)] = point.simulate.median;
        }
        table.values.push_back(std::move(row));
    }
    return table;
}

struct Course {
    const char* name; ///< of a file
    const char* title;
    const char* axis;
    const char* unit;
    double (*value)(const FrameStatistics& frame);
};

constexpr Course courses[] = {
    {"broadphase", QT_TRANSLATE_NOOP("ComparisonCharts", "Broad-phase in each frame"),
     QT_TRANSLATE_NOOP("ComparisonCharts", "time"), "ms",
     [](const FrameStatistics& frame) { return frame.broadphase; }},
    {"frame", QT_TRANSLATE_NOOP("ComparisonCharts", "Whole step in each frame"),
     QT_TRANSLATE_NOOP("ComparisonCharts", "time"), "ms",
     [](const FrameStatistics& frame) { return frame.simulate; }},
    {"tested", QT_TRANSLATE_NOOP("ComparisonCharts", "Pairs tested in each frame"),
     QT_TRANSLATE_NOOP("ComparisonCharts", "pairs tested"), "",
     [](const FrameStatistics& frame) { return static_cast<double>(frame.broad.tested); }},
};

// Logarithmic, or the slowest algorithm would press all others onto the axis.
ChartSpec chartOf(const Benchmark& benchmark, const Course& course) {
    ChartSpec chart{.title = ComparisonChartsTexts::tr(course.title),
                    .x = {ComparisonChartsTexts::tr("frame"), {}, false},
                    .y = {ComparisonChartsTexts::tr(course.axis), QString::fromLatin1(course.unit), true},
                    .series = {},
                    .levels = {}};
    for (const BenchmarkTrace& trace : benchmark.traces) {
        ChartSeries series{.name = textOf(trace.algorithm->title),
                           .x = {},
                           .y = {},
                           .style = SeriesStyle::Line,
                           .colour = {}};
        for (const FrameStatistics& frame : trace.frames) {
            series.x.push_back(static_cast<double>(frame.frame));
            series.y.push_back(course.value(frame));
        }
        chart.series.push_back(std::move(series));
    }
    return chart;
}

} // namespace

ComparisonTable comparisonTable(const Benchmark& benchmark) {
    return benchmark.plan.scenes.empty() ? tableOfOneScene(benchmark) : tableAgainstNumbers(benchmark);
}

std::vector<NamedChart> comparisonCharts(const Benchmark& benchmark) {
    if (!benchmark.plan.scenes.empty()) return chartsOf(benchmark);
    std::vector<NamedChart> charts;
    for (const Course& course : courses)
        charts.push_back({QString::fromLatin1(course.name), chartOf(benchmark, course)});
    return charts;
}

std::vector<const BroadphaseRow*> fastestBroadphases(const Benchmark& benchmark) {
    struct Measured {
        const BroadphaseRow* algorithm;
        double median; ///< [ms]
        Interval interval;
    };
    std::vector<Measured> all;
    for (const BenchmarkTrace& trace : benchmark.traces) {
        std::vector<double> times;
        for (const FrameStatistics& frame : trace.frames)
            if (frame.frame > 1) times.push_back(frame.broadphase); // the first pays for what is made once
        if (const std::optional<Interval> interval = medianInterval(times))
            all.push_back({trace.algorithm, summarise(times).median, *interval});
    }
    if (all.empty()) {
        const std::vector<BenchmarkPoint>::const_iterator best =
            std::ranges::min_element(benchmark.points, {}, &BenchmarkPoint::broadphase);
        return best == benchmark.points.end() ? std::vector<const BroadphaseRow*>()
                                              : std::vector{best->algorithm};
    }
    std::ranges::stable_sort(all, {}, &Measured::median);
    std::vector<const BroadphaseRow*> fastest;
    for (const Measured& one : all)
        if (one.interval.overlaps(all.front().interval)) fastest.push_back(one.algorithm);
    return fastest;
}

} // namespace carom
