// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/solvers/contacts/entered.h"
#include "tests/support/contact_scenes.h"
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"

#include "core/math/rotation.h"
#include "core/simulation/touching.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <numbers>

// Rows that are kept within a frame: which ones depends on nothing that is far away, and what rocks does not
// outlast them.

namespace carom {
namespace {

/// Adds towers of two cubes. The lower ones fall flat on the floor, and the upper ones slide.
void addTowers(Scene& scene, double where, int count, double tilt, double speed) {
    const double middle = 0.5 * (std::cos(tilt) + std::sin(tilt));
    for (int k = 0; k < count; ++k) {
        Body lower = test::cuboid({1, 1, 1}, 1, {where, middle, 3.0 * k});
        lower.pose.orientation = fromRotationVector({0, 0, tilt});
        Body upper = test::cuboid({1, 1, 1}, 1, {where + 0.05, 2 * middle + 0.5 + 0.2 * tilt, 3.0 * k + 0.1});
        upper.velocity = {0.5, 0, 0.1 * k};
        lower.velocity = {0, 0, speed};
        for (Body* body : {&lower, &upper}) scene.bodies.push_back(test::rough(*body, 0.5, 0, 0.001 * k));
    }
}

} // namespace

class SteppedMotionKeepingTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // All islands of a division are moved together. Whether rows were kept was decided for all of them, and
    // rows were made anew with the others of their group: bodies were somewhere else, by the rounding of
    // some steps, where others slid 100 m away.
    void towersMoveAsTheyDoAlone_data() {
        QTest::addColumn<double>("tilt");
        QTest::addColumn<double>("speed");
        for (const double tilt : {0.0, 0.02, 0.1})
            for (const double speed : {0.0, 0.3, 3.0, 6.0})
                QTest::addRow("tilt %.2f, others at %.1f m/s", tilt, speed) << tilt << speed;
    }
    void towersMoveAsTheyDoAlone() {
        QFETCH(double, tilt);
        QFETCH(double, speed);
        constexpr int count = 5, frames = 60;
        Scene alone = test::sceneOf({test::floorOf(0.5)}, test::downwards());
        addTowers(alone, 0, count, tilt, 0);
        Scene beside = alone;
        addTowers(beside, 100, 2 * count, 0.05, speed);
        test::Entered one(alone), both(beside);
        for (int substep = 0; substep < test::substeps * frames; ++substep) {
            const bool isFirst = substep % test::substeps == 0;
            one.step(isFirst);
            both.step(isFirst);
            for (const BodyIndex i : one.bodies.mobileBodies) {
                const Vec3 apart = both.state.pose[i].position - one.state.pose[i].position;
                QVERIFY2(
                    apart == Vec3::Zero(),
                    qPrintable(
                        QStringLiteral("body %1, substep %2: %3 m").arg(i).arg(substep).arg(apart.norm())));
            }
        }
    }

    // A disc that lies on a block and is turned up at one side rocks on its rim, which is held at four points
    // of it. Between two of these it comes down by up to (1 − 1/√2) r φ while they are kept: .0029 r in this
    // frame.
    void discThatRocksStaysOutOfTheBlock() {
        constexpr double radius = 0.5, height = 0.14, spin = 0.6, most = 1e-3; // of the radius
        double deepest = 0;
        for (int heading = 0; heading < 16; ++heading) {
            const double angle = heading * std::numbers::pi / 32;
            Body block = test::cuboid({2, 1, 2}, 1, {0, -0.5, 0});
            block.fixed = true;
            Body disc = test::cylinder(radius, height, 1, {0, 0.5 * height, 0});
            disc.angularVelocity = spin * Vec3(std::cos(angle), 0, std::sin(angle));
            disc.velocity.y() = spin * radius; // about the rim
            test::Entered world(test::sceneOf({block, disc}, test::downwards()));
            for (int substep = 0; substep < test::substeps; ++substep) world.step(substep == 0);
            for (const TouchingPair& touching : touchingPairs(world.bodies, world.state))
                deepest = std::max(deepest, -touching.manifold.deepest().separation / radius);
        }
        QVERIFY2(deepest < most, qPrintable(QStringLiteral("%1 of the radius").arg(deepest)));
    }

    // A disc that slaps down on the floor turns by as much as it leans within a few steps: what strikes is a
    // place of the rim between the points that were found.
    void discThatSlapsDownStaysOutOfTheFloor() {
        constexpr double radius = 0.18, height = 0.14, most = 5e-4; // of the radius
        double deepest = 0;
        for (const double spin : {6.0, 9.0, 12.0, 15.0})
            for (int heading = 0; heading < 32; ++heading) {
                const Quat turn = fromRotationVector({0, heading * std::numbers::pi / 16, 0});
                Body disc = test::rough(test::cylinder(radius, height, 1, {0, 0.0888, 0}), 0, 0.8);
                disc.pose.orientation = turn * fromRotationVector({-0.005, -0.073, -0.107});
                disc.angularVelocity = turn * Vec3(-0.93 * spin, 0, 0.37 * spin);
                disc.velocity = {0, -0.75, 0};
                test::Entered world(test::sceneOf({test::floorOf(0, 0.8), disc}, test::downwards()));
                for (int substep = 0; substep < 3 * test::substeps; ++substep) {
                    world.step(substep % test::substeps == 0);
                    for (const TouchingPair& touching : touchingPairs(world.bodies, world.state))
                        deepest = std::max(deepest, -touching.manifold.deepest().separation / radius);
                }
            }
        QVERIFY2(deepest < most, qPrintable(QStringLiteral("%1 of the radius").arg(deepest)));
    }
};

} // namespace carom

CAROM_TEST(stepped_motion_keeping_test, carom::SteppedMotionKeepingTest)
#include "stepped_motion_keeping_test.moc"
