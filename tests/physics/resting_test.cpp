// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/contact_scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"
#include "tests/support/worst_of_run.h"

#include "core/dynamics/energy.h"
#include "core/math/random.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <numbers>

// What has come to rest is left alone, and woken by whatever may touch it.

namespace carom {
namespace {

using namespace test;

constexpr double edge = 1; // [m]

Body box(double x, double height) {
    return rough(cuboid(Vec3(edge, edge, edge), 1, Vec3(x, height, 0)), 0.5);
}

/// A spring from a hook at x = z = 0 to the centre of a body below.
Spring hookAbove(BodyIndex body, double height, double stiffness, double length, double damping) {
    Spring spring = springBetween(noBody, body, stiffness, damping);
    spring.fromAt = Vec3(0, height, 0);
    spring.length = length;
    return spring;
}

/// Ten boxes on each other at x, and a floor.
Scene towerAt(double x) {
    Scene scene = sceneOf({floorOf(0.5)}, downwards());
    for (int i = 0; i < 10; ++i) scene.bodies.push_back(box(x, (i + 0.5) * edge));
    return scene;
}

} // namespace

constexpr double courseHeight = 0.2; // [m]

/// A wall of twenty courses of bricks that touch on all sides, on a floor with this friction.
Scene flushWall(double friction, const Vec3& velocity) {
    const Vec3 size(0.4, courseHeight, 0.2); // [m]
    constexpr int courses = 20, length = 30;
    Scene scene = sceneOf({floorOf(friction, 0.1)}, downwards());
    for (int row = 0; row < courses; ++row)
        for (int i = 0; i < length - row % 2; ++i) {
            const Vec3 place((i + 0.5 * (row % 2)) * size.x(), (row + 0.5) * size.y(), 0);
            scene.bodies.push_back(rough(cuboid(size, 1, place), 0.6, 0.1));
            scene.bodies.back().velocity = velocity;
        }
    return scene;
}

class RestingTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void bodiesAtRestAreLeftAloneAndKeepTheirForces() {
        World world = worldOf(towerAt(0), contacts("default"));
        run(world, 30);
        QCOMPARE(world.statistics().resting, 10U);
        const std::vector<Pose> before = world.state().pose;
        const std::vector<ContactForce> forces = world.contactForces();
        run(world, 600);
        QCOMPARE(world.statistics().resting, 10U);
        QCOMPARE(world.statistics().contacts, 4U * 10U); // pairs, in each of four substeps
        for (std::size_t i = 0; i < before.size(); ++i)
            QVERIFY(world.state().pose[i].position == before[i].position);
        double weight = 0;
        for (const ContactForce& force : world.contactForces()) weight = std::max(weight, force.force.y());
        QCOMPARE(world.contactForces().size(), forces.size());
        QVERIFY(weight > 0);
    }

    void aBallThatHitsATowerAtRestWakesItAndGivesItItsMomentum() {
        Scene scene = towerAt(0);
        const double speed = 10, mass = 0.5;
        scene.bodies.push_back(moving(rough(sphere(0.3, mass, Vec3(-8, 7, 0)), 0.5), Vec3(speed, 0, 0)));
        scene.bodies.back().elastic = 0;
        World world = worldOf(scene, contacts("default"));
        bool rested = false, woke = false;
        double fastest = 0;
        for (int frame = 0; frame < 70; ++frame) {
            world.step();
            rested = rested || world.statistics().resting == 10;
            woke = woke || (rested && world.statistics().resting == 0);
            for (BodyIndex i = 1; i <= 10; ++i) fastest = std::max(fastest, world.state().velocity[i].norm());
        }
        QVERIFY(rested);
        QVERIFY(woke);
        QVERIFY(fastest > 0.5);
        QVERIFY(world.health().finite);
    }

