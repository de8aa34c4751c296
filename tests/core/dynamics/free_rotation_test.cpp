// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/dynamics/free_rotation.h"
#include "core/math/random.h"
#include "core/math/rotation.h"
#include "core/shapes/cuboid.h"
#include "core/study/cases/random_pairs.h"

#include <QTest>

#include <array>
#include <cmath>

// A body that no torque acts on: hard cases 8, 9 and 10 in short form, and closed forms.

namespace carom {
namespace {

const Cuboid brick{Vec3(0.1, 0.2, 0.3)};
constexpr double mass = 48; // [kg]

double energyOf(const Vec3& inertia, const Quat& orientation, const Vec3& momentum) {
    return 0.5 * momentum.dot(angularVelocityFrom(inertia, orientation, momentum));
}

double angleBetween(const Quat& a, const Quat& b) { return toRotationVector(a * b.conjugate()).norm(); }

} // namespace

class FreeRotationTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aFreelyRotatingBrickKeepsItsEnergy_data() {
        QTest::addColumn<double>("wx");
        QTest::addColumn<double>("wy");
        QTest::addColumn<double>("wz");
        QTest::addColumn<double>("step");
        QTest::addColumn<int>("steps");
        QTest::newRow("omega (1, 2, 3), 100 s") << 1.0 << 2.0 << 3.0 << 0.01 << 10000;
        QTest::newRow("about the middle axis, 100 s") << 0.01 << 5.0 << 0.01 << 0.01 << 10000;
        QTest::newRow("10,000 rad/s, 1 s") << 5000.0 << 5000.0 << 7000.0 << 1.0 / 240 << 240;
    }
    void aFreelyRotatingBrickKeepsItsEnergy() {
        QFETCH(double, wx);
        QFETCH(double, wy);
        QFETCH(double, wz);
        QFETCH(double, step);
        QFETCH(int, steps);
        const Vec3 inertia = inertiaOf(brick, mass);
        Quat orientation = Quat::Identity();
        const Vec3 momentum = angularMomentumFrom(inertia, orientation, Vec3(wx, wy, wz));
        const double energy = energyOf(inertia, orientation, momentum);
        double worst = 0;
        for (int i = 0; i < steps; ++i) {
            rotateFreely(inertia, momentum, step, orientation);
            worst = std::max(worst, std::abs(energyOf(inertia, orientation, momentum) / energy - 1));
        }
        qInfo("energy within %.1e", worst);
        QVERIFY(worst < 1e-12);
    }

    // Hard case 10, of which these are 2.5 s: 2,000 turns a step. Each normalised by itself took 7e-13 of the
    // energy, and always the same way: 3e-11 in 100 s.
    void thousandsOfTurnsAStepDoNotAddUpTheirRounding() {
        const Vec3 inertia = inertiaOf(brick, mass);
        Quat orientation = Quat::Identity();
        const Vec3 momentum = angularMomentumFrom(inertia, orientation, 1e4 * Vec3(1, 2, 3).normalized());
        const double energy = energyOf(inertia, orientation, momentum);
        constexpr double rounding = 1e-13; // a random walk of 2,000 steps of 1e-16 stays within 2e-14
        double worst = 0;
        for (int i = 0; i < 2000; ++i) {
            rotateFreely(inertia, momentum, 0.01 / 8, orientation);
            worst = std::max(worst, std::abs(energyOf(inertia, orientation, momentum) / energy - 1));
        }
        qInfo("energy within %.1e", worst);
        QVERIFY(worst < rounding);
    }

    // Hard case 8. With ω kept in place of L it lost 2e-16 of L a step, and always the same way.
    void aFreeBodyKeepsItsAngularMomentumToTheBit() {
        Bodies bodies;
        bodies.inertia.push_back(inertiaOf(brick, mass));
        State state;
        state.pose.emplace_back();
        state.angularVelocity.emplace_back(1, 2, 3);
        state.angularMomentum.emplace_back(Vec3::Zero());
        const Vec3 momentum = angularMomentumOf(bodies, 0, state);
        constexpr std::array<BodyIndex, 1> list = {0};
        constexpr int steps = 10'000;
        for (int i = 0; i < steps; ++i)
            i % 2 == 0 ? rotateAllFreely(bodies, list, 0.01, state)
                       : rotateInPieces(bodies, list, 0.01, 2, state);
        QVERIFY(angularMomentumOf(bodies, 0, state) == momentum);
        QVERIFY((state.angularVelocity[0] - Vec3(1, 2, 3)).norm() > 0.1); // it did turn
    }

