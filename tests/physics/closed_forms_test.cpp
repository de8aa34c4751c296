// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include "core/dynamics/energy.h"

#include <QTest>

#include <cmath>

// Whole worlds against what a pencil gives.

namespace carom {
namespace {

using test::cylinder;
using test::run;
using test::sceneOf;
using test::sphere;
using test::wall;
using test::worldOf;

/// Relative; a run adds a few hundred roundings of 1e-16 each, mostly cancelling.
constexpr double closedForm = 1e-12;

SimulationSettings stepped(double step, int substeps = 1) {
    SimulationSettings options = test::byMethod("microcollisions");
    options.step = step;
    options.substeps = substeps;
    return options;
}

bool near(const Vec3& a, const Vec3& b, double scale) { return (a - b).norm() <= closedForm * scale; }

} // namespace

class ClosedFormsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // x_n = x0 + n h v0 + n(n−1)/2 h² g,  v_n = v0 + n h g.
    void freeFallFollowsItsDiscreteFormula_data() {
        QTest::addColumn<int>("substeps");
        QTest::newRow("one substep") << 1;
        QTest::newRow("five substeps") << 5;
    }
    void freeFallFollowsItsDiscreteFormula() {
        QFETCH(int, substeps);
        const Vec3 x0(1, 100, -2), v0(3, 4, 5), g(0.5, -9.8, 0.25);
        World world = worldOf(sceneOf({sphere(1, 2, x0, v0)}, g), stepped(1.0 / 60, substeps));
        run(world, 600);
        const double n = 600.0 * substeps, h = 1.0 / 60 / substeps;
        const Vec3 x = x0 + n * h * v0 + 0.5 * n * (n - 1) * h * h * g;
        const Vec3 v = v0 + n * h * g;
        QVERIFY(near(world.state().pose[0].position, x, x.norm()));
        QVERIFY(near(world.state().velocity[0], v, v.norm()));
    }

    // The closed form has n² for n(n−1): the error is h t g/2, of order one.
    void halvingTheStepHalvesTheErrorOfFreeFall() {
        const auto error = [](int substeps) {
            World world =
                worldOf(sceneOf({sphere(1, 2, Vec3::Zero())}, Vec3(0, -10, 0)), stepped(0.5, substeps));
            run(world, 4);
            return std::abs(world.state().pose[0].position.y() + 0.5 * 10 * 4);
        };
        QVERIFY(std::abs(error(8) / error(16) - 2) < 1e-9);
        QVERIFY(std::abs(error(16) - 0.5 * 10 * 2 * 0.5 / 16) < 1e-9);
    }

    // Two spheres of unequal masses meet obliquely: along the line of centres at contact they exchange
    // 2 m/(mA+mB) of the relative velocity, across it nothing changes.
    void twoSpheresCollideObliquely() {
        const double mA = 0.17, mB = 1.3, rA = 0.3, rB = 0.45;
        const Vec3 vA(2, 0.5, -0.25), vB(-1, 0.125, 0.5);
        const Vec3 xA(0, 0, 0), xB(1, 0.3, 0.2);
        World world = worldOf(sceneOf({sphere(rA, mA, xA, vA), sphere(rB, mB, xB, vB)}), stepped(1.0 / 1024));
        double time = 0;
        while (world.statistics().contacts == 0) {
            world.step();
            time += 1.0 / 1024;
            QVERIFY(time < 1);
        }
        const Vec3 n = ((xB + time * vB) - (xA + time * vA)).normalized();
        const double along = (vA - vB).dot(n);
        QVERIFY(along > 0);
        QVERIFY(std::abs(n.dot(Vec3::UnitX())) < 0.99); // oblique indeed
        QVERIFY(near(world.state().velocity[0], vA - 2 * mB / (mA + mB) * along * n, 1));
        QVERIFY(near(world.state().velocity[1], vB + 2 * mA / (mA + mB) * along * n, 1));
    }

    // A sphere strikes the curved side near the end of a free cylinder, at right angles to its axis:
    // j = (1+e) v / (1/m + 1/M + d²/I), v' = v − j/m, V = j/M, ω = j d/I, I = M (3r² + h²)/12.
    void aSphereStrikesTheEndOfAFreeCylinder() {
        constexpr double tight = 1e-10;
        const double m = 0.4, M = 2.3, r = 0.1, height = 2, d = 0.8, v = 3;
        const double I = M * (3 * r * r + height * height) / 12;
        for (const double e : {1.0, 0.6, 0.0}) {
            Body striker = sphere(0.15, m, Vec3(-0.5, d, 0), Vec3(v, 0, 0));
            striker.elastic = e;
            World world =
                worldOf(sceneOf({striker, cylinder(r, height, M, Vec3::Zero())}), stepped(1.0 / 1024));
            while (world.statistics().contacts == 0) {
                world.step();
                QVERIFY(world.state().frame < 1000);
            }
            const double j = (1 + e) * v / (1 / m + 1 / M + d * d / I);
            QVERIFY(std::abs(world.state().velocity[0].x() - (v - j / m)) < tight);
            QVERIFY((world.state().velocity[1] - Vec3(j / M, 0, 0)).norm() < tight);
            QVERIFY((world.state().angularVelocity[1] - Vec3(0, 0, -j * d / I)).norm() < tight);
        }
    }

