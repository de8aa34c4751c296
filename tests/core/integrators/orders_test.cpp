// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/contact_scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include "core/dynamics/free_rotation.h"
#include "core/math/rotation.h"
#include "core/integrators/integrator.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <utility>

// The orders of the integrators, measured on worlds: halving the substep divides the error by two to the
// power of the order.

namespace carom {
namespace {

using namespace test;

/// The order measured may be off by this: the next term of the error is still there.
constexpr double orderTolerance = 0.1;
/// Rounding after a second of at most 4096 steps, each below 2e-16 of lengths about 10 m.
constexpr double rounding = 1e-11;

Spring springTo(BodyIndex body, const Vec3& at = Vec3::Zero(), double damping = 0) {
    Spring spring = springBetween(noBody, body, 100, damping);
    spring.toAt = at;
    spring.length = 1;
    return spring;
}

/// One second of a scene that touches nothing.
State after(const Scene& scene, std::string_view integrator, std::string_view method, int substeps) {
    SimulationSettings options;
    options.method = method;
    options.integrator = integrator;
    options.step = 1.0;
    options.substeps = substeps;
    World world = worldOf(scene, options);
    world.step();
    return world.state();
}

double attitudeError(const Pose& a, const Pose& b) {
    return toRotationVector(a.orientation * b.orientation.conjugate()).norm();
}

/// Positions and attitudes of all bodies.
double errorOf(const State& state, const State& reference) {
    double worst = 0;
    for (std::size_t i = 0; i < state.pose.size(); ++i)
        worst = std::max({worst, (state.pose[i].position - reference.pose[i].position).norm(),
                          attitudeError(state.pose[i], reference.pose[i])});
    return worst;
}

Scene projectile() { return sceneOf({sphere(0.1, 1, Vec3::Zero(), Vec3(1, 2, 3))}, downwards()); }

State projectileReference() {
    State state = initialStateOf(projectile());
    state.pose[0].position = Vec3(1, 2, 3) + 0.5 * downwards();
    return state;
}

Scene oscillator() {
    Scene scene = sceneOf({sphere(0.1, 1, Vec3(1.1, 0, 0))});
    scene.springs = {springTo(0)};
    return scene;
}

State oscillatorReference() { // ω = 10 rad/s
    State state = initialStateOf(oscillator());
    state.pose[0].position = Vec3(1 + 0.1 * std::cos(10.0), 0, 0);
    return state;
}

Scene springPendulum() {
    Scene scene = sceneOf({sphere(0.1, 1, Vec3(1, 0, 0))}, downwards());
    scene.springs = {springTo(0)};
    return scene;
}

Scene dampedPendulum() {
    Scene scene = springPendulum();
    scene.springs = {springTo(0, Vec3::Zero(), 2)};
    return scene;
}

/// A light ball that is thrown in air, in a side wind.
Scene thrownBall() {
    Scene scene = sceneOf({sphere(0.1, 0.1, Vec3::Zero(), Vec3(10, 5, 2))}, downwards());
    scene.bodies[0].values.set("drag", 0.5);
    scene.declare("air").values.set("density", 1.2);
    scene.declare("air").values.set("wind", Vec3(0, 0, -5));
    return scene;
}

/// The same with a plate that turns, and shows the same three faces to the air all the time.
Scene thrownPlate() {
    Scene scene = thrownBall();
    scene.bodies[0] =
        moving(cuboid(Vec3(0.1, 0.2, 0.3), 1, Vec3::Zero()), Vec3(10, -5, 4), Vec3(0.2, 0.1, 0.1));
    scene.bodies[0].values.set("drag", 0.5);
    return scene;
}

/// A cuboid that hangs by a corner, and a second one from it.
Scene swingingCuboids() {
    const Vec3 size(0.2, 0.4, 0.6);
    Scene scene = sceneOf({moving(cuboid(size, 1, Vec3(1, 0, 0)), Vec3::Zero(), Vec3(1, 2, 0.5)),
                           cuboid(size, 0.5, Vec3(2, 0, 0))},
                          downwards());
    Spring between = springTo(1, -0.5 * size);
    between.from = 0;
    between.fromAt = 0.5 * size;
    scene.springs = {springTo(0, -0.5 * size), between};
    return scene;
}

Scene tumblingCuboid() {
    return sceneOf({moving(cuboid(Vec3(0.2, 0.4, 0.6), 1, Vec3::Zero()), Vec3::Zero(), Vec3(1, 2, 3))});
}

State tumblingReference() {
    const Scene scene = tumblingCuboid();
    State state = initialStateOf(scene);
    const Bodies bodies = bodiesOf(scene);
    Quat& orientation = state.pose[0].orientation;
    const Vec3 momentum = angularMomentumFrom(bodies.inertia[0], orientation, state.angularVelocity[0]);
    rotateFreely(bodies.inertia[0], momentum, 1, orientation);
    return state;
}

/// The finest run stands for the reference solution: 64 times the steps and order four.
State fineRun(const Scene& scene) { return after(scene, "rk4", "microcollisions", 8192); }

} // namespace

class OrdersTest : public QObject {
    Q_OBJECT