    // What never comes near changes nothing, not even by being there.
    void aTowerIsNotWokenByWhatPassesIt() {
        Scene scene = towerAt(0);
        scene.bodies.push_back(
            moving(rough(sphere(0.3, 1, Vec3(-5, 0.3, 2)), 0.5), Vec3(3, 0, 0), Vec3(0, 0, -3 / 0.3)));
        World world = worldOf(scene, contacts("default"));
        run(world, 30);
        for (int frame = 0; frame < 240; ++frame) {
            world.step();
            QCOMPARE(world.statistics().resting, 10U);
        }
        QVERIFY(world.state().pose.back().position.x() > 5);
    }

    // A box that slides into one at rest: before they touch it is left alone, and after that both move on as
    // one would expect of equal masses and a plastic impact.
    void aSlidingBoxPushesOneAtRest() {
        Scene scene = sceneOf({floorOf(0)}, downwards());
        scene.bodies.push_back(rough(box(0, 0.5 * edge), 0.2));
        scene.bodies.push_back(moving(rough(box(-2, 0.5 * edge), 0.2), Vec3(1, 0, 0)));
        World world = worldOf(scene, contacts("default"));
        bool rested = false;
        for (int frame = 0; frame < 50; ++frame) {
            world.step();
            rested = rested || world.statistics().resting == 1;
        }
        QVERIFY(rested);
        run(world, 70);
        QCOMPARE(world.statistics().resting, 0U);
        QVERIFY(std::abs(world.state().velocity[1].x() - 0.5) < 1e-9);
        QVERIFY(std::abs(world.state().velocity[2].x() - 0.5) < 1e-9);
    }

    // Balls fall on a box at rest and lie still on it: balls move before, and are woken and put to sleep with
    // it.
    void whatFallsOnSomethingAtRestWakesIt() {
        Scene scene = sceneOf({floorOf(0.5)}, downwards());
        scene.bodies.push_back(rough(cuboid(Vec3(4, 1, 4), 10, Vec3(0, 0.5, 0)), 0.5));
        for (int i = 0; i < 9; ++i)
            scene.bodies.push_back(
                rough(sphere(0.2, 1, Vec3(i % 3 - 1, 2 + 0.1 * i, i / 3 - 1)), 0.5, 0.3, 0.01));
        World world = worldOf(scene, contacts("default"));
        std::uint64_t most = 0;
        bool boxWoke = false;
        for (int frame = 0; frame < 300; ++frame) {
            const std::uint64_t before = world.statistics().resting;
            world.step();
            boxWoke = boxWoke || world.statistics().resting < before;
            most = std::max(most, world.statistics().resting);
        }
        QVERIFY(boxWoke);
        QCOMPARE(most, 10U);
        QCOMPARE(world.statistics().resting, 10U);
        for (BodyIndex i = 2; i < scene.bodies.size(); ++i)
            QVERIFY(std::abs(world.state().pose[i].position.y() - 1.2) < 1e-6);
    }

    // Balls land one after the other on those that have come to rest below them. What slept was in no list of
    // what fell past the place where it would have been, had it gone on falling: in 58 of 81 columns a ball
    // passed into another, by up to its radius, and one of the columns shot up at 28 m/s. Where many columns
    // land at once, some are moved on the base path: with the force that an impact cut short had left, it
    // threw them up.
    void whatFallsOnWhatSleepsDoesNotPassIntoIt_data() {
        QTest::addColumn<int>("rows");
        QTest::newRow("a column by itself") << 1;
        QTest::newRow("81 columns at once") << 9;
    }
    void whatFallsOnWhatSleepsDoesNotPassIntoIt() {
        QFETCH(int, rows);
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        constexpr double pitch = 0.22, largest = 0.1; // [m]
        Random random(test::seed);
        WorstOfRun worst;
        for (int trial = 0; trial < (rows == 1 ? 40 : 1); ++trial) {
            Scene scene = sceneOf({floorOf(0.2)}, downwards());
            for (int column = 0; column < rows * rows; ++column)
                for (int k = 0; k < 7; ++k) {
                    const double radius = largest * random.uniform(0.5, 1);
                    scene.bodies.push_back(
                        rough(sphere(radius, 1000 * std::pow(radius, 3),
                                     Vec3(column / rows * pitch, largest + k * pitch, column % rows * pitch)),
                              0.2));
                }
            World world = worldOf(scene, contacts("default"));
            worst.include(worstOf(world, 40));
        }
        const double deepest = worst.overlap / largest;
        qInfo("overlap %.1e, energy gained %.1e", deepest, worst.gained);
        QVERIFY(deepest < (rows == 1 ? 1e-6 : 0.1));
        QVERIFY(worst.gained < 1e-3);
    }

