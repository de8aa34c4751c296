// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/math/distributions.h"

#include "core/math/random.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <vector>

// Against tables: M. Abramowitz, I. A. Stegun, "Handbook of mathematical functions", 1964, 26.8 and 26.10;
// N. Smirnov, 1948.

namespace carom {

class DistributionsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void chiSquareHasTheTabulatedTails() {
        const struct {
            double degrees, value, tail;
        } rows[] = {{1, 3.841458820694124, 0.05},    {2, 4.605170185988092, 0.1},
                    {10, 18.307038053275146, 0.05},  {10, 2.558212, 0.99},
                    {100, 135.80672317102676, 0.01}, {5, 0.831212, 0.975}};
        constexpr double tabulated = 2e-7; // the shortest value above has seven digits
        for (const auto& row : rows)
            QVERIFY2(std::abs(chiSquareTail(row.value, row.degrees) - row.tail) < tabulated,
                     qPrintable(QString::number(row.value)));
    }

    void chiSquareWithTwoDegreesIsAnExponential() {
        constexpr double rounding = 1e-13;
        for (double x = 0.01; x < 80; x *= 1.3)
            QVERIFY(std::abs(chiSquareTail(x, 2) / std::exp(-x / 2) - 1) <
                        rounding * 100 / std::exp(-x / 2) ||
                    std::abs(chiSquareTail(x, 2) - std::exp(-x / 2)) < rounding);
    }

    void kolmogorovHasTheTabulatedLimits() {
        // Of √n D for large n: 1.2238 at 10 %, 1.3581 at 5 %, 1.6276 at 1 %; median 0.82757.
        constexpr std::size_t many = 100'000'000;
        constexpr double tabulated = 1e-4;
        for (const auto& [limit, tail] : {std::pair(1.22385, 0.10), std::pair(1.35810, 0.05),
                                          std::pair(1.62762, 0.01), std::pair(0.82757, 0.5)})
            QVERIFY(std::abs(kolmogorovTail(limit / 1e4, many) - tail) < tabulated);
    }

    void bothFormsOfTheKolmogorovTailMeet() {
        constexpr std::size_t many = 100'000'000;
        QVERIFY(std::abs(kolmogorovTail(1.1799999 / 1e4, many) - kolmogorovTail(1.1800001 / 1e4, many)) <
                1e-6); // the slope is about 0.5
    }

    void theDistanceOfASampleIsItsWorstStep() {
        const std::vector<double> sample = {0.1, 0.5, 0.6};
        QCOMPARE(kolmogorovDistance(sample, [](double x) { return x; }), 0.4); // 1 − 0.6 behind the last
    }

    void samplesOfTheDistributionItselfPassAsOftenAsTheySay() {
        Random random(3);
        int below = 0;
        constexpr int trials = 2000;
        for (int t = 0; t < trials; ++t) {
            std::vector<double> sample(50);
            for (double& x : sample) x = random.uniform();
            std::sort(sample.begin(), sample.end());
            if (kolmogorovTail(kolmogorovDistance(sample, [](double x) { return x; }), 50) < 0.2) ++below;
        }
        // Binomial: 400 ± 18; four deviations.
        QVERIFY2(std::abs(below - 400) < 72, qPrintable(QString::number(below)));
    }

    void studentsFactorIsTheTabulatedOne() {
        for (const auto& [degrees, factor] : {std::pair(4.0, 2.7764), std::pair(10.0, 2.2281),
                                              std::pair(19.0, 2.0930), std::pair(120.0, 1.9799)})
            QVERIFY(std::abs(studentFactor(degrees) - factor) < 2e-3);
    }

    void theSpeedsOfMaxwellAreThoseOfThreeNormalComponents() {
        Random random(5);
        std::vector<double> speeds(20'000);
        for (double& speed : speeds)
            speed = std::hypot(random.gaussian(), random.gaussian(), random.gaussian());
        std::sort(speeds.begin(), speeds.end());
        QVERIFY(kolmogorovTail(kolmogorovDistance(speeds, maxwellShare), speeds.size()) > 0.01);
        for (double x = 0.1; x < 5; x += 0.1) { // the density is the derivative of the share
            constexpr double h = 1e-5;
            QVERIFY(std::abs((maxwellShare(x + h) - maxwellShare(x - h)) / (2 * h) - maxwellDensity(x)) <
                    1e-9);
        }
    }
};

} // namespace carom

CAROM_TEST(distributions_test, carom::DistributionsTest)
#include "distributions_test.moc"
