// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include "core/dynamics/energy.h"

#include <QTest>

#include <cmath>

// The reference's procedure, rule by rule: what one step does to two or three bodies that overlap.

namespace carom {
namespace {

using test::cuboid;
using test::cylinder;
using test::run;
using test::sceneOf;
using test::sphere;
using test::wall;
using test::worldOf;

/// Small numbers, a handful of operations each.
constexpr double roundingOfImpacts = 1e-14;

/// A step so short that nothing moves but by displacement.
SimulationSettings instant() {
    SimulationSettings options = test::byMethod("microcollisions");
    options.step = 1e-30;
    return options;
}

Vec3 positionOf(const World& world, BodyIndex body) { return world.state().pose[body].position; }

} // namespace

class MicrocollisionsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void bodiesThatPartAreLeftAloneThoughTheyOverlap() {
        World world = worldOf(sceneOf({sphere(1, 1, Vec3(0, 0, 0), Vec3(-1, 0, 0)),
                                       sphere(1, 1, Vec3(1.5, 0, 0), Vec3(0.5, 0, 0))}),
                              instant());
        world.step();
        QCOMPARE(positionOf(world, 0), Vec3(-1e-30, 0, 0));
        QCOMPARE(world.state().velocity[0], Vec3(-1, 0, 0));
        QCOMPARE(world.state().velocity[1], Vec3(0.5, 0, 0));
        QCOMPARE(world.statistics().contacts, 1U); // found, and left
        QCOMPARE(world.statistics().maxPenetration, 0.5);
    }

    void twoMobileBodiesShareTheDisplacement() {
        World world = worldOf(sceneOf({sphere(1, 1, Vec3(0, 0, 0), Vec3(1, 0, 0)),
                                       sphere(1, 100, Vec3(1.5, 0, 0), Vec3(-1, 0, 0))}),
                              instant());
        world.step();
        QVERIFY((positionOf(world, 0) - Vec3(-0.25, 0, 0)).norm() < roundingOfImpacts);
        QVERIFY((positionOf(world, 1) - Vec3(1.75, 0, 0)).norm() < roundingOfImpacts);
    }

    void anImmobilePartnerLeavesTheWholeDisplacement() {
        Body pillar = sphere(1, 1, Vec3(1.5, 0, 0));
        pillar.fixed = true;
        World world = worldOf(sceneOf({sphere(1, 1, Vec3(0, 0, 0), Vec3(1, 0, 0)), pillar}), instant());
        world.step();
        QVERIFY((positionOf(world, 0) - Vec3(-0.5, 0, 0)).norm() < roundingOfImpacts);
        QCOMPARE(positionOf(world, 1), Vec3(1.5, 0, 0));
        QVERIFY((world.state().velocity[0] - Vec3(-1, 0, 0)).norm() < roundingOfImpacts);
    }

    void bodiesAtRestInEachOtherAreStillDisplaced() {
        World world = worldOf(sceneOf({sphere(1, 1, Vec3(0, 0, 0)), sphere(1, 1, Vec3(0, 1, 0))}), instant());
        world.step();
        QVERIFY((positionOf(world, 1) - positionOf(world, 0) - Vec3(0, 2, 0)).norm() < roundingOfImpacts);
        QCOMPARE(world.state().velocity[0], Vec3(Vec3::Zero()));
    }

    void thePairHasTheSmallerRestitutionAndKeepsItsMomentum() {
        Body soft = sphere(1, 3, Vec3(0, 0, 0), Vec3(2, 0, 0));
        soft.elastic = 0.25;
        Body hard = sphere(1, 5, Vec3(1.9, 0, 0), Vec3(-2, 0, 0));
        hard.elastic = 0.75;
        World world = worldOf(sceneOf({soft, hard}), instant());
        world.step();
        const double separation = world.state().velocity[1].x() - world.state().velocity[0].x();
        QVERIFY(std::abs(separation - 0.25 * 4) < roundingOfImpacts);
        QVERIFY((world.statistics().momentum - Vec3(3 * 2 - 5 * 2, 0, 0)).norm() < roundingOfImpacts);
    }

