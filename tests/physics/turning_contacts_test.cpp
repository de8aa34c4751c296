// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/contact_scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"
#include "tests/support/worst_of_run.h"

#include "core/math/random.h"
#include "core/simulation/build.h"
#include "core/study/cases/generated.h"
#include "core/study/references.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <numbers>

// Contacts that turn while bodies do, under method `contacts`: hard cases 11 and 12 in short form, and the
// order of the method in them. With the contacts as they are at the start of a substep it was one, and
// Euler's disk was half a radian off after ten turns.

namespace carom {
namespace {

using namespace test;

constexpr double halfWidth = 0.1, halfHeight = 0.4; ///< of the block [m]

SimulationSettings parts(int substeps) {
    SimulationSettings options = contacts("default");
    options.substeps = substeps;
    options.tolerance = 1e-10;
    return options;
}

/// On one lower edge, turned half of the way to where it would fall over.
Scene leaningBlock() {
    const double critical = std::atan(halfWidth / halfHeight), angle = critical / 2;
    const double reach = std::hypot(halfWidth, halfHeight);
    const Vec3 centre(reach * std::sin(critical - angle), reach * std::cos(critical - angle), 0);
    const Body block = cuboid(Vec3(2 * halfWidth, 2 * halfHeight, 2 * halfWidth), 1, centre);
    return sceneOf({floorOf(10), rough(turned(block, Vec3(0, 0, angle)), 10)}, downwards());
}

constexpr double discRadius = 0.064, discThickness = 0.0064; ///< [m]

/// Of discs that stand on their rims and spin about a diameter [rad/s], with and without friction and bounce.
WorstOfRun worstOfDiscs(const QByteArray& preset, double spin) {
    WorstOfRun worst;
    for (const double e : {0.0, 0.5}) {
        for (const double friction : {0.0, 0.3}) {
            Body disc = turned(cylinder(discRadius, discThickness, 0.1, Vec3(0, 1.1 * discRadius, 0)),
                               std::atan2(1, -0.33) * Vec3(0, 0, -1));
            disc = rough(moving(disc, Vec3::Zero(), Vec3(0, spin, 0)), friction, e);
            World world = worldOf(sceneOf({floorOf(friction, e), disc}, downwards()), contacts(preset));
            worst.include(worstOf(world, 300));
        }
    }
    return worst;
}

/// Coins in a packet, each thrown along −z at `speed` [m/s] at a fixed plate whose front is at z = 0.
Scene coinsThrownAtPlate(Random& random, double thickness, double speed) {
    constexpr double radius = 0.09, apart = 0.2; // [m]
    Body plate = rough(cuboid(Vec3(20, 20, thickness), 1, Vec3(0, 0, -thickness / 2)), 0.3, 0.2);
    plate.fixed = true;
    Scene scene = sceneOf({plate});
    for (int i = 0; i < 72; ++i) {
        const Vec3 at(apart * (i % 6 - 2.5), apart * (i / 6 % 6 - 2.5), 0.5 + apart * (i / 36));
        const Body coin =
            turned(cylinder(radius, 0.006, 1, at), random.uniform(0, 3) * uniformDirection(random));
        scene.bodies.push_back(rough(moving(coin, Vec3(0, 0, -speed)), 0.3, 0.2));
    }
    return scene;
}

/// The angle from standing after `time`: a pendulum about the edge, I θ'' = −m g r sin(critical − θ), by
/// Runge's and Kutta's rule in steps too small to matter.
double leanAfter(double time) {
    const double critical = std::atan(halfWidth / halfHeight), reach = std::hypot(halfWidth, halfHeight);
    const double rate = gravity / (4.0 / 3.0 * reach); // m g r/I about the edge
    constexpr int steps = 10'000;
    const double h = time / steps;
    double angle = critical / 2, spin = 0;
    const auto pull = [&](double at) { return -rate * std::sin(critical - at); };
    for (int i = 0; i < steps; ++i) {
        const double k1 = spin, l1 = pull(angle);
        const double k2 = spin + h / 2 * l1, l2 = pull(angle + h / 2 * k1);
        const double k3 = spin + h / 2 * l2, l3 = pull(angle + h / 2 * k2);
        const double k4 = spin + h * l3, l4 = pull(angle + h * k3);
        angle += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        spin += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
    }
    return angle;
}

double leanError(int substeps) {
    World world = worldOf(leaningBlock(), parts(substeps));
    constexpr int frames = 12; // it comes down after some 17
    run(world, frames);
    const Vec3 up = world.state().pose[1].directionToWorld(Vec3::UnitY());
    return std::abs(std::asin(-up.x()) - leanAfter(frames / 60.0));
}

/// On its rim, rolling round so that the tilt is steady and the centre rests.
Scene disk(double tilt) {
    constexpr double radius = 0.0375, halfThickness = 0.0065;
    const Vec3 axis(std::sin(tilt), std::cos(tilt), 0), outward(std::cos(tilt), -std::sin(tilt), 0);
    const Vec3 toContact = radius * outward - halfThickness * axis;
    const double precession = reference::diskPrecession(radius, halfThickness, tilt, gravity);
    const Body body =
        turned(cylinder(radius, 2 * halfThickness, 0.4, Vec3(0, -toContact.y(), 0)), Vec3(0, 0, -tilt));
    return sceneOf(
        {floorOf(1), rough(moving(body, Vec3::Zero(), -precession * axis.x() / radius * toContact), 1)},
        downwards());
}

double tiltError(double tilt, int substeps, int frames) {
    World world = worldOf(disk(tilt), parts(substeps));
    double worst = 0;
    for (int frame = 0; frame < frames; ++frame) {
        world.step();
        const double height = world.state().pose[1].directionToWorld(Vec3::UnitY()).y();
        worst = std::max(worst, std::abs(std::acos(std::min(1.0, height)) - tilt));
    }
    return worst;
}

void everyPreset() {
    QTest::addColumn<QByteArray>("preset");
    for (const char* preset : {"fast", "default", "accurate"}) QTest::newRow(preset) << QByteArray(preset);
}

} // namespace

class TurningContactsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aBlockTurnsAboutItsEdgeToSecondOrder() {
        const double coarse = leanError(4), fine = leanError(8);
        qInfo("lean off by %.2e and %.2e rad", coarse, fine);
        QVERIFY(coarse < 1e-4); // first order: 2e-3
        QVERIFY(fine < coarse / 3);
    }