  private:
    void expectOrder(const char* name, const Scene& scene, const State& reference, const char* method,
                     const IntegratorRow& row, int expected, int substeps) {
        const double coarse = errorOf(after(scene, row.name, method, substeps), reference);
        const double fine = errorOf(after(scene, row.name, method, 2 * substeps), reference);
        const double order = std::log2(coarse / fine);
        const QString told = QStringLiteral("%1, %2, %3: errors %4 and %5, order %6")
                                 .arg(QLatin1StringView(name), QLatin1StringView(method),
                                      QString::fromUtf8(row.name.data(), std::ssize(row.name)))
                                 .arg(coarse)
                                 .arg(fine)
                                 .arg(order);
        QVERIFY2(std::abs(order - expected) < orderTolerance, qPrintable(told));
    }

  private Q_SLOTS:
    void freeFallIsExactOrOfTheOrderOfTheScheme() {
        for (const IntegratorRow& row : integrators()) {
            for (const char* method : {"microcollisions", "contacts"}) {
                if (row.order == 1)
                    expectOrder("projectile", projectile(), projectileReference(), method, row, row.order,
                                256);
                else
                    QVERIFY(errorOf(after(projectile(), row.name, method, 256), projectileReference()) <
                            rounding);
            }
        }
    }

    void springsMoveByTheOrderOfTheSchemeUnderEveryMethodThatSteps() {
        struct Case {
            const char* name;
            Scene scene;
            State reference;
        };
        const Case cases[] = {{"oscillator", oscillator(), oscillatorReference()},
                              {"spring pendulum", springPendulum(), fineRun(springPendulum())},
                              {"damped pendulum", dampedPendulum(), fineRun(dampedPendulum())},
                              {"swinging cuboids", swingingCuboids(), fineRun(swingingCuboids())}};
        for (const Case& a : cases) {
            for (const IntegratorRow& row : integrators()) {
                const int order = row.orderOnSprings;
                // A step in which tied bodies turn far is cut into shorter ones: these are short enough.
                const int orderFour =
                    row.name == "rk4" || a.name == std::string_view("swinging cuboids") ? 256 : 64;
                const int substeps = order == 1 ? 4096 : order == 2 ? 512 : orderFour;
                expectOrder(a.name, a.scene, a.reference, "contacts", row, order, substeps);
                if (row.motion.moveOnSprings != nullptr)
                    expectOrder(a.name, a.scene, a.reference, "microcollisions", row, order, substeps);
            }
        }
    }

