// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/math/running_summary.h"

#include <QObject>
#include <QTest>

#include <cmath>
#include <vector>

namespace {

using carom::RunningSummary;
using carom::Summary;

bool isWithin(double value, double expected, double share) {
    return std::abs(value - expected) <= share * std::abs(expected);
}

class RunningSummaryTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void ofFewValuesItIsExact() {
        carom::Random random(5);
        RunningSummary running;
        std::vector<double> values;
        QCOMPARE(running.summary().total, 0.0);
        for (int i = 0; i < 1000; ++i) {
            values.push_back(random.uniform(-1, 1));
            running.add(values.back());
        }
        const Summary exact = carom::summarise(values), summary = running.summary();
        QCOMPARE(summary.median, exact.median);
        QCOMPARE(summary.p95, exact.p95);
        QCOMPARE(summary.p99, exact.p99);
        QCOMPARE(summary.mean, exact.mean);
        QCOMPARE(summary.maximum, exact.maximum);
        QCOMPARE(summary.total, exact.total);
    }

    void ofManyItsPercentilesAreWithinOnePercent() {
        // Times of frames over twelve orders of magnitude, in an order that means nothing.
        constexpr double promised = 0.01;
        carom::Random random(7);
        RunningSummary running;
        std::vector<double> values;
        for (int i = 0; i < 300'000; ++i) {
            values.push_back(std::pow(10, random.uniform(-5, 7)));
            running.add(values.back());
        }
        const Summary exact = carom::summarise(values), summary = running.summary();
        QCOMPARE(running.count(), std::uint64_t{300'000});
        QVERIFY(isWithin(summary.median, exact.median, promised));
        QVERIFY(isWithin(summary.p95, exact.p95, promised));
        QVERIFY(isWithin(summary.p99, exact.p99, promised));
        QCOMPARE(summary.maximum, exact.maximum);
        QCOMPARE(summary.total, exact.total);
        QCOMPARE(summary.mean, exact.mean);
    }

    void equalValuesAreThemselvesToOnePercentAndNeverMoreThanTheLargest() {
        RunningSummary running;
        for (int i = 0; i < 100'000; ++i) running.add(0.25);
        for (const double figure : {running.summary().median, running.summary().p95, running.summary().p99})
            QVERIFY(figure <= 0.25 && isWithin(figure, 0.25, 0.01));
    }
};

} // namespace

CAROM_TEST(running_summary_test, RunningSummaryTest)
#include "running_summary_test.moc"
