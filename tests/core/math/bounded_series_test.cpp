// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/math/bounded_series.h"
#include "core/math/random.h"

#include <QObject>
#include <QTest>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace {

using carom::BoundedSeries;
using carom::SeriesPoint;
using carom::SeriesStretch;

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

class BoundedSeriesTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aShortSeriesKeepsEveryFigure() {
        BoundedSeries series;
        QVERIFY(series.points().empty());
        for (const double value : {3.0, 1.0, 4.0}) series.add(value);
        QCOMPARE(series.length(), std::int64_t{1});
        const std::vector<SeriesPoint> points = series.points();
        QCOMPARE(points.size(), std::size_t{3});
        QCOMPARE(points[1].place, std::int64_t{1});
        QCOMPARE(points[1].value, 1.0);
    }

    void ofALongSeriesEachStretchHasItsLeastAndGreatestFigure() {
        // Held against the figures themselves: 100,000 are 13 times what there is room for.
        constexpr std::int64_t count = 100'003;
        carom::Random random(7);
        std::vector<double> figures;
        BoundedSeries series;
        for (std::int64_t i = 0; i < count; ++i) {
            figures.push_back(random.uniform(-5, 5));
            series.add(figures.back());
        }
        QCOMPARE(series.count(), count);
        QCOMPARE(series.length(), std::int64_t{16});
        QVERIFY(series.stretches().size() <= BoundedSeries::mostStretches);
        QVERIFY(series.stretches().size() >= BoundedSeries::mostStretches / 2);
        for (const SeriesStretch& stretch : series.stretches()) {
            const auto begin = figures.begin() + stretch.first;
            const auto end = figures.begin() + std::min(count, stretch.first + series.length());
            QCOMPARE(stretch.low, *std::min_element(begin, end));
            QCOMPARE(stretch.high, *std::max_element(begin, end));
            QCOMPARE(figures[static_cast<std::size_t>(stretch.lowAt)], stretch.low);
            QCOMPARE(figures[static_cast<std::size_t>(stretch.highAt)], stretch.high);
            QCOMPARE(&series.at(stretch.first + 1), &stretch);
        }
    }

    void bothEndsOfTheCurveAreExactAndItsPlacesAscend() {
        BoundedSeries series;
        for (std::int64_t i = 0; i < 50'000; ++i) series.add(std::sin(0.37 * static_cast<double>(i)));
        const std::vector<SeriesPoint> points = series.points();
        QCOMPARE(points.front().place, std::int64_t{0});
        QCOMPARE(points.front().value, 0.0);
        QCOMPARE(points.back().place, std::int64_t{49'999});
        QCOMPARE(points.back().value, std::sin(0.37 * 49'999));
        for (std::size_t i = 0; i + 1 < points.size(); ++i) QVERIFY(points[i].place < points[i + 1].place);
    }

    void memoryEndsToGrow() {
        BoundedSeries series;
        std::size_t most = 0;
        for (std::int64_t i = 0; i < 2'200'000; ++i) {
            series.add(static_cast<double>(i));
            most = std::max(most, series.bytes());
        }
        QVERIFY(most <= BoundedSeries::mostStretches * sizeof(SeriesStretch));
        QCOMPARE(series.stretches().back().high, 2'199'999.0);
    }

    void figuresThatAreNoNumbersArePlacesOnly() {
        BoundedSeries series;
        for (std::int64_t i = 0; i < 20'000; ++i) series.add(i < 10'000 || i % 2 == 0 ? notANumber : 1.0);
        QCOMPARE(series.length(), std::int64_t{4});
        QVERIFY(std::isnan(series.stretches().front().low));
        QCOMPARE(series.stretches().back().low, 1.0);
        QCOMPARE(series.stretches().back().high, 1.0);
    }
};

} // namespace

CAROM_TEST(bounded_series_test, BoundedSeriesTest)
#include "bounded_series_test.moc"
