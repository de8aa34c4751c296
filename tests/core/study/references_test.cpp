// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/study/references.h"

#include <QTest>

#include <cmath>
#include <numbers>

// Closed forms against published figures, and against the equations they solve.

namespace carom {
namespace {

using namespace reference;

bool near(double value, double expected, double relative) {
    return std::abs(value - expected) <= relative * std::abs(expected);
}

/// The figures below are published with seven to eight digits.
constexpr double printed = 1e-7;
constexpr double rounding = 1e-13;

} // namespace

class ReferencesTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aBouncingPointRestsAfterTheSumOfItsBounces() {
        const BouncingPoint point{1, 9.80665, 0.5};
        double time = point.firstContact(), speed = 0.5 * 9.80665 * time, path = 1;
        for (int k = 1; k < 60; ++k) {
            QVERIFY(near(point.impactTime(k), time, rounding));
            const Motion apex = point.at(time + speed / 9.80665);
            QVERIFY(near(apex.place, speed * speed / (2 * 9.80665), 1e-9) || apex.place < 1e-12);
            path += speed * speed / 9.80665;
            time += 2 * speed / 9.80665;
            speed *= 0.5;
        }
        QVERIFY(near(point.restTime(), time, rounding));
        QVERIFY(near(point.path(), path, rounding));
        QCOMPARE(point.at(2 * time).place, 0.0);
    }

    void anElasticPointIsPeriodic() {
        const BouncingPoint point{2, 9.81, 1};
        const double period = 2 * point.firstContact();
        for (const double time : {0.1, 0.5, 0.9, 1.2}) {
            QVERIFY(near(point.at(time + 1000 * period).place, point.at(time).place, 1e-10));
            QVERIFY(near(point.at(time + 1000 * period).speed, point.at(time).speed, 1e-10));
        }
    }

    void aReboundKeepsMomentumAndReturnsESpeeds() {
        const Rebound after = rebound(2, 3, 5, -1, 0.25);
        QVERIFY(near(2 * after.first + 5 * after.second, 2 * 3 - 5, rounding));
        QVERIFY(near(after.second - after.first, 0.25 * 4, rounding));
    }

    void slidingAndRollingHaveTheirPublishedFigures() {
        const SlidingRoller sphere{5, 0.3, 0.4, 9.81}, cylinder{5, 0.3, 0.5, 9.81};
        QVERIFY(near(sphere.rollTime(), 0.4854133, printed));
        QVERIFY(near(cylinder.rollTime(), 0.5663156, printed));
        QVERIFY(near(sphere.rollingSpeed(), 25.0 / 7, rounding));
        QVERIFY(near(sphere.at(2).speed, 25.0 / 7, rounding));
        QVERIFY(near(SlidingBlock({3, 0.5, 9.81}).at(9).place, 9 / 9.81, rounding));
        QVERIFY(near(std::tan(slipSlope(0.2, 0.4)), 0.7, rounding));
        const double limit = slipSlope(0.2, 0.4); // both laws agree there
        QVERIFY(near(slopeAcceleration(limit * (1 + 1e-12), 0.2, 0.4, 9.81),
                     slopeAcceleration(limit, 0.2, 0.4, 9.81), 1e-10));
    }

    void aDampedOscillatorSolvesItsEquation() {
        const Oscillator spring{0.3, 7, 0.8};
        QVERIFY(near(spring.at(0).place, 0.3, rounding));
        constexpr double h = 1e-4;
        for (const double t : {0.2, 1.0, 1.7}) {
            const double acceleration = (spring.at(t + h).speed - spring.at(t - h).speed) / (2 * h);
            const double force = -49 * spring.at(t).place - 2 * 0.8 * spring.at(t).speed;
            QVERIFY(std::abs(acceleration - force) < 1e-6 * 49 * 0.3); // h² of the third derivative
        }
    }

    void eulersDiskPrecessesAsPublished() {
        const double degree = std::numbers::pi / 180;
        QVERIFY(near(diskPrecession(0.0375, 0.0065, 10 * degree, 9.81), 77.24975, printed));
        QVERIFY(near(diskPrecession(0.0375, 0.0065, 20 * degree, 9.81), 56.00504, printed));
        QVERIFY(near(diskPrecession(0.0375, 0.0065, 45 * degree, 9.81), 42.00316, printed));
    }

    void aRockingBlockKeepsHousnersShare() { QVERIFY(near(housnerRatio(0.1, 0.4), 0.8313149, printed)); }

    void aFreeCuboidRepeatsAfterItsPeriod() {
        const Vec3 inertia(0.13 / 3, 0.10 / 3, 0.05 / 3);
        QVERIFY(near(freeRotationPeriod(inertia, Vec3(1, 2, 3)), 3.6718473, printed));
        QVERIFY(near(freeRotationPeriod(inertia, Vec3(0.01, 5, 0.01)) / 2, 6.450623, printed));
    }

    void hardSpheresHaveTheirPublishedPressure() {
        QVERIFY(near(hardSphereCompressibility(0.5), 3.262431, printed));
        QCOMPARE(hardSphereCompressibility(0), 1.0);
    }

    void theEllipticIntegralIsRightAtItsEnds() {
        QVERIFY(near(completeEllipticK(0), std::numbers::pi / 2, rounding));
        QVERIFY(near(completeEllipticK(std::sqrt(0.5)), 1.8540746773013719, rounding));
    }
};

} // namespace carom

CAROM_TEST(references_test, carom::ReferencesTest)
#include "references_test.moc"
