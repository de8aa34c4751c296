// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include "core/dynamics/energy.h"

#include <QTest>

#include <cmath>

// What a World promises whoever holds one, whatever the physics.

namespace carom {
namespace {

using test::cylinder;
using test::run;
using test::sceneOf;
using test::sphere;
using test::wall;
using test::worldOf;

const Vec3 down(0, -9.8, 0);

/// Balls that fall on a floor and on each other, and a cylinder among them.
Scene tumblingBody() {
    Scene scene = sceneOf({wall(Vec3::UnitY(), 0)}, down);
    for (int i = 0; i < 40; ++i) {
        scene.bodies.push_back(sphere(0.2, 1 + i, Vec3(0.3 * (i % 5), 0.5 + 0.41 * (i / 5), 0.01 * i)));
        scene.bodies.back().elastic = 0.8;
    }
    Body log = cylinder(0.2, 1, 3, Vec3(0.5, 4.5, 0.3));
    log.angularVelocity = Vec3(1, 2, 3);
    scene.bodies.push_back(log);
    return scene;
}

} // namespace

class WorldTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aNewWorldIsTheSceneAtFrameZero() {
        const Scene scene = tumblingBody();
        const World world = worldOf(scene);
        QCOMPARE(world.state().frame, 0);
        QCOMPARE(world.statistics().simulate, 0.0);
        QCOMPARE(world.statistics().contacts, 0U);
        QVERIFY(world.health().finite);
        const Invariants expected = invariantsOf(world.pipeline().bodies(), world.state(), down);
        QCOMPARE(world.statistics().kinetic, expected.kinetic);
        QCOMPARE(world.statistics().potential, expected.potential);
    }

    void framesCountFromOneAndTimeIsFrameTimesStep() {
        SimulationSettings options;
        options.step = 0.1;
        options.substeps = 3;
        World world = worldOf(tumblingBody(), options);
        run(world, 7);
        QCOMPARE(world.state().frame, 7);
        QCOMPARE(world.statistics().frame, 7);
        QCOMPARE(world.state().time, 7 * 0.1);
        QCOMPARE(world.statistics().time, 7 * 0.1);
    }

    void theStagesAreWithinTheWholeStep() {
        World world = worldOf(tumblingBody());
        for (int i = 0; i < 50; ++i) {
            world.step();
            const FrameStatistics& s = world.statistics();
            for (const double stage : {s.integrate, s.broadphase, s.narrowphase, s.respond})
                QVERIFY(stage >= 0);
            QVERIFY(s.simulate >= s.integrate + s.broadphase + s.narrowphase + s.respond);
        }
    }

    void countsAddUpOverSubsteps() {
        // A ball that lies on the floor touches it once a substep.
        SimulationSettings options = test::byMethod("microcollisions"); // which searches anew in each
        options.substeps = 5;
        Body ball = sphere(1, 1, Vec3(0, 0.5, 0));
        ball.elastic = 0;
        World world = worldOf(sceneOf({wall(Vec3::UnitY(), 0), ball}), options);
        world.step();
        QCOMPARE(world.statistics().contacts, 5U);
        QCOMPARE(world.statistics().broad.boxes, 5U);
        QCOMPARE(world.statistics().maxPenetration, 0.5);
    }

    void resetGivesTheSameBitsAgain() {
        World world = worldOf(tumblingBody());
        const std::uint64_t start = world.stateHash();
        run(world, 200);
        const std::uint64_t end = world.stateHash();
        QVERIFY(start != end);
        world.reset();
        QCOMPARE(world.stateHash(), start);
        QCOMPARE(world.statistics().frame, 0);
        run(world, 200);
        QCOMPARE(world.stateHash(), end);
    }

    void theHashSeesOneBitOfAnyQuantityAndTheFrame() {
        const Scene scene = tumblingBody();
        const std::uint64_t plain = worldOf(scene).stateHash();
        Scene moved = scene;
        moved.bodies[3].pose.position.x() = std::nextafter(moved.bodies[3].pose.position.x(), 9);
        QVERIFY(worldOf(moved).stateHash() != plain);
        Scene faster = scene;
        faster.bodies[3].velocity.z() = 1e-300;
        QVERIFY(worldOf(faster).stateHash() != plain);
        World still = worldOf(sceneOf({sphere(1, 1, Vec3::Zero())}));
        const std::uint64_t before = still.stateHash();
        still.step();
        QVERIFY(still.stateHash() != before);
    }