    void anAngularVelocityThatSomethingChangedCountsMoreThanTheMomentumKept() {
        Bodies bodies;
        bodies.inertia.push_back(inertiaOf(brick, mass));
        State state;
        state.pose.emplace_back();
        state.angularVelocity.emplace_back(1, 2, 3);
        state.angularMomentum.emplace_back(Vec3::Zero());
        constexpr std::array<BodyIndex, 1> list = {0};
        rotateAllFreely(bodies, list, 0.01, state);
        state.angularVelocity[0] = Vec3(-1, 0, 0.5);
        QVERIFY(angularMomentumOf(bodies, 0, state) ==
                angularMomentumFrom(bodies.inertia[0], state.pose[0].orientation, Vec3(-1, 0, 0.5)));
        state.angularVelocity[0] = Vec3::Zero();
        QVERIFY(angularMomentumOf(bodies, 0, state) == Vec3::Zero());
    }

    // Hard case 8: the body's own motion has the period 4 K(k)/rate, 3.6718473 s for this brick.
    void theBodyMotionOfABrickHasThePeriodOfTheEllipticFunctions() {
        const Vec3 inertia = inertiaOf(brick, mass);
        Quat orientation = Quat::Identity();
        const Vec3 spin(1, 2, 3);
        const Vec3 momentum = angularMomentumFrom(inertia, orientation, spin);
        constexpr double period = 3.6718473; // [s], to the digits given
        constexpr int steps = 367;
        for (int i = 0; i < steps; ++i) rotateFreely(inertia, momentum, period / steps, orientation);
        const Vec3 bodySpin = orientation.conjugate() * angularVelocityFrom(inertia, orientation, momentum);
        QVERIFY((bodySpin - spin).norm() < 1e-6); // the period's last digit times the acceleration
    }

    // Hard case 9: a brick spun about its middle axis flips every 6.450623 s.
    void aBrickSpunAboutItsMiddleAxisFlipsOnTime() {
        const Vec3 inertia = inertiaOf(brick, mass);
        Quat orientation = Quat::Identity();
        const Vec3 momentum = angularMomentumFrom(inertia, orientation, Vec3(0.01, 5, 0.01));
        constexpr double interval = 6.450623, step = 1.0 / 240;
        double before = 5, last = 0;
        int flips = 0;
        double worst = 0;
        for (int i = 1; flips < 20; ++i) {
            rotateFreely(inertia, momentum, step, orientation);
            const double along =
                (orientation.conjugate() * angularVelocityFrom(inertia, orientation, momentum)).y();
            if ((along < 0) != (before < 0)) {
                const double time = (i - 1 + before / (before - along)) * step;
                if (flips > 0) worst = std::max(worst, std::abs((time - last) / interval - 1));
                last = time;
                ++flips;
            }
            before = along;
        }
        qInfo("intervals within %.1e", worst);
        QVERIFY(worst < 2e-6); // linear interpolation within a step leaves about 1e-6
    }

    void aSymmetricTopIsExactInOneStep() {
        const Vec3 inertia(2, 1, 2);
        const Quat start = fromRotationVector(Vec3(0.3, -0.2, 0.5));
        const Vec3 momentum(1, 2, -1);
        Quat once = start, often = start;
        rotateFreely(inertia, momentum, 3.0, once);
        for (int i = 0; i < 1000; ++i) rotateFreely(inertia, momentum, 0.003, often);
        QVERIFY(angleBetween(once, often) < 1e-12);
        // The axis turns about the angular momentum at |L|/I across.
        const Vec3 axis = fromRotationVector(3.0 * momentum / 2) * (start * Vec3::UnitY());
        QVERIFY((once * Vec3::UnitY() - axis).norm() < 1e-14);
    }

    /// Order 2 in parts of at most 1/20 rad: off by no more than what the parts add up to.
    void partsOfOrderTwoAreAsCloseAsTheirSizeSays() {
        const Vec3 inertia = inertiaOf(brick, mass);
        for (const double speed : {0.5, 5.0, 50.0, 500.0}) {
            Quat exact = Quat::Identity(), parts = exact;
            const Vec3 momentum = angularMomentumFrom(inertia, exact, speed * Vec3(1, 2, 3));
            const double step = 1.0 / 480, energy = energyOf(inertia, exact, momentum);
            for (int i = 0; i < 480; ++i) {
                rotateFreely(inertia, momentum, step, exact);
                rotateInParts(inertia, momentum, step, parts);
            }
            const double angle = momentum.norm() / inertia.minCoeff(), part = std::min(0.05, angle * step);
            const double off = angleBetween(exact, parts);
            qInfo("%g rad/s: off by %.1e rad after a second", speed * std::sqrt(14.0), off);
            QVERIFY(off < angle * part * part);
            QVERIFY(std::abs(energyOf(inertia, parts, momentum) / energy - 1) < part * part);
        }
    }
    /// Two constant rotations: exact for two equal moments; otherwise off by a part of the angle cubed at the
    /// end, where one constant angular velocity is off by its square.
    void twoRotationsTurnABodyAsItTurnsFreely() {
        const Quat start = fromRotationVector(Vec3(0.3, -0.2, 0.5));
        for (const Vec3& inertia : {Vec3(2, 0.1, 2), Vec3(1, 2, 1), Vec3(3, 3, 3), Vec3(1, 2, 2.5)})
            for (const double h : {0.4, 0.04, 0.004}) {
                const Vec3 momentum = angularMomentumFrom(inertia, start, Vec3(1, 2, -1));
                const TwoRotations turning = rotationsOf(inertia, momentum, h, start);
                Quat exact = start;
                rotateFreely(inertia, momentum, h, exact);
                const Quat two =
                    fromRotationVector(h * turning.world) * start * fromRotationVector(h * turning.body);
                const Quat one = fromRotationVector(h * Vec3(1, 2, -1)) * start;
                const double angle = h * std::sqrt(6.0);
                const bool isSymmetric = inertia.x() == inertia.z();
                QVERIFY(angleBetween(two, exact) < (isSymmetric ? 1e-14 : 0.1 * angle * angle * angle));
                if (!hasEqualMoments(inertia)) QVERIFY(angleBetween(one, exact) > 0.05 * angle * angle);
            }
    }

