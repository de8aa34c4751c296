// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/simulation/build.h"
#include "core/simulation/world.h"
#include "core/study/cases/scene_text.h"

#include <QTest>

#include <string>

// Bodies that share their places when a run begins: their state stays finite at any number of substeps.

namespace carom {
namespace {

/// So many bodies, each `apart` metres from the one before. `kind` is a shape, or 3: all in turn.
std::string crowdedScene(int kind, int count, double apart, double elastic, int substeps) {
    std::string scene = text("simulation { method contacts  substeps ", substeps, " }\n");
    for (int n = 0; n < count; ++n) {
        const std::string further =
            text("  mass 1  centre ", Vec3(apart * n, 1, 0), "  friction 0.3  elastic ", elastic, " }\n");
        switch (kind == 3 ? n % 3 : kind) {
        case 0:
            scene += "sphere { radius 0.1" + further;
            break;
        case 1:
            scene += "cuboid { size 0.2, 0.2, 0.2" + further;
            break;
        default:
            scene += "cylinder { radius 0.1  height 0.2  axis 0, 1, 0" + further;
            break;
        }
    }
    return scene;
}

} // namespace

class OverlapsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void theStateStaysFinite_data() {
        QTest::addColumn<int>("kind");
        QTest::addColumn<int>("count");
        QTest::addColumn<double>("apart"); // [m]
        QTest::newRow("spheres at one place") << 0 << 40 << 0.0;
        QTest::newRow("cuboids at one place") << 1 << 12 << 0.0;
        QTest::newRow("cylinders at one place") << 2 << 12 << 0.0;
        QTest::newRow("all shapes at one place") << 3 << 12 << 0.0;
        QTest::newRow("spheres a millimetre apart") << 0 << 100 << 1e-3;
        QTest::newRow("all shapes a millimetre apart") << 3 << 12 << 1e-3;
    }
    void theStateStaysFinite() {
        QFETCH(int, kind);
        QFETCH(int, count);
        QFETCH(double, apart);
        for (const double elastic : {0.0, 1.0})
            for (const int substeps : {1, 2, 4, 8}) {
                const Build scene = build(crowdedScene(kind, count, apart, elastic, substeps));
                QVERIFY(scene.pipeline != nullptr);
                World world(scene.pipeline);
                for (int frame = 0; frame < 10 && world.health().finite; ++frame) stepWorld(world);
                QVERIFY2(world.health().finite, qPrintable(QStringLiteral("elastic %1, %2 substeps: frame %3")
                                                               .arg(elastic)
                                                               .arg(substeps)
                                                               .arg(world.state().frame)));
            }
    }
};

} // namespace carom

CAROM_TEST(overlaps_test, carom::OverlapsTest)
#include "overlaps_test.moc"
