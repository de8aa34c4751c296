// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/analysis.h"
#include "core/simulation/method_choice.h"

#include "tests/support/random_scene.h"
#include "tests/support/shipped_scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include <QTest>

#include <algorithm>
#include <numeric>

// The order of declarations numbers the bodies, and changes nothing but that, bit for bit: under `contacts`
// and `events` on every scene. Under microcollisions while no body touches two others in one substep; where
// one does, that method treats its pairs in turn, so the motion depends on the order: that is the method, not
// an accident.

namespace carom {
namespace {

using test::randomVector;
using test::sceneOf;
using test::sphere;
using test::worldOf;

constexpr std::uint64_t seed = 99;

/// A random order of `count` things.
std::vector<std::size_t> shuffle(Random& random, std::size_t count) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = count; i-- > 1;) std::swap(order[i], order[random.below(i + 1)]);
    return order;
}

/// The scene with body order[i] declared as the i-th, and its springs in any order.
Scene declaredAs(const Scene& scene, const std::vector<std::size_t>& order, Random& random) {
    Scene other = scene;
    std::vector<BodyIndex> place(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        other.bodies[i] = scene.bodies[order[i]];
        place[order[i]] = static_cast<BodyIndex>(i);
    }
    const std::vector<std::size_t> springs = shuffle(random, scene.springs.size());
    for (std::size_t k = 0; k < springs.size(); ++k) {
        Spring& spring = other.springs[k] = scene.springs[springs[k]];
        if (spring.from != noBody) spring.from = place[spring.from];
        if (spring.to != noBody) spring.to = place[spring.to];
    }
    return other;
}

/// The first body with a bit that differs, or nothing.
QString firstDifference(const World& plain, const World& other, const std::vector<std::size_t>& order) {
    const State &a = plain.state(), &b = other.state();
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::size_t k = order[i];
        if (a.pose[k].position != b.pose[i].position || a.velocity[k] != b.velocity[i] ||
            a.pose[k].orientation.coeffs() != b.pose[i].orientation.coeffs() ||
            a.angularVelocity[k] != b.angularVelocity[i])
            return QStringLiteral("body %1 in frame %2").arg(k).arg(a.frame);
    }
    return {};
}

void movesTheSameInAnyOrder(const Scene& scene, const char* method, Random& random, int frames) {
    const std::vector<std::size_t> order = shuffle(random, scene.bodies.size());
    World plain = worldOf(scene, test::byMethod(method));
    World other = worldOf(declaredAs(scene, order, random), test::byMethod(method));
    for (int frame = 0; frame < frames; ++frame) {
        plain.step();
        other.step();
        const QString difference = firstDifference(plain, other, order);
        QVERIFY2(difference.isEmpty(), qPrintable(difference));
    }
}

/// Pairs of bodies that meet head on or obliquely, far from all other pairs, each on its own floor.
Scene farPairs(Random& random) {
    Scene scene = sceneOf({}, Vec3(0, -9.8, 0));
    for (int i = 0; i < 20; ++i) {
        const Vec3 place(100.0 * i, 50, 0);
        Body left = i % 3 == 0 ? test::cylinder(0.3, 0.8, 2, place) : sphere(0.4, 2, place);
        left.pose.orientation = fromRotationVector(randomVector(random, 1));
        const Vec3 aim(random.uniform(-1, 1), random.uniform(0, 0.4), random.uniform(-0.2, 0.2));
        Body right = sphere(0.5, random.uniform(1, 5), place + Vec3(2, 0, 0), Vec3(-5, 0, 0) + aim);
        right.elastic = random.uniform();
        scene.bodies.push_back(left);
        scene.bodies.push_back(right);
    }
    return scene;
}

} // namespace

class DeclarationOrderTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everyShippedSceneMovesTheSameInAnyOrder_data() {
        QTest::addColumn<QString>("path");
        QTest::addColumn<QByteArray>("method");
        for (const QString& path : test::shippedScenes())
            for (const char* method : {"contacts", "events"})
                QTest::addRow("%s, %s", qPrintable(path), method) << path << QByteArray(method);
    }
    void everyShippedSceneMovesTheSameInAnyOrder() {
        QFETCH(QString, path);
        QFETCH(QByteArray, method);
        qInfo("seed %llu", static_cast<unsigned long long>(seed));
        Random random(seed);
        const Scene scene = analyse(test::textOfScene(path)).scene;
        if (const SolverRow& row = *findSolver(method.constData()); objectionTo(row, scene))
            return;                // the method does not treat this scene
        constexpr int frames = 30; // enough for impacts, slides and rests of most
        movesTheSameInAnyOrder(scene, method.constData(), random, frames);
    }

    void randomScenesMoveTheSameInAnyOrder() {
        qInfo("seed %llu", static_cast<unsigned long long>(seed));
        Random random(seed);
        for (int round = 0; round < 10; ++round) {
            Scene scene = test::randomScene(random);
            for (Body& body : scene.bodies) body.friction = random.below(2) == 0 ? random.uniform() : 0;
            movesTheSameInAnyOrder(scene, "contacts", random, 40);
        }
    }

    void independentCollisionsDoNotDependOnTheOrderOfDeclarations() {
        qInfo("seed %llu", static_cast<unsigned long long>(seed));
        Random random(seed);
        for (int round = 0; round < 20; ++round) {
            const Scene scene = farPairs(random);
            const std::vector<std::size_t> order = shuffle(random, scene.bodies.size());
            const Scene shuffled = declaredAs(scene, order, random);

            World plain = worldOf(scene, test::byMethod("microcollisions"));
            World other = worldOf(shuffled, test::byMethod("microcollisions"));
            std::uint64_t contacts = 0;
            for (int frame = 0; frame < 60; ++frame) {
                plain.step();
                other.step();
                contacts += plain.statistics().contacts;
            }
            QVERIFY(contacts >= 20);
            const QString difference = firstDifference(plain, other, order);
            QVERIFY2(difference.isEmpty(), qPrintable(difference));
        }
    }

    void aFarBystanderChangesNothing() {
        Random random(seed);
        const Scene scene = test::randomScene(random);
        Scene watched = scene;
        watched.bodies.push_back(sphere(1, 1, Vec3(0, 1e6, 0))); // above the floor: it touches nothing
        World plain = worldOf(scene), other = worldOf(watched);
        test::run(plain, 120);
        test::run(other, 120);
        for (std::size_t i = 0; i < scene.bodies.size(); ++i)
            QCOMPARE(other.state().pose[i].position, plain.state().pose[i].position);
    }
};

} // namespace carom

CAROM_TEST(declaration_order_test, carom::DeclarationOrderTest)
#include "declaration_order_test.moc"
