// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/files.h"
#include "tests/support/test_class.h"

#include "ui/widgets/sweep_charts.h"

#include <QApplication>
#include <QTemporaryDir>
#include <QTest>

#include <cmath>

// Which chart a sweep gets, and that its figures stand where they belong.

namespace carom {
namespace {

using test::longestWait;

const std::string chartedBall = "sphere ball { radius 0.1 mass 1 centre 0, 1, 0 vel 1, 0, 0 }\n"
                                "generate g { scene tower n 1 offset 9, 0, 0 }\n";

struct ChartedSweep {
    std::shared_ptr<const Sweep> sweep;
    std::vector<SweepPoint> points;
};

/// A sweep whose figure is 100 times the index of the first value, and the index of the second, and the seed.
ChartedSweep charted(std::vector<std::string> vary, std::int64_t seeds = 0,
                     SweepOutcome outcome = SweepOutcome::Done) {
    const ReadSweep read = readSweep({.vary = std::move(vary),
                                      .measures = {"final x of ball"},
                                      .seeds = seeds,
                                      .frames = {},
                                      .generate = {}},
                                     chartedBall);
    if (!read.sweep) qFatal("%s", read.objection.c_str());
    ChartedSweep result{read.sweep, {}};
    SweepSummary summary(*read.sweep, [&](const SweepPoint& point) { result.points.push_back(point); });
    const std::size_t ofPoint = read.sweep->runsOfPoint();
    const std::size_t second = read.sweep->axes().size() > 1 ? read.sweep->axes()[1].count : 1;
    for (std::size_t run = 0; run < read.sweep->runs(); ++run) {
        const std::size_t point = run / ofPoint;
        SweepResult one;
        one.run = run;
        one.outcome = outcome;
        one.figures = {100.0 * static_cast<double>(point / second) + static_cast<double>(point % second) +
                       static_cast<double>(run % ofPoint)};
        summary.add(one);
    }
    summary.finish();
    return result;
}

std::vector<SweepChart> chartsOf(const ChartedSweep& made) {
    return carom::chartsOf(*made.sweep, made.points);
}

} // namespace

class SweepChartsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void oneNumberGivesALine() {
        const std::vector<SweepChart> charts = chartsOf(charted({"ball.vel.x=log 1e-2:1:3"}));
        QCOMPARE(charts.size(), std::size_t(1));
        const ChartSpec& chart = charts[0].chart;
        QCOMPARE(chart.series.size(), std::size_t(1));
        QVERIFY(chart.x.logarithmic);
        QCOMPARE(chart.x.label, QStringLiteral("ball.vel.x"));
        QCOMPARE(chart.y.unit, QStringLiteral("m"));
        QCOMPARE(chart.series[0].x, (std::vector<double>{0.01, 0.1, 1}));
        QCOMPARE(chart.series[0].y, (std::vector<double>{0, 100, 200}));
    }

    // Of the seeds 0 to 8 half lie from 2 to 6, nine of ten from 0 to 8.
    void seedsGiveBands() {
        const std::vector<SweepChart> charts = chartsOf(charted({"ball.vel.x=1,2,3"}, 9));
        const ChartSpec& chart = charts[0].chart;
        QCOMPARE(chart.series.size(), std::size_t(3));
        QVERIFY(chart.series[0].style == SeriesStyle::Band && chart.series[1].style == SeriesStyle::Band);
        QCOMPARE(chart.series[0].low, (std::vector<double>{0, 1, 2}));
        QCOMPARE(chart.series[1].low, (std::vector<double>{2, 3, 4}));
        QCOMPARE(chart.series[1].high, (std::vector<double>{6, 7, 8}));
        QCOMPARE(chart.series[2].y, (std::vector<double>{4, 5, 6}));
    }

    void fewValuesOfASecondGiveALineEach() {
        const std::vector<SweepChart> charts =
            chartsOf(charted({"simulation.method=contacts,microcollisions", "ball.vel.x=1:5:5"}));
        const ChartSpec& chart = charts[0].chart;
        QCOMPARE(chart.series.size(), std::size_t(2));
        QCOMPARE(chart.series[1].name, QStringLiteral("simulation.method microcollisions"));
        QCOMPARE(chart.series[1].y, (std::vector<double>{100, 101, 102, 103, 104}));
        QVERIFY(!chart.map);
    }

