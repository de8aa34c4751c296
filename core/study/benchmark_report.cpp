// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/benchmark_report.h"

#include "core/base/csv.h"
#include "core/base/figures.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

constexpr double realTime = 1000.0 / 30; ///< [ms] a frame
constexpr std::string_view naive = "all_pairs", baraff = "sweep_and_sort";

std::string padded(std::string text, std::size_t width) {
    return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

std::string reachText(const std::optional<RealTimeReach>& reach) {
    if (!reach) return "-";
    return (reach->measured ? "" : "> ") + std::to_string(std::llround(reach->n));
}

std::string_view nameOf(const GeneratorRow* scene) { return scene ? scene->name : "scene"; }

const BenchmarkPoint* pointAt(const std::vector<BenchmarkPoint>& points, std::int64_t n) {
    const std::vector<BenchmarkPoint>::const_iterator found =
        std::find_if(points.begin(), points.end(), [n](const BenchmarkPoint& point) { return point.n == n; });
    return found == points.end() ? nullptr : &*found;
}

} // namespace

std::vector<BenchmarkPoint> pointsOf(const Benchmark& benchmark, const GeneratorRow& scene,
                                     const BroadphaseRow& algorithm) {
    std::vector<BenchmarkPoint> points;
    for (const BenchmarkPoint& point : benchmark.points)
        if (point.scene == &scene && point.algorithm == &algorithm) points.push_back(point);
    return points;
}

std::optional<RealTimeReach> realTimeReach(const std::vector<BenchmarkPoint>& points) {
    if (points.empty() || points.front().simulate.median > realTime) return std::nullopt;
    for (std::size_t p = 1; p < points.size(); ++p) {
        const double fast = points[p - 1].simulate.median, slow = points[p].simulate.median;
        if (slow <= realTime) continue;
        const double few = static_cast<double>(points[p - 1].n), many = static_cast<double>(points[p].n);
        return RealTimeReach{few * std::pow(many / few, std::log(realTime / fast) / std::log(slow / fast)),
                             true};
    }
    return RealTimeReach{static_cast<double>(points.back().n), false};
}

std::optional<QuadraticFit> fitQuadratic(const std::vector<BenchmarkPoint>& points) {
    if (points.size() < 3) return std::nullopt;
    std::vector<double> n, time;
    for (const BenchmarkPoint& point : points) {
        n.push_back(static_cast<double>(point.n));
        time.push_back(point.simulate.median);
    }
    const std::vector<double> c = fitPolynomial(n, time, 2);
    const double mean = summarise(time).mean;
    double unexplained = 0, variance = 0;
    for (std::size_t p = 0; p < n.size(); ++p) {
        const double error = time[p] - (c[0] + c[1] * n[p] + c[2] * n[p] * n[p]);
        unexplained += error * error;
        variance += (time[p] - mean) * (time[p] - mean);
    }
    return QuadraticFit{c[0], c[1], c[2], variance > 0 ? 1 - unexplained / variance : 1};
}

std::optional<double> growthExponent(const std::vector<BenchmarkPoint>& points, std::int64_t from) {
    std::vector<double> logN, logTime;
    for (const BenchmarkPoint& point : points) {
        if (point.n < from || point.simulate.median <= 0) continue;
        logN.push_back(std::log(static_cast<double>(point.n)));
        logTime.push_back(std::log(point.simulate.median));
    }
    if (logN.size() < 2) return std::nullopt;
    return fitPolynomial(logN, logTime, 1)[1];
}

std::string pointsAsCsv(const Benchmark& benchmark) {
    CsvTable table("scene,n,bodies,broadphase,frames,first_ms,mean_ms,median_ms,p95_ms,max_ms,frame_rate,"
                   "broadphase_ms,narrowphase_ms,pairs,tested,contacts,swaps,memory_bytes");
    for (const BenchmarkPoint& p : benchmark.points)
        table.row(nameOf(p.scene), p.n, p.bodies, p.algorithm->name, benchmark.plan.frames, p.first,
                  p.simulate.mean, p.simulate.median, p.simulate.p95, p.simulate.maximum,
                  p.simulate.mean > 0 ? 1000 / p.simulate.mean : 0, p.broadphase, p.narrowphase, p.pairs,
                  p.tested, p.contacts, p.swaps, p.memoryBytes);
    return table.take();
}

std::string tracesAsCsv(const Benchmark& benchmark) {
    CsvTable table("scene,n,broadphase,frame,time,simulate_ms,broadphase_ms,narrowphase_ms,pairs,tested,"
                   "contacts,swaps");
    for (const BenchmarkTrace& trace : benchmark.traces)
        for (const FrameStatistics& frame : trace.frames)
            table.row(nameOf(trace.scene), trace.n, trace.algorithm->name, frame.frame, frame.time,
                      frame.simulate, frame.broadphase, frame.narrowphase, frame.broad.pairs,
                      frame.broad.tested, frame.contacts, frame.broad.swaps);
    return table.take();
}

