// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/solvers/contacts/two_bodies.h"
#include "tests/support/test_class.h"

#include "core/solvers/contacts/manifold_following.h"

#include <QTest>

#include <cmath>
#include <cstddef>
#include <numbers>

// Kept contacts of cylinders and cuboids: the normal turns with what it is across, and what rolls stands on
// the line below its axis.

namespace carom {
namespace {

using test::cuboid;
using test::cylinder;
using test::fixedOne;
using test::roundingOfPlaces;
using test::turnedBy;
using test::Two;

} // namespace

class ManifoldFollowingTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // A cylinder that lies on another body and rolls by less than what is found anew: its contact stays
    // straight below the axis, or the force at what it has left behind would push it on.
    void whatRollsStandsOnTheLineBelowItsAxis() {
        const double radius = 0.4, angle = 0.004;
        for (const bool isFirst : {false, true}) {
            const Body block = fixedOne(cuboid({4, 1, 4}, 1, {0, -0.5, 0}));
            const Body log =
                turnedBy(cylinder(radius, 1, 1, {0, radius - 1e-5, 0}), {0, 0, std::numbers::pi / 2});
            Two two(isFirst ? log : block, isFirst ? block : log);
            const BodyIndex roller = isFirst ? 0 : 1;
            QVERIFY(two.update());
            QCOMPARE(two.manifold.count, 2);
            two.moveBy(roller, {0, 0, radius * angle}, {angle, 0, 0});
            QVERIFY(!two.update());
            const PlacedManifold now = two.here();
            for (std::size_t k = 0; k < 2; ++k) {
                const Vec3& arm = isFirst ? now.points[k].armA : now.points[k].armB;
                const Vec3 place = two.state.pose[roller].position + arm;
                QVERIFY(std::abs(place.z() - radius * angle) < roundingOfPlaces);
                QVERIFY(std::abs(std::abs(place.x()) - 0.5) < roundingOfPlaces);
                QVERIFY(std::abs(now.points[k].separation + 1e-5) < roundingOfPlaces);
            }
        }
    }

    void normalTurnsWithTheFaceThatItIsAcross() {
        for (const BodyIndex turner : {0U, 1U}) { // a small cube lies on a large one
            Two two(cuboid({4, 1, 4}, 1, {0, -0.5, 0}), cuboid({1, 1, 1}, 1, {0.3, 0.5, 0.2}));
            QVERIFY(two.update());
            // Faces of both are across the normal; that of A is taken.
            two.moveBy(turner, Vec3::Zero(), {0.002, 0, 0.003});
            QVERIFY(!two.update());
            const Vec3 face = two.state.pose[0].directionToWorld(Vec3::UnitY());
            QVERIFY((two.here().normal - face).norm() < roundingOfPlaces);
        }
        // A corner of A below a face of B.
        Two two(turnedBy(cuboid({1, 1, 1}, 1, {0.1, -0.86, 0.2}), {0.7, 0.2, 0.6}),
                cuboid({4, 1, 4}, 1, {0, 0.5, 0}));
        QVERIFY(two.update());
        QCOMPARE(static_cast<int>(two.manifold.source.kind), static_cast<int>(DirectionSource::Kind::FaceB));
        two.moveBy(1, Vec3::Zero(), {0.002, 0, 0.003});
        QVERIFY(!two.update());
        QVERIFY((two.here().normal - two.state.pose[1].directionToWorld(Vec3::UnitY())).norm() <
                roundingOfPlaces);
    }

    void normalOfCrossedCylindersDoesNotTurnWithOneThatRolls() {
        Two two(turnedBy(cylinder(0.4, 2, 1, {0, 0, 0}), {0, 0, std::numbers::pi / 2}),
                turnedBy(cylinder(0.3, 2, 1, {0.1, 0.699, 0.05}), {std::numbers::pi / 2, 0, 0}));
        QVERIFY(two.update());
        QCOMPARE(static_cast<int>(two.manifold.source.kind), static_cast<int>(DirectionSource::Kind::Edges));
        two.moveBy(0, Vec3::Zero(), {0.004, 0, 0}); // about its own axis
        QVERIFY(!two.update());
        const PlacedManifold now = two.here();
        QVERIFY((now.normal - Vec3::UnitY()).norm() < roundingOfPlaces);
        QVERIFY(std::abs(now.points[0].separation + 0.001) < roundingOfPlaces);
        QVERIFY((now.points[0].armA - Vec3(0.1, 0.3995, 0.0)).norm() < roundingOfPlaces + 0.05);
        QVERIFY(std::abs(now.points[0].armA.z() - 0.0) < 0.05);
    }

    // Two that lie side by side: what is across both axes turns by many degrees when these turn by next to
    // nothing, and is no normal then.
    void normalOfNearlyParallelCylindersStays() {
        for (const double angle : {1e-8, 1e-6, 1e-4, 1e-3, 5e-3}) {
            Two two(cylinder(0.2, 2, 1, {0, 0, 0}),
                    turnedBy(cylinder(0.2, 2, 1, {0.4 - 1e-6, 0, 0}), {angle, 0, 0}));
            QVERIFY(two.update());
            QVERIFY((two.here().normal - Vec3::UnitX()).norm() < roundingOfPlaces);
            for (const double turn : {0.2, -0.4}) {
                two.moveBy(1, Vec3::Zero(), {0, 0, turn * angle});
                two.update();
                const PlacedManifold now = two.here();
                QVERIFY2((now.normal - Vec3::UnitX()).norm() < 4 * angle, qPrintable(QString::number(angle)));
                for (int k = 0; k < now.count; ++k) // no deeper than what tilts into the other
                    QVERIFY(now.points[static_cast<std::size_t>(k)].separation > -2e-6 - angle);
            }
        }
    }
};

} // namespace carom

CAROM_TEST(manifold_following_test, carom::ManifoldFollowingTest)
#include "manifold_following_test.moc"
