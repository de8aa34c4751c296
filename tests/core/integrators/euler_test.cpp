// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"

#include "core/integrators/integrator.h"

#include <QTest>

#include <cmath>

namespace carom {
namespace {

using test::cylinder;
using test::sceneOf;
using test::sphere;

const SmoothMotion& euler() { return findIntegrator("euler")->motion; }

} // namespace

class EulerTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everyIntegratorSaysWhatItIs() {
        for (const IntegratorRow& row : integrators()) {
            QVERIFY(!row.name.empty() && !row.title.empty() && !row.help.empty() && !row.source.empty());
            QVERIFY(row.order >= 1 && row.motion.move != nullptr && row.motion.turn != nullptr);
            QCOMPARE(findIntegrator(row.name), &row);
        }
        QCOMPARE(findIntegrator("no such"), nullptr);
    }

    void aStepMovesByTheVelocityFromBeforeIt() {
        State state = initialStateOf(sceneOf({sphere(1, 1, Vec3(1, 2, 3), Vec3(4, 5, 6))}));
        const BodyIndex body = 0;
        euler().move({&body, 1}, Vec3(0, -8, 0), 0.5, state);
        QCOMPARE(state.pose[0].position, Vec3(3, 4.5, 6));
        QCOMPARE(state.velocity[0], Vec3(4, 1, 6));
    }

    void aStepTurnsByTwiceTheArcTangentOfHalfTheAngle() {
        constexpr double tight = 1e-14; // a hundred steps of rounding, each below 2e-16
        Body body = cylinder(1, 1, 1, Vec3::Zero());
        body.angularVelocity = Vec3(2, -1, 2); // |ω| = 3
        State state = initialStateOf(sceneOf({body}));
        const BodyIndex index = 0;
        const int steps = 100;
        const double h = 0.01;
        for (int i = 0; i < steps; ++i) euler().turn({&index, 1}, h, state);
        const double angle = steps * 2 * std::atan(h * 3 / 2);
        const Vec3 axis = Vec3(2, -1, 2) / 3;
        const Quat& q = state.pose[0].orientation;
        QVERIFY(std::abs(q.w() - std::cos(angle / 2)) < tight);
        QVERIFY((q.vec() - std::sin(angle / 2) * axis).norm() < tight);
        QVERIFY(std::abs(q.norm() - 1) < tight);
        QCOMPARE(state.angularVelocity[0], Vec3(2, -1, 2));
    }

    void angularVelocityIsInWorldCoordinates() {
        Body body = cylinder(1, 1, 1, Vec3::Zero());
        body.pose.orientation = Quat(std::sqrt(0.5), 0, 0, std::sqrt(0.5)); // its axis along −x
        body.angularVelocity = Vec3(0, 1, 0);
        State state = initialStateOf(sceneOf({body}));
        const BodyIndex index = 0;
        euler().turn({&index, 1}, 0.1, state);
        // Turned about the world's y axis, the cylinder's axis stays in the plane y = 0.
        QVERIFY(std::abs(axisOf(state.pose[0]).y()) < 1e-15);
        QVERIFY(axisOf(state.pose[0]).z() > 0.09);
    }

    void aBodyThatDoesNotSpinKeepsItsOrientationToTheBit() {
        Body body = cylinder(1, 1, 1, Vec3::Zero());
        body.pose.orientation = Quat(0.1, 0.2, 0.3, 0.4).normalized();
        State state = initialStateOf(sceneOf({body}));
        const BodyIndex index = 0;
        euler().turn({&index, 1}, 0.1, state);
        QCOMPARE(state.pose[0].orientation.coeffs(), body.pose.orientation.coeffs());
    }
};

} // namespace carom

CAROM_TEST(euler_test, carom::EulerTest)
#include "euler_test.moc"