namespace {

/// Median time of a frame by number (down) and algorithm (across), then what the columns say.
std::string tableOf(const Benchmark& benchmark, const GeneratorRow& scene) {
    constexpr std::size_t first = 22, column = 18;
    const auto line = [&](std::string label, auto cell) {
        std::string text = std::move(label);
        text.resize(std::max(text.size(), first), ' ');
        for (const BroadphaseRow* algorithm : benchmark.plan.algorithms)
            text += padded(cell(*algorithm, pointsOf(benchmark, scene, *algorithm)), column);
        return text + "\n";
    };
    using Points = std::vector<BenchmarkPoint>;
    std::string text = line(std::string(scene.name),
                            [](const BroadphaseRow& row, const Points&) { return std::string(row.name); });
    for (const std::int64_t n : benchmark.plan.counts)
        text += line("  N = " + std::to_string(n), [n](const BroadphaseRow&, const Points& points) {
            const BenchmarkPoint* point = pointAt(points, n);
            return point ? figure(point->simulate.median) : std::string("-");
        });
    text += line("  30 frames/s up to",
                 [](const BroadphaseRow&, const Points& points) { return reachText(realTimeReach(points)); });
    text += line("  growth from 1000 on", [](const BroadphaseRow&, const Points& points) {
        const std::optional<double> exponent = growthExponent(points);
        return exponent ? "N^" + figure(*exponent) : std::string("-");
    });
    text += line("  N² share of the fit", [](const BroadphaseRow&, const Points& points) {
        const std::optional<QuadraticFit> fit = fitQuadratic(points);
        return fit ? figure(fit->quadratic) + " N²" : std::string("-");
    });
    return text;
}

std::string comparisonOf(const Benchmark& benchmark, const GeneratorRow& scene) {
    const std::vector<BenchmarkPoint> all = pointsOf(benchmark, scene, *findBroadphase(naive));
    const std::vector<BenchmarkPoint> sorted = pointsOf(benchmark, scene, *findBroadphase(baraff));
    const std::optional<RealTimeReach> slow = realTimeReach(all), fast = realTimeReach(sorted);
    if (!slow || !fast || !slow->measured) return "";
    std::string text = "On " + std::string(scene.name) + " sweep and sort keeps 30 frames/s for " +
                       (fast->measured ? "" : "more than ") + figure(fast->n / slow->n) +
                       " times as many bodies as all pairs";
    const std::optional<QuadraticFit> naiveFit = fitQuadratic(all), sortedFit = fitQuadratic(sorted);
    if (naiveFit && sortedFit)
        text += "; a parabola explains " + figure(100 * naiveFit->determination, 4) +
                " % of all pairs' times (" + figure(naiveFit->quadratic) + " ms N²) and " +
                figure(100 * sortedFit->determination, 4) + " % of sweep and sort's (" +
                figure(sortedFit->quadratic) + " ms N²)";
    return text + ".\n";
}

std::string sentenceOf(const BenchmarkTrace& trace) {
    if (trace.frames.size() < 2) return "";
    std::vector<double> later;
    std::size_t peak = 1;
    for (std::size_t f = 1; f < trace.frames.size(); ++f) {
        later.push_back(trace.frames[f].simulate);
        if (trace.frames[f].contacts > trace.frames[peak].contacts) peak = f;
    }
    const Summary summary = summarise(later);
    return "  " + std::string(trace.algorithm->name) + ": first frame " +
           figure(trace.frames.front().simulate) + " ms, then median " + figure(summary.median) + ", mean " +
           figure(summary.mean) + ", p95 " + figure(summary.p95) + ", max " + figure(summary.maximum) +
           " ms; most contacts at frame " + std::to_string(trace.frames[peak].frame) + ".\n";
}

} // namespace

std::string summaryOf(const Benchmark& benchmark) {
    std::string text;
    if (!benchmark.points.empty())
        text += "Median time of a frame [ms] behind the first, over " +
                std::to_string(benchmark.plan.frames) + " frames; the worlds of one line took turns.\n\n";
    for (const GeneratorRow* scene : benchmark.plan.scenes)
        if (std::any_of(benchmark.points.begin(), benchmark.points.end(),
                        [scene](const BenchmarkPoint& point) { return point.scene == scene; }))
            text += tableOf(benchmark, *scene) + "\n";
    for (const GeneratorRow* scene : benchmark.plan.scenes) text += comparisonOf(benchmark, *scene);
    if (!benchmark.traces.empty()) {
        const BenchmarkTrace& trace = benchmark.traces.front();
        text += "A run of " + std::to_string(trace.frames.size()) + " frames of " +
                std::string(trace.scene->name) + ", N = " + std::to_string(trace.n) + ":\n";
        for (const BenchmarkTrace& each : benchmark.traces) text += sentenceOf(each);
    }
    for (const std::string& remark : benchmark.remarks) text += remark + ".\n";
    if (!benchmark.complete) text += "Stopped early: what is here is whole, the rest was not measured.\n";
    return text;
}

} // namespace carom