    void timeRunsBackwardsToTheStart() {
        const Vec3 inertia(1, 2, 3);
        const Quat start = fromRotationVector(Vec3(1, 0.4, -0.3));
        Quat orientation = start;
        const Vec3 momentum(3, -2, 1);
        rotateFreely(inertia, momentum, 0.4, orientation);
        QVERIFY(angleBetween(orientation, start) > 0.1);
        rotateFreely(inertia, momentum, -0.4, orientation);
        QVERIFY(angleBetween(orientation, start) < 1e-14);
    }

    // 112 m long, .4 m wide, .25 m thick, at 6 rad/s: cut by |L| over the smallest moment, 340,000 rad/s, it
    // took 10,000 parts a step and 17 ms.
    void aPlankTakesPartsByThePrecessionOfItsAxes() {
        const Vec3 inertia = inertiaOf(Cuboid{Vec3(56, 0.2, 0.125)}, 1);
        const Quat orientation = Quat::Identity();
        const Vec3 momentum = angularMomentumFrom(inertia, orientation, Vec3(0.02, 6, -0.02));
        const double parts = partsOfFreeRotation(inertia, momentum, 1.0 / 60, orientation);
        QVERIFY2(parts <= 4, qPrintable(QString::number(parts)));
    }

    void aCallIsAsCloseAsManyShortOnesWhateverTheShape() {
        Random random(20261124, 3);
        double worst = 0, most = 0, spared = 0;
        for (int trial = 0; trial < 400; ++trial) {
            Vec3 half;
            for (Eigen::Index k = 0; k < 3; ++k) half[k] = std::exp(random.uniform(-4, 4));
            const Vec3 inertia = inertiaOf(Cuboid{half}, 1);
            Quat whole = fromRotationVector(gaussianVector<3>(random));
            Vec3 spin = gaussianVector<3>(random);
            if (trial % 2 == 0) spin = spin.cwiseProduct(Vec3(1e-3, 1, 1e-3)); // about one axis, nearly
            const Vec3 momentum = angularMomentumFrom(inertia, whole, spin);
            constexpr double h = 0.05;
            constexpr int pieces = 64;
            const double parts = partsOfFreeRotation(inertia, momentum, h, whole);
            most = std::max(most, parts);
            spared = std::max(spared, h * momentum.norm() / inertia.minCoeff() / 0.05 / parts);
            Quat cut = whole;
            const Quat start = whole;
            rotateFreely(inertia, momentum, h, whole);
            for (int i = 0; i < pieces; ++i) rotateFreely(inertia, momentum, h / pieces, cut);
            // By rounding the axes are off by 1e-16 of |L| over the smallest moment.
            const double rounding = 1e-15 * h * momentum.norm() / inertia.minCoeff();
            worst = std::max(worst, angleBetween(whole, cut) / (1e-13 * parts + 1e-13 + rounding));
            QCOMPARE(partsOfFreeRotation(inertia, momentum, h, whole) - parts, 0.0);
            rotateFreely(inertia, momentum, -h, whole);
            QVERIFY(angleBetween(whole, start) < 1e-12 + 1e2 * rounding);
        }
        qInfo("worst %.2g of the bound, up to %g parts, up to %g times fewer than by |L|", worst, most,
              spared);
        QVERIFY(worst < 1);
        QVERIFY(spared > 100);
    }

    void aBodyAtRestIsNotTouched() {
        const Quat start(0.6, 0, 0.8, 1e-17);
        Quat orientation = start;
        rotateFreely(Vec3(1, 2, 3), Vec3::Zero(), 1, orientation);
        QCOMPARE(orientation.coeffs(), start.coeffs());
    }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, free_rotation_test, carom::FreeRotationTest)
#include "free_rotation_test.moc"
