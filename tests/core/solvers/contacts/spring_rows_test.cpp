// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/random_scene.h"
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/math/rotation.h"
#include "core/solvers/contacts/spring_rows.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <vector>

// Springs on the base path: one pass against the step of implicit Euler in closed form, and the equations of
// the rows for networks.

namespace carom {
namespace {

using test::cuboid;
using test::randomVector;
using test::sceneOf;
using test::sphere;
using test::substep;

constexpr double roundingOfSteps = 1e-12;

/// Bodies with springs of their own as the solver of the base path has them: number 0 cannot move.
struct SpringScene {
    explicit SpringScene(const Scene& scene)
        : bodies(bodiesOf(scene)), state(initialStateOf(scene)), local(bodies.count()), solver(1) {
        for (const BodyIndex i : bodies.mobileBodies) {
            local[i] = static_cast<std::uint32_t>(solver.size());
            SolverBody& body = solver.emplace_back();
            body.velocity = arrayOf(state.velocity[i]);
            body.spin = arrayOf(state.angularVelocity[i]);
            body.inverseMass = bodies.inverseMass[i];
            const Mat3 axes = state.pose[i].orientation.toRotationMatrix();
            setInverseInertia(axes * bodies.inverseInertia[i].asDiagonal() * axes.transpose(), body);
        }
    }
    void add(const SpringForce& spring) {
        springs.push_back(static_cast<std::uint32_t>(bodies.springs.size()));
        bodies.springs.push_back(spring);
    }
    void prepare() { prepareSprings(bodies, state, springs, local, 0, substep, solver, rows); }
    Vec3 velocityOf(BodyIndex i) const { return vectorOf(solver[local[i]].velocity); }
    double kineticEnergy() const {
        double sum = 0;
        for (const BodyIndex i : bodies.mobileBodies) {
            const SolverBody& body = solver[local[i]];
            const Vec3 spin = vectorOf(body.spin);
            sum += 0.5 * vectorOf(body.velocity).squaredNorm() / body.inverseMass +
                   0.5 * spin.dot(inverseInertiaOf(body).inverse() * spin);
        }
        return sum;
    }

