// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/scene/scene.h"

#include <QObject>
#include <QTest>

#include <cmath>
#include <string>

namespace {

using carom::pairFriction;
using carom::pairRestitution;
using carom::pairRolling;
using carom::Scene;
using carom::SimulationSettings;

class SceneTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aPairHasTheSmallerRestitutionTheMeanFrictionAndTheLargerRolling() {
        QCOMPARE(pairRestitution(0.5, 0.9), 0.5);
        QCOMPARE(pairFriction(0.4, 0.9), 0.6);
        QCOMPARE(pairRolling(0.001, 0.002), 0.002);
        QCOMPARE(pairFriction(0.4, 0.9), pairFriction(0.9, 0.4));
    }

    void theMeanFrictionOfHugeCoefficientsIsFinite() {
        QVERIFY(std::abs(pairFriction(1e300, 1e300) / 1e300 - 1) < 1e-15);
    }

    void bodiesAreNamedByTheirLabelOrKindAndIndex() {
        Scene scene;
        scene.bodies.resize(2);
        scene.bodies[0].label = "cue";
        scene.bodies[1].shape = carom::Wall{};
        QCOMPARE(scene.nameOf(0), std::string("`cue`"));
        QCOMPARE(scene.nameOf(1), std::string("wall 1"));
        QCOMPARE(scene.nameOf(carom::noBody), std::string("the world"));
        QCOMPARE(scene.labelled("cue"), carom::BodyIndex{0});
        QCOMPARE(scene.labelled("ball"), carom::noBody);
        QCOMPARE(scene.labelled(""), carom::noBody);
    }

    void whatIsGivenWinsOverWhatIsNot() {
        SimulationSettings base, over;
        base.step = 0.1;
        base.method = "contacts";
        over.step = 0.2;
        over.threads = 3;
        const SimulationSettings both = overridden(base, over);
        QCOMPARE(*both.step, 0.2);
        QCOMPARE(*both.method, std::string("contacts"));
        QCOMPARE(*both.threads, 3);
        QVERIFY(!both.duration);
    }
};

} // namespace

CAROM_TEST(scene_test, SceneTest)
#include "scene_test.moc"
