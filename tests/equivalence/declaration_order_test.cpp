// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/random_scene.h"

#include <QTest>

#include <algorithm>
#include <numeric>

// The order of declarations numbers the bodies. While no body touches two others in one substep, pairs do not
// know each other and the numbering changes nothing but itself, bit for bit. Where one does, microcollisions
// treats its pairs in turn, so the motion depends on the order: that is the method, not an accident.

namespace carom {
namespace {

using test::randomVector;
using test::sceneOf;
using test::sphere;
using test::worldOf;

constexpr std::uint64_t seed = 99;

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
    void independentCollisionsDoNotDependOnTheOrderOfDeclarations() {
        qInfo("seed %llu", static_cast<unsigned long long>(seed));
        Random random(seed);
        for (int round = 0; round < 20; ++round) {
            const Scene scene = farPairs(random);
            std::vector<std::size_t> order(scene.bodies.size());
            std::iota(order.begin(), order.end(), std::size_t{0});
            for (std::size_t i = order.size() - 1; i > 0; --i)
                std::swap(order[i], order[random.below(i + 1)]);
            Scene shuffled = scene;
            for (std::size_t i = 0; i < order.size(); ++i) shuffled.bodies[i] = scene.bodies[order[i]];

            World plain = worldOf(scene, test::byMethod("microcollisions"));
            World other = worldOf(shuffled, test::byMethod("microcollisions"));
            std::uint64_t contacts = 0;
            for (int frame = 0; frame < 60; ++frame) {
                plain.step();
                other.step();
                contacts += plain.statistics().contacts;
            }
            QVERIFY(contacts >= 20);
            for (std::size_t i = 0; i < order.size(); ++i) {
                const std::size_t k = order[i];
                QCOMPARE(other.state().pose[i].position, plain.state().pose[k].position);
                QCOMPARE(other.state().pose[i].orientation.coeffs(),
                         plain.state().pose[k].orientation.coeffs());
                QCOMPARE(other.state().velocity[i], plain.state().velocity[k]);
                QCOMPARE(other.state().angularVelocity[i], plain.state().angularVelocity[k]);
            }
        }
    }

    void aFarBystanderChangesNothing() {
        Random random(seed);
        const Scene scene = test::randomScene(random);
        Scene watched = scene;
        watched.bodies.push_back(sphere(1, 1, Vec3(1e6, 1e6, 1e6)));
        World plain = worldOf(scene), other = worldOf(watched);
        test::run(plain, 120);
        test::run(other, 120);
        for (std::size_t i = 0; i < scene.bodies.size(); ++i)
            QCOMPARE(other.state().pose[i].position, plain.state().pose[i].position);
    }
};

} // namespace carom

QTEST_APPLESS_MAIN(carom::DeclarationOrderTest)
#include "declaration_order_test.moc"
