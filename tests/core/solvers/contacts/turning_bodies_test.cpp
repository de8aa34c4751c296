// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/scenes.h"
#include "tests/support/solver_rows.h"
#include "tests/support/test_class.h"

#include "core/dynamics/free_rotation.h"
#include "core/math/random.h"
#include "core/math/rotation.h"
#include "core/solvers/contacts/turning_bodies.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace carom {
namespace {

using test::seed;
using test::uniformIn;

constexpr double stepLength = 1.0 / 720;  // [s]
constexpr double roundingOfTurns = 1e-14; // of a unit quaternion and of angular velocities of a few rad/s

/// Cylinders, cuboids, cubes and balls at random, which turn, and the arrays that the step has of them.
struct TurningScene {
    TurningScene(Random& random, std::size_t count, double spin) {
        std::vector<Body> list;
        for (std::size_t i = 0; i < count; ++i) {
            const double size = random.uniform(0.05, 0.5);
            Body body;
            body.mass = random.uniform(0.5, 2);
            switch (i % 4) {
            case 0:
                body.shape = Cylinder{size, random.uniform(0.02, 0.6)};
                break;
            case 1:
                body.shape = Cuboid{Vec3(size, random.uniform(0.02, 0.6), random.uniform(0.02, 0.6))};
                break;
            case 2:
                body.shape = Cuboid{Vec3::Constant(size)};
                break;
            default:
                body.shape = Sphere{size};
            }
            body.pose.orientation = fromRotationVector(uniformIn(random, 3.0));
            body.angularVelocity = uniformIn(random, spin);
            list.push_back(body);
        }
        scene.bodies = list;
        bodies = bodiesOf(scene);
        state = initialStateOf(scene);
        turning.begin();
        solved.resize(count + 1);
        for (std::uint32_t i = 0; i < count; ++i) {
            turning.add(bodies, i, state);
            SolverBody& body = solved[i + 1];
            body.spin = arrayOf(state.angularVelocity[i]);
            body.inverseMass = bodies.inverseMass[i];
            setInverse(body, i);
            numbers.push_back(i + 1);
        }
    }
    void setInverse(SolverBody& body, BodyIndex i) const {
        const Mat3 turn = state.pose[i].orientation.toRotationMatrix();
        setInverseInertia(turn * bodies.inverseInertia[i].asDiagonal() * turn.transpose(), body);
    }

    Scene scene;
    Bodies bodies;
    State state;
    TurningBodies turning;
    std::vector<SolverBody> solved;
    std::vector<std::uint32_t> numbers; // numbers of all
};

double distanceOf(const Quat& a, const Quat& b) {
    return std::min((a.coeffs() - b.coeffs()).norm(), (a.coeffs() + b.coeffs()).norm());
}

// Against the same by free_rotation.h, body by body.
void compare(double spin) {
    Random random(seed, 1);
    TurningScene scene(random, 41, spin);
    for (int step = 0; step < 50; ++step) {
        scene.turning.turn(scene.numbers, stepLength, scene.solved);
        for (BodyIndex i = 0; i < 41; ++i) {
            const Vec3 momentum = angularMomentumOf(scene.bodies, i, scene.state);
            rotateInParts(scene.bodies.inertia[i], momentum, stepLength, scene.state.pose[i].orientation);
            keepAngularMomentum(scene.bodies, i, momentum, scene.state);
            const double steps = (step + 1) * (1 + spin * stepLength); // rounding adds up
            QVERIFY(distanceOf(scene.turning.orientationOf(i + 1), scene.state.pose[i].orientation) <
                    roundingOfTurns * steps);
            QVERIFY((vectorOf(scene.solved[i + 1].spin) - scene.state.angularVelocity[i]).norm() <
                    roundingOfTurns * steps * spin);
            SolverBody expected;
            scene.setInverse(expected, i);
            const double size = scene.bodies.inverseInertia[i].maxCoeff();
            QVERIFY((inverseInertiaOf(scene.solved[i + 1]) - inverseInertiaOf(expected)).norm() <
                    10 * roundingOfTurns * steps * size);
        }
    }
}

} // namespace

class TurningBodiesTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void fourAtATimeTurnAsOneDoes() {
        for (const double spin : {1e-3, 1.0, 20.0, 150.0, 2000.0})
            compare(spin); // the last turn too far for series
    }

    void momentumStaysToTheBitWhileNothingElseTurnsTheBody() {
        Random random(seed, 2);
        TurningScene scene(random, 8, 30);
        scene.turning.turn(scene.numbers, stepLength, scene.solved);
        const Vec3 before = scene.turning.momentumOf(2);
        for (int step = 0; step < 1000; ++step) scene.turning.turn(scene.numbers, stepLength, scene.solved);
        QCOMPARE(scene.turning.momentumOf(2), before);
        add(scene.solved[2].spin, Vec3(1e-9, 0, 0));
        scene.turning.turn(scene.numbers, stepLength, scene.solved);
        QVERIFY(scene.turning.momentumOf(2) != before);
    }
    void bodiesAreTurnedTheSameWhoeverIsBeside() {
        Random random(seed, 3);
        for (const double spin : {5.0, 400.0}) {
            TurningScene together(random, 11, spin), alone = together;
            together.turning.turn(together.numbers, stepLength, together.solved);
            for (const std::uint32_t number : alone.numbers)
                alone.turning.turn({&number, 1}, stepLength, alone.solved);
            for (const std::uint32_t number : alone.numbers) {
                QCOMPARE(together.turning.orientationOf(number).coeffs(),
                         alone.turning.orientationOf(number).coeffs());
                QCOMPARE(together.solved[number].spin, alone.solved[number].spin);
                QCOMPARE(inverseInertiaOf(together.solved[number]), inverseInertiaOf(alone.solved[number]));
            }
        }
    }

    void whatIsRoundKeepsItsAngularVelocityToTheBit() {
        Random random(seed, 4);
        TurningScene scene(random, 8, 20);
        for (int step = 0; step < 10; ++step) scene.turning.turn(scene.numbers, stepLength, scene.solved);
        for (const BodyIndex i : {2U, 3U, 6U, 7U}) // cubes and balls
            QCOMPARE(vectorOf(scene.solved[i + 1].spin), scene.state.angularVelocity[i]);
    }
};

} // namespace carom

CAROM_TEST(turning_bodies_test, carom::TurningBodiesTest)
#include "turning_bodies_test.moc"
