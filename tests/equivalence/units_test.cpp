// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/analysis.h"
#include "core/simulation/method_choice.h"
#include "core/study/units.h"

#include "tests/support/random_scene.h"
#include "tests/support/shipped_scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include <QTest>

// No length, speed, time or mass is built in: a scene in other units moves the same, to the bit.

namespace carom {
namespace {

using namespace test;

constexpr Units otherUnits[] = {{-10, 0}, {0, -9}, {7, 6}};
/// Frames of a shipped scene; enough for impacts, slides and rests to have happened in most.
constexpr int frames = 3;

World worldIn(const Scene& scene, const Units& units, const char* method, const char* preset) {
    SimulationSettings options;
    options.method = method;
    options.preset = preset;
    options.step = units.second() / 64; // a power of two, so that scaling it is exact
    options.duration.reset();
    return World(std::make_shared<const Pipeline>(scaled(scene, units), options));
}

/// The first thing that differs by a bit, or nothing.
QString firstDifference(const World& world, const World& other, const Units& units) {
    const State &a = world.state(), &b = other.state();
    const double metre = units.metre(), second = units.second();
    for (const BodyIndex i : world.pipeline().bodies().mobileBodies) {
        const char* what = nullptr;
        if (a.pose[i].position * metre != b.pose[i].position) what = "position";
        if (a.pose[i].orientation.coeffs() != b.pose[i].orientation.coeffs()) what = "orientation";
        if (a.velocity[i] * (metre / second) != b.velocity[i]) what = "velocity";
        if (a.angularVelocity[i] / second != b.angularVelocity[i]) what = "angular velocity";
        if (what != nullptr)
            return QStringLiteral("%1 of body %2 in frame %3, lengths times 4^%4, masses times 2^%5")
                .arg(QLatin1String(what))
                .arg(i)
                .arg(a.frame)
                .arg(units.length)
                .arg(units.mass);
    }
    return {};
}

void movesTheSameInAllUnits(const Scene& scene, const char* method, const char* preset, int most) {
    World plain = worldIn(scene, {}, method, preset);
    std::vector<World> others;
    for (const Units& units : otherUnits) others.push_back(worldIn(scene, units, method, preset));
    for (int frame = 0; frame < most; ++frame) {
        plain.step();
        for (std::size_t k = 0; k < others.size(); ++k) {
            others[k].step();
            QVERIFY(others[k].health().finite);
            const QString difference = firstDifference(plain, others[k], otherUnits[k]);
            QVERIFY2(difference.isEmpty(), qPrintable(difference));
        }
    }
}

} // namespace

class UnitsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everyShippedSceneMovesTheSameInAllUnits_data() {
        QTest::addColumn<QString>("path");
        QTest::addColumn<QByteArray>("method");
        for (const QString& path : shippedScenes())
            for (const char* method : {"contacts", "microcollisions", "events"})
                QTest::addRow("%s, %s", qPrintable(path), method) << path << QByteArray(method);
    }
    void everyShippedSceneMovesTheSameInAllUnits() {
        QFETCH(QString, path);
        QFETCH(QByteArray, method);
        const Scene scene = analyse(textOfScene(path)).scene;
        if (const SolverRow& row = *findSolver(method.constData()); objectionTo(row, scene))
            return; // the method does not treat this scene
        movesTheSameInAllUnits(scene, method.constData(), "default", frames);
    }

    void randomScenesMoveTheSameInAllUnits_data() {
        QTest::addColumn<QByteArray>("preset");
        for (const char* preset : {"default", "accurate"}) QTest::newRow(preset) << QByteArray(preset);
    }
    void randomScenesMoveTheSameInAllUnits() {
        QFETCH(QByteArray, preset);
        constexpr std::uint64_t seed = 41;
        qInfo("seed %llu", static_cast<unsigned long long>(seed));
        Random random(seed);
        for (int round = 0; round < 3; ++round) {
            movesTheSameInAllUnits(randomRoughScene(random), "contacts", preset.constData(), 5);
        }
    }

    // Many turns of the clock that events keep their times by, in the smaller unit of time as in the larger.
    void aLongRunOfEventsIsTheSameInAllUnits() {
        const Scene scene = analyse(textOfScene(QStringLiteral("brownian.sdl"))).scene;
        movesTheSameInAllUnits(scene, "events", "default", 200);
    }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, units_test, carom::UnitsTest)
#include "units_test.moc"
