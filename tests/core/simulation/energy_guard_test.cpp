// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/scenes.h"
#include "tests/support/shipped_scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/trials.h"
#include "tests/support/worlds.h"

#include "core/simulation/build.h"
#include "core/simulation/energy_guard.h"

#include <QTest>

#include <optional>

// When a run is said to have gained energy, and when it is not.

namespace carom {
namespace {

/// The first rise within so many frames.
std::optional<EnergyRise> riseOf(World& world, int frames) {
    world.keepLedger(true);
    EnergyGuard guard(world.pipeline(), world.statistics());
    for (int i = 0; i < frames; ++i) {
        world.step();
        if (const std::optional<EnergyRise> rise = guard.look(world.statistics())) return rise;
    }
    return std::nullopt;
}

/// A body of 1 kg, `stretch` metres beyond the length of a spring on a fixed point.
Scene oscillator(double stiffness, double stretch) {
    Scene scene = test::sceneOf({test::sphere(0.1, 1, Vec3(1 + stretch, 0, 0))});
    Spring spring;
    spring.to = 0;
    spring.stiffness = stiffness;
    spring.length = 1.0;
    scene.springs.push_back(spring);
    return scene;
}

SimulationSettings byIntegrator(const char* name) {
    SimulationSettings options = test::byMethod("contacts");
    options.integrator = name;
    return options;
}

} // namespace

class EnergyGuardTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aRiseAboveATenthOfWhatThereIsToSpendIsFoundOnce() {
        // 2 J of motion, and 1 kg that falls its own 0.1 m: S = 2 + 0.981 J.
        const World world = test::worldOf(
            test::sceneOf({test::sphere(0.1, 1, Vec3(0, 5, 0), Vec3(2, 0, 0))}, Vec3(0, -9.81, 0)));
        const FrameStatistics start = world.statistics();
        EnergyGuard guard(world.pipeline(), start);
        FrameStatistics frame = start;
        frame.frame = 1;
        frame.kinetic = start.kinetic + 0.298;
        QVERIFY(!guard.look(frame));
        frame.frame = 2;
        frame.kinetic = start.kinetic + 0.2983;
        frame.ledger[LedgerAccount::Friction].energy = 0.1;
        frame.ledger[LedgerAccount::Spring].energy = 0.2;
        const std::optional<EnergyRise> rise = guard.look(frame);
        QVERIFY(rise);
        QCOMPARE(rise->frame, std::int64_t{2});
        QVERIFY(std::abs(rise->energy - 0.2983) < 1e-12);
        QVERIFY(std::abs(rise->scale - 2.981) < 1e-12);
        QCOMPARE(rise->account, std::optional(LedgerAccount::Spring));
        QCOMPARE(QByteArray::fromStdString(describe(*rise)),
                 QByteArray("gained 0.298 J by frame 2, where it had 2.98 J to spend; most of it by spring"));
        QVERIFY(!guard.look(frame));
    }

    void whatIsReleasedMayBeSpent() {
        const World world =
            test::worldOf(test::sceneOf({test::sphere(0.1, 1, Vec3(0, 5, 0))}, Vec3(0, -9.81, 0)));
        EnergyGuard guard(world.pipeline(), world.statistics());
        FrameStatistics frame = world.statistics();
        frame.potential -= 40;
        frame.kinetic += 44;
        QVERIFY(!guard.look(frame));
        frame.kinetic += 0.2;
        QVERIFY(guard.look(frame));
    }

    // (1 + ω²h²) a step for explicit Euler: 28 % at ωh = 0.53.
    void anIntegratorThatGainsEnergyIsFound() {
        World wrong = test::worldOf(oscillator(1000, 0.1), byIntegrator("euler"));
        const std::optional<EnergyRise> rise = riseOf(wrong, 60);
        QVERIFY(rise);
        QCOMPARE(rise->account, std::optional(LedgerAccount::Spring));
        World right = test::worldOf(oscillator(1000, 0.1), byIntegrator("midpoint"));
        QVERIFY(!riseOf(right, 600));
    }

    void correctingAnOverlapIsNoRise() {
        Scene scene = test::sceneOf({test::wall(Vec3::UnitY(), 0)}, Vec3(0, -9.81, 0));
        for (int i = 0; i < 4; ++i)
            scene.bodies.push_back(test::cuboid(Vec3::Ones(), 1, Vec3(0, 0.1 + 0.2 * i, 0)));
        World world = test::worldOf(scene);
        QVERIFY(!riseOf(world, 240));
        QVERIFY(world.state().pose[4].position.y() > 3); // it has been lifted by 2.3 m
    }

    void heightsAreMeasuredFromAnywhere() {
        Scene scene = test::sceneOf({test::sphere(0.1, 1, Vec3(0, 5, 0))}, Vec3(0, -9.81, 0));
        Scene above = scene;
        above.bodies[0].pose.position.y() += 1e5;
        for (const Scene& one : {scene, above}) {
            const World world = test::worldOf(one);
            EnergyGuard guard(world.pipeline(), world.statistics());
            FrameStatistics frame = world.statistics();
            frame.kinetic += 0.097;
            QVERIFY(!guard.look(frame));
            frame.kinetic += 0.002;
            QVERIFY(guard.look(frame));
        }
    }

    void noShippedSceneGainsEnergy_data() {
        QTest::addColumn<QString>("scene");
        for (const QString& path : test::shippedScenes()) QTest::newRow(qPrintable(path)) << path;
    }
    void noShippedSceneGainsEnergy() {
        QFETCH(QString, scene);
        const Build built = build(test::textOfScene(scene));
        World world(built.pipeline);
        const std::optional<EnergyRise> rise = riseOf(world, test::trials(60));
        QVERIFY2(!rise, rise ? describe(*rise).c_str() : "");
    }
};

} // namespace carom

CAROM_TEST(energy_guard_test, carom::EnergyGuardTest)
#include "energy_guard_test.moc"
