// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/varied_scene.h"

#include "core/simulation/build.h"
#include "core/simulation/energy_guard.h"
#include "core/simulation/touching.h"
#include "core/simulation/world.h"

#include <QTest>

#include <algorithm>
#include <array>
#include <optional>
#include <variant>

using namespace carom;
using test::variedScene;

// The scenes that other tests draw at random are what they say they are, and none gains energy.

class VariedSceneTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void sceneOfASeedIsAlwaysTheSame() {
        QCOMPARE(variedScene(5), variedScene(5));
        QVERIFY(variedScene(5) != variedScene(6));
    }

    void noSceneHasMistakesOrOverlapsAtTheStart() {
        for (std::uint64_t seed = 1; seed <= 100; ++seed) {
            const Build scene = build(variedScene(seed));
            const QByteArray where = "seed " + QByteArray::number(qulonglong(seed));
            QVERIFY2(!hasErrors(scene.analysis.diagnostics), where);
            QVERIFY2(touchingPairs(scene.pipeline->bodies(), scene.pipeline->initialState()).empty(), where);
        }
    }

    void scenesAreOfAllSizesAndHoldEverything() {
        std::array<std::size_t, std::variant_size_v<Shape>> ofShape = {};
        std::size_t fewest = 1000, most = 0, springs = 0, fixed = 0;
        for (std::uint64_t seed = 1; seed <= 100; ++seed) {
            const Scene scene = analyse(variedScene(seed)).scene;
            std::size_t count = 0;
            for (const Body& body : scene.bodies) {
                ++ofShape[body.shape.index()];
                count += !isWall(body.shape);
                fixed += body.fixed;
            }
            fewest = std::min(fewest, count);
            most = std::max(most, count);
            springs += scene.springs.size();
        }
        for (const std::size_t number : ofShape) QVERIFY(number >= 100);
        QVERIFY(springs > 0 && fixed > 0);
        QVERIFY2(fewest == 1 && most > 400 && most <= 500, qPrintable(QString::number(most)));
    }

    // Those with springs are the hard ones: nothing but the energy of these bounds what bodies may have.
    void noSceneGainsEnergy_data() {
        QTest::addColumn<QByteArray>("preset");
        for (const char* preset : {"fast", "default"}) QTest::newRow(preset) << QByteArray(preset);
    }
    void noSceneGainsEnergy() {
        QFETCH(QByteArray, preset);
        SimulationSettings options;
        options.method = "contacts";
        options.preset = preset.toStdString();
        int springs = 0;
        for (std::uint64_t seed = 1; seed <= 140; ++seed) {
            World world(build(variedScene(seed, 150), options).pipeline);
            springs += !world.pipeline().bodies().springs.empty();
            EnergyGuard guard(world.pipeline(), world.statistics());
            for (int frame = 0; frame < 16; ++frame) {
                world.step();
                const QByteArray seedAndFrame =
                    "seed " + QByteArray::number(qulonglong(seed)) + " frame " + QByteArray::number(frame);
                QVERIFY2(world.health().finite, seedAndFrame);
                const std::optional<EnergyRise> rise = guard.look(world.statistics());
                QVERIFY2(!rise,
                         seedAndFrame + (rise ? " " + QByteArray::fromStdString(describe(*rise)) : ""));
            }
        }
        QVERIFY2(springs >= 24, QByteArray::number(springs));
    }
};

CAROM_TEST(varied_scene_test, VariedSceneTest)
#include "varied_scene_test.moc"
