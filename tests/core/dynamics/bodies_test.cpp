// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"

#include "core/dynamics/energy.h"

#include <QTest>

#include <cmath>
#include <limits>

namespace carom {
namespace {

using test::cuboid;
using test::cylinder;
using test::sceneOf;
using test::sphere;
using test::wall;

/// Sums of a handful of terms: a few roundings.
constexpr double rounding = 1e-15;

bool near(double a, double b) { return std::abs(a - b) <= rounding * std::max(std::abs(a), std::abs(b)); }

} // namespace

class BodiesTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void immobileBodiesHaveNeitherMassNorInertiaNorVelocity() {
        Body fixed = sphere(1, 5, Vec3::Zero(), Vec3(1, 2, 3));
        fixed.fixed = true;
        fixed.angularVelocity = Vec3(1, 0, 0);
        const Scene scene = sceneOf({wall(Vec3::UnitY(), 0), fixed, sphere(1, 4, Vec3(5, 5, 5))});
        const Bodies bodies = bodiesOf(scene);
        for (const BodyIndex i : {0U, 1U}) {
            QCOMPARE(bodies.mass[i], 0.0);
            QCOMPARE(bodies.inverseMass[i], 0.0);
            QCOMPARE(bodies.inverseInertia[i], Vec3(Vec3::Zero()));
            QVERIFY(!bodies.mobile[i]);
        }
        QCOMPARE(bodies.inverseMass[2], 0.25);
        QCOMPARE(initialStateOf(scene).velocity[1], Vec3(Vec3::Zero()));
        QCOMPARE(initialStateOf(scene).angularVelocity[1], Vec3(Vec3::Zero()));
        QCOMPARE(bodies.walls, std::vector<BodyIndex>{0});
        QCOMPARE(bodies.bounded, (std::vector<BodyIndex>{1, 2}));
        QCOMPARE(bodies.mobileBodies, std::vector<BodyIndex>{2});
    }

    void onlyWhatSpinsOrCanBeHitOffItsCentreRotates() {
        Body spinning = sphere(1, 1, Vec3(9, 0, 0));
        spinning.angularVelocity = Vec3(0, 1, 0);
        const Scene scene = sceneOf({sphere(1, 1, Vec3::Zero()), cylinder(1, 1, 1, Vec3(3, 0, 0)),
                                     cuboid(Vec3(1, 1, 1), 1, Vec3(6, 0, 0)), spinning});
        QCOMPARE(bodiesOf(scene).rotating, (std::vector<BodyIndex>{1, 2, 3}));
        QVERIFY(bodiesOf(sceneOf({cylinder(1, 1, 1, Vec3::Zero())})).rotating.empty());
    }

    void whatCanTurnWithUnequalMomentsPrecesses() {
        const Body apart = sphere(1, 1, Vec3(9, 0, 0));
        const auto precesses = [&](const Body& body) {
            return anyPrecesses(bodiesOf(sceneOf({body, apart})));
        };
        QVERIFY(precesses(cuboid(Vec3(1, 1, 2), 1, Vec3::Zero())));
        QVERIFY(!precesses(cuboid(Vec3(2, 2, 2), 1, Vec3::Zero())));
        QVERIFY(precesses(cylinder(1, 1.7, 1, Vec3::Zero())));
        QVERIFY(!precesses(cylinder(1, std::sqrt(3.0), 1, Vec3::Zero())));     // but for rounding
        const Scene alone = sceneOf({cuboid(Vec3(1, 1, 2), 1, Vec3::Zero())}); // nothing can turn it
        QVERIFY(!anyPrecesses(bodiesOf(alone)) && !anyCanMeet(bodiesOf(alone)));
        QVERIFY(anyCanMeet(bodiesOf(sceneOf({apart, wall(Vec3::UnitY(), 0)}))));
        Body fixed = apart;
        fixed.fixed = true;
        QVERIFY(!anyCanMeet(bodiesOf(sceneOf({fixed, wall(Vec3::UnitY(), 0)}))));
    }