    Bodies bodies;
    State state;
    std::vector<std::uint32_t> local, springs;
    std::vector<SolverBody> solver;
    std::vector<SpringRow> rows;
};

} // namespace

class SpringRowsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // x' = x + h v',  v' = v − (h k/m) x' − (h c/m) v':  v' (1 + h c/m + h² k/m) = v − (h k/m) x
    void onePassIsTheStepOfImplicitEuler() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 111);
        for (int trial = 0; trial < 300; ++trial) {
            const Vec3 place = randomVector(random, 1), anchor = randomVector(random, 1);
            const double mass = std::exp(random.uniform(-2, 2));
            SpringScene scene(sceneOf({sphere(0.1, mass, place, randomVector(random, 3))}));
            const double stiffness = mass * std::exp(random.uniform(0, 20)); // up to h² k/m of some 8000
            scene.add({.to = 0, .fromAt = anchor, .stiffness = stiffness});
            const Vec3 before = scene.velocityOf(0);
            scene.prepare();
            solveSprings(scene.rows, scene.solver);
            const Vec3 expected = (before - substep * stiffness / mass * (place - anchor)) /
                                  (1 + substep * substep * stiffness / mass);
            QVERIFY((scene.velocityOf(0) - expected).norm() < 1e-9 * (before.norm() + expected.norm()));
        }
    }

    void alongASpringALengthAtRestAndDampingAreExactToo() {
        Random random(test::seed, 112);
        for (int trial = 0; trial < 300; ++trial) {
            const double mass = std::exp(random.uniform(-2, 2)), speed = random.uniform(-3, 3);
            const double length = random.uniform(0.5, 2), atRest = random.uniform(0.2, 2);
            const double k = 100 * std::exp(random.uniform(-2, 5)), c = std::exp(random.uniform(-2, 3));
            SpringScene scene(sceneOf({sphere(0.1, mass, Vec3(0, length, 0), Vec3(0, speed, 0))}));
            scene.add({.to = 0, .stiffness = k, .damping = c, .length = atRest});
            scene.prepare();
            const double before = scene.kineticEnergy();
            solveSprings(scene.rows, scene.solver);
            const double h = substep;
            const double expected =
                (speed - h * k / mass * (length - atRest)) / (1 + h * c / mass + h * h * k / mass);
            QVERIFY(std::abs(scene.velocityOf(0).y() - expected) <
                    roundingOfSteps * (3 + std::abs(expected)));
            QVERIFY(std::abs(scene.velocityOf(0).x()) + std::abs(scene.velocityOf(0).z()) < roundingOfSteps);
            const double work = scene.kineticEnergy() - before;
            QVERIFY(std::abs(workOf(scene.rows[0], scene.solver) - work) < 1e-10 * (1 + std::abs(work)));
        }
    }

    void twoBallsOnASpringHaveTheirReducedMassAndKeepTheirMomentum() {
        Random random(test::seed, 113);
        for (int trial = 0; trial < 100; ++trial) {
            const double a = std::exp(random.uniform(-2, 2)), b = std::exp(random.uniform(-2, 2));
            const Vec3 place = randomVector(random, 1), other = randomVector(random, 1);
            const Vec3 velocity = randomVector(random, 2);
            SpringScene scene(
                sceneOf({sphere(0.1, a, place, velocity), sphere(0.1, b, other, randomVector(random, 2))}));
            const double k = 1000;
            scene.add({.from = 0, .to = 1, .stiffness = k});
            const Vec3 momentum = a * scene.velocityOf(0) + b * scene.velocityOf(1);
            const Vec3 apart = scene.velocityOf(1) - scene.velocityOf(0);
            scene.prepare();
            solveSprings(scene.rows, scene.solver);
            const double reduced = a * b / (a + b);
            const Vec3 expected =
                (apart - substep * k / reduced * (other - place)) / (1 + substep * substep * k / reduced);
            QVERIFY((scene.velocityOf(1) - scene.velocityOf(0) - expected).norm() <
                    1e-10 * (1 + expected.norm()));
            QVERIFY((a * scene.velocityOf(0) + b * scene.velocityOf(1) - momentum).norm() <
                    roundingOfSteps * (1 + momentum.norm()) * (a + b));
        }
    }

    // u + bias + yield λ = 0 in every row, and the work of all is the change of kinetic energy.
    void passesSolveTheRowsOfANetwork() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 114);
        for (int trial = 0; trial < 20; ++trial) {
            Scene bodies = sceneOf({});
            for (int i = 0; i < 4; ++i) {
                Body body = cuboid({0.2, 0.3, 0.4}, 1, randomVector(random, 1));
                body.pose.orientation = fromRotationVector(randomVector(random, 1));
                body.velocity = randomVector(random, 1);
                body.angularVelocity = randomVector(random, 1);
                body.fixed = i == 3;
                if (body.fixed) body.velocity = body.angularVelocity = Vec3::Zero();
                bodies.bodies.push_back(body);
            }
            SpringScene scene(bodies);
            for (BodyIndex i = 0; i < 4; ++i)
                for (BodyIndex j = 0; j < i; ++j)
                    scene.add({.from = i,
                               .to = j,
                               .fromAt = randomVector(random, 0.1),
                               .toAt = randomVector(random, 0.1),
                               .stiffness = random.uniform(10, 2000),
                               .damping = random.uniform(0, 3),
                               .length = random.uniform(0, 1)});
            scene.prepare();
            const double before = scene.kineticEnergy();
            for (int pass = 0; pass < 300; ++pass) solveSprings(scene.rows, scene.solver);
            double work = 0;
            for (const SpringRow& row : scene.rows) {
                const Vec3 speed = row.frame.transpose() * (velocityAt(scene.solver[row.b], row.armB) -
                                                            velocityAt(scene.solver[row.a], row.armA));
                for (int k = 0; k < 3; ++k)
                    if (row.mass[k] != 0)
                        QVERIFY(std::abs(speed[k] + row.bias[k] + row.yield[k] * row.impulse[k]) < 1e-10);
                work += workOf(row, scene.solver);
            }
            QVERIFY(std::abs(work - (scene.kineticEnergy() - before)) < 1e-9 * (1 + before));
            QVERIFY(scene.solver[0].velocity == (std::array<double, 3>{}));
        }
    }

    void aSlackSpringDoesNothingAcross() {
        SpringScene scene(sceneOf({sphere(0.1, 1, Vec3(0, 0.5, 0), Vec3(1, 0, 0))}));
        scene.add({.to = 0, .stiffness = 1000, .length = 1}); // pushed together: across it would be unstable
        scene.prepare();
        QVERIFY(scene.rows[0].mass[0] > 0);
        QCOMPARE(scene.rows[0].mass[1], 0.0);
        QCOMPARE(scene.rows[0].mass[2], 0.0);
        SpringScene none(sceneOf({sphere(0.1, 1, Vec3(0, 0.5, 0))}));
        none.add({.to = 0, .length = 1}); // neither stiff nor damped
        none.prepare();
        QVERIFY(none.rows.empty());
    }
};

} // namespace carom

CAROM_TEST(spring_rows_test, carom::SpringRowsTest)
#include "spring_rows_test.moc"
