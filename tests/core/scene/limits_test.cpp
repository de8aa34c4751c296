// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/scene/limits.h"

#include <QObject>
#include <QTest>

#include <string>

namespace {

using carom::Body;
using carom::limitFaultOf;
using carom::Vec3;

Body ball(double radius, double mass) {
    Body body;
    body.shape = carom::Sphere{radius};
    body.mass = mass;
    return body;
}

std::string blamed(const Body& body) {
    const std::optional<carom::LimitFault> fault = limitFaultOf(body);
    return fault ? std::string(fault->parameter) : "nothing";
}

class LimitsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void fromAtomsToGalaxiesNothingIsBlamed() {
        QCOMPARE(blamed(ball(1e-10, 1e-27)), std::string("nothing"));
        QCOMPARE(blamed(ball(1e21, 1e42)), std::string("nothing"));
    }

    void aSizeThatCannotBeSquaredIsBlamed() {
        QCOMPARE(blamed(ball(1e155, 1)), std::string("radius"));
        QCOMPARE(blamed(ball(1e-155, 1)), std::string("radius"));
        Body block;
        block.shape = carom::Cuboid{Vec3(1, 1, 1e200)};
        block.mass = 1;
        QCOMPARE(blamed(block), std::string("size"));
    }

    void anInertiaBeyondDoublesIsBlamedOnTheMass() {
        QCOMPARE(blamed(ball(1e100, 1e150)), std::string("mass"));
        QCOMPARE(blamed(ball(1e-100, 1e-150)), std::string("mass"));
        QCOMPARE(blamed(ball(1, 1e-309)), std::string("mass"));
    }

    void aMotionOrAPlaceBeyondDoublesIsBlamed() {
        Body body = ball(1, 1);
        body.velocity = Vec3(1e160, 0, 0);
        QCOMPARE(blamed(body), std::string("vel"));
        body = ball(1, 1);
        body.angularVelocity = Vec3(0, 1e160, 0);
        QCOMPARE(blamed(body), std::string("angvel"));
        body = ball(1, 1);
        body.pose.position = Vec3(0, 0, 1e160);
        QCOMPARE(blamed(body), std::string("centre"));
    }

    void whatIsFixedWithoutAMassNeedsNoInertia() {
        Body body = ball(1, 0);
        body.fixed = true;
        QCOMPARE(blamed(body), std::string("nothing"));
        body.shape = carom::Wall{};
        QCOMPARE(blamed(body), std::string("nothing"));
    }
};

} // namespace

CAROM_TEST(limits_test, LimitsTest)
#include "limits_test.moc"
