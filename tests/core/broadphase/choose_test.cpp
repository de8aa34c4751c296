// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/broadphase/moving_boxes.h"
#include "tests/support/test_class.h"

#include <QTest>

namespace carom {
namespace {

MovingBoxes cloud(int count, double side, double largest, int immobileEvery = 0) {
    Random random(9);
    MovingBoxes scene;
    for (int i = 0; i < count; ++i) {
        const Vec3 centre = uniformIn(random, 0.5 * side);
        const Vec3 half = Vec3::Constant(random.uniform(0.1, largest));
        scene.add({centre - half, centre + half}, immobileEvery == 0 || i % immobileEvery == 0);
    }
    return scene;
}

void verifyChoice(const MovingBoxes& scene, const char* name, const char* because) {
    const BroadphaseChoice choice = chooseBroadphase(scene.input());
    QVERIFY(choice.row != nullptr);
    QCOMPARE(choice.row->name, name);
    QVERIFY2(choice.reason.text().starts_with(std::string(name) + ": "), choice.reason.text().c_str());
    QVERIFY2(choice.reason.text().find(because) != std::string::npos, choice.reason.text().c_str());
}

} // namespace

class ChooseTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void fewBodiesAreComparedPairByPair() {
        verifyChoice(cloud(0, 10, 0.2), "all_pairs", "0 bodies");
        verifyChoice(cloud(1, 10, 0.2), "all_pairs", "1 body,");
        verifyChoice(cloud(30, 10, 0.2), "all_pairs", "30 bodies, too few");
    }
    void aLargeThinGasGetsTheGrid() { verifyChoice(cloud(3000, 10, 0.11), "uniform_grid", "similar size"); }
    void aSmallThinGasGetsTheSweep() { verifyChoice(cloud(500, 8, 0.11), "single_axis_sweep", "well apart"); }
    void bodiesLyingCloseGetTheTree() { verifyChoice(cloud(3000, 3, 0.11), "bounding_tree", "lying close"); }
    void bodiesOfManySizesGetTheTree() {
        verifyChoice(cloud(500, 90, 2), "bounding_tree", "times the narrow");
    }
    void mostlyFixedBodiesGetTheTree() {
        verifyChoice(cloud(500, 20, 0.11, 4), "bounding_tree", "only 125 can move");
    }
};

} // namespace carom

CAROM_TEST(choose_test, carom::ChooseTest)
#include "choose_test.moc"
