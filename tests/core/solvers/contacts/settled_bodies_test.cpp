// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/contact_scenes.h"
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include "core/solvers/contacts/settled_bodies.h"

#include <QTest>

#include <algorithm>
#include <vector>

// Bodies that are passed over in a substep because nothing of them changes: when they are, and that what
// happens does not depend on it.

namespace carom {
namespace {

using List = std::vector<BodyIndex>;

/// Lists the members that are active, of which `still` stand still, and lets those settle that may.
List settleIn(SettledBodies& bodies, const List& members, const List& still, bool may = true) {
    List active;
    bodies.list(members, active);
    for (const BodyIndex i : still) bodies.begin(i);
    bodies.settle(active, [may](BodyIndex) { return may; });
    return active;
}

/// A wall of bricks on a rough floor, and balls that strike it one after another from different sides.
Scene struckWall() {
    constexpr double length = 0.2, height = 0.08; // of a brick [m]
    Scene scene = test::sceneOf({test::floorOf(0.7, 0.1)}, test::downwards());
    for (int row = 0; row < 6; ++row)
        for (int k = 0; k < 7; ++k) {
            const Vec3 place((k + 0.5 * (row % 2)) * length, (row + 0.5) * height, 0);
            scene.bodies.push_back(test::rough(test::cuboid({length, height, 0.1}, 3, place), 0.7, 0.1));
        }
    const auto shoot = [&scene](const Vec3& centre, const Vec3& velocity) {
        Body ball = test::sphere(0.1, 8, centre, velocity);
        scene.bodies.push_back(test::rough(ball, 0.5, 0.1));
    };
    shoot({0.7, 0.4, 2}, {0, 0, -5});
    shoot({0.2, 0.1, -4}, {0, 0, 3});
    shoot({3.5, 0.1, 0}, {-2, 0, 0});
    return scene;
}

} // namespace

class SettledBodiesTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void whatStandsStillSettlesWhereItMay() {
        SettledBodies bodies(6);
        QCOMPARE(settleIn(bodies, {1, 2, 3, 5}, {2, 5}, false), (List{1, 2, 3, 5}));
        QCOMPARE(settleIn(bodies, {1, 2, 3, 5}, {2, 5}), (List{1, 3}));
        QVERIFY(bodies.has(2) && bodies.has(5) && !bodies.has(1) && !bodies.has(3) && !bodies.has(4));
        QCOMPARE(settleIn(bodies, {1, 2, 3, 5}, {}), (List{1, 3})); // and stays so
    }

    void whatIsWokenIsActive() {
        SettledBodies bodies(6);
        List active = settleIn(bodies, {1, 2, 3, 4, 5}, {1, 2, 4, 5});
        QCOMPARE(active, List{3});
        for (const BodyIndex i : {4u, 1u, 3u}) bodies.wake(i);
        bodies.wake(4); // again
        bodies.addWoken(active);
        QCOMPARE(active, (List{1, 3, 4}));
        bodies.addWoken(active); // they are added once
        QCOMPARE(active, (List{1, 3, 4}));
        bodies.settle(active, [](BodyIndex) { return true; }); // not before a frame has begun
        QCOMPARE(active, (List{1, 3, 4}));
        bodies.wakeAll();
        bodies.list(List{1, 2, 3, 4, 5}, active);
        QCOMPARE(active, (List{1, 2, 3, 4, 5}));
    }

    void whatIsWokenAfterItBeganDoesNotSettle() {
        SettledBodies bodies(3);
        List active;
        bodies.list(List{0, 1, 2}, active);
        for (const BodyIndex i : active) bodies.begin(i);
        bodies.wake(1);
        bodies.settle(active, [](BodyIndex) { return true; });
        QCOMPARE(active, List{1});
    }

    // A world that is taken up anew in each frame looks at all of its bodies again. What air acts on does not
    // settle, even where it stands still.
    void whatHappensDoesNotDependOnIt_data() {
        QTest::addColumn<QByteArray>("preset");
        QTest::addColumn<bool>("hasAir");
        for (const char* preset : {"fast", "default"})
            for (const bool hasAir : {false, true})
                QTest::addRow("%s%s", preset, hasAir ? ", in air" : "") << QByteArray(preset) << hasAir;
    }
    void whatHappensDoesNotDependOnIt() {
        QFETCH(QByteArray, preset);
        QFETCH(bool, hasAir);
        Scene scene = struckWall();
        if (hasAir) {
            scene.declare("air").values.set("density", 1.2);
            for (Body& body : scene.bodies)
                if (body.mobile()) body.values.set("drag", 1);
        }
        World straight = test::worldOf(scene, test::contacts(preset.constData()));
        World anew = test::worldOf(scene, test::contacts(preset.constData()));
        std::size_t mostAtRest = 0; // among others that move
        for (int frame = 1; frame <= 200; ++frame) {
            straight.step();
            mostAtRest = std::max(mostAtRest, straight.statistics().resting);
            anew.restore(anew.checkpoint());
            anew.step();
            QVERIFY2(straight.stateHash() == anew.stateHash(),
                     qPrintable(QStringLiteral("frame %1").arg(frame)));
        }
        QVERIFY2(mostAtRest > 20, qPrintable(QString::number(mostAtRest)));
    }
};

} // namespace carom

CAROM_TEST(settled_bodies_test, carom::SettledBodiesTest)
#include "settled_bodies_test.moc"