    void aSnapshotIsAValue() {
        World world = worldOf(tumblingBody());
        run(world, 10);
        const Snapshot snapshot = world.snapshot();
        const Vec3 position = world.state().pose[5].position;
        run(world, 10);
        QCOMPARE(snapshot.frame, 10);
        QCOMPARE(snapshot.pose[5].position, position);
        QVERIFY(world.state().pose[5].position != position);
        QCOMPARE(snapshot.pose.size(), world.pipeline().scene().bodies.size());
        QCOMPARE(snapshot.statistics.frame, 10);
        QVERIFY(snapshot.health.finite);
    }

    void anotherBroadphaseGoesOnWithTheSameMotion() {
        World steady = worldOf(tumblingBody());
        World switching = worldOf(tumblingBody());
        for (int i = 0; i < 120; ++i) {
            const std::span<const BroadphaseRow> rows = broadphases();
            if (i % 7 == 0) switching.useBroadphase(rows[static_cast<std::size_t>(i) % rows.size()]);
            steady.step();
            switching.step();
            QCOMPARE(switching.stateHash(), steady.stateHash());
        }
    }

    // 1e308 m/s takes x beyond 1.8e308 within two seconds.
    void aRunThatOverflowsStopsAndSaysWhere() {
        SimulationSettings options = test::byMethod("microcollisions");
        options.step = 1;
        Body fast = sphere(1, 1, Vec3(0, 50, 0), Vec3(1e308, 0, 0));
        World world = worldOf(sceneOf({wall(Vec3::UnitY(), 0), sphere(1, 1, Vec3(9, 9, 9)), fast}), options);
        run(world, 10);
        QVERIFY(!world.health().finite);
        QCOMPARE(world.health().body, 2U);
        QCOMPARE(world.health().frame, 2);
        QVERIFY(world.health().quantity == "position");
        QCOMPARE(world.state().frame, 2);
        const std::uint64_t hash = world.stateHash();
        world.step();
        QCOMPARE(world.stateHash(), hash);
        QVERIFY(!world.snapshot().health.finite);
        world.reset();
        QVERIFY(world.health().finite);
    }

    // Contacts look ahead: the path is known to leave the numbers before it does.
    void aPathThatWouldOverflowStopsAndSaysWhose() {
        SimulationSettings options;
        options.step = 1;
        Body fast = sphere(1, 1, Vec3(0, 50, 0), Vec3(1e308, 0, 0));
        World world = worldOf(sceneOf({wall(Vec3::UnitY(), 0), sphere(1, 1, Vec3(9, 9, 9)), fast}), options);
        run(world, 10);
        QVERIFY(!world.health().finite);
        QCOMPARE(world.health().body, 2U);
        QVERIFY(world.health().frame <= 2);
    }

    void aCollisionThatOverflowsStopsInTheSameFrame() {
        SimulationSettings options = test::byMethod("microcollisions");
        options.step = 1e-320; // 1.5e-12 m
        Body light = sphere(1, 1e-300, Vec3(-0.9, 0, 0), Vec3(1.5e308, 0, 0));
        Body heavy = sphere(1, 1e300, Vec3(0.9, 0, 0), Vec3(-1.5e308, 0, 0));
        World world = worldOf(sceneOf({light, heavy}), options);
        world.step();
        QVERIFY(!world.health().finite);
        QCOMPARE(world.health().frame, 1);
        QVERIFY(world.health().quantity == "velocity");
    }

    void worldsThatShareAPipelineDoNotDisturbEachOther() {
        const std::shared_ptr<const Pipeline> pipeline = std::make_shared<const Pipeline>(tumblingBody());
        World first(pipeline), second(pipeline);
        run(first, 60);
        QCOMPARE(second.state().frame, 0);
        run(second, 60);
        QCOMPARE(second.stateHash(), first.stateHash());
    }

    void anEmptySceneRuns() {
        World world = worldOf(Scene{});
        run(world, 3);
        QCOMPARE(world.state().frame, 3);
        QVERIFY(world.health().finite);
    }
};

} // namespace carom

CAROM_TEST(world_test, carom::WorldTest)
#include "world_test.moc"