    void kineticEnergyCountsRotationAboutEachPrincipalAxis() {
        Body body = cylinder(0.5, 2, 3, Vec3(0, 7, 0));
        body.velocity = Vec3(1, 2, 2);
        body.angularVelocity = Vec3(0, 4, 0); // about its own axis: I = m r²/2
        const Scene scene = sceneOf({body});
        const Invariants along = invariantsOf(bodiesOf(scene), initialStateOf(scene), Vec3(0, -10, 0));
        QVERIFY(near(along.kinetic, 0.5 * 3 * 9 + 0.5 * (3 * 0.25 / 2) * 16));
        QVERIFY(near(along.potential, 3 * 10 * 7));
        QCOMPARE(along.momentum, Vec3(3, 6, 6));
        const MotionTotals totals = motionTotalsOf(bodiesOf(scene), initialStateOf(scene));
        QVERIFY(totals.kinetic == along.kinetic && totals.momentum == along.momentum);

        // Laid along x by a quarter turn about z, the same spin is across the axis: I = m (3 r² + h²)/12.
        body.pose.orientation = Quat(std::sqrt(0.5), 0, 0, std::sqrt(0.5));
        const Scene laid = sceneOf({body});
        const Invariants across = invariantsOf(bodiesOf(laid), initialStateOf(laid), Vec3::Zero());
        QVERIFY(near(across.kinetic, 0.5 * 3 * 9 + 0.5 * (3 * (3 * 0.25 + 4) / 12) * 16));
    }

    void angularMomentumIsOrbitalAndOwn() {
        Body body = sphere(0.5, 2, Vec3(1, 0, 0), Vec3(0, 3, 0));
        body.angularVelocity = Vec3(0, 0, 5);
        const Scene scene = sceneOf({body});
        const Vec3 momentum = angularMomentumOf(bodiesOf(scene), initialStateOf(scene));
        QVERIFY(near(momentum.z(), 1 * 2 * 3 + 0.4 * 2 * 0.25 * 5));
    }

    void aLossNamesTheBodyAndTheQuantity_data() {
        QTest::addColumn<QString>("quantity");
        for (const char* name : {"position", "velocity", "orientation", "angular velocity"})
            QTest::newRow(name) << QString::fromLatin1(name);
    }
    void aLossNamesTheBodyAndTheQuantity() {
        QFETCH(QString, quantity);
        const Scene scene =
            sceneOf({wall(Vec3::UnitY(), 0), sphere(1, 1, Vec3(0, 5, 0)), cylinder(1, 1, 1, Vec3(9, 5, 0))});
        const Bodies bodies = bodiesOf(scene);
        for (const double bad :
             {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
              std::numeric_limits<double>::quiet_NaN()}) {
            State state = initialStateOf(scene);
            QVERIFY(!findLoss(bodies, state));
            if (quantity == QLatin1String("position")) state.pose[2].position.y() = bad;
            if (quantity == QLatin1String("velocity")) state.velocity[2].z() = bad;
            if (quantity == QLatin1String("orientation")) state.pose[2].orientation.w() = bad;
            if (quantity == QLatin1String("angular velocity")) state.angularVelocity[2].x() = bad;
            const Loss loss = findLoss(bodies, state);
            QCOMPARE(loss.body, 2U);
            QCOMPARE(QString::fromUtf8(loss.quantity.data(), qsizetype(loss.quantity.size())), quantity);
        }
    }

    void theLargestFiniteNumbersAreNoLoss() {
        Body body = sphere(1, 1, Vec3::Constant(std::numeric_limits<double>::max()));
        body.velocity = -body.pose.position;
        const Scene scene = sceneOf({body});
        QVERIFY(!findLoss(bodiesOf(scene), initialStateOf(scene)));
    }
};

} // namespace carom

CAROM_TEST(bodies_test, carom::BodiesTest)
#include "bodies_test.moc"
