// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/contact_scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include "core/solvers/contacts/bounce_train.h"
#include "core/study/cases/scene_text.h"

#include <QTest>

#include <cmath>

// Impacts under method `contacts` against closed forms: hard cases 1, 3 to 7, 19 and 20 in short form.

namespace carom {
namespace {

using namespace test;

/// Balls of radius 0.5 in a row along x, touching; the first `moving` come with `speed` from a metre away.
Scene cradle(int balls, int movingBalls, double speed) {
    Scene scene = sceneOf({});
    for (int i = 0; i < balls; ++i) {
        const bool comes = i < movingBalls;
        scene.bodies.push_back(rough(moving(sphere(0.5, 1, Vec3(i - (comes ? 1 : 0), 0, 0)),
                                            comes ? Vec3(speed, 0, 0) : Vec3(Vec3::Zero())),
                                     0, 1));
    }
    return scene;
}

} // namespace

class ImpactsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // Hard case 1.
    void anElasticBallKeepsItsEnergyFor20Seconds_data() { bothPresets(); }
    void anElasticBallKeepsItsEnergyFor20Seconds() {
        QFETCH(QByteArray, preset);
        World world =
            worldOf(sceneOf({floorOf(0, 1), rough(sphere(0.1, 1, Vec3(0, 5, 0)), 0, 1)}, downwards()),
                    contacts(preset));
        const double energy = energyOf(world);
        double worst = 0;
        for (int i = 0; i < 1200; ++i) {
            world.step();
            worst = std::max(worst, std::abs(energyOf(world) / energy - 1));
        }
        qInfo("energy within %.1e", worst);
        QVERIFY(worst < 1e-12);
    }

    // Hard case 3, by speed: the rebound has the speed of the fall over 12 decades of height.
    void aDropOfAnyHeightReboundsFully() {
        constexpr double rounding = 1e-12; // of speeds, after some thousand bounces
        for (double height = 1e-9; height < 2e3; height *= 10) {
            double gap = height, speed = 0;
            const double energy = gravity * height;
            for (int step = 0; step < 1000; ++step) {
                const Bounce after = bounceTrain(gap, speed, gravity, 1, 1.0 / 240);
                gap = after.gap;
                speed = after.speed;
                QVERIFY(!after.rests);
                QVERIFY(std::abs((0.5 * speed * speed + gravity * gap) / energy - 1) < rounding * (1 + step));
            }
        }
    }

    // Hard case 4: from rest at height h a point comes to rest after t0 (1+e)/(1−e), t0 = sqrt(2 h/g).
    void aBouncingPointRestsOnTime() {
        constexpr double g = 9.80665, height = 1, step = 1.0 / 240;
        const double fall = std::sqrt(2 * height / g);
        for (const double e : {0.5, 0.9, 0.99}) {
            double gap = height, speed = 0, time = 0;
            Bounce after;
            while (!after.rests && time < 200) {
                after = bounceTrain(gap, speed, g, e, step);
                gap = after.gap;
                speed = after.speed;
                time += after.rests ? after.restsAfter : step;
            }
            const double expected = fall * (1 + e) / (1 - e);
            qInfo("e = %g rests after %.12g s, off by %.1e", e, time, time / expected - 1);
            QVERIFY(std::abs(time / expected - 1) < 1e-9);
            QCOMPARE(bounceTrain(0, 0, g, e, step).speed, 0.0);
        }
    }

    // Hard case 5.
    void anElasticSphereLaidOnAWallNeverMoves() {
        World world =
            worldOf(sceneOf({floorOf(0, 1), rough(sphere(0.1, 1, Vec3(0, 0.1, 0)), 0, 1)}, downwards()),
                    contacts("default"));
        run(world, 1000);
        QCOMPARE(world.state().pose[1].position, Vec3(0, 0.1, 0));
        QCOMPARE(world.state().velocity[1], Vec3(Vec3::Zero()));
    }

    // Hard case 6.
    void twoSpheresPartAtMinusETimesTheirClosingSpeed() {
        double worst = 0;
        for (int k = 0; k <= 20; ++k)
            for (const double mass : {1.0, 1e2, 1e4, 1e6}) {
                const double e = 0.05 * k;
                World world =
                    worldOf(sceneOf({rough(sphere(0.5, 1, Vec3(-1.3, 0, 0), Vec3(3, 0, 0)), 0, e),
                                     rough(sphere(0.5, mass, Vec3(1, 0, 0), Vec3(-1, 0, 0)), 0, e)}),
                            contacts("default"));
                run(world, 60);
                const double separation = world.state().velocity[1].x() - world.state().velocity[0].x();
                worst = std::max(worst, std::abs(separation - 4 * e) / 4);
            }
        qInfo("within %.1e", worst);
        QVERIFY(worst < 1e-12);
    }

    // Hard case 7.
    void aCubeDroppedFlatOnASmallerOneReturnsWithoutSpin_data() { bothPresets(); }
    void aCubeDroppedFlatOnASmallerOneReturnsWithoutSpin() {
        QFETCH(QByteArray, preset);
        Body anvil = rough(cuboid(Vec3(0.5, 0.5, 0.5), 1, Vec3(0, -0.25, 0)), 0, 1);
        anvil.fixed = true;
        World world =
            worldOf(sceneOf({anvil, rough(cuboid(Vec3(1, 1, 1), 1, Vec3(0, 10.5, 0)), 0, 1)}, downwards()),
                    contacts(preset));
        const double energy = energyOf(world);
        double worst = 0, spin = 0;
        for (int i = 0; i < 300; ++i) {
            world.step();
            worst = std::max(worst, std::abs(energyOf(world) / energy - 1));
            spin = std::max(spin, world.state().angularVelocity[1].norm());
        }
        qInfo("energy within %.1e, spin at most %.1e rad/s", worst, spin);
        QVERIFY(worst < 1e-9);
        QVERIFY(spin < 1e-9);
    }

    // Hard case 19.
    void asManyBallsLeaveANewtonsCradleAsCome() {
        for (const int balls : {5, 50})
            for (const int come : balls == 5 ? std::vector<int>{1, 2, 3, 4} : std::vector<int>{1, 7}) {
                World world = worldOf(cradle(balls, come, 2), contacts("default"));
                run(world, 60);
                for (int i = 0; i < balls; ++i) {
                    const double expected = i >= balls - come ? 2 : 0;
                    QVERIFY(std::abs(world.state().velocity[static_cast<std::size_t>(i)].x() - expected) <
                            1e-12);
                }
            }
    }

    // Hard case 20.
    void aBallStruckFromBothSidesStandsStillBitForBit() {
        World world = worldOf(sceneOf({rough(sphere(0.5, 1, Vec3(-2, 0, 0), Vec3(5, 0, 0)), 0, 1),
                                       rough(sphere(0.5, 1, Vec3(0, 0, 0)), 0, 1),
                                       rough(sphere(0.5, 1, Vec3(2, 0, 0), Vec3(-5, 0, 0)), 0, 1)}),
                              contacts("default"));
        run(world, 60);
        QCOMPARE(world.state().velocity[1], Vec3(Vec3::Zero()));
        QCOMPARE(world.state().velocity[0].x(), -world.state().velocity[2].x());
        QCOMPARE(world.state().pose[0].position.x(), -world.state().pose[2].position.x());
        QVERIFY(std::abs(world.state().velocity[2].x() - 5) < 1e-12);
    }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, impacts_test, carom::ImpactsTest)
#include "impacts_test.moc"