    void eulersDiskKeepsItsTilt() {
        const double tilt = 20 * std::numbers::pi / 180;
        const double coarse = tiltError(tilt, 4, 60), fine = tiltError(tilt, 8, 60);
        qInfo("tilt off by %.2e and %.2e rad", coarse, fine);
        QVERIFY(coarse < 1e-2);
        QVERIFY(fine < coarse / 3);
    }

    // Hard case 54: the spin of a thin body precesses within a substep. Followed as if it did not, the end of
    // a stick came down through the floor by 1.6 times its thickness, and rims of discs between two looks by
    // .012 of it.
    void spinningSticksAndPlatesStayAboveTheFloor() {
        constexpr double length = 0.2, allowed = 1e-2; // [m]; of the thickness
        constexpr std::uint64_t seed = 1905;
        qInfo("seed %llu", static_cast<unsigned long long>(seed));
        Random random(seed, 54);
        double deepest = 0;
        for (int member = 0; member < 60; ++member) {
            const double thickness = member % 2 == 0 ? length / 10 : length / 100;
            const Vec3 at(0, random.uniform(0.2, 0.6), 0),
                attitude = random.uniform(0, 3) * uniformDirection(random);
            Body body = member % 3 == 0   ? cylinder(thickness / 2, length, 1, at)
                        : member % 3 == 1 ? cuboid(Vec3(length, thickness, length), 1, at)
                                          : cuboid(Vec3(length, thickness, thickness), 1, at);
            const Vec3 velocity(random.uniform(-2, 2), random.uniform(-3, 0), 0);
            body = moving(turned(body, attitude), velocity, random.uniform(0, 20) * uniformDirection(random));
            World world = worldOf(sceneOf({floorOf(0.5, 0.3), rough(body, 0.5, 0.3)}, downwards()),
                                  contacts("default"));
            for (int frame = 0; frame < 90; ++frame) {
                run(world, 1);
                deepest = std::max(deepest, deepestOverlap(world) / thickness);
            }
        }
        qInfo("sunk in by at most %.1e of the thickness", deepest);
        QVERIFY(deepest < allowed);
    }

