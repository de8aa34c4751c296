// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/math/random.h"

#include <QObject>
#include <QTest>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

namespace {

using carom::Random;

constexpr std::uint64_t randomSeed = 7;
constexpr int draws = 200'000;

class RandomTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void theSameSeedGivesTheSameBitsOnEveryMachine() {
        Random words(1);
        for (const std::uint64_t word : {0x8C763A220DBCA164ULL, 0x2347E8829062B17CULL, 0x4E504E74DD057B7CULL})
            QCOMPARE(words.bits(), std::uint64_t{word});
        Random other(1, 2);
        QCOMPARE(other.bits(), std::uint64_t{0xC3C3741BF89633E7ULL});
        Random normal(1);
        for (const double x : {0x1.317f1ccd78f1cp-3, -0x1.abbdfb2e7aecfp-3, -0x1.914537dd0d924p-1})
            QCOMPARE(std::bit_cast<std::uint64_t>(normal.gaussian()), std::bit_cast<std::uint64_t>(x));
    }

    void seedsAndStreamsDoNotRunAlongside() {
        std::set<std::uint64_t> firsts;
        for (std::uint64_t s = 0; s < 100; ++s)
            for (std::uint64_t stream = 0; stream < 100; ++stream) firsts.insert(Random(s, stream).bits());
        QCOMPARE(firsts.size(), std::size_t{10'000});
    }

    void uniformNumbersFillTheUnitIntervalEvenly() {
        Random random(randomSeed);
        std::array<int, 20> counts{};
        for (int i = 0; i < draws; ++i) {
            const double u = random.uniform();
            QVERIFY(u >= 0 && u < 1);
            ++counts[static_cast<std::size_t>(u * 20)];
        }
        double chiSquared = 0;
        const double expected = draws / 20.0;
        for (const int count : counts) chiSquared += (count - expected) * (count - expected) / expected;
        QVERIFY(chiSquared <
                43.8); // 19 degrees of freedom: exceeded once in a thousand seeds, and this one is fixed
    }

    void uniformNumbersStayBetweenTheirBounds() {
        Random random(randomSeed);
        for (int i = 0; i < 1000; ++i) {
            const double u = random.uniform(-3, 5);
            QVERIFY(u >= -3 && u < 5);
        }
    }

    void gaussianNumbersHaveTheMomentsOfTheNormalDistribution() {
        Random random(randomSeed);
        double first = 0, second = 0, third = 0, fourth = 0;
        for (int i = 0; i < draws; ++i) {
            const double x = random.gaussian();
            first += x;
            second += x * x;
            third += x * x * x;
            fourth += x * x * x * x;
        }
        // Four standard errors: the moments' variances are 1, 2, 15 and 96 over the number of draws.
        const double root = std::sqrt(static_cast<double>(draws));
        QVERIFY(std::abs(first / draws) < 4 / root);
        QVERIFY(std::abs(second / draws - 1) < 4 * std::sqrt(2.0) / root);
        QVERIFY(std::abs(third / draws) < 4 * std::sqrt(15.0) / root);
        QVERIFY(std::abs(fourth / draws - 3) < 4 * std::sqrt(96.0) / root);
    }

    void gaussianNumbersTakeAMeanAndADeviation() {
        Random plain(randomSeed);
        Random scaled(randomSeed);
        QCOMPARE(scaled.gaussian(10, 2), 10 + 2 * plain.gaussian());
    }

    void countsBelowABoundAreUnbiased() {
        Random random(randomSeed);
        std::array<int, 7> counts{};
        for (int i = 0; i < 70'000; ++i) ++counts[random.below(7)];
        for (const int count : counts) QVERIFY(std::abs(count - 10'000) < 400); // four deviations of 93
        QCOMPARE(random.below(1), std::uint64_t{0});
    }
};

} // namespace

CAROM_TEST(random_test, RandomTest)
#include "random_test.moc"
