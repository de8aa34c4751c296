// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/study/benchmark_report.h"

#include "core/simulation/build.h"

#include <QTest>

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

BenchmarkPlan smallPlan() {
    BenchmarkPlan plan = standardBenchmark();
    plan.scenes = {findGenerator("brownian"), findGenerator("pyramid")};
    plan.counts = {20, 60};
    plan.frames = 12;
    plan.traceCount = 40;
    plan.traceFrames = 15;
    plan.traceRepeats = 2;
    plan.timeLimit = 1e9;
    return plan;
}

const BenchmarkListener always = [](std::int64_t, std::int64_t) { return true; };

/// Points whose times follow a formula.
std::vector<BenchmarkPoint> pointsAlong(double (*milliseconds)(double n)) {
    std::vector<BenchmarkPoint> points;
    for (const std::int64_t n : {100, 300, 1000, 3000, 10000}) {
        BenchmarkPoint point;
        point.n = n;
        point.simulate.median = milliseconds(static_cast<double>(n));
        points.push_back(point);
    }
    return points;
}

qsizetype linesIn(const std::string& text) { return std::ranges::count(text, '\n'); }

} // namespace

class BenchmarkTest : public QObject {
    Q_OBJECT

    static constexpr double rounding = 1e-9; // of least squares over powers of numbers up to 1e4

  private Q_SLOTS:
    void everyAlgorithmIsMeasuredOnEverySceneAndArrivesAtTheSameState() {
        const BenchmarkPlan plan = smallPlan();
        const Benchmark benchmark = runBenchmark(plan, always);
        QVERIFY(benchmark.complete);
        QVERIFY(benchmark.remarks.empty());
        const std::size_t algorithms = plan.algorithms.size();
        QCOMPARE(benchmark.points.size(), 2 * 2 * algorithms);
        for (std::size_t p = 0; p < benchmark.points.size(); ++p) {
            const BenchmarkPoint& point = benchmark.points[p];
            QCOMPARE(point.algorithm, plan.algorithms[p % algorithms]);
            QCOMPARE(point.stateHash, benchmark.points[p - p % algorithms].stateHash);
            QCOMPARE(point.pairs, benchmark.points[p - p % algorithms].pairs);
            QVERIFY(point.bodies > static_cast<std::uint64_t>(point.n));
            QVERIFY(point.first > 0 && point.simulate.median > 0);
            QVERIFY(point.simulate.median >= 0 && point.broadphase <= point.simulate.mean);
        }
        QCOMPARE(benchmark.traces.size(), algorithms);
        for (const BenchmarkTrace& trace : benchmark.traces) {
            QCOMPARE(trace.frames.size(), 15U);
            QCOMPARE(trace.frames.back().frame, 15);
        }
    }

    void theListenerHearsEveryFrameOnce() {
        std::int64_t last = 0, announced = 0;
        const BenchmarkPlan plan = smallPlan();
        runBenchmark(plan, [&](std::int64_t done, std::int64_t total) {
            announced = total;
            return done == ++last;
        });
        const std::int64_t algorithms = std::ssize(plan.algorithms);
        QCOMPARE(last, algorithms * (2 * 2 * plan.frames + 2 * plan.traceFrames));
        QCOMPARE(announced, last);
    }

    void stoppedEarlyItKeepsWhatIsWhole() {
        const BenchmarkPlan plan = smallPlan();
        const std::int64_t algorithms = std::ssize(plan.algorithms);
        const std::int64_t firstContest = algorithms * plan.frames;
        const Benchmark benchmark =
            runBenchmark(plan, [&](std::int64_t done, std::int64_t) { return done <= firstContest; });
        QVERIFY(!benchmark.complete);
        QVERIFY(benchmark.traces.empty());
        QCOMPARE(std::ssize(benchmark.points), algorithms);
        QVERIFY(summaryOf(benchmark).find("Stopped early") != std::string::npos);

        const std::int64_t allAndATrace = algorithms * (4 * plan.frames + plan.traceFrames);
        const Benchmark later =
            runBenchmark(plan, [&](std::int64_t done, std::int64_t) { return done <= allAndATrace; });
        QVERIFY(!later.complete);
        QCOMPARE(std::ssize(later.traces), algorithms); // of one repeat of two
        QCOMPARE(std::ssize(later.points), 4 * algorithms);
    }

    // The traces came first: nothing was written for ten seconds, and a kill then lost everything.
    void theFirstRowsAreThereAfterTheSmallestScene() {
        const BenchmarkPlan plan = smallPlan();
        std::int64_t heard = 0, atFirst = 0, calls = 0;
        runBenchmark(
            plan, [&](std::int64_t done, std::int64_t) { return (heard = done) > 0; },
            [&](const Benchmark& soFar) {
                if (calls++ == 0) atFirst = heard;
                QVERIFY(!soFar.points.empty());
            });
        QCOMPARE(atFirst, std::ssize(plan.algorithms) * plan.frames);
        QCOMPARE(calls, 2 * 2 + plan.traceRepeats);
    }

    void theSlowAreLeftOutAtLargerNumbersAndNamed() {
        BenchmarkPlan plan = smallPlan();
        plan.traceScene = nullptr;
        plan.timeLimit = 0;
        const Benchmark benchmark = runBenchmark(plan, always);
        QCOMPARE(benchmark.points.size(), 2 * plan.algorithms.size());
        QCOMPARE(benchmark.remarks.size(), 2 * plan.algorithms.size());
        QVERIFY(benchmark.remarks.front().starts_with("brownian: all_pairs not beyond N = 20"));
    }

