// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/math/compensated.h"

#include "core/math/random.h"

#include <QtTest/QTest>

#include <cmath>

namespace carom::testing {
namespace {

constexpr std::uint64_t compensatedSeed = 20261121;
constexpr int trials = 20'000;
// Of a sum in twice 53 bits.
constexpr long double twiceTheDigits = 1e-27L;

/// Numbers of very different sizes.
double anyNumber(Random& random) {
    return std::ldexp(random.uniform(-1, 1), static_cast<int>(random.uniform(-30, 30)));
}

} // namespace

class CompensatedTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void aSumAndAProductAreTheirNumberAndItsRest() {
        Random random(compensatedSeed);
        for (int i = 0; i < trials; ++i) {
            const double a = anyNumber(random), b = anyNumber(random);
            const WithRest<double> product = exactProduct(a, b);
            QCOMPARE(product.value, a * b);
            QCOMPARE(product.rest, std::fma(a, b, -product.value));
            // With the number of the smaller magnitude second, Dekker's shorter form says the same.
            const double large = std::abs(a) < std::abs(b) ? b : a, small = std::abs(a) < std::abs(b) ? a : b;
            const WithRest<double> sum = exactSum(a, b);
            QCOMPARE(sum.value, a + b);
            QCOMPARE(sum.rest, small - (sum.value - large));
        }
    }

    void aPlaceKeepsTheDigitsOfSmallSteps() {
        Vec3 place(0.5, 1e6, -3), rest = Vec3::Zero();
        for (int i = 0; i < 1000; ++i) moveBy(Vec3(1e-17, -1e-11, 1e-16), place, rest);
        const Vec3 moved = (place - Vec3(0.5, 1e6, -3)) + rest;
        QVERIFY((moved - Vec3(1e-14, -1e-8, 1e-13)).cwiseQuotient(moved).norm() < 1e-12);
    }

    // Hard case 3: of the height .5 + 1e-9 a double says the gap to seven digits, its rest all the others.
    void aGapOfANanometreHasAllItsDigits() {
        const Vec3 place(0, 0.5 + 1e-9, 0), rest(0, 1e-9 - ((0.5 + 1e-9) - 0.5), 0);
        QCOMPARE(exactGap(Vec3::UnitY(), 0, 0.5, place, rest), 1e-9);
        QVERIFY(std::abs((place.y() - 0.5) / 1e-9 - 1) > 1e-8);
    }

    void aGapAboveASlopeIsThatOfLongNumbers() {
        Random random(compensatedSeed);
        for (int i = 0; i < trials; ++i) {
            const Vec3 normal = Vec3(random.gaussian(), random.gaussian(), random.gaussian()).normalized();
            const double radius = random.uniform(0.1, 1), offset = random.uniform(-10, 10);
            const Vec3 place = (offset + radius + random.uniform(0, 1e-9)) * normal +
                               normal.cross(Vec3(random.gaussian(), random.gaussian(), random.gaussian()));
            const Vec3 rest = 1e-17 * Vec3(random.gaussian(), random.gaussian(), random.gaussian());
            WithRest<long double> sum{0, 0}; // of long numbers the rounding is carried, too
            const auto add = [&sum](long double term) {
                const long double next = sum.value + term, part = next - sum.value;
                sum.rest += (sum.value - (next - part)) + (term - part);
                sum.value = next;
            };
            for (int axis = 0; axis < 3; ++axis) {
                const WithRest<double> product = exactProduct(normal[axis], place[axis]);
                add(product.value);
                add(product.rest);
                add(static_cast<long double>(normal[axis]) * rest[axis]);
            }
            add(-offset);
            add(-radius);
            const long double expected = sum.value + sum.rest;
            const double found = exactGap(normal, offset, radius, place, rest);
            const long double allowed = 1e-15L * std::abs(expected) + twiceTheDigits;
            QVERIFY2(std::abs(found - expected) <= allowed, qPrintable(QString::number(i)));
        }
    }
};

} // namespace carom::testing

CAROM_TEST_WITH(QCoreApplication, compensated_test, carom::testing::CompensatedTest)
#include "compensated_test.moc"