    void bodiesInAirMoveByTheOrderOfTheSchemeUnderEveryMethodThatSteps() {
        const std::pair<const char*, Scene> cases[] = {{"thrown ball", thrownBall()},
                                                       {"thrown plate", thrownPlate()}};
        for (const auto& [name, scene] : cases) {
            const State reference = fineRun(scene);
            for (const IntegratorRow& row : integrators()) {
                const int substeps = row.order == 1 ? 1024 : row.order == 2 ? 128 : 16;
                for (const char* method : {"contacts", "microcollisions"})
                    expectOrder(name, scene, reference, method, row, row.order, substeps);
            }
        }
    }

    void freeRotationIsExactOrOfTheOrderOfTheScheme() {
        for (const IntegratorRow& row : integrators()) {
            if (row.name == "midpoint")
                QVERIFY(errorOf(after(tumblingCuboid(), row.name, "contacts", 64), tumblingReference()) <
                        rounding);
            else
                expectOrder("cuboid", tumblingCuboid(), tumblingReference(), "contacts", row, row.order, 256);
        }
    }

    void aFreeBodyKeepsItsAngularMomentumUnderEveryScheme() {
        const Bodies bodies = bodiesOf(tumblingCuboid());
        const auto momentum = [&](const State& state) {
            return angularMomentumFrom(bodies.inertia[0], state.pose[0].orientation,
                                       state.angularVelocity[0]);
        };
        const Vec3 before = momentum(initialStateOf(tumblingCuboid()));
        for (const IntegratorRow& row : integrators())
            QVERIFY((momentum(after(tumblingCuboid(), row.name, "contacts", 100)) - before).norm() <
                    rounding * before.norm());
    }

    void verletRunsBackToWhereItCameFrom() {
        // A hundred thousand times the error of order h² that a scheme without the symmetry leaves.
        constexpr double back = 1e-10;
        Scene scene = swingingCuboids();
        const State there = after(scene, "verlet", "microcollisions", 300);
        const Scene start = scene;
        for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
            scene.bodies[i].pose = there.pose[i];
            scene.bodies[i].velocity = -there.velocity[i];
            scene.bodies[i].angularVelocity = -there.angularVelocity[i];
        }
        const State home = after(scene, "verlet", "microcollisions", 300);
        QVERIFY(errorOf(home, initialStateOf(start)) < back);
        const State euler = after(scene, "symplectic", "microcollisions", 300);
        QVERIFY(errorOf(euler, initialStateOf(start)) > 1e-3); // the test can fail
    }

    void beyondItsLimitAnOscillationGrowsAndBelowItStaysBounded() {
        for (const IntegratorRow& row : integrators()) {
            if (!(row.stableUpTo > 0) || !std::isfinite(row.stableUpTo)) continue;
            for (const double part : {0.99, 1.01}) {
                // ω = 10 rad/s: h = limit/10 · part, 2000 steps. At rest it has no length, so it is linear.
                Scene scene = oscillator();
                scene.springs[0].length = 0;
                scene.bodies[0].pose.position = Vec3(0.1, 0, 0);
                SimulationSettings options;
                options.method = "contacts";
                options.integrator = row.name;
                options.step = part * row.stableUpTo / 10;
                options.substeps = 1;
                World world = worldOf(scene, options);
                run(world, 2000);
                const double stretch = world.state().pose[0].position.norm();
                if (part < 1)
                    QVERIFY2(stretch < 10, row.name.data());
                else
                    QVERIFY2(!(stretch < 1e3), row.name.data());
            }
        }
    }

    void aDampedSpringOnBothMethodsMovesAlike() {
        for (const IntegratorRow& row : integrators()) {
            if (row.motion.moveOnSprings == nullptr) continue;
            const State one = after(dampedPendulum(), row.name, "contacts", 100);
            const State other = after(dampedPendulum(), row.name, "microcollisions", 100);
            QVERIFY2(errorOf(one, other) < rounding, row.name.data());
        }
    }
};

} // namespace carom

CAROM_TEST(orders_test, carom::OrdersTest)
#include "orders_test.moc"
