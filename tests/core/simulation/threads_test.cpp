// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/random_scene.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include <QTest>

// The number of threads changes no bit, where there is so much to do that they really share it. Short enough
// for the thread sanitizer; tests/determinism holds it on every shipped scene.

namespace carom::test {
namespace {

constexpr std::uint64_t sceneSeed = 4711;

std::uint64_t hashAfter(const Scene& scene, int frames, const char* method, int threads) {
    SimulationSettings options = byMethod(method);
    options.broadphase = "sweep_and_sort";
    options.threads = threads;
    World world = worldOf(scene, options);
    run(world, frames);
    return world.stateHash();
}

} // namespace

class ThreadsTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void manyBodiesMoveTheSameOnAnyNumberOfThreads() {
        qInfo("seed %llu", static_cast<unsigned long long>(sceneSeed));
        Random random(sceneSeed);
        Scene scene = sceneOf({wall(Vec3::UnitY(), 0)}, Vec3(0, -9.8, 0));
        for (int i = 0; i < 10000; ++i) scene.bodies.push_back(randomBody(random, 8));
        World one = worldOf(scene, byMethod("microcollisions"));
        run(one, 15);
        QVERIFY(one.statistics().contacts > 100);
        for (const int threads : {1, 2, 3, 8})
            QCOMPARE(hashAfter(scene, 15, "microcollisions", threads), one.stateHash());
    }

    void manyIslandsMoveTheSameOnAnyNumberOfThreads() {
        Scene scene = sceneOf({wall(Vec3::UnitY(), 0)}, Vec3(0, -9.8, 0));
        for (int stack = 0; stack < 40; ++stack) // two cuboids each, a little askew, on the floor
            for (int level = 0; level < 2; ++level) {
                Body box = cuboid(Vec3(1, 0.5, 1), 1, Vec3(3 * stack + 0.1 * level, 0.26 + 0.51 * level, 0));
                box.friction = 0.5;
                scene.bodies.push_back(box);
            }
        const std::uint64_t hash = hashAfter(scene, 20, "contacts", 1);
        for (const int threads : {2, 3, 8}) QCOMPARE(hashAfter(scene, 20, "contacts", threads), hash);
    }
};

} // namespace carom::test

CAROM_TEST(threads_test, carom::test::ThreadsTest)
#include "threads_test.moc"