    void manyValuesOfASecondGiveAMap() {
        const std::vector<SweepChart> charts = chartsOf(charted({"ball.vel.x=1:7:7", "ball.vel.z=1:9:9"}));
        const ChartMap& map = charts[0].chart.map.value();
        QCOMPARE(map.columns, std::size_t(9));
        QCOMPARE(map.rows, std::size_t(7));
        QCOMPARE(map.values[3 * 9 + 5], 305.0);
        QCOMPARE(charts[0].chart.x.label, QStringLiteral("ball.vel.z"));
        QCOMPARE(charts[0].chart.y.names.size(), std::size_t(7));
    }

    // The second number is the shortest: a map for each of its values, over the other two. The figure is 100
    // times the index of the first, and that of the second and third together.
    void threeNumbersGiveAMapForEachValueOfTheShortest() {
        const std::vector<SweepChart> charts =
            chartsOf(charted({"ball.vel.x=1:7:7", "ball.vel.y=1:3:3", "ball.vel.z=1:9:9"}));
        QCOMPARE(charts.size(), std::size_t(3));
        QCOMPARE(charts[1].name, QStringLiteral("sweep-1-2"));
        QCOMPARE(charts[1].chart.title, QStringLiteral("final x of ball, ball.vel.y 2"));
        const ChartMap& map = charts[1].chart.map.value();
        QCOMPARE(map.columns, std::size_t(9));
        QCOMPARE(map.rows, std::size_t(7));
        const std::size_t run = 4 * 27 + 1 * 9 + 5;
        QCOMPARE(charts[1].runs[4][5], run);
        QCOMPARE(map.values[4 * 9 + 5], 100.0 * static_cast<double>(run / 3) + static_cast<double>(run % 3));
        QVERIFY(map.range && map.range == charts[2].chart.map->range);
    }

    void tooManyCombinationsGiveNoChart() {
        QVERIFY(
            chartsOf(charted({"ball.vel.x=1:14:14", "ball.vel.z=1:14:14", "ball.vel.y=1:13:13"})).empty());
        QVERIFY(chartsOf(charted({}, 4)).empty());
    }

    // A scale from 0 to 1 beside it said what no run had given, and a block of dark blue that all had the
    // least.
    void aMapWithoutValuesHasNoScale() {
        QTemporaryDir folder;
        const std::vector<SweepChart> charts =
            chartsOf(charted({"ball.vel.x=1:7:7", "ball.vel.z=1:9:9"}, 0, SweepOutcome::Faulty));
        QCOMPARE(charts[0].chart.note, QStringLiteral("no run gave a value"));
        const QString path = folder.filePath(QStringLiteral("map.png"));
        QCOMPARE(writeChart(charts[0].chart, path), QString());
        const QImage image(path);
        int coloured = 0;
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                if (image.pixelColor(x, y).hsvSaturation() > 100) ++coloured;
        QCOMPARE(coloured, 0);
        QCOMPARE(chartsOf(charted({"ball.vel.x=1:7:7", "ball.vel.z=1:9:9"}))[0].chart.note, QString());
    }

    // The lowest cell, left below, is dark; the highest, right above, is light.
    void aMapIsDrawnWithItsScale() {
        QTemporaryDir folder;
        const QString path = folder.filePath(QStringLiteral("map.png"));
        const std::vector<SweepChart> charts = chartsOf(charted({"ball.vel.x=1:7:7", "ball.vel.z=1:9:9"}));
        QCOMPARE(writeChart(charts[0].chart, path), QString());
        const QImage image(path);
        const QColor low = image.pixelColor(image.width() / 8, image.height() * 7 / 8);
        const QColor high = image.pixelColor(image.width() * 3 / 4, image.height() / 8);
        QVERIFY2(low.lightness() < 90, qPrintable(low.name()));
        QVERIFY2(high.lightness() > 120 && high.red() > 200, qPrintable(high.name()));
        // Another chart in the same widget has no scale beside it any more.
        PlotWidget plot;
        plot.resize(500, 300);
        plot.setChart(charts[0].chart);
        plot.setChart(chartsOf(charted({"ball.vel.x=1:7:7"}))[0].chart);
        plot.show();
        QVERIFY(QTest::qWaitForWindowExposed(&plot, longestWait));
        QTRY_VERIFY_WITH_TIMEOUT(plot.xOf(7) > 430, longestWait);
    }
};

} // namespace carom

CAROM_TEST_WITH(QApplication, sweep_charts_test, carom::SweepChartsTest)
#include "sweep_charts_test.moc"
