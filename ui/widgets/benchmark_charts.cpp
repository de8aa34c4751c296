// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/benchmark_charts.h"

#include "core/study/benchmark_report.h"
#include "ui/widgets/text_of.h"

#include <QCoreApplication>

namespace carom {
namespace {

constexpr double realTimeRate = 30; ///< frames a second

struct BenchmarkChartsTexts {
    Q_DECLARE_TR_FUNCTIONS(BenchmarkCharts)
};

QString nameOf(const char* kind, const GeneratorRow& scene) {
    return QString::fromLatin1(kind) + QLatin1Char('_') + textOf(scene.name);
}

ChartAxis bodiesAxis(bool logarithmic) {
    return {BenchmarkChartsTexts::tr("number of objects N"), {}, logarithmic};
}

ChartAxis timeAxis() {
    return {BenchmarkChartsTexts::tr("simulation time of a frame"), QStringLiteral("ms"), false};
}

void addFrameRates(const Benchmark& benchmark, const GeneratorRow& scene, std::vector<NamedChart>& charts) {
    ChartSpec chart{
        .title = BenchmarkChartsTexts::tr("Frame rate against number of objects: %1").arg(textOf(scene.name)),
        .x = bodiesAxis(true),
        .y = {BenchmarkChartsTexts::tr("frame rate"), QStringLiteral("1/s"), true},
        .series = {},
        .levels = {{realTimeRate, BenchmarkChartsTexts::tr("30 frames/s")}}};
    for (const BroadphaseRow* algorithm : benchmark.plan.algorithms) {
        ChartSeries series{.name = textOf(algorithm->title),
                           .x = {},
                           .y = {},
                           .style = SeriesStyle::LineAndMarks,
                           .colour = {}};
        for (const BenchmarkPoint& point : pointsOf(benchmark, scene, *algorithm)) {
            series.x.push_back(static_cast<double>(point.n));
            series.y.push_back(1000 / point.simulate.median);
        }
        if (!series.x.empty()) chart.series.push_back(std::move(series));
    }
    if (!chart.series.empty()) charts.push_back({nameOf("frame_rate", scene), std::move(chart)});
}

/// Marks where it was measured, and the parabola through them.
void addMeasuredAndFitted(const std::vector<BenchmarkPoint>& points, std::size_t colour, ChartSpec& chart) {
    if (points.empty()) return;
    const QString title = textOf(points.front().algorithm->title);
    ChartSeries marks{
        .name = title, .x = {}, .y = {}, .style = SeriesStyle::Marks, .colour = seriesColour(colour)};
    for (const BenchmarkPoint& point : points) {
        marks.x.push_back(static_cast<double>(point.n));
        marks.y.push_back(point.simulate.median);
    }
    const double most = marks.x.back();
    chart.series.push_back(std::move(marks));
    const std::optional<QuadraticFit> fit = fitQuadratic(points);
    if (!fit) return;
    ChartSeries curve{.name = BenchmarkChartsTexts::tr("%1: parabola").arg(title),
                      .x = {},
                      .y = {},
                      .style = SeriesStyle::Line,
                      .colour = seriesColour(colour)};
    constexpr int segments = 200;
    for (int k = 0; k <= segments; ++k) {
        const double n = most * k / segments;
        curve.x.push_back(n);
        curve.y.push_back(fit->constant + fit->linear * n + fit->quadratic * n * n);
    }
    chart.series.push_back(std::move(curve));
}

void addNaiveAndBaraff(const Benchmark& benchmark, const GeneratorRow& scene,
                       std::vector<NamedChart>& charts) {
    const std::vector<BenchmarkPoint> naive = pointsOf(benchmark, scene, *findBroadphase("all_pairs"));
    std::vector<BenchmarkPoint> baraff = pointsOf(benchmark, scene, *findBroadphase("sweep_and_sort"));
    if (naive.empty() || baraff.empty()) return;
    // As far as both were measured: beyond, the chart would show one of them only.
    std::erase_if(baraff, [&naive](const BenchmarkPoint& point) { return point.n > naive.back().n; });
    ChartSpec chart{.title =
                        BenchmarkChartsTexts::tr("All pairs and sweep and sort: %1").arg(textOf(scene.name)),
                    .x = bodiesAxis(false),
                    .y = timeAxis(),
                    .series = {},
                    .levels = {{1000 / realTimeRate, BenchmarkChartsTexts::tr("33 ms: 30 frames/s")}}};
    addMeasuredAndFitted(naive, 0, chart);
    addMeasuredAndFitted(baraff, 1, chart);
    charts.push_back({nameOf("naive_and_baraff", scene), std::move(chart)});
}

ChartSpec emptyTraceChart(const BenchmarkTrace& trace, const QString& what) {
    return {.title =
                BenchmarkChartsTexts::tr("%1: %2, N = %3").arg(what, textOf(trace.scene->name)).arg(trace.n),
            .x = {BenchmarkChartsTexts::tr("frame"), {}, false},
            .y = timeAxis(),
            .series = {},
            .levels = {}};
}

ChartSeries courseOf(const BenchmarkTrace& trace, std::size_t firstShown) {
    ChartSeries series{
        .name = textOf(trace.algorithm->title), .x = {}, .y = {}, .style = SeriesStyle::Line, .colour = {}};
    for (std::size_t f = firstShown; f < trace.frames.size(); ++f) {
        series.x.push_back(static_cast<double>(trace.frames[f].frame));
        series.y.push_back(trace.frames[f].simulate);
    }
    return series;
}

void addTraces(const Benchmark& benchmark, std::vector<NamedChart>& charts) {
    if (benchmark.traces.empty()) return;
    const auto add = [&charts](const QString& name, const BenchmarkTrace& trace, std::size_t firstShown) {
        ChartSpec chart = emptyTraceChart(trace, textOf(trace.algorithm->title));
        chart.series.push_back(courseOf(trace, firstShown));
        charts.push_back({name, std::move(chart)});
    };
    ChartSpec all = emptyTraceChart(benchmark.traces.front(), BenchmarkChartsTexts::tr("Every algorithm"));
    all.y.logarithmic = true;
    for (const BenchmarkTrace& trace : benchmark.traces) {
        all.series.push_back(courseOf(trace, 1));
        if (trace.algorithm->name == "all_pairs") add(QStringLiteral("trace_all_pairs"), trace, 0);
        if (trace.algorithm->name != "sweep_and_sort") continue;
        add(QStringLiteral("trace_first_frame"), trace, 0);
        add(QStringLiteral("trace_sweep_and_sort"), trace, 1);
    }
    charts.push_back({QStringLiteral("trace"), std::move(all)});
}

} // namespace

std::vector<NamedChart> chartsOf(const Benchmark& benchmark) {
    std::vector<NamedChart> charts;
    for (const GeneratorRow* scene : benchmark.plan.scenes) {
        addFrameRates(benchmark, *scene, charts);
        addNaiveAndBaraff(benchmark, *scene, charts);
    }
    addTraces(benchmark, charts);
    return charts;
}

} // namespace carom
