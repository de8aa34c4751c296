// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/solvers/contacts/entered.h"
#include "tests/support/contact_scenes.h"
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <vector>

// Bodies of the base path that stand still while others of their island move.

namespace carom {
namespace {

constexpr double ballRadius = 0.1; // [m]

class HeldOnes : public test::Entered {
  public:
    using Entered::Entered;

    void frame() {
        for (int k = 0; k < test::substeps; ++k) step();
    }
    void hold(const std::vector<BodyIndex>& list) {
        path.hold(input(), manifolds,
                  [&](BodyIndex body) { return std::find(list.begin(), list.end(), body) != list.end(); });
    }
};

Body aBall(double x, double y, double elastic, const Vec3& velocity = Vec3::Zero()) {
    Body body = test::sphere(ballRadius, 1, {x, y, 0}, velocity);
    return test::rough(body, 0.5, elastic);
}

/// Four balls in a row on a floor (1 to 4), and one (5) that comes at `speed` towards the first, `gap` away.
Scene rowOfBalls(double elastic, double speed, double gap = 0.06) {
    Scene scene = test::sceneOf({test::floorOf(0.5, elastic)});
    for (int k = 0; k < 4; ++k) scene.bodies.push_back(aBall(2 * ballRadius * k, ballRadius, elastic));
    scene.bodies.push_back(aBall(-2 * ballRadius - gap, ballRadius, elastic, {speed, 0, 0}));
    scene.gravity.acceleration = test::downwards();
    return scene;
}

/// The same of cubes.
Scene rowOfCubes(double elastic, double speed) {
    Scene scene = rowOfBalls(elastic, speed);
    for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
        scene.bodies[i].shape = Cuboid{Vec3::Constant(ballRadius)};
        scene.bodies[i].friction = 0;
    }
    return scene;
}

const std::vector<BodyIndex> theRow{1, 2, 3, 4};

} // namespace

class StillBodiesTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void whatStandsStillStaysToTheBit() {
        for (const Scene& scene : {rowOfBalls(0.5, 0.02), rowOfCubes(0.5, 0.02)}) {
            HeldOnes heap(scene);
            heap.frame();
            heap.hold(theRow);
            QCOMPARE(heap.path.stillBodies(), std::size_t{4});
            const std::vector<Pose> poses = heap.state.pose;
            const Vec3 force = heap.forceOf({0, 2});
            for (int n = 0; n < 8; ++n) heap.frame();
            QCOMPARE(heap.path.stillBodies(), std::size_t{4});
            for (const BodyIndex i : theRow) {
                QVERIFY(heap.state.pose[i].position == poses[i].position);
                QVERIFY(heap.state.pose[i].orientation.coeffs() == poses[i].orientation.coeffs());
                QVERIFY(heap.state.velocity[i] == Vec3::Zero());
            }
            QVERIFY(heap.forceOf({0, 2}) == force);
            QVERIFY((force - Vec3(0, test::gravity, 0)).norm() < 0.05 * test::gravity);
            QVERIFY(heap.state.pose[5].position.x() > -2 * ballRadius - 0.059); // who moves does
        }
    }

    // Through all of the row, as if it had never stood still.
    void aStrikePassesThroughARowThatStandsStill() {
        for (const Scene& scene : {rowOfBalls(0.9, 2), rowOfCubes(0.9, 2)}) {
            HeldOnes moving(scene), still(scene);
            moving.step();
            still.step();
            still.hold(theRow);
            QCOMPARE(still.path.stillBodies(), std::size_t{4});
            for (int n = 0; n < 20; ++n) {
                moving.step();
                still.step();
            }
            QCOMPARE(still.path.stillBodies(), std::size_t{0});
            QVERIFY(moving.state.velocity[4].x() > 0.5);
            for (const BodyIndex i : moving.bodies.mobileBodies)
                QVERIFY2((moving.state.velocity[i] - still.state.velocity[i]).norm() < 0.01 * 2,
                         qPrintable(QStringLiteral("body %1: %2 and %3 m/s")
                                        .arg(i)
                                        .arg(moving.state.velocity[i].x())
                                        .arg(still.state.velocity[i].x())));
        }
    }

    void aTouchThatMovesNobodyWakesNobody() {
        HeldOnes heap(rowOfBalls(0.5, 0.005, 1e-4));
        heap.step();
        heap.hold(theRow);
        for (int n = 0; n < 8; ++n) heap.frame();
        QVERIFY(std::abs(heap.state.pose[5].position.x() + 2 * ballRadius) < 2e-5);
        QCOMPARE(heap.path.stillBodies(), std::size_t{4});
        QVERIFY(heap.state.velocity[1] == Vec3::Zero());
    }

    // A ball that is laid on two others: their load was balanced without it.
    void whatIsLoadedMovesOn() {
        Scene scene = rowOfBalls(0, 0);
        scene.bodies[5] = aBall(ballRadius, ballRadius + std::sqrt(3.0) * ballRadius + 1e-4, 0);
        HeldOnes heap(scene);
        heap.step();
        heap.hold(theRow);
        QCOMPARE(heap.path.stillBodies(), std::size_t{4});
        for (int n = 0; n < 4; ++n) heap.frame();
        QVERIFY(heap.path.stillBodies() < 3); // those two move on, and perhaps their neighbours
    }

    // The cube on a ball falls when that is struck away, as soon as if it had never stood still.
    void whatLosesItsSupportFalls() {
        Scene scene = test::sceneOf({test::floorOf(0)});
        scene.gravity.acceleration = test::downwards();
        scene.bodies.push_back(test::rough(aBall(0, ballRadius, 0), 0, 0.9));
        Body cube = test::cuboid(Vec3::Constant(2 * ballRadius), 1, {0, 3 * ballRadius, 0});
        scene.bodies.push_back(test::rough(cube, 0));
        scene.bodies.push_back(test::rough(aBall(-0.35, ballRadius, 0, {4, 0, 0}), 0, 0.9));
        HeldOnes moving(scene), still(scene);
        moving.step();
        still.step();
        still.hold({2});
        QCOMPARE(still.path.stillBodies(), std::size_t{1});
        for (int n = 0; n < 12; ++n) {
            moving.frame();
            still.frame();
        }
        QCOMPARE(still.path.stillBodies(), std::size_t{0});
        const double fallen = 3 * ballRadius - moving.state.pose[2].position.y();
        QVERIFY(fallen > 0.5 * ballRadius);
        QVERIFY(std::abs(still.state.pose[2].position.y() - moving.state.pose[2].position.y()) <
                0.1 * fallen);
    }

    void whatIsOutOfBalanceDoesNotStandStill() {
        Scene falling = rowOfBalls(0, 0);
        falling.bodies[4].pose.position.y() = 3 * ballRadius; // in the air
        HeldOnes inAir(falling);
        inAir.step();
        inAir.hold(theRow);
        QCOMPARE(inAir.path.stillBodies(), std::size_t{3});
    }

    // Friction balances a spring, and holds both boxes: without the spring's force a fifth of their weight is
    // unbalanced. When the other end of a second one flies away, its pull moves the box on.
    void whatASpringPullsStandsStillUntilItPullsHarder() {
        constexpr double part = 0.2, speed = 3; // of the weight; [m/s]
        Scene scene = test::sceneOf({test::floorOf(0.5)}, test::downwards());
        for (const double x : {0.0, 0.5})
            scene.bodies.push_back(
                test::rough(test::cuboid(Vec3::Constant(2 * ballRadius), 1, {x, ballRadius, 0}), 0.5));
        scene.bodies.push_back(test::sphere(ballRadius, 1, {1.5, 2, 0}, {speed, speed, 0}));
        const double stiffness = 20;
        const double stretch = part * test::gravity / stiffness; // [m]
        for (const BodyIndex from : {1U, 2U}) {
            Spring spring = test::springBetween(from, from + 1, stiffness, 1);
            if (from == 1) spring.length = 0.5 - stretch;
            scene.springs.push_back(spring);
        }
        HeldOnes tied(scene);
        for (int n = 0; n < 2; ++n) tied.step();
        const double place = tied.state.pose[2].position.x();
        tied.hold({1, 2});
        QCOMPARE(tied.path.stillBodies(), std::size_t{2});
        double pull = 0; // by the second spring
        int substep = 0;
        for (; substep < 200 && tied.path.isStill(2); ++substep) {
            tied.step();
            pull = forceOf(tied.bodies.springs[1], tied.state).norm();
        }
        QVERIFY(!tied.path.isStill(2));
        QVERIFY(pull > part * test::gravity);
        QVERIFY(pull < 3 * test::gravity);
        for (int n = 0; n < 40; ++n) tied.step();
        QVERIFY(tied.state.pose[2].position.x() > place + 0.01);
    }

    // A copy goes on as the original does, and whoever leaves takes its forces along.
    void copiesAndThoseThatLeaveGoOn() {
        HeldOnes heap(rowOfBalls(0.5, 0.3));
        heap.frame();
        heap.hold(theRow);
        BasePath copy = heap.path;
        State state = heap.state;
        Manifolds manifolds = heap.manifolds;
        for (int n = 0; n < 200; ++n) {
            heap.advance();
            copy.advance({.bodies = heap.bodies, .gravity = test::downwards(), .state = state}, manifolds);
        }
        QCOMPARE(copy.stillBodies(), heap.path.stillBodies());
        for (const BodyIndex i : heap.bodies.mobileBodies)
            QVERIFY(state.pose[i].position == heap.state.pose[i].position);

        HeldOnes other(rowOfBalls(0.5, 0.1));
        other.frame();
        other.hold(theRow);
        const Vec3 force = other.forceOf({0, 3});
        other.leave();
        other.enterAll();
        QCOMPARE(other.path.stillBodies(), std::size_t{0});
        QVERIFY((other.forceOf({0, 3}) - force).norm() < 1e-9 * test::gravity);
    }
};

} // namespace carom

CAROM_TEST(still_bodies_test, carom::StillBodiesTest)
#include "still_bodies_test.moc"