    void allAlgorithmsCanBeComparedOnAnySceneOverTheSameFrames() {
        const Build built = build("wall { normal 0,1,0 toOrig 0 } sphere { centre 0,2,0 radius 0.5 mass 1 } "
                                  "sphere { centre 0.5,4,0 radius 0.5 mass 1 }");
        const Benchmark comparison = compareBroadphases(built.pipeline, 30, always);
        QVERIFY(comparison.complete);
        QCOMPARE(comparison.points.size(), broadphases().size());
        for (std::size_t k = 0; k < comparison.points.size(); ++k) {
            const BenchmarkPoint& point = comparison.points[k];
            QCOMPARE(point.algorithm, &broadphases()[k]);
            QCOMPARE(point.n, 3);
            QCOMPARE(point.stateHash, comparison.points[0].stateHash);
            QVERIFY(point.stateHash != 0);
            QVERIFY(point.simulate.median > 0);
            QCOMPARE(comparison.traces[k].algorithm, point.algorithm);
            QCOMPARE(comparison.traces[k].frames.size(), 30U);
        }
        QVERIFY(pointsAsCsv(comparison).find("\nscene,3,3,all_pairs,30,") != std::string::npos);
        QVERIFY(tracesAsCsv(comparison).find("\nscene,3,sweep_and_sort,30,") != std::string::npos);
    }

    void aComparisonStoppedEarlyKeepsTheFramesThatAllHaveDone() {
        const Build built = build("sphere { centre 0,2,0 radius 0.5 mass 1 }");
        const std::int64_t worlds = std::ssize(broadphases());
        // Ten frames of each world make a round; the second round is broken off in the last world's third.
        const std::int64_t last = 10 * worlds + 10 * (worlds - 1) + 3;
        const Benchmark stopped = compareBroadphases(
            built.pipeline, 30, [last](std::int64_t done, std::int64_t) { return done < last; });
        QVERIFY(!stopped.complete);
        QCOMPARE(stopped.plan.frames, 13);
        QCOMPARE(std::ssize(stopped.points), worlds);
        for (const BenchmarkTrace& trace : stopped.traces) QCOMPARE(trace.frames.size(), 13U);
        QVERIFY(stopped.points.back().stateHash != 0);
        QCOMPARE(stopped.points.front().stateHash, 0U); // that world is at frame 20

        const Benchmark atOnce =
            compareBroadphases(built.pipeline, 30, [](std::int64_t, std::int64_t) { return false; });
        QVERIFY(atOnce.points.empty());
        QCOMPARE(atOnce.plan.frames, 0);
    }

    void theParabolaThroughAParabolaIsThatParabola() {
        const std::optional<QuadraticFit> fit =
            fitQuadratic(pointsAlong([](double n) { return 0.5 + 2e-3 * n + 3e-7 * n * n; }));
        QVERIFY(fit.has_value());
        QVERIFY(std::abs(fit->constant - 0.5) < rounding);
        QVERIFY(std::abs(fit->linear - 2e-3) < rounding);
        QVERIFY(std::abs(fit->quadratic - 3e-7) < rounding);
        QVERIFY(std::abs(fit->determination - 1) < rounding);
        QVERIFY(!fitQuadratic({}).has_value());
    }

    void aPowerLawGrowsWithItsExponentAndReachesRealTimeWhereItShould() {
        const std::vector<BenchmarkPoint> points =
            pointsAlong([](double n) { return 1e-3 * std::pow(n, 1.25); });
        QVERIFY(std::abs(growthExponent(points).value() - 1.25) < rounding);
        const std::optional<RealTimeReach> reach = realTimeReach(points);
        QVERIFY(reach.has_value() && reach->measured);
        const double expected = std::pow(1000.0 / 30 / 1e-3, 1 / 1.25); // 4158 bodies
        QVERIFY(std::abs(reach->n / expected - 1) < rounding);
    }

    void realTimeBeyondTheLargestNumberIsSaidToBeSo() {
        const std::optional<RealTimeReach> reach = realTimeReach(pointsAlong([](double) { return 1.0; }));
        QVERIFY(reach.has_value() && !reach->measured);
        QCOMPARE(reach->n, 10000.0);
        QVERIFY(!realTimeReach(pointsAlong([](double) { return 100.0; })).has_value());
    }

    void theFilesHaveARowForEveryPointAndFrame() {
        const Benchmark benchmark = runBenchmark(smallPlan(), always);
        const std::string points = pointsAsCsv(benchmark), traces = tracesAsCsv(benchmark);
        QCOMPARE(linesIn(points), 1 + std::ssize(benchmark.points));
        QCOMPARE(linesIn(traces), 1 + 15 * std::ssize(benchmark.traces));
        QVERIFY(points.find("\nbrownian,20,25,all_pairs,12,") != std::string::npos);
        QVERIFY(traces.find("\npyramid,40,sweep_and_sort,15,0.25,") != std::string::npos);
        const std::string summary = summaryOf(benchmark);
        for (const BroadphaseRow& algorithm : broadphases())
            QVERIFY(summary.find(algorithm.name) != std::string::npos);
    }
};

} // namespace carom

CAROM_TEST(benchmark_test, carom::BenchmarkTest)
#include "benchmark_test.moc"