    // Forces of an impact that was over threw heavy boxes up from a light plate again and again: their energy
    // rose by 28 % of what there was.
    void heavyBoxesOnALightPlateGainNoEnergy() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed);
        Scene scene = sceneOf({floorOf(0.5)}, downwards());
        scene.bodies.push_back(rough(cuboid(Vec3(3, 0.1, 3), 1, Vec3(0, 0.05, 0)), 0.5));
        for (int i = 0; i < 49; ++i) {
            const Vec3 place(0.3 * (i % 7 - 3), random.uniform(0.3, 0.6), 0.3 * (i / 7 - 3));
            scene.bodies.push_back(rough(cuboid(Vec3(0.2, 0.2, 0.2), i % 3 == 0 ? 5 : 100, place), 0.5));
        }
        World world = worldOf(scene, contacts("default"));
        const WorstOfRun worst = worstOf(world, 120);
        qInfo("energy gained %.1e", worst.gained);
        QVERIFY(worst.gained < 0.05); // what overlaps are pushed apart by
    }

    // Where many bodies lean on each other, impulses grew from step to step as only velocities were limited
    // by the energy there was: these overlapped by nine tenths of their thickness, and got 17 % of their
    // energy of motion in a frame.
    void spiralsOfDominoesGainNoEnergy() {
        constexpr double thickness = 0.0075, height = 0.05, width = 0.025; // [m]
        double gained = 0, deepest = 0; // of the energy of motion, of the thickness
        constexpr double elastic = 0.3;
        for (const double friction : {0.2, 0.3})
            for (const int dominoes : {92, 108, 143}) {
                Scene scene = sceneOf({floorOf(friction, elastic)}, Vec3(0, -9.8, 0));
                double angle = 0, radius = 0.6;
                for (int i = 0; i < dominoes; ++i, angle += width / radius, radius += 0.2 * thickness) {
                    const Vec3 place(radius * std::cos(angle), height / 2, radius * std::sin(angle));
                    const Body domino = cuboid(Vec3(thickness, height, width), 0.01, place);
                    scene.bodies.push_back(rough(
                        turned(domino, (std::numbers::pi / 2 - angle) * Vec3::UnitY()), friction, elastic));
                }
                const Body striker = sphere(0.01, 0.02, Vec3(0.6, 0.045, -0.04));
                scene.bodies.push_back(rough(moving(striker, Vec3(0, 0, 1.5)), friction, elastic));
                World world = worldOf(scene, contacts("default"));
                double before = energyOf(world), moves = 0, most = 0;
                for (int frame = 0; frame < 180; ++frame) {
                    world.step();
                    most = std::max(most, energyOf(world) - before);
                    before = energyOf(world);
                    moves = std::max(moves, world.statistics().kinetic);
                    deepest = std::max(deepest, deepestOverlap(world) / thickness);
                }
                gained = std::max(gained, most / moves);
            }
        qInfo("%.1e of the energy of motion gained in a frame, overlap %.1e", gained, deepest);
        QVERIFY(gained < 0.01);
        QVERIFY(deepest < 0.3);
    }

    void nothingRestsWhereNothingLosesEnergy() {
        Scene scene = sceneOf({floorOf(0, 1)}, downwards());
        scene.bodies.push_back(rough(box(0, 0.5 * edge), 0, 1));
        World world = worldOf(scene, contacts("default"));
        run(world, 60);
        QVERIFY(!world.pipeline().simulates("resting"));
        QCOMPARE(world.statistics().resting, 0U);
    }

    void aWorldRestoredAtRestGoesOnToTheBit() {
        Scene scene = towerAt(0);
        scene.bodies.push_back(moving(rough(sphere(0.3, 0.5, Vec3(-12, 7, 0)), 0.5), Vec3(10, 0, 0)));
        World world = worldOf(scene, contacts("default"));
        run(world, 40);
        QCOMPARE(world.statistics().resting, 10U);
        const Checkpoint checkpoint = world.checkpoint();
        run(world, 60);
        World other = worldOf(scene, contacts("default"));
        other.restore(checkpoint);
        run(other, 60);
        QCOMPARE(other.stateHash(), world.stateHash());
        QCOMPARE(other.statistics().resting, world.statistics().resting);
    }

    void theLedgerOfWhatRestsBalances() {
        World world = worldOf(towerAt(0), contacts("default"));
        world.keepLedger(true);
        run(world, 60);
        QCOMPARE(world.statistics().resting, 10U);
        const Ledger& ledger = world.statistics().ledger;
        const double weight = 10 * gravity * world.pipeline().settings().step;
        QVERIFY(std::abs(ledger[LedgerAccount::Gravity].momentum.y() + weight) < 1e-12 * weight);
        QCOMPARE(world.statistics().unexplained.momentum.norm(), 0.0);
        QCOMPARE(world.statistics().unexplained.energy, 0.0);
    }

    // A box on a damped spring sinks by m g/k and is left alone there, while the spring bears its weight; a
    // ball that falls on it makes it swing again.
    void aBoxHungOnADampedSpringComesToRest() {
        constexpr double stiffness = 100, length = 2, height = 8; // [N/m], [m], [m]
        Scene scene = sceneOf({floorOf(0.5), box(0, height - length)}, downwards());
        scene.springs = {hookAbove(1, height, stiffness, length, 10)};
        scene.bodies.push_back(rough(sphere(0.2, 1, Vec3(0.1, 900, 0)), 0.5));
        World world = worldOf(scene, contacts("default"));
        world.keepLedger(true);
        run(world, 600);
        QCOMPARE(world.statistics().resting, 1U);
        QVERIFY(std::abs(world.state().pose[1].position.y() - (height - length - gravity / stiffness)) <
                1e-6);
        const Ledger& ledger = world.statistics().ledger;
        const double weight = gravity * world.pipeline().settings().step; // in a frame [N s]
        QVERIFY(std::abs(ledger[LedgerAccount::Spring].momentum.y() - weight) < 1e-6 * weight);
        QVERIFY(world.statistics().unexplained.momentum.norm() < 1e-9 * weight);
        double lowest = height;
        for (int frame = 0; frame < 600; ++frame) {
            world.step();
            lowest = std::min(lowest, world.state().pose[1].position.y());
        }
        QVERIFY(lowest < height - length - gravity / stiffness - 0.1);
    }

    // x = A cos(ω t) with a period of ten minutes, on a floor without friction: at first it is slower than
    // what counts as rest elsewhere, for longer than a box alone would have to be.
    void whatASpringWithoutDamperMovesIsNeverLeftAlone() {
        constexpr double amplitude = 1e-4, rate = 0.01; // [m], [rad/s]
        Scene scene = sceneOf({floorOf(0)}, downwards());
        scene.bodies.push_back(rough(box(amplitude, 0.5 * edge), 0, 0.5));
        scene.springs = {hookAbove(1, 0.5 * edge, rate * rate, 0, 0)};
        World world = worldOf(scene, contacts("default"));
        for (int frame = 0; frame < 3000; ++frame) {
            world.step();
            QCOMPARE(world.statistics().resting, 0U);
        }
        const double expected = amplitude * std::cos(rate * world.state().time);
        QVERIFY(std::abs(world.state().pose[1].position.x() - expected) < 1e-3 * amplitude);
    }

    // Boxes fall into a bin, every third tied to the next by a damped spring; all of them come to rest, and
    // keep what their springs store. What meets one wakes the other, which it does not touch.
    void aHeapTiedByDampedSpringsComesToRest() {
        Scene scene = sceneOf({floorOf(0.5)}, downwards());
        for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)})
            scene.bodies.push_back(rough(wall(normal, -1), 0.5));
        const BodyIndex first = static_cast<BodyIndex>(scene.bodies.size());
        constexpr BodyIndex boxes = 64;
        Random random(3, 1);
        for (BodyIndex i = 0; i < boxes; ++i) {
            const Vec3 place(0.45 * (i % 4) - 0.675, 0.3 + 0.45 * (i / 16), 0.45 * (i / 4 % 4) - 0.675);
            const Vec3 turn(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
            scene.bodies.push_back(rough(turned(cuboid(Vec3::Constant(0.25), 1, place), turn), 0.5, 0.1));
        }
        for (BodyIndex i = first; i + 1 < first + boxes; i += 3)
            scene.springs.push_back(springBetween(i, i + 1, 500, 10));
        World world = worldOf(scene, contacts("default"));
        run(world, 600);
        QCOMPARE(world.statistics().resting, static_cast<std::uint64_t>(boxes));
        QCOMPARE(world.statistics().kinetic, 0.0);
        const std::vector<Pose> before = world.state().pose;
        run(world, 60);
        for (std::size_t i = 0; i < before.size(); ++i)
            QVERIFY(world.state().pose[i].position == before[i].position);
    }

    // Two boxes far apart on a rough floor, joined by a spring: what strikes the one wakes both.
    void whatStrikesOneEndOfASpringWakesTheOther() {
        Scene scene = sceneOf({floorOf(0.5), box(0, 0.5 * edge), box(5, 0.5 * edge)}, downwards());
        scene.springs = {springBetween(1, 2, 200, 5)};
        scene.bodies.push_back(moving(rough(sphere(0.3, 1, Vec3(-20.8, 0.7, 0)), 0), Vec3(4, 24.5, 0)));
        World world = worldOf(scene, contacts("default"));
        bool rested = false, woke = false;
        for (int frame = 0; frame < 400; ++frame) {
            world.step();
            rested = rested || world.statistics().resting == 2;
            woke = woke || (rested && world.statistics().resting == 0);
        }
        QVERIFY(rested);
        QVERIFY(woke);
        QVERIFY(world.state().pose[2].position.x() > 5.01);
    }

    // Bricks that touch on all sides, half-brick bond, twenty courses: with one pass a step the wall swayed
    // for ever, and rose.
    void aFlushWallOfBricksComesToRest() {
        const Scene scene = flushWall(0.6, Vec3::Zero());
        World world = worldOf(scene, contacts("default"));
        run(world, 120);
        QCOMPARE(world.statistics().resting, static_cast<std::uint64_t>(scene.bodies.size() - 1));
        QVERIFY(world.statistics().work.unfinished == 0);
        QVERIFY(deepestOverlap(world) < 2e-3 * courseHeight);
        for (BodyIndex i = 1; i < scene.bodies.size(); ++i) {
            const Vec3 way = world.state().pose[i].position - scene.bodies[i].pose.position;
            QVERIFY(way.norm() < 0.02 * courseHeight);
        }
    }
    // What slides or falls does not sway: one pass in place of two is three sweeps of a step in place of
    // five.
    void aWallThatSlidesMakesFewerPassesThanOneThatStands() {
        const auto sweptOf = [](const Vec3& velocity) {
            World world = worldOf(flushWall(0, velocity), contacts("default"));
            run(world, 32); // levels have been counted twice
            std::uint64_t swept = 0;
            for (int frame = 0; frame < 6; ++frame) {
                world.step();
                swept += world.statistics().work.rowsSwept;
            }
            return static_cast<double>(swept);
        };
        const double standing = sweptOf(Vec3::Zero()), sliding = sweptOf(Vec3(1, 0, 0));
        QVERIFY(sliding > 0);
        QVERIFY2(sliding < 0.75 * standing, qPrintable(QString::number(sliding / standing)));
    }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, resting_test, carom::RestingTest)
#include "resting_test.moc"
