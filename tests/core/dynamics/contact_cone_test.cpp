// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/dynamics/contact_constraint.h"
#include "core/simulation/build.h"
#include "core/simulation/world.h"

#include <QTest>

#include <cmath>

// Coulomb's cone: what is outside, and that what the method of contacts computes never is.

namespace carom {
namespace {

constexpr double rounding = 1e-12; // of a force, some thousand operations

ContactSet contactWith(double friction, const Vec3& force) {
    ContactSet set;
    ContactConstraint point;
    point.force = force;
    set.append({.a = 0, .b = 1, .friction = friction}, std::span(&point, 1));
    return set;
}

} // namespace

class ContactConeTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void forcesInsideTheConeDoNotViolateIt() {
        QCOMPARE(coneViolationOf({}), 0.0);
        QCOMPARE(coneViolationOf(contactWith(0.5, {2, 0.6, 0.8})), 0.0); // on its edge
        QCOMPARE(coneViolationOf(contactWith(0.5, {2, 0.1, 0})), 0.0);
        QCOMPARE(coneViolationOf(contactWith(0.5, Vec3::Zero())), 0.0);
    }

    void whatIsOutsideIsToldRelativeToTheForce() {
        const double size = std::sqrt(2 * 2 + 3 * 3);
        QVERIFY(std::abs(coneViolationOf(contactWith(0.5, {2, 3, 0})) - (3 - 0.5 * 2) / size) < rounding);
        QCOMPARE(coneViolationOf(contactWith(1, {-2, 0, 0})), 1.0); // it pulls
        QCOMPARE(coneViolationOf(contactWith(0, {0, 0, 5})), 1.0);
    }

    void aCubeThatSlidesAndComesToRestStaysInside() {
        const Build built =
            build("wall { normal 0, 1, 0 toOrig 0 friction .5 elastic 0 }\n"
                  "cuboid { size 1, 1, 1 mass 1 centre 0, .5, 0 vel 2, 0, 1 friction .5 elastic 0 }");
        World world(built.pipeline);
        double worst = 0, residual = 0;
        for (int frame = 0; frame < 120; ++frame) {
            world.step();
            worst = std::max(worst, world.statistics().coneViolation);
            residual = std::max(residual, world.statistics().residual);
        }
        QVERIFY2(worst < rounding, qPrintable(QString::number(worst)));
        QVERIFY(residual > 0); // there was something to solve
        QVERIFY(world.state().velocity[1].norm() < 1e-6);
    }
};

} // namespace carom

CAROM_TEST(contact_cone_test, carom::ContactConeTest)
#include "contact_cone_test.moc"
