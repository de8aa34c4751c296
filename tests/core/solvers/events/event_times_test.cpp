// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/trials.h"

#include "core/solvers/events/event_times.h"

#include "core/math/random.h"

#include <QTest>

#include <array>
#include <bit>
#include <cmath>

namespace carom {
namespace {

/// Relative to the time found; one root and a handful of sums.
constexpr double roundingOfTimes = 1e-13;

Vec3 anyVector(Random& random, double deviation) {
    return {random.gaussian(0, deviation), random.gaussian(0, deviation), random.gaussian(0, deviation)};
}

double gapAt(const TrajectoryOrigin& a, const Vec3& gA, const TrajectoryOrigin& b, const Vec3& gB,
             double time) {
    return (positionAt(b, gB, time) - positionAt(a, gA, time)).norm() - a.radius - b.radius;
}

/// The obvious way: walk in small steps until the gap turns negative, then halve.
double collisionBySteps(const TrajectoryOrigin& a, const Vec3& gA, const TrajectoryOrigin& b, const Vec3& gB,
                        double from, double until) {
    constexpr int steps = 20'000;
    double before = from, gapBefore = gapAt(a, gA, b, gB, from);
    for (int k = 1; k <= steps; ++k) {
        const double now = from + (until - from) * k / steps, gap = gapAt(a, gA, b, gB, now);
        if (gapBefore > 0 && gap <= 0) {
            double low = before, high = now;
            for (int i = 0; i < 80; ++i) {
                const double middle = 0.5 * (low + high);
                (gapAt(a, gA, b, gB, middle) > 0 ? low : high) = middle;
            }
            return high;
        }
        before = now;
        gapBefore = gap;
    }
    return never;
}

} // namespace

class EventTimesTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aDroppedBallReachesTheFloorAfterTheRootOfTwoHeightsOverGravity() {
        for (const double height : {1e-9, 1e-3, 1.0, 1e3}) {
            const double closed = std::sqrt(2 * height / 9.81);
            QVERIFY(std::abs(timeToPlane(height, 0, -9.81) - closed) <= roundingOfTimes * closed);
        }
    }

    void aThrownBallComesBackAfterTwiceItsSpeedOverGravity() {
        QCOMPARE(timeToPlane(0, 3, -9.81), 2 * 3 / 9.81);
        QCOMPARE(timeToPlane(0, 3, 0), never);
        QCOMPARE(timeToPlane(0, -3, -9.81), 0.0);
        QCOMPARE(timeToPlane(1, -2, 0), 0.5);
        QCOMPARE(timeToPlane(1, -1, 1), never); // turns round before it arrives
        QVERIFY(std::abs(timeToPlane(1, -2, 1.5) - (2 - std::sqrt(4 - 3.0)) / 1.5) < roundingOfTimes);
    }

    void aFallingRootIsTheFirstAndFalls() {
        // (t−1)(t−2)(t−3)(t−4) = 24 − 50 t + 35 t² − 10 t³ + t⁴: falls at 1 and 3.
        QVERIFY(std::abs(firstFallingRoot({24, -50, 35, -10, 1}) - 1) < 1e-12);
        // −(t−2) and t²: one root, none.
        QCOMPARE(firstFallingRoot({2, -1, 0, 0, 0}), 2.0);
        QCOMPARE(firstFallingRoot({1, 0, 1, 0, 0}), never);
        // Touching at once: falling, or rising and falling back later, (t)(t−1)(t−2) ...
        QCOMPARE(firstFallingRoot({0, -1, 1, 0, 0}), 0.0);
        QVERIFY(std::abs(firstFallingRoot({0, 2, -3, 1, 0}) - 1) < 1e-12);
    }

    // Against bisection with more digits, where hops last from a second down to a billionth of one.
    void aFallingRootIsFoundToRounding() {
        constexpr std::uint64_t seed = 20054;
        constexpr double roundingOfRoots = 1e-14; // relative
        Random random(seed);
        for (int trial = 0; trial < test::trials(2000); ++trial) {
            const double hop = std::pow(10.0, random.uniform(-9, 0));
            const std::array<double, 5> q{0, random.uniform(1, 2) * hop, -random.uniform(1, 2),
                                          random.uniform(-1, 1), random.uniform(0, 20)};
            const auto value = [&](long double t) { return q[1] + t * (q[2] + t * (q[3] + t * q[4])); };
            long double low = 0, high = 4 * hop;
            if (value(high) >= 0) continue; // another shape
            for (int round = 0; round < 100; ++round) {
                const long double middle = (low + high) / 2;
                (value(middle) > 0 ? low : high) = middle;
            }
            const double expected = static_cast<double>(low);
            QVERIFY2(std::abs(firstFallingRoot(q) - expected) <= roundingOfRoots * expected,
                     qPrintable(QStringLiteral("seed %1 trial %2").arg(seed).arg(trial)));
        }
    }