    // On the flat end, beside the axis: the same with the arm across it.
    void aSphereStrikesTheFlatEndBesideTheAxis() {
        constexpr double tight = 1e-10;
        const double m = 0.4, M = 2.3, r = 0.5, height = 1, d = 0.3, v = 3;
        const double I = M * (3 * r * r + height * height) / 12;
        World world = worldOf(
            sceneOf({cylinder(r, height, M, Vec3::Zero()), sphere(0.15, m, Vec3(d, 0.8, 0), Vec3(0, -v, 0))}),
            stepped(1.0 / 1024));
        while (world.statistics().contacts == 0) {
            world.step();
            QVERIFY(world.state().frame < 1000);
        }
        const double j = 2 * v / (1 / m + 1 / M + d * d / I);
        QVERIFY((world.state().velocity[1] - Vec3(0, -v + j / m, 0)).norm() < tight);
        QVERIFY((world.state().velocity[0] - Vec3(0, -j / M, 0)).norm() < tight);
        QVERIFY((world.state().angularVelocity[0] - Vec3(0, 0, -j * d / I)).norm() < tight);
    }

    void aBallBouncesFromAnObliqueWallWithItsRestitution() {
        const Vec3 n = Vec3(1, 2, 2) / 3;
        const Vec3 v(0.5, -3, -1);
        Body ball = sphere(0.5, 7, 1.2 * n, v);
        ball.elastic = 0.75;
        World world = worldOf(sceneOf({ball, wall(n, 0)}), stepped(1.0 / 256));
        while (world.statistics().contacts == 0) {
            world.step();
            QVERIFY(world.state().frame < 1000);
        }
        QVERIFY(near(world.state().velocity[0], v - 1.75 * v.dot(n) * n, v.norm()));
        QVERIFY(distanceTo(Wall{n, 0}, world.state().pose[0].position) >= 0.5 - 1e-15); // displaced out
    }

    void aClosedElasticSystemKeepsMomentumAndEnergy() {
        Scene scene = sceneOf({});
        for (int i = 0; i < 64; ++i) {
            const Vec3 centre(0.5 * (i % 4), 0.5 * (i / 4 % 4), 0.5 * (i / 16));
            const Vec3 away = centre - Vec3::Constant(0.75);
            scene.bodies.push_back(sphere(0.2 + 0.002 * i, 1 + 0.1 * i, centre,
                                          -2 * away + Vec3(0.1 * (i % 3), 0.05 * (i % 5), 0)));
        }
        World world = worldOf(scene, stepped(1.0 / 60));
        const FrameStatistics start = world.statistics();
        std::uint64_t contacts = 0;
        for (int i = 0; i < 300; ++i) {
            world.step();
            contacts += world.statistics().contacts;
            QVERIFY(near(world.statistics().momentum, start.momentum, 100));
            QVERIFY(std::abs(world.statistics().kinetic - start.kinetic) < closedForm * start.kinetic);
        }
        QVERIFY(contacts > 50);
    }

    void angularMomentumSurvivesCollisionsOfTurningBodies() {
        Body log = cylinder(0.2, 1.5, 2, Vec3(0, 0, 0));
        log.angularVelocity = Vec3(0, 0, 4);
        const Scene scene = sceneOf({log, sphere(0.3, 1, Vec3(0.9, 0.4, 0.05))});
        World world = worldOf(scene, stepped(1.0 / 500));
        const Bodies& bodies = world.pipeline().bodies();
        const Vec3 before = angularMomentumOf(bodies, world.state());
        std::uint64_t contacts = 0;
        for (int i = 0; i < 500 && contacts == 0; ++i) {
            world.step();
            contacts += world.statistics().contacts;
        }
        QVERIFY(contacts > 0);
        // Displacing bodies moves their momentum's line by the depth: that part is the method's own error.
        const double slip = world.statistics().maxPenetration * 2 * before.norm();
        QVERIFY((angularMomentumOf(bodies, world.state()) - before).norm() <= slip + closedForm);
        QVERIFY(world.state().velocity[1].norm() > 1);
    }
};

} // namespace carom

CAROM_TEST(closed_forms_test, carom::ClosedFormsTest)
#include "closed_forms_test.moc"
