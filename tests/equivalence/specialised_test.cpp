// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/random_scene.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include "core/simulation/build.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <limits>

// What was proved absent does not change the motion: a scene without friction moves as the same scene does
// with a friction so small that it does nothing but rule the proofs out. And proofs that barely fail, fail.

namespace carom {
namespace {

using namespace test;

constexpr double nearlyNone = 1e-300; ///< of every positive number, that all proofs must heed

/// Up to six bodies close to each other over a floor, apart at the start; without friction.
Scene smoothScene(Random& random) {
    Scene scene = sceneOf({wall(Vec3::UnitY(), 0)}, Vec3(0, random.below(4) == 0 ? 0 : -9.8, 0));
    const bool onlySpheres = random.below(2) == 0;
    const auto isFree = [&](const Body& body, double radius) {
        if (body.pose.position.y() < 1.01 * radius) return false;
        return std::none_of(scene.bodies.begin() + 1, scene.bodies.end(), [&](const Body& other) {
            const double apart = (body.pose.position - other.pose.position).norm();
            return apart < 1.01 * (radius + boundingRadiusOf(other.shape));
        });
    };
    double spread = 0.4; // [m], and as much more as it takes to find room
    for (std::uint64_t left = 2 + random.below(5); left > 0; spread *= 1.05) {
        Body body = randomBody(random, spread);
        if (onlySpheres) body.shape = Sphere{random.uniform(0.1, 0.5)};
        if (!isFree(body, boundingRadiusOf(body.shape))) continue;
        scene.bodies.push_back(body);
        --left;
    }
    return scene;
}

/// The same, but that nothing can be proved of it: everything rubs, and whatever can turn may have to.
Scene generalOf(Scene scene) {
    for (Body& body : scene.bodies) body.friction = nearlyNone;
    return scene;
}

/// The largest difference of any place [m] or speed [m/s, rad/s].
double apart(const World& a, const World& b) {
    double worst = 0;
    for (const BodyIndex k : a.pipeline().bodies().mobileBodies)
        worst = std::max({worst, (a.state().pose[k].position - b.state().pose[k].position).norm(),
                          (a.state().velocity[k] - b.state().velocity[k]).norm(),
                          (a.state().angularVelocity[k] - b.state().angularVelocity[k]).norm()});
    return worst;
}

/// The same scene after some frames of twice as many substeps.
World finer(const Scene& scene, SimulationSettings options, int frames) {
    options.substeps = 2 * worldOf(scene, options).pipeline().settings().substeps;
    World world = worldOf(scene, options);
    for (int frame = 0; frame < frames; ++frame) world.step();
    return world;
}

std::shared_ptr<const Pipeline> pipelineOf(const QByteArray& text) {
    return build(text.toStdString()).pipeline;
}
bool simulates(const QByteArray& text, std::string_view effect) {
    return pipelineOf(text)->simulates(effect);
}

/// A floor and two balls; each of the three says its own of itself.
QByteArray ballsOnFloor(const char* floor, const char* ball, const char* other) {
    return QByteArray("wall { normal 0, 1, 0  toOrig 0 ") + floor + " }\n" +
           "sphere a { radius 1  mass 1  centre 0, 1, 0 " + ball + " }\n" +
           "sphere b { radius 1  mass 1  centre 0, 9, 0 " + other + " }\n";
}

} // namespace

class SpecialisedTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void theGeneralWayGivesTheSpecialOnesMotion_data() {
        QTest::addColumn<QByteArray>("method");
        QTest::addColumn<QByteArray>("preset");
        QTest::addColumn<double>("tolerance"); // [m, m/s]
        // The arithmetic is the same.
        QTest::newRow("microcollisions") << QByteArray("microcollisions") << QByteArray("default") << 0.0;
        // Contact forces are found by iteration: to 1e-6, or 1e-10, of the speed that gravity gives in a
        // substep.
        QTest::newRow("contacts") << QByteArray("contacts") << QByteArray("default") << 1e-7;
        QTest::newRow("contacts, accurate") << QByteArray("contacts") << QByteArray("accurate") << 1e-9;
    }
    void theGeneralWayGivesTheSpecialOnesMotion() {
        QFETCH(QByteArray, method);
        QFETCH(QByteArray, preset);
        QFETCH(double, tolerance);
        constexpr double rounding = 1e-13;
        constexpr std::uint64_t seed = 777;
        constexpr int scenes = 1000, frames = 5, mostDecided = 5;
        SimulationSettings options = byMethod(method.constData());
        options.preset = preset.toStdString();
        qInfo("seed %llu", static_cast<unsigned long long>(seed));
        Random random(seed);
        double worst = 0;
        int met = 0, equal = 0, decided = 0;
        for (int i = 0; i < scenes; ++i) {
            const Scene special = smoothScene(random);
            World a = worldOf(special, options), b = worldOf(generalOf(special), options);
            std::uint64_t contacts = 0;
            for (int frame = 0; frame < frames; ++frame) {
                a.step();
                b.step();
                contacts += a.statistics().contacts;
            }
            const double difference = apart(a, b);
            // Where rounding decides whether a substep has one event more, what differs is what such parts
            // leave open: less than the substeps do.
            if (difference > tolerance) {
                ++decided;
                const double open = apart(a, finer(special, options, frames));
                QVERIFY2(
                    difference <= 0.1 * open,
                    qPrintable(QStringLiteral("scene %1: %2, substeps %3").arg(i).arg(difference).arg(open)));
                continue;
            }
            worst = std::max(worst, difference);
            met += contacts > 0 ? 1 : 0;
            equal += difference <= rounding ? 1 : 0;
        }
        qInfo("%d scenes with contacts, %d equal to rounding, others up to %.1e apart", met, equal, worst);
        QVERIFY(met > scenes / 4);
        QVERIFY(equal > scenes * 9 / 10);
        QVERIFY(decided <= mostDecided);
    }

