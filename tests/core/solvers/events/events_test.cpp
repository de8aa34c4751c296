// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include "core/math/random.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <numeric>

// The exact method against closed forms and conserved quantities: no tolerance here is about a step.

namespace carom {
namespace {

using test::run;
using test::sceneOf;
using test::sphere;
using test::wall;
using test::worldOf;

const Vec3 down(0, -9.81, 0);

SimulationSettings exact(double step = 1.0 / 60) {
    SimulationSettings options;
    options.step = step;
    options.method = "events";
    return options;
}

Body elastic(Body body, double e) {
    body.elastic = e;
    return body;
}

/// So many balls in layers of nine, pushed a little out of their places, that fall into a box as wide as they
/// are.
Scene heap(int count, double e) {
    Scene scene;
    scene.gravity.acceleration = down;
    scene.bodies.push_back(elastic(wall(Vec3::UnitY(), 0), e));
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)})
        scene.bodies.push_back(elastic(wall(axis, -0.4), e));
    Random random(7);
    for (int i = 0; i < count; ++i)
        scene.bodies.push_back(
            elastic(sphere(0.1, 1,
                           Vec3(0.25 * (i % 3 - 1) + random.uniform(-0.02, 0.02), 0.2 + 0.25 * (i / 9),
                                0.25 * (i / 3 % 3 - 1) + random.uniform(-0.02, 0.02))),
                    e));
    return scene;
}

double energyOf(const World& world) { return world.statistics().kinetic + world.statistics().potential; }

/// A gas of balls at rest-free random places in a box of edge `edge`, closed by six walls.
Scene gas(int count, double radius, double edge, std::uint64_t seed, const Vec3& gravity) {
    Scene scene;
    scene.gravity.acceleration = gravity;
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
        scene.bodies.push_back(wall(axis, 0));
        scene.bodies.push_back(wall(-axis, -edge));
    }
    Random random(seed);
    while (static_cast<int>(scene.bodies.size()) < count + 6) {
        const Vec3 place(random.uniform(radius, edge - radius), random.uniform(radius, edge - radius),
                         random.uniform(radius, edge - radius));
        const bool clear = std::none_of(scene.bodies.begin() + 6, scene.bodies.end(), [&](const Body& other) {
            return (other.pose.position - place).norm() < 2.01 * radius;
        });
        if (clear)
            scene.bodies.push_back(
                sphere(radius, 1, place, {random.gaussian(), random.gaussian(), random.gaussian()}));
    }
    return scene;
}

double deepestOverlap(const World& world) {
    const Bodies& bodies = world.pipeline().bodies();
    double deepest = 0;
    for (std::size_t i = 6; i < bodies.count(); ++i)
        for (std::size_t j = i + 1; j < bodies.count(); ++j) {
            const double reach =
                std::get<Sphere>(bodies.shape[i]).radius + std::get<Sphere>(bodies.shape[j]).radius;
            const double distance = (world.state().pose[i].position - world.state().pose[j].position).norm();
            deepest = std::max(deepest, 1 - distance / reach);
        }
    return deepest;
}

} // namespace

class EventsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // Hard case 1: 20 s from 5 m; the ball is at h0 − g τ²/2 after the last of its bounces, for ever.
    void anElasticBallBouncesForEverToTheSameHeight() {
        World world =
            worldOf(sceneOf({wall(Vec3::UnitY(), 0), sphere(0.1, 1, Vec3(0, 5.1, 0))}, down), exact());
        const double initial = energyOf(world);
        for (int frame = 0; frame < 1200; ++frame) {
            world.step();
            QVERIFY(std::abs(energyOf(world) - initial) <= 1e-12 * initial);
            const double fall = std::sqrt(2 * 5 / 9.81);
            const double phase = std::fmod(world.state().time + fall, 2 * fall) - fall;
            QVERIFY(std::abs(world.state().pose[1].position.y() - (5.1 - 0.5 * 9.81 * phase * phase)) <
                    1e-10);
        }
    }

    // Hard case 3: no drop is too low to rebound.
    void anElasticBallReboundsFromAnyHeight() {
        for (const double height : {1e-9, 1e-6, 1e-3, 1.0, 1e3}) {
            const double radius = 0.1, fall = std::sqrt(2 * height / 9.81);
            World world = worldOf(
                sceneOf({wall(Vec3::UnitY(), 0), sphere(radius, 1, Vec3(0, radius + height, 0))}, down),
                exact(2 * fall));
            run(world, 1); // one fall and one rise: at the top again
            const double rebound = world.state().pose[1].position.y() - radius;
            QVERIFY2(std::abs(rebound / height - 1) < 1e-7 && world.statistics().contacts >= 1,
                     qPrintable(QString::number(height)));
        }
    }

    // What rounding leaves of a velocity is no bounce: lower than 1e-10 of its radius the ball rests, at any
    // restitution. A break of elastic balls had 45 million bounces in a frame, of 1e-16 m; of the lowest that
    // are left a ball makes g h / 2v = 1.1e4.
    void bouncesThatAreRoundingEnd() {
        Scene scene = sceneOf(
            {wall(Vec3::UnitY(), 0), sphere(0.027, 0.17, Vec3(0.3, 0.027, 0.7), Vec3(-3, 0, -7))}, down);
        Random random(10);
        for (int row = 0; row < 5; ++row)
            for (int k = 0; k <= row; ++k) {
                const double x = random.uniform(-4e-5, 4e-5), z = random.uniform(-4e-5, 4e-5);
                scene.bodies.push_back(
                    sphere(0.0286, 0.17, Vec3(x + 0.0574 * (k - 0.5 * row), 0.0286, z - 0.05 * row)));
            }
        for (Body& body : scene.bodies) body.elastic = 1;
        World world = worldOf(scene, {});
        const double initial = energyOf(world);
        for (int frame = 0; frame < 20; ++frame) {
            world.step();
            QVERIFY2(world.statistics().events < 200'000,
                     qPrintable(QString::number(world.statistics().events)));
        }
        QVERIFY(std::abs(energyOf(world) - initial) <= 1e-12 * initial);
        QVERIFY(world.statistics().work.rowsSwept == 0); // exact to the end
    }

    // Hard case 4: the bounces sum to t0 (1+e)/(1−e), after which it rests.
    void anInelasticBallRestsWhenItsBouncesEnd() {
        for (const double e : {0.5, 0.9, 0.99}) {
            const double g = 9.80665, t0 = std::sqrt(2 / g), rest = t0 * (1 + e) / (1 - e);
            const Scene scene =
                sceneOf({elastic(wall(Vec3::UnitY(), 0), e), elastic(sphere(0.1, 1, Vec3(0, 1.1, 0)), e)},
                        {0, -g, 0});
            World before = worldOf(scene, exact(rest * (1 - 1e-6)));
            run(before, 1);
            QVERIFY(before.state().pose[1].position.y() > 0.1 || before.state().velocity[1].y() != 0);
            World after = worldOf(scene, exact(rest * (1 + 1e-9)));
            run(after, 3);
            QVERIFY(std::abs(after.state().pose[1].position.y() - 0.1) < 1e-12);
            QCOMPARE(after.state().velocity[1], Vec3(0, 0, 0));
        }
    }

    // Hard case 5.
    void aBallLaidOnAFloorDoesNotMoveByABit() {
        World world =
            worldOf(sceneOf({wall(Vec3::UnitY(), 0), sphere(0.5, 1, Vec3(0.3, 0.5, -0.7))}, down), exact());
        run(world, 10'000);
        QCOMPARE(world.state().pose[1].position, Vec3(0.3, 0.5, -0.7));
        QCOMPARE(world.state().velocity[1], Vec3(0, 0, 0));
    }

    // Hard case 6, sphere and sphere: v' = −e v of the relative velocity, momentum kept, at any mass ratio.
    void aPairPartsWithItsRestitutionTimesItsApproach() {
        for (const double ratio : {1.0, 1e3, 1e6})
            for (int k = 0; k <= 20; ++k) {
                const double e = 0.05 * k;
                World world =
                    worldOf(sceneOf({elastic(sphere(0.5, 1, Vec3(-1, 0, 0), Vec3(2, 0, 0)), e),
                                     elastic(sphere(0.5, ratio, Vec3(1, 0, 0), Vec3(-1, 0, 0)), e)}),
                            exact(1));
                run(world, 1);
                const double vA = world.state().velocity[0].x(), vB = world.state().velocity[1].x();
                QVERIFY(std::abs((vB - vA) - 3 * e) < 1e-12 * 3);
                QVERIFY(std::abs((vA + ratio * vB) - (2 - ratio)) < 1e-12 * (2 + ratio));
            }
    }

    // Hard case 19: as many balls leave as came in.
    void theCradlePassesOnAsManyBallsAsCameIn() {
        for (int in = 1; in <= 4; ++in) {
            Scene scene;
            scene.gravity.acceleration = Vec3::Zero();
            for (int i = 0; i < 5; ++i)
                scene.bodies.push_back(
                    sphere(0.5, 1, Vec3(i < in ? i - 1.0 : i, 0, 0), i < in ? Vec3(1, 0, 0) : Vec3::Zero()));
            World world = worldOf(scene, exact(2));
            run(world, 1);
            for (int i = 0; i < 5; ++i)
                QVERIFY(std::abs(world.state().velocity[static_cast<std::size_t>(i)].x() -
                                 (i >= 5 - in ? 1 : 0)) < 1e-12);
        }
    }

    // Hard case 20.
    void aBallStruckFromBothSidesStays() {
        World world =
            worldOf(sceneOf({sphere(0.5, 1, Vec3(-2, 0, 0), Vec3(5, 0, 0)), sphere(0.5, 1, Vec3::Zero()),
                             sphere(0.5, 1, Vec3(2, 0, 0), Vec3(-5, 0, 0))}),
                    exact(1));
        run(world, 1);
        QVERIFY((world.state().velocity[0] - Vec3(-5, 0, 0)).norm() < 1e-12);
        QVERIFY(world.state().velocity[1].norm() < 1e-12);
        QVERIFY((world.state().velocity[2] - Vec3(5, 0, 0)).norm() < 1e-12);
    }

    // Hard case 46, short: no drift, and at no frame do two balls overlap by more than rounding.
    void aGasKeepsItsEnergyAndNeverOverlaps_data() {
        QTest::addColumn<bool>("gravity");
        QTest::newRow("without gravity") << false;
        QTest::newRow("with gravity") << true;
    }
    void aGasKeepsItsEnergyAndNeverOverlaps() {
        QFETCH(bool, gravity);
        World world = worldOf(gas(200, 0.05, 1, 7, gravity ? down : Vec3::Zero()), exact());
        const double initial = energyOf(world);
        std::uint64_t collisions = 0;
        for (int frame = 0; frame < 600; ++frame) {
            world.step();
            collisions += world.statistics().contacts;
            if (frame % 10 == 0) QVERIFY(deepestOverlap(world) < 1e-12);
        }
        QVERIFY(collisions > 10'000);
        QVERIFY(std::abs(energyOf(world) - initial) <= 1e-12 * initial);
    }

    void cuttingTimeIntoMoreFramesChangesNoBit() {
        const Scene scene = gas(100, 0.05, 1, 11, down);
        World coarse = worldOf(scene, exact(1.0 / 8)), fine = worldOf(scene, exact(1.0 / 64));
        run(coarse, 24);
        run(fine, 8 * 24);
        for (std::size_t i = 6; i < scene.bodies.size(); ++i) {
            QCOMPARE(coarse.state().pose[i].position, fine.state().pose[i].position);
            QCOMPARE(coarse.state().velocity[i], fine.state().velocity[i]);
        }
    }

    void theOrderOfDeclarationsChangesNoBit() {
        const Scene scene = gas(100, 0.05, 1, 13, down);
        Scene reversed = scene;
        std::reverse(reversed.bodies.begin(), reversed.bodies.end());
        World forwards = worldOf(scene, exact()), backwards = worldOf(reversed, exact());
        run(forwards, 120);
        run(backwards, 120);
        const std::size_t count = scene.bodies.size();
        for (std::size_t i = 6; i < count; ++i)
            QCOMPARE(forwards.state().pose[i].position, backwards.state().pose[count - 1 - i].position);
    }

    void aBallSlidesOffAFixedBallWhenItsPathDoes() {
        // Thrown at a fixed ball under gravity: the quartic. Energy stays, and it never enters.
        Body post = sphere(1, 1, Vec3::Zero());
        post.fixed = true;
        World world = worldOf(
            sceneOf({post, sphere(0.2, 1, Vec3(0.1, 3, 0.05)), wall(Vec3::UnitY(), -2)}, down), exact());
        const double initial = energyOf(world);
        std::uint64_t contacts = 0;
        for (int frame = 0; frame < 300; ++frame) {
            world.step();
            contacts += world.statistics().contacts;
            QVERIFY(world.state().pose[1].position.norm() > 1.2 - 1e-12);
            QVERIFY(std::abs(energyOf(world) - initial) < 1e-11 * std::abs(initial));
        }
        QVERIFY(contacts >= 2);
    }

    void aRestingBallThatIsHitLeavesAndComesToRestAgain() {
        const double e = 0.5;
        World world =
            worldOf(sceneOf({elastic(wall(Vec3::UnitY(), 0), e), elastic(sphere(0.5, 1, Vec3(0, 0.5, 0)), e),
                             elastic(sphere(0.5, 1, Vec3(0.3, 4, 0)), e)},
                            down),
                    exact());
        run(world, 1200);
        for (const std::size_t i : {std::size_t{1}, std::size_t{2}}) {
            QVERIFY(std::abs(world.state().pose[i].position.y() - 0.5) < 1e-9);
            QVERIFY(std::abs(world.state().velocity[i].y()) < 1e-9);
        }
        QVERIFY(world.health().finite);
    }

    // Balls come to rest on walls only; on each other they go on in hops of a billionth of a radius. In a
    // column of two the upper one fell through the lower one, and columns of five stopped the run: no time
    // passed between their events any more.
    void inelasticBallsThatFallInAColumnComeToStandOnEachOther_data() {
        QTest::addColumn<double>("e");
        QTest::addColumn<int>("count");
        for (const double e : {0.0, 0.5, 0.9})
            for (const int count : {2, 5}) QTest::addRow("%d balls, e = %g", count, e) << e << count;
    }
    void inelasticBallsThatFallInAColumnComeToStandOnEachOther() {
        QFETCH(double, e);
        QFETCH(int, count);
        Scene scene = sceneOf({elastic(wall(Vec3::UnitY(), 0), e)}, down);
        for (int i = 0; i < count; ++i)
            scene.bodies.push_back(elastic(sphere(0.1, 1, Vec3(0, 0.12 + 0.22 * i, 0)), e));
        World world = worldOf(scene, exact());
        run(world, 180);
        QVERIFY(world.health().finite);
        constexpr double hop = 2e-9 * 0.1; // each ball one above the one below it [m]
        for (int i = 0; i < count; ++i) {
            const Vec3& place = world.state().pose[static_cast<std::size_t>(i) + 1].position;
            QVERIFY2(std::abs(place.y() - (0.1 + 0.2 * i)) < hop * (i + 1),
                     qPrintable(QString::number(place.y() - (0.1 + 0.2 * i))));
            QCOMPARE(place.x(), 0.0);
        }
    }

    // Rounding of their places lets some of them begin a little above the next; elastic ones hopped there for
    // ever.
    void aColumnThatIsLaidStaysUntilItIsStruck() {
        for (const double e : {0.5, 1.0}) {
            Scene scene = sceneOf({elastic(wall(Vec3::UnitY(), 0), e)}, down);
            for (int i = 0; i < 5; ++i)
                scene.bodies.push_back(elastic(sphere(0.1, 1, Vec3(0, 0.1 + 0.2 * i, 0)), e));
            scene.bodies.push_back(elastic(sphere(0.1, 1, Vec3(2, 1, 0), Vec3(-2, 4.08, 0)), e));
            World world = worldOf(scene, exact());
            run(world, 50); // hit after 0.9 s, at the second ball from the top
            for (int i = 0; i < 5; ++i) {
                const Vec3& place = world.state().pose[static_cast<std::size_t>(i) + 1].position;
                QVERIFY(std::abs(place.y() - (0.1 + 0.2 * i)) < 1e-12);
                QCOMPARE(place.x(), 0.0);
            }
            run(world, 15);
            QVERIFY(world.health().finite);
            QVERIFY(world.state().pose[4].position.x() < -0.1);
            QVERIFY(world.state().velocity[5] != Vec3::Zero());
        }
    }

    // From 1 mm beside the top it slides off, the other way than the one below it, and never enters it.
    void anInelasticBallSlidesOffAnotherWithoutEnteringIt() {
        for (const double e : {0.0, 0.5}) {
            World world = worldOf(
                sceneOf({elastic(wall(Vec3::UnitY(), 0), e), elastic(sphere(0.1, 1, Vec3(0, 0.1, 0)), e),
                         elastic(sphere(0.1, 1, Vec3(1e-3, 0.35, 0)), e)},
                        down),
                exact());
            for (int frame = 0; frame < 180; ++frame) {
                world.step();
                const Vec3 between = world.state().pose[2].position - world.state().pose[1].position;
                QVERIFY2(between.norm() > 0.2 * (1 - 1e-12), qPrintable(QString::number(between.norm())));
            }
            QVERIFY(world.health().finite);
            QVERIFY(std::abs(world.state().pose[2].position.y() - 0.1) < 1e-9);
            QVERIFY(world.state().velocity[1].x() < -0.1 && world.state().velocity[2].x() > 0.1);
        }
    }

    // Where one wall stops it a ball is pushed into the other, on which it rests already. Three balls in a
    // groove that slopes went through its walls by up to six radii.
    void ballsInAGrooveStayOutOfItsWalls() {
        for (const bool byName : {false, true})
            for (const double e : {0.0, 0.3})
                for (const double steepness : {0.4, 1.0, 2.5}) {
                    Scene scene = sceneOf({}, down);
                    for (const double side : {1.0, -1.0})
                        scene.bodies.push_back(elastic(wall(Vec3(side, steepness, 0.2).normalized(), 0), e));
                    for (int i = 0; i < 3; ++i)
                        scene.bodies.push_back(
                            elastic(sphere(0.1, 1, Vec3(0.06 * (i - 1), 1 + 0.25 * i, 0.02 * i)), e));
                    World world = worldOf(scene, byName ? exact() : SimulationSettings());
                    for (int frame = 0; frame < 90; ++frame) {
                        world.step();
                        QVERIFY(world.health().finite);
                        for (std::size_t ball = 2; ball < 5; ++ball)
                            for (std::size_t k = 0; k < 2; ++k) {
                                const double gap = distanceTo(std::get<Wall>(scene.bodies[k].shape),
                                                              world.state().pose[ball].position) -
                                                   0.1;
                                QVERIFY2(gap > -0.01 * 0.1, qPrintable(QString::number(gap)));
                            }
                    }
                }
    }

    // Impacts of balls that lie on each other have no end. Frames with too many are left to the general
    // method, so there is a bound to what a frame handles, and everything comes to rest.
    void aFrameHandlesSoManyEventsAtMostAndAHeapComesToRest() {
        const Scene scene = heap(100, 0.5);
        World world = worldOf(scene, {});
        const double energy = energyOf(world);
        std::size_t exactFrames = 0;
        for (int frame = 0; frame < 600; ++frame) {
            world.step();
            QVERIFY(world.health().finite);
            QVERIFY2(world.statistics().events <= 6000 + 16 * 100 + 100, // the last slice is looked at whole
                     qPrintable(QString::number(world.statistics().events)));
            exactFrames += world.statistics().work.rowsSwept == 0 && world.statistics().resting == 0 ? 1 : 0;
        }
        QVERIFY2(exactFrames >= 10, qPrintable(QString::number(exactFrames))); // while they fall
        QVERIFY2(world.statistics().kinetic < 1e-4 * energy,
                 qPrintable(QString::number(world.statistics().kinetic)));
        QVERIFY(world.statistics().maxPenetration < 0.01 * 0.1);
    }

    // From then on attempts are ever more seldom, and change nothing: who sleeps is not moved by a bit.
    void anAttemptInVainChangesNothing() {
        World world = worldOf(heap(30, 0.2), {});
        for (int frame = 0; frame < 1200 && world.statistics().resting < 30; ++frame) world.step();
        QCOMPARE(world.statistics().resting, std::uint64_t{30});
        const std::vector<Pose> before = world.state().pose;
        std::size_t attempts = 0;
        for (int frame = 0; frame < 3000; ++frame) {
            world.step();
            attempts += world.statistics().events > 0 ? 1 : 0;
            for (std::size_t i = 0; i < before.size(); ++i)
                QVERIFY(world.state().pose[i].position == before[i].position);
        }
        QVERIFY2(attempts >= 1 && attempts <= 12, qPrintable(QString::number(attempts)));
    }

    void aRunGoesOnFromACheckpointOfEitherMethod() {
        const Scene scene = heap(40, 0.5);
        World straight = worldOf(scene, {});
        int generally = 0;
        for (int frame = 0; frame < 90; ++frame) {
            const Checkpoint checkpoint = straight.checkpoint();
            World other = worldOf(scene, {});
            other.restore(checkpoint);
            straight.step();
            other.step();
            QCOMPARE(other.stateHash(), straight.stateHash());
            generally += straight.statistics().work.rowsSwept > 0 ? 1 : 0;
        }
        QVERIFY2(generally >= 10 && generally <= 80, qPrintable(QString::number(generally)));
    }

    void aBallSlidesDownAFrictionlessSlopeAsAPointDoes() {
        const double slope = 0.3;
        const Vec3 normal(std::sin(slope), std::cos(slope), 0);
        World world = worldOf(
            sceneOf({elastic(wall(normal, 0), 0.5), elastic(sphere(0.5, 1, 0.5 * normal), 0.5)}, down),
            exact(1));
        run(world, 2);
        const Vec3 along(std::cos(slope), -std::sin(slope), 0);
        const Vec3 expected = 0.5 * normal + (0.5 * 9.81 * std::sin(slope) * 4) * along;
        QVERIFY((world.state().pose[1].position - expected).norm() < 1e-12);
    }

    void whatTheMethodCannotTreatIsNamedAtItsPlace() {
        Scene scene = sceneOf({wall(Vec3::UnitY(), 0), test::cylinder(1, 1, 1, Vec3(0, 2, 0))}, down);
        scene.bodies[1].source.type = {123, 8};
        const Pipeline pipeline(scene, exact());
        const bool named =
            std::any_of(pipeline.warnings().begin(), pipeline.warnings().end(), [](const Diagnostic& d) {
                return d.code == DiagnosticCode::UnsuitableMethod && d.range == SourceRange{123, 8} &&
                       d.message.find("cylinder") != std::string::npos;
            });
        QVERIFY(named);
        QCOMPARE(pipeline.settings().method->name, std::string_view("contacts"));
    }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, events_test, carom::EventsTest)
#include "events_test.moc"