    // Discs as thick as coins, tossed and spinning at up to 100 rad/s: rims meet the floor at other places
    // within a step. Held at the places where they were, the discs went through the floor under `fast`, and
    // sank in by their thickness under `default`; a part that contacts could not be followed through gave
    // them up to a tenth of their energy.
    void tossedCoinsStayAboveTheFloor_data() {
        QTest::addColumn<QByteArray>("preset");
        QTest::addColumn<double>("allowed"); // of the thickness
        QTest::newRow("fast") << QByteArray("fast") << 0.1;
        QTest::newRow("default") << QByteArray("default") << 0.05;
        QTest::newRow("accurate") << QByteArray("accurate") << 1e-3;
    }
    void tossedCoinsStayAboveTheFloor() {
        QFETCH(QByteArray, preset);
        QFETCH(double, allowed);
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        constexpr double radius = 0.0115, thickness = 0.0023; // [m]
        Random random(test::seed);
        WorstOfRun worst;
        for (int coin = 0; coin < (preset == "accurate" ? 6 : 24); ++coin) {
            const Vec3 spin = random.uniform(0, 100) * uniformDirection(random);
            Body body = turned(cylinder(radius, thickness, 0.0075, Vec3(0, 0.05, 0)),
                               random.uniform(0, 3) * uniformDirection(random));
            body = rough(moving(body, Vec3::Zero(), spin), 0.3, 0.3);
            World world = worldOf(sceneOf({floorOf(0.3, 0.3), body}, downwards()), contacts(preset));
            worst.include(worstOf(world, 90));
        }
        const double deepest = worst.overlap / thickness;
        qInfo("sunk in by at most %.1e of the thickness, energy gained %.1e", deepest, worst.gained);
        QVERIFY(deepest < allowed);
        QVERIFY(worst.gained < 1e-3);
    }

    // A disc that spins about a diameter comes down and rolls round on its rim, by two radians in a substep
    // at 500 rad/s. Corrections of overlaps turned it and left its angular velocity: without friction it
    // had 1.5 times its energy after three seconds, and at 1000 rad/s under `accurate` 1.7 times. Under
    // `fast`, what was left of a substep when its events were used up gave one of 250 rad/s a thousandth of
    // its energy in every frame, and one of 725 rad/s sank in by .6 of its thickness in a part that ended at
    // an event.
    void spinningDiscsGainNoEnergy_data() { everyPreset(); }
    void spinningDiscsGainNoEnergy() {
        QFETCH(QByteArray, preset);
        constexpr double allowed = 0.02 * discRadius; // mostCorrection: no substep adds more
        constexpr double mostGained = 2e-3; // a part of a substep may give a thousandth (island_motion.cpp)
        WorstOfRun worst;
        for (const double spin : {100.0, 250.0, 500.0, 725.0, 1000.0}) {
            const WorstOfRun run = worstOfDiscs(preset, spin);
            qInfo("%4.0f rad/s: gained %.1e, sunk in by %.1e", spin, run.gained, run.overlap / discThickness);
            worst.include(run);
        }
        QVERIFY(worst.gained < mostGained);
        QVERIFY(worst.overlap < allowed);
    }

