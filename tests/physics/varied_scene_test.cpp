// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/varied_scene.h"

#include "core/simulation/build.h"
#include "core/simulation/touching.h"

#include <QTest>

#include <algorithm>
#include <array>
#include <variant>

using namespace carom;
using test::variedScene;

// The scenes that other tests draw at random are what they say they are.

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
};

CAROM_TEST(varied_scene_test, VariedSceneTest)
#include "varied_scene_test.moc"
