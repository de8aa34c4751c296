// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/math/statistics.h"

#include <QObject>
#include <QTest>

#include <algorithm>
#include <cmath>
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
