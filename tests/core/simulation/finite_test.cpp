// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include <QTest>

#include <cmath>

// Finite or stopped: every method looks for lost numbers twice a substep, where forces or smooth motion have
// given velocities and at its end. Each row loses its numbers in one of the two places, and what is said of
// it could not be said by the other: before forces are acted upon nothing has moved.

namespace carom {
namespace {

using namespace test;

struct Lost {
    Scene scene;
    const char* method = "contacts";
    BodyIndex body = 1;
    const char* quantity = "position";
    double step = 1;           // [s]
    int frame = 1;             // in which it is found
    bool isUnmoved = false;    // found before anything moves
    bool isUnsearched = false; // found before any pair is looked for
};

constexpr double huge = 1.5e308; // twice it is no number

Scene onFloor(const Body& body, const Vec3& gravity) {
    return sceneOf({wall(Vec3::UnitY(), 0), body}, gravity);
}

/// A body that the floor is out of reach of.
Body inMotion(Body body) {
    body.pose.position.y() = 50;
    return body;
}

Body spinning(Body body, const Vec3& angularVelocity) {
    body.angularVelocity = angularVelocity;
    return body;
}

Lost lostIn(const QString& place) {
    const Body ball = sphere(1, 1, Vec3(0, 50, 0), Vec3(huge, 0, 0));
    const Body box = cuboid(Vec3(1, 2, 3), 1, Vec3(0, 1, 0));
    if (place == QLatin1String("microcollisions, motion"))
        return {.scene = onFloor(ball, Vec3::Zero()),
                .method = "microcollisions",
                .frame = 2,
                .isUnsearched = true};
    if (place == QLatin1String("microcollisions, impact"))
        return {.scene = sceneOf({sphere(1, 1e-300, Vec3(-0.9, 0, 0), Vec3(huge, 0, 0)),
                                  sphere(1, 1e300, Vec3(0.9, 0, 0), Vec3(-huge, 0, 0))}),
                .method = "microcollisions",
                .body = 0,
                .quantity = "velocity",
                .step = 1e-320};
    if (place == QLatin1String("contacts, forces"))
        return {
            .scene = onFloor(box, Vec3(0, -huge, 0)), .quantity = "velocity", .step = 10, .isUnmoved = true};
    if (place == QLatin1String("contacts, motion")) return {.scene = onFloor(ball, Vec3::Zero()), .frame = 2};
    return {.scene = onFloor(inMotion(spinning(box, Vec3(huge, huge, 0))), Vec3::Zero()),
            .quantity = "orientation"};
    return {.scene = onFloor(inMotion(spinning(box, Vec3(huge, huge, 0))), Vec3::Zero()),
            .quantity = "orientation"};
}

} // namespace

class FiniteTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aLossIsFoundWhereItHappens_data() {
        QTest::addColumn<QString>("place");
        for (const char* place : {"microcollisions, motion", "microcollisions, impact", "contacts, forces",
                                  "contacts, motion", "contacts, turning"})
            QTest::newRow(place) << QString::fromLatin1(place);
    }
    void aLossIsFoundWhereItHappens() {
        QFETCH(QString, place);
        const Lost lost = lostIn(place);
        SimulationSettings options = byMethod(lost.method);
        options.step = lost.step;
        World world = worldOf(lost.scene, options);
        for (int frame = 1; frame < lost.frame; ++frame) {
            world.step();
            QVERIFY(world.health().finite);
        }
        const Vec3 before = world.state().pose[lost.body].position;
        world.step();
        const Health& health = world.health();
        QVERIFY(!health.finite);
        QCOMPARE(health.body, lost.body);
        QCOMPARE(health.frame, lost.frame);
        QCOMPARE(QByteArray(health.quantity.data(), qsizetype(health.quantity.size())),
                 QByteArray(lost.quantity));
        if (lost.isUnsearched) QCOMPARE(world.statistics().broadphase, 0.0); // not a nanosecond
        if (lost.isUnmoved) QCOMPARE(world.state().pose[lost.body].position, before);
    }
};

} // namespace carom

CAROM_TEST(finite_test, carom::FiniteTest)
#include "finite_test.moc"