    void aCollisionUnderCommonGravityIsFoundWhereSmallStepsFindIt() {
        constexpr std::uint64_t seed = 20051;
        Random random(seed);
        int collisions = 0;
        for (int trial = 0; trial < test::trials(300); ++trial) {
            const Vec3 g = anyVector(random, 5);
            const TrajectoryOrigin a{anyVector(random, 1), random.uniform(0, 0.2), anyVector(random, 2), 0.3};
            const TrajectoryOrigin b{anyVector(random, 0.5) + Vec3(3, 0, 0), random.uniform(0, 0.2),
                                     anyVector(random, 1) - Vec3(4, 0, 0), 0.5};
            const double found = pairTime(a, b, g);
            const double expected = collisionBySteps(a, g, b, g, std::max(a.time, b.time), 4);
            if (expected == never) continue; // a graze between two steps is not seen that way
            ++collisions;
            QVERIFY2(std::abs(found - expected) < 1e-9,
                     qPrintable(QStringLiteral("seed %1 trial %2").arg(seed).arg(trial)));
        }
        QVERIFY(collisions > test::trials(10));
    }

    void aCollisionUnderDifferentAccelerationsIsFoundWhereSmallStepsFindIt() {
        constexpr std::uint64_t seed = 20052;
        Random random(seed);
        int collisions = 0;
        for (int trial = 0; trial < test::trials(300); ++trial) {
            const Vec3 gA = anyVector(random, 4), gB = anyVector(random, 4);
            const TrajectoryOrigin a{anyVector(random, 1), random.uniform(0, 0.2), anyVector(random, 2), 0.3};
            const TrajectoryOrigin b{anyVector(random, 0.5) + Vec3(3, 0, 0), random.uniform(0, 0.2),
                                     anyVector(random, 1) - Vec3(3, 0, 0), 0.5};
            const double found = pairTime(a, gA, b, gB);
            const double expected = collisionBySteps(a, gA, b, gB, std::max(a.time, b.time), 4);
            if (expected == never) continue;
            ++collisions;
            QVERIFY2(std::abs(found - expected) < 1e-9,
                     qPrintable(QStringLiteral("seed %1 trial %2").arg(seed).arg(trial)));
        }
        QVERIFY(collisions > test::trials(10));
    }

    // One that hopped lower than rounding had put it into the other never hit it again, and sank into it.
    void aBallThatOverlapsByRoundingAndBouncesComesBack() {
        const TrajectoryOrigin below{Vec3::Zero(), 0, Vec3::Zero(), 0.1};
        const TrajectoryOrigin above{Vec3(0, 0.2 * (1 - 1e-16), 0), 0, Vec3(0, 1e-10, 0), 0.1};
        const double found = pairTime(below, Vec3::Zero(), above, Vec3(0, -10, 0));
        QVERIFY2(std::abs(found / 2e-11 - 1) < 1e-9, qPrintable(QString::number(found)));
    }

    void exchangingTheTwoBallsChangesNoBit() {
        Random random(20053);
        for (int trial = 0; trial < test::trials(1000); ++trial) {
            const Vec3 g = anyVector(random, 5);
            const TrajectoryOrigin a{anyVector(random, 1), random.uniform(), anyVector(random, 2), 0.3};
            const TrajectoryOrigin b{anyVector(random, 2), random.uniform(), anyVector(random, 2), 0.5};
            QCOMPARE(std::bit_cast<std::uint64_t>(pairTime(a, b, g)),
                     std::bit_cast<std::uint64_t>(pairTime(b, a, g)));
        }
    }

    // Two balls that pass at (1 − 10⁻ᵏ) of the sum of their radii hit, at (1 + 10⁻ᵏ) they do not.
    void aGrazeHitsJustInsideAndMissesJustOutside() {
        for (int k = 1; k <= 12; ++k) {
            const double sum = 1.0, slip = std::pow(10.0, -k);
            const TrajectoryOrigin a{Vec3::Zero(), 0, Vec3::Zero(), 0.4};
            const TrajectoryOrigin inside{Vec3(-5, sum * (1 - slip), 0), 0, Vec3(2, 0, 0), 0.6};
            const TrajectoryOrigin outside{Vec3(-5, sum * (1 + slip), 0), 0, Vec3(2, 0, 0), 0.6};
            QVERIFY2(pairTime(a, inside, Vec3::Zero()) < never, qPrintable(QString::number(k)));
            QVERIFY2(pairTime(a, outside, Vec3::Zero()) == never, qPrintable(QString::number(k)));
        }
    }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, event_times_test, carom::EventTimesTest)
#include "event_times_test.moc"