    // The rim comes down gently and rolls round by four radians in a substep. A force that was to close the
    // gap pushed the disc off the floor and gave up to a thousandth of its energy, in substep after substep:
    // one under `fast` gained .7 %, one under `default` .2 %. Friction, along directions of the middle of a
    // part that were turned by radians from those of its slip, then gave .23 % and .1 %.
    void aForceInAGapGivesNoEnergy_data() { everyPreset(); }
    void aForceInAGapGivesNoEnergy() {
        QFETCH(QByteArray, preset);
        constexpr double mostGained = 1e-3; // in a run no more than one part may give (island_motion.cpp)
        WorstOfRun worst;
        for (double spin = 960; spin < 1040; spin += preset == "accurate" ? 16 : 4)
            worst.include(worstOfDiscs(preset, spin));
        qInfo("gained %.1e, sunk in by %.1e of the thickness", worst.gained, worst.overlap / discThickness);
        QVERIFY(worst.gained < mostGained);
    }

    // One after the other, impacts on two sides of a rim. A place of the rim that rounding had chosen, on no
    // side of it, was held like a contact: a cylinder between walls lost nine tenths of its energy.
    void aCylinderBetweenElasticWallsKeepsItsEnergy_data() { everyPreset(); }
    void aCylinderBetweenElasticWallsKeepsItsEnergy() {
        QFETCH(QByteArray, preset);
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 60);
        double worst = 0;
        for (int run = 0; run < 6; ++run) {
            const Body body = turned(cylinder(0.1, random.uniform(0.02, 0.4), 1, Vec3::Zero()),
                                     random.uniform(0, 3) * uniformDirection(random));
            Scene scene = sceneOf({rough(moving(body, random.uniform(1, 4) * uniformDirection(random),
                                                random.uniform(0, 9) * uniformDirection(random)),
                                         0, 1)});
            for (int axis = 0; axis < 3; ++axis)
                for (const double sign : {-1.0, 1.0})
                    scene.bodies.push_back(rough(wall(sign * Vec3::Unit(axis), -0.5), 0, 1));
            World world = worldOf(scene, contacts(preset));
            const double start = energyOf(world);
            test::run(world, 200);
            worst = std::max(worst, std::abs(energyOf(world) / start - 1));
        }
        qInfo("energy off by at most %.1e", worst);
        QVERIFY(worst < 1e-11);
    }

    // Thin rods thrown into a bin: what strikes one end turns a rod by a quarter of a turn within a step of
    // `fast`, and its other end came down where nobody had looked. In the mean of all frames the deepest
    // overlap was two to four thicknesses, and nearly that of a half length beside a wall.
    void rodsThrownIntoABinStayInIt() {
        constexpr double radius = 0.002, length = 0.04, half = 0.1, apart = 0.045, allowed = 1.5; // [m]
        constexpr int frames = 60;
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 80);
        double sum = 0;
        for (int heap = 0; heap < 3; ++heap) {
            Scene scene = sceneOf({floorOf(0.4, 0.3)}, downwards());
            for (const Vec3& inwards : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)})
                scene.bodies.push_back(rough(wall(inwards, -half), 0.4, 0.3));
            for (int i = 0; i < 80; ++i) {
                const Vec3 at(apart * (i % 4 - 1.5), 0.05 + apart * (i / 16), apart * (i / 4 % 4 - 1.5));
                const Body rod = turned(cylinder(radius, length, 0.01, at),
                                        random.uniform(0, 3) * uniformDirection(random));
                const Vec3 velocity = random.uniform(0, 2) * uniformDirection(random);
                scene.bodies.push_back(rough(
                    moving(rod, velocity, random.uniform(15, 60) * uniformDirection(random)), 0.4, 0.3));
            }
            World world = worldOf(scene, contacts("fast"));
            for (int frame = 0; frame < frames; ++frame) {
                run(world, 1);
                sum += deepestOverlap(world) / (3 * frames * 2 * radius);
            }
        }
        qInfo("deepest overlap, in the mean of all frames, %.2f of the thickness", sum);
        QVERIFY(sum < allowed);
    }

    // What strikes one side of a coin turns it, and its other side comes down within the step, where nobody
    // looked after an impact; and what was found deep in the plate was a contact with its far side, which
    // pushed coins through: 44 of 216 were behind it.
    void coinsThrownAtAThinPlateStayBeforeIt() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed);
        long behind = 0;
        for (const double speed : {20.0, 30.0, 50.0}) {
            World world = worldOf(coinsThrownAtPlate(random, 0.01, speed), contacts("default"));
            run(world, 12);
            behind += std::count_if(world.state().pose.begin() + 1, world.state().pose.end(),
                                    [](const Pose& pose) { return pose.position.z() < 0; });
        }
        qInfo("%ld of 216 coins are behind the plate", behind);
        QCOMPARE(behind, 0);
    }

    // Nothing takes energy from smooth elastic rods but that the base path solves for them with few passes.
    // Contacts that are found late in a step, where an impact has turned rods, held them when they rebounded,
    // and did not rebound themselves: .70 of the energy was left, of three gases of 80 rods after 100 frames.
    void elasticRodsKeepMostOfTheirEnergy() {
        constexpr double half = 1.6, apart = 0.5, least = 0.8; // [m]; of the energy
        constexpr int gases = 3;
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 20);
        double left = 0;
        for (int gas = 0; gas < gases; ++gas) {
            Scene scene = sceneOf({});
            for (int axis = 0; axis < 3; ++axis)
                for (const double sign : {-1.0, 1.0})
                    scene.bodies.push_back(rough(wall(sign * Vec3::Unit(axis), -half), 0, 1));
            for (int i = 0; i < 80; ++i) {
                const Vec3 at(apart * (i % 5 - 2), apart * (i / 25 - 1.5), apart * (i / 5 % 5 - 2));
                const Body rod = turned(cuboid(Vec3(0.05, 0.48, 0.05), 1, at),
                                        random.uniform(0, 3) * uniformDirection(random));
                const Vec3 velocity = random.uniform(0, 8) * uniformDirection(random);
                scene.bodies.push_back(rough(moving(rod, velocity, 5 * uniformDirection(random)), 0, 1));
            }
            World world = worldOf(scene, contacts("default"));
            const double start = energyOf(world);
            run(world, 100);
            left += energyOf(world) / start / gases;
        }
        qInfo("%.3f of the energy is left", left);
        QVERIFY(left > least);
        QVERIFY(left <= 1);
    }

    // Hard case 29, its steps when the heavy sphere has struck. The rim comes down where no point of it was
    // looked at, and rattles: one of these sank in by 1.7e-3 of its radius.
    void disksThatFallFlatDoNotSinkIn() {
        constexpr double radius = 1.9, allowed = 1e-3; // of the radius, as in the hard case
        constexpr int disks = 60;
        constexpr std::uint64_t seed = 1905;
        qInfo("seed %llu", static_cast<unsigned long long>(seed));
        Random random(seed);
        double deepest = 0;
        for (int disk = 0; disk < disks; ++disk) {
            const Vec3 tilt(random.uniform(-0.05, 0.05), 0, random.uniform(-0.05, 0.05));
            const Vec3 spin(random.uniform(-2, 2), 0, random.uniform(-2, 2));
            Body body = turned(cylinder(radius, 0.5, 15000, Vec3(0, 0.4, 0)), tilt);
            body = rough(moving(body, Vec3(2, random.uniform(-2, 0), 0), spin), 0, 0.8);
            World world = worldOf(sceneOf({floorOf(0, 0.8), body}, downwards()), contacts("default"));
            for (int frame = 0; frame < 150; ++frame) {
                run(world, 1);
                deepest = std::max(deepest, deepestOverlap(world) / radius);
            }
        }
        qInfo("sunk in by at most %.1e of the radius", deepest);
        QVERIFY(deepest < allowed);
    }

    // Rows that are added for what has turned within a step begin with the torque of rolling resistance that
    // the pair's other rows have, as if nothing did: where a spring lets an island have any energy, that of
    // nine rods at 100 rad/s grew without bound under `fast`.
    void rollingResistanceOfTurningRodsGivesNoEnergy_data() { everyPreset(); }
    void rollingResistanceOfTurningRodsGivesNoEnergy() {
        QFETCH(QByteArray, preset);
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        constexpr double rolling = 1e-3; // [m]
        Random random(test::seed);
        Scene scene = sceneOf({rough(floorOf(0.5, 0.2), 0.5, 0.2, rolling)}, downwards());
        for (const Vec3& inward : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)})
            scene.bodies.push_back(rough(wall(inward, -0.3), 0.5, 0.2, rolling));
        for (int i = 0; i < 9; ++i) {
            const Body rod =
                cuboid(Vec3(0.16, 0.03, 0.03), 1, Vec3(0.18 * (i % 3 - 1), 0.1, 0.18 * (i / 3 - 1)));
            scene.bodies.push_back(
                rough(moving(rod, Vec3::Zero(), 100 * uniformDirection(random)), 0.5, 0.2, rolling));
        }
        scene.springs.push_back(springBetween(5, 6, 1));
        World world = worldOf(scene, contacts(preset));
        const WorstOfRun worst = worstOf(world, 40);
        qInfo("gained %.1e, sunk in by %.1e m", worst.gained, worst.overlap);
        QVERIFY(worst.gained < 1e-2);
    }

    // Hard case 29, its steps when they have been struck. Rims that come down make some fifty parts of a
    // substep. The rounds in which their contacts turn gained a third to a tenth each and took the budget of
    // the frame; on the base path, which was left with the rest, these sank in by 3.7e-5 m.
    void discsThatRockOnEachOtherStayOutOfEachOther() {
        constexpr double thickness = 0.6; // [m]
        constexpr double towers[2][4][2] = {
            {{0.22686, -0.0905288}, {0.174434, 0.270952}, {-0.112669, 0.160993}, {-0.0991808, -0.201727}},
            {{0.260557, -0.0671792},
             {0.192985, -0.151342},
             {-0.0107632, -0.135825},
             {0.0252123, -0.255005}}}; // [rad/s]
        WorstOfRun worst;
        for (const auto& spins : towers) {
            Scene scene = sceneOf({floorOf(0.3, 0.2)}, Vec3(0, -9.8, 0));
            for (int i = 0; i < 4; ++i) {
                const Body step =
                    cylinder(3.2 - 0.6 * i, thickness, 40 - 8 * i, Vec3(0, (i + 0.5) * thickness, 0));
                scene.bodies.push_back(
                    rough(moving(step, Vec3::Zero(), Vec3(spins[i][0], 0, spins[i][1])), 0.3, 0.2));
            }
            World world = worldOf(scene, contacts("accurate"));
            worst.include(worstOf(world, 4));
        }
        qInfo("gained %.1e, sunk in by %.1e m", worst.gained, worst.overlap);
        QVERIFY(worst.gained < 1e-9);
        QVERIFY(worst.overlap < 1e-8);
    }

    // Cylinders of radius .1 m that fall into a bin. Where the contacts of a rim were found anew as seldom as
    // those of a corner, one of a hundred was pressed into another by 13 mm.
    void heapsOfCylindersOverlapByLessThanSevenPercent() {
        constexpr std::uint64_t heaps = 4;
        double deepest = 0;
        for (std::uint64_t seed = 1; seed <= heaps; ++seed) {
            const std::string text =
                generated("heap", {.n = 100, .seed = seed, .options = {{"cuboids", 0.0}}});
            World world(build(text).pipeline);
            for (int frame = 0; frame < 120; ++frame) {
                world.step();
                deepest = std::max(deepest, world.statistics().maxPenetration);
            }
        }
        qInfo("%.1e m", deepest);
        QVERIFY(deepest < 7e-3);
    }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, turning_contacts_test, carom::TurningContactsTest)
#include "turning_contacts_test.moc"
