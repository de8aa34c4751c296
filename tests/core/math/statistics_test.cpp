// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/math/statistics.h"

#include <QObject>
#include <QTest>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace {

using carom::Summary;

class StatisticsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void anEmptySeriesIsAllZero() {
        const Summary summary = carom::summarise({});
        QCOMPARE(summary.mean, 0.0);
        QCOMPARE(summary.maximum, 0.0);
    }

    void oneValueIsEveryFigureOfItself() {
        const std::vector<double> one = {-3};
        const Summary summary = carom::summarise(one);
        for (const double figure :
             {summary.mean, summary.median, summary.p95, summary.p99, summary.maximum, summary.total})
            QCOMPARE(figure, -3.0);
    }

    void theIntervalOfAMedianHoldsItNineteenTimesInTwenty() {
        // Series of 200 with a long tail, as frame times have; the true median is ln 2.
        carom::Random random(17);
        constexpr int series = 2000;
        int held = 0;
        double width = 0;
        for (int i = 0; i < series; ++i) {
            std::vector<double> values;
            for (int k = 0; k < 200; ++k) values.push_back(-std::log(1 - random.uniform()));
            const std::optional<carom::Interval> interval = carom::medianInterval(values);
            QVERIFY(interval.has_value());
            held += interval->low <= std::log(2.0) && std::log(2.0) <= interval->high ? 1 : 0;
            width += (interval->high - interval->low) / series;
        }
        // Medians of stretches of five are a little skew, which costs a per cent or two.
        QVERIFY2(held > 0.91 * series && held < 0.995 * series, qPrintable(QString::number(held)));
        QVERIFY2(width < 0.6, qPrintable(QString::number(width)));
    }

    void aFewMeasurementsHaveNoInterval() {
        QVERIFY(!carom::medianInterval(std::vector<double>(17, 1.0)));
        const std::optional<carom::Interval> alike = carom::medianInterval(std::vector<double>(18, 1.0));
        QVERIFY(alike && alike->low == 1 && alike->high == 1);
        QVERIFY((carom::Interval{1, 2}.overlaps({2, 3})));
        QVERIFY((!carom::Interval{1, 2}.overlaps({2.1, 3})));
    }

    void theMedianOfAnEvenCountIsTheMeanOfTheMiddleTwo() {
        const std::vector<double> values = {9, 1, 4, 2};
        QCOMPARE(carom::summarise(values).median, 3.0);
        QCOMPARE(carom::summarise(values).mean, 4.0);
        QCOMPARE(carom::summarise(values).total, 16.0);
    }

    void percentilesAreTheNearestRankForEveryCount() {
        carom::Random random(3);
        for (std::size_t count = 1; count <= 400; ++count) {
            std::vector<double> values(count);
            for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<double>(i + 1); // rank = value
            for (std::size_t i = count; i > 1; --i) std::swap(values[i - 1], values[random.below(i)]);
            const Summary summary = carom::summarise(values);
            QCOMPARE(summary.p95, static_cast<double>((95 * count + 99) / 100));
            QCOMPARE(summary.p99, static_cast<double>((99 * count + 99) / 100));
            QCOMPARE(summary.maximum, static_cast<double>(count));
        }
    }

    void aPolynomialIsFoundFromItsValues() {
        std::vector<double> x, y;
        for (int i = -5; i <= 5; ++i) {
            x.push_back(i);
            y.push_back(2 - 3.0 * i + 0.5 * i * i);
        }
        const std::vector<double> fitted = carom::fitPolynomial(x, y, 2);
        QCOMPARE(fitted.size(), std::size_t{3});
        constexpr double tolerance = 1e-12; // roundings of sums up to 1e3
        QVERIFY(std::abs(fitted[0] - 2) < tolerance);
        QVERIFY(std::abs(fitted[1] + 3) < tolerance);
        QVERIFY(std::abs(fitted[2] - 0.5) < tolerance);
    }

    void aLineThroughScatterHasTheClosedFormsSlope() {
        carom::Random random(11);
        std::vector<double> x, y;
        double sumX = 0, sumY = 0, sumXx = 0, sumXy = 0;
        constexpr int count = 100;
        for (int i = 0; i < count; ++i) {
            x.push_back(random.uniform(0, 10));
            y.push_back(3 * x.back() + random.gaussian());
            sumX += x.back();
            sumY += y.back();
            sumXx += x.back() * x.back();
            sumXy += x.back() * y.back();
        }
        const double slope = (count * sumXy - sumX * sumY) / (count * sumXx - sumX * sumX);
        QVERIFY(std::abs(carom::fitPolynomial(x, y, 1)[1] - slope) < 1e-12);
    }
};

} // namespace

CAROM_TEST(statistics_test, StatisticsTest)
#include "statistics_test.moc"
