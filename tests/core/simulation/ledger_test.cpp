// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/build.h"
#include "core/simulation/world.h"

#include "tests/support/contact_scenes.h"
#include "tests/support/random_scene.h"
#include "tests/support/shipped_scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include <QTest>

#include <algorithm>

// Energy and momentum change by what the ledger says and by nothing else, frame by frame.

namespace carom {
namespace {

using namespace test;

/// Rounding of energies and momenta, relative to the sums they come out of, over the parts of one frame. The
/// velocities of a solved island are rounded to about 1e-14 of the speeds in play.
constexpr double sumRounding = 1e-11;

struct Unexplained {
    double energy = 0, momentum = 0; // worst of any frame, relative
};

/// The worst unexplained change over the frames, relative to the energy and momentum in play.
Unexplained worstOf(World& world, int frames) {
    world.keepLedger(true);
    Unexplained worst;
    double mass = 0;
    for (const BodyIndex i : world.pipeline().bodies().mobileBodies)
        mass += world.pipeline().bodies().mass[i];
    const double fall = world.pipeline().gravity().norm() * world.pipeline().settings().step;
    double kinetic = world.statistics().kinetic;
    for (int frame = 0; frame < frames; ++frame) {
        world.step();
        const FrameStatistics& now = world.statistics();
        if (!world.health().finite) break;
        double turnover = std::max(kinetic, now.kinetic) + std::abs(now.potential) + 0.5 * mass * fall * fall;
        for (const LedgerEntry& entry : now.ledger.entries) turnover += std::abs(entry.energy);
        const double motion = std::sqrt(2 * mass * turnover);
        kinetic = now.kinetic;
        if (turnover == 0) continue;
        worst.energy = std::max(worst.energy, std::abs(now.unexplained.energy) / turnover);
        worst.momentum = std::max(worst.momentum, now.unexplained.momentum.norm() / motion);
    }
    return worst;
}

void balances(World& world, int frames) {
    const Unexplained worst = worstOf(world, frames);
    qInfo("unexplained: energy %.1e, momentum %.1e", worst.energy, worst.momentum);
    QVERIFY(worst.energy < sumRounding);
    QVERIFY(worst.momentum < sumRounding);
}

} // namespace

class LedgerTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everyShippedSceneBalances_data() {
        QTest::addColumn<QString>("method");
        for (const QString& path : shippedScenes())
            for (const char* method : {"contacts", "microcollisions"})
                QTest::addRow("%s, %s", qPrintable(path), method) << QString::fromLatin1(method);
    }
    void everyShippedSceneBalances() {
        QFETCH(QString, method);
        const QString path = QString::fromUtf8(QTest::currentDataTag()).section(QLatin1Char(','), 0, 0);
        constexpr int frames = 12; // enough for impacts, slides and springs of the small scenes
        World world(build(textOfScene(path), byMethod(method.toLatin1().constData())).pipeline);
        balances(world, frames);
    }

    void randomScenesBalance_data() {
        QTest::addColumn<QString>("method");
        for (const char* method : {"contacts", "microcollisions"})
            QTest::newRow(method) << QString::fromLatin1(method);
    }
    void randomScenesBalance() {
        QFETCH(QString, method);
        constexpr std::uint64_t seed = 20261;
        qInfo("seed %llu", static_cast<unsigned long long>(seed));
        Random random(seed);
        for (int round = 0; round < 12; ++round) {
            World world = worldOf(randomRoughScene(random), byMethod(method.toLatin1().constData()));
            const Unexplained worst = worstOf(world, 12);
            qInfo("round %d: energy %.1e, momentum %.1e", round, worst.energy, worst.momentum);
            QVERIFY(worst.energy < sumRounding);
            QVERIFY(worst.momentum < sumRounding);
        }
    }

    // A ball of 2 kg hits the floor at 3 m/s with e = 1/2: it loses 2 · (9 − 2.25)/2 = 6.75 J and the floor
    // gives it 9 N s.
    void anImpactIsRecordedByItsLoss() {
        Body ball = rough(moving(sphere(0.5, 2, Vec3(0, 0.5, 0)), Vec3(0, -3, 0)), 0, 0.5);
        World world = worldOf(sceneOf({floorOf(0, 0.5), ball}), contacts("default"));
        world.keepLedger(true);
        world.step();
        const LedgerEntry& impacts = world.statistics().ledger[LedgerAccount::Restitution];
        QVERIFY(std::abs(impacts.energy + 6.75) < 1e-12);
        QVERIFY((impacts.momentum - Vec3(0, 9, 0)).norm() < 1e-12);
    }

    // It slides at 5 m/s: friction takes μ m g v dt to first order, and gives momentum −μ m g dt.
    void frictionIsRecordedByItsForce() {
        constexpr double mu = 0.5, mass = 3, speed = 5;
        World world = worldOf(
            sceneOf({floorOf(mu),
                     rough(moving(cuboid(Vec3(1, 1, 1), mass, Vec3(0, 0.5, 0)), Vec3(speed, 0, 0)), mu)},
                    downwards()),
            contacts("default"));
        world.keepLedger(true);
        world.step();
        const double dt = world.pipeline().settings().step;
        const LedgerEntry& friction = world.statistics().ledger[LedgerAccount::Friction];
        const double lost = mu * mass * gravity * dt * (speed - 0.5 * mu * gravity * dt);
        constexpr double tolerance = 1e-5; // relative; the default solves forces to 1e-6
        QVERIFY(std::abs(friction.energy + lost) < tolerance * lost);
        QVERIFY(std::abs(friction.momentum.x() + mu * mass * gravity * dt) < tolerance * mass * gravity * dt);
    }

    void whoeverKeepsALedgerSeesTheSameMotion() {
        for (const char* path : {"table.sdl", "cradle.sdl", "pool_break.sdl"}) {
            const Build built = build(textOfScene(QString::fromLatin1(path)));
            World with(built.pipeline), without(built.pipeline);
            with.keepLedger(true);
            run(with, 20);
            run(without, 20);
            QCOMPARE(with.stateHash(), without.stateHash());
            QCOMPARE(without.statistics().ledger.total().energy, 0.0);
        }
    }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, ledger_test, carom::LedgerTest)
#include "ledger_test.moc"