    void aStickyPairDoesNotMoveThroughEachOther() {
        Body sticky = sphere(1, 1, Vec3(0, 0, 0), Vec3(1, 0, 0));
        sticky.elastic = 0;
        World world = worldOf(sceneOf({sticky, sphere(1, 1, Vec3(1.9, 0, 0))}), instant());
        world.step();
        QVERIFY((world.state().velocity[0] - Vec3(0.5, 0, 0)).norm() < roundingOfImpacts);
        QVERIFY((world.state().velocity[1] - Vec3(0.5, 0, 0)).norm() < roundingOfImpacts);
    }

    // Three equal elastic balls in a row, all touching, the first one moving. Pairs are met as (0,1), (0,2),
    // (1,2): the blow travels through to the last in one substep if and only if that order holds.
    void pairsAreMetInAscendingOrder() {
        World forward = worldOf(sceneOf({sphere(1, 1, Vec3(0, 0, 0), Vec3(1, 0, 0)),
                                         sphere(1, 1, Vec3(2, 0, 0)), sphere(1, 1, Vec3(4, 0, 0))}),
                                instant());
        forward.step();
        QVERIFY((forward.state().velocity[2] - Vec3(1, 0, 0)).norm() < roundingOfImpacts);
        // The same row declared from the other end: (0,1) are the resting two, so the blow stops in the
        // middle.
        World backward = worldOf(sceneOf({sphere(1, 1, Vec3(4, 0, 0)), sphere(1, 1, Vec3(2, 0, 0)),
                                          sphere(1, 1, Vec3(0, 0, 0), Vec3(1, 0, 0))}),
                                 instant());
        backward.step();
        QVERIFY((backward.state().velocity[1] - Vec3(1, 0, 0)).norm() < roundingOfImpacts);
        QCOMPARE(backward.state().velocity[0], Vec3(Vec3::Zero()));
    }

    // A ball between a wall and a ball that pushes it into the wall. Declared wall, ball, pusher the pairs
    // are (wall, ball), (ball, pusher): the wall is met before the push. Declared ball, pusher, wall the push
    // comes first and the wall turns it back.
    void wallsTakeTheirPlaceInTheSameOrder() {
        const Body floor = wall(Vec3::UnitX(), 0);
        const Body ball = sphere(1, 1, Vec3(1, 0, 0));
        const Body pusher = sphere(1, 1, Vec3(3, 0, 0), Vec3(-1, 0, 0));
        World wallFirst = worldOf(sceneOf({floor, ball, pusher}), instant());
        wallFirst.step();
        QVERIFY((wallFirst.state().velocity[1] - Vec3(-1, 0, 0)).norm() < roundingOfImpacts);
        World wallLast = worldOf(sceneOf({ball, pusher, floor}), instant());
        wallLast.step();
        QVERIFY((wallLast.state().velocity[0] - Vec3(1, 0, 0)).norm() < roundingOfImpacts);
        World wallBetween = worldOf(sceneOf({pusher, floor, ball}), instant());
        wallBetween.step(); // (pusher, ball) before (wall, ball)
        QVERIFY((wallBetween.state().velocity[2] - Vec3(1, 0, 0)).norm() < roundingOfImpacts);
        World wallSecond = worldOf(sceneOf({ball, floor, pusher}), instant());
        wallSecond.step(); // (ball, wall) before (ball, pusher)
        QVERIFY((wallSecond.state().velocity[0] - Vec3(-1, 0, 0)).norm() < roundingOfImpacts);
    }

    // The wall is 0.2 m out of the first ball's reach until the second has pushed it 0.3 m that way.
    void aWallIsMetAtThePoseOfItsTurn() {
        World world = worldOf(
            sceneOf({sphere(1, 1, Vec3(1.2, 0, 0)), sphere(1, 1, Vec3(2.6, 0, 0)), wall(Vec3::UnitX(), 0)}),
            instant());
        world.step();
        QCOMPARE(world.statistics().contacts, 2U);
        QVERIFY((positionOf(world, 0) - Vec3(1, 0, 0)).norm() < roundingOfImpacts);
    }