    void aProofThatBarelyFailsTakesTheGeneralMethod_data() {
        QTest::addColumn<QByteArray>("effect");
        QTest::addColumn<QByteArray>("proved");
        QTest::addColumn<QByteArray>("barelyNot");
        const auto add = [](const char* name, const char* effect, const QByteArray& proved,
                            const QByteArray& barelyNot) {
            QTest::newRow(name) << QByteArray(effect) << proved << barelyNot;
        };
        const QByteArray none = ballsOnFloor("", "", "");
        const QByteArray rough = ballsOnFloor("friction 1e-300", "friction 1e-300", "");
        const auto tied = [](const char* at) {
            return QByteArray("sphere a { radius 1  mass 1  centre 0, 0, 0 }\n"
                              "spring { from world  to a  stiffness 5  fromAt 0, 5, 0  toAt ") +
                   at + ", 0, 0 }\n";
        };
        const auto falling = [](const char* by) {
            return QByteArray("gravity { accel 0, ") + by + ", 0 }\n" + ballsOnFloor("", "", "");
        };
        add("friction", "friction", ballsOnFloor("friction 1", "", ""), rough);
        add("rotation by friction", "rotation", ballsOnFloor("friction 1", "", ""), rough);
        add("rolling resistance", "rolling_resistance", none, ballsOnFloor("", "rolling 1e-300", ""));
        add("rotation by rolling resistance", "rotation", none, ballsOnFloor("", "rolling 1e-300", ""));
        add("rotation by a spring", "rotation", tied("0"), tied("1e-12"));
        add("rotation by a spin", "rotation", none, ballsOnFloor("", "angvel 0, 1e-300, 0", ""));
        add("restitution", "restitution", ballsOnFloor("elastic 0", "elastic 0", "elastic 1"),
            ballsOnFloor("elastic 1e-300", "elastic 0", "elastic 1e-300"));
        add("gravity", "gravity", falling("0"), falling("-1e-300"));
        add("collision", "collision", "sphere { radius 1  mass 1  centre 0, 9, 0 }",
            "sphere { radius 1  mass 1  centre 0, 9, 0 }\nsphere { radius 1  centre 1e12, 0, 0  fixed yes }");
        add("springs", "spring", ballsOnFloor("", "", ""),
            tied("0").replace("stiffness 5", "stiffness 1e-300"));
    }
    void aProofThatBarelyFailsTakesTheGeneralMethod() {
        QFETCH(QByteArray, effect);
        QFETCH(QByteArray, proved);
        QFETCH(QByteArray, barelyNot);
        QVERIFY(!simulates(proved, effect.constData()));
        QVERIFY(simulates(barelyNot, effect.constData()));
    }

    // By the compiler's word rotation is absent, and by the list of what turns there is nothing to do.
    void rotationIsAbsentWhereNothingIsListedToTurn() {
        constexpr std::uint64_t seed = 31;
        qInfo("seed %llu", static_cast<unsigned long long>(seed));
        Random random(seed);
        int absent = 0;
        for (int round = 0; round < 500; ++round) {
            Scene scene = smoothScene(random);
            for (Body& body : scene.bodies) {
                if (random.below(8) != 0) body.angularVelocity = Vec3::Zero();
                if (random.below(6) == 0) body.friction = nearlyNone;
                if (random.below(40) == 0) body.rolling = nearlyNone;
            }
            if (random.below(8) == 0) {
                Spring spring;
                spring.from = 1;
                spring.toAt = Vec3(0, 9, 0);
                spring.stiffness = 1;
                if (random.below(2) == 0) spring.fromAt = Vec3(1e-12, 0, 0);
                scene.springs.push_back(spring);
            }
            const Pipeline pipeline(scene);
            QCOMPARE(pipeline.simulates("rotation"), !pipeline.bodies().rotating.empty());
            absent += pipeline.bodies().rotating.empty() ? 1 : 0;
        }
        QVERIFY(absent > 50 && absent < 450);
    }

    // Half a cache line of numbers moves a sphere that nothing turns: its orientation is of no account.
    void theOrientationOfASmoothSphereIsNeverRead() {
        for (const char* method : {"contacts", "microcollisions", "events"}) {
            Scene scene = sceneOf({wall(Vec3::UnitY(), 0)}, Vec3(0, -9.8, 0));
            for (int i = 0; i < 20; ++i)
                scene.bodies.push_back(
                    sphere(0.2, 1, Vec3(0.5 * i, 1 + 0.1 * (i % 3), 0), Vec3(i % 2 == 0 ? 1 : -1, 0, 0)));
            World plain = worldOf(scene, byMethod(method));
            for (Body& body : scene.bodies)
                body.pose.orientation.coeffs().setConstant(std::numeric_limits<double>::quiet_NaN());
            World unread = worldOf(scene, byMethod(method));
            for (int frame = 0; frame < 60; ++frame) {
                plain.step();
                unread.step();
                QVERIFY(unread.health().finite);
                QCOMPARE(apart(plain, unread), 0.0);
            }
            QCOMPARE(unread.statistics().kinetic, plain.statistics().kinetic);
        }
    }
};

} // namespace carom

CAROM_TEST(specialised_test, carom::SpecialisedTest)
#include "specialised_test.moc"