    void eachPairIsTestedAtThePosesOfItsTurn() {
        // (0,1) parts the two by half a metre each, which pushes 1 out of 2's reach into its overlap: without
        // the displacement 1 and 2 would not touch.
        World world = worldOf(sceneOf({sphere(1, 1, Vec3(0, 0, 0)), sphere(1, 1, Vec3(1, 0, 0)),
                                       sphere(1, 1, Vec3(2.6, 1.4, 0))}),
                              instant());
        world.step();
        // Before: |x2 − x1| = |(1.6, 1.4)| = 2.126 > 2, though their boxes overlap. After: |(1.1, 1.4)| < 2.
        QCOMPARE(world.statistics().contacts, 2U);
    }

    void coincidentCentresArePartedAlongSomeLine() {
        World world = worldOf(sceneOf({sphere(1, 1, Vec3(3, 3, 3)), sphere(1, 1, Vec3(3, 3, 3))}), instant());
        world.step();
        QVERIFY(world.health().finite);
        QVERIFY(std::abs((positionOf(world, 1) - positionOf(world, 0)).norm() - 2) < roundingOfImpacts);
    }

    void aBodyThatLandsFlatDoesNotStartToSpin_data() {
        QTest::addColumn<bool>("round");
        QTest::addColumn<double>("height");
        for (const double height : {0.5, 0.5 - 1e-3, 0.5 - 1e-13, 0.4}) {
            QTest::addRow("cylinder at %.17g", height) << true << height;
            QTest::addRow("cuboid at %.17g", height) << false << height;
        }
    }
    void aBodyThatLandsFlatDoesNotStartToSpin() {
        QFETCH(bool, round);
        QFETCH(double, height);
        const Vec3 centre(0.1, height, 0.7);
        Body body = round ? cylinder(0.3, 1, 2, centre) : cuboid(Vec3(0.6, 1, 0.4), 2, centre);
        body.velocity = Vec3(0.5, -3, 0.25);
        World world = worldOf(sceneOf({wall(Vec3::UnitY(), 0), body}), instant());
        world.step();
        QCOMPARE(world.statistics().contacts, 1U);
        QVERIFY((world.state().velocity[1] - Vec3(0.5, 3, 0.25)).norm() < 1e-12);
        QVERIFY(world.state().angularVelocity[1].norm() < 1e-9); // points agree to 1e-16 of a slop of 1e-6
    }

    void aStandingCylinderStaysUprightForTenSeconds() {
        Body body = cylinder(0.2, 0.5, 2, Vec3(0, 0.25, 0));
        body.elastic = 0.5;
        World world = worldOf(sceneOf({wall(Vec3::UnitY(), 0), body}, Vec3(0, -9.8, 0)),
                              test::byMethod("microcollisions"));
        run(world, 600);
        QVERIFY(axisOf(world.state().pose[1]).y() > 1 - 1e-9);
        QVERIFY(std::abs(positionOf(world, 1).y() - 0.25) < 0.01);
    }

    // Two leaning cylinders whose boxes overlap while they do not touch: the first frame searches for what
    // parts them, the frames after try that direction first and need no search.
    void theDirectionThatPartedTwoBodiesIsTriedFirstInTheNextFrame() {
        Body first = cylinder(0.2, 2, 1, Vec3(0, 0, 0)), second = cylinder(0.2, 2, 1, Vec3(0.6, 0, 0));
        const Quat leaning(Eigen::AngleAxisd(0.7, Vec3::UnitZ()));
        first.pose.orientation = leaning;
        second.pose.orientation = leaning;
        World world = worldOf(sceneOf({first, second}), instant());
        world.step();
        QCOMPARE(world.statistics().broad.pairs, 1U);
        QCOMPARE(world.statistics().contacts, 0U);
        QCOMPARE(world.statistics().axesTried, 0U);
        world.step();
        QCOMPARE(world.statistics().axesTried, 1U);
        QCOMPARE(world.statistics().axesSpared, 1U);
    }
};

} // namespace carom

CAROM_TEST(microcollisions_test, carom::MicrocollisionsTest)
#include "microcollisions_test.moc"
