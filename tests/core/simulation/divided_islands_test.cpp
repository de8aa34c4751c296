// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include "core/math/random.h"
#include "core/math/rotation.h"

#include <QTest>

#include <algorithm>
#include <vector>

// Islands so large that they are divided for threads (core/solvers/contacts/sections.h): the number of
// threads changes no bit of them, nor do other bodies that they never meet, nor an interruption.

namespace carom::test {
namespace {

/// Four layers and more of bodies that lie a little askew on a floor, so that each touches its neighbours.
void addHeap(Scene& scene, const Vec3& at, bool balls, double gap) {
    Random random(test::seed, 9);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 14; ++x)
            for (int z = 0; z < 6; ++z) {
                const double askewX = random.uniform(-0.004, 0.004), askewZ = random.uniform(-0.004, 0.004);
                const Vec3 place = at + Vec3(0.2 * x + askewX, 0.1 + (0.2 + gap) * y, 0.2 * z + askewZ);
                const int kind = balls ? 0 : static_cast<int>(random.below(3));
                Body body = kind == 0   ? sphere(0.1, 1, place)
                            : kind == 1 ? cylinder(0.1, 0.2, 1, place)
                                        : cuboid(Vec3(0.19, 0.2, 0.19), 1, place);
                body.friction = 0.5;
                body.elastic = 0.3;
                body.velocity = Vec3(0, -1, 0);
                scene.bodies.push_back(body);
            }
}

Scene heapScene(bool balls) {
    Scene scene = sceneOf({wall(Vec3::UnitY(), 0)}, Vec3(0, -9.81, 0));
    scene.bodies.front().friction = 0.5;
    addHeap(scene, Vec3::Zero(), balls, 0.001);
    return scene;
}

World worldOn(const Scene& scene, int threads) {
    SimulationSettings options = byMethod("contacts");
    options.threads = threads;
    return worldOf(scene, options);
}

} // namespace

class DividedIslandsTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void theyMoveTheSameOnAnyNumberOfThreads_data() { addKinds(); }
    void theyMoveTheSameOnAnyNumberOfThreads() {
        QFETCH(bool, balls);
        const Scene scene = heapScene(balls);
        World one = worldOn(scene, 1);
        run(one, frames);
        QVERIFY2(one.statistics().contacts > 700, qPrintable(QString::number(one.statistics().contacts)));
        for (const int threads : {2, 3}) {
            World several = worldOn(scene, threads);
            run(several, frames);
            QCOMPARE(several.stateHash(), one.stateHash());
        }
    }

    // Both heaps are divided, and their pairs change at different times.
    void theyMoveTheSameBesideOthers_data() { addKinds(); }
    void theyMoveTheSameBesideOthers() {
        QFETCH(bool, balls);
        const Scene alone = heapScene(balls);
        Scene both = alone;
        addHeap(both, Vec3(0, 0, 40), !balls, 0.004);
        World one = worldOn(alone, 1), two = worldOn(both, 2);
        run(one, frames);
        run(two, frames);
        for (std::size_t i = 0; i < alone.bodies.size(); ++i) {
            QCOMPARE(two.state().pose[i].position, one.state().pose[i].position);
            QCOMPARE(two.state().velocity[i], one.state().velocity[i]);
        }
    }

    void theyGoOnFromACheckpoint_data() { addKinds(); }
    void theyGoOnFromACheckpoint() {
        QFETCH(bool, balls);
        const Scene scene = heapScene(balls);
        World whole = worldOn(scene, 2), resumed = worldOn(scene, 1);
        run(whole, frames / 2);
        const Checkpoint middle = whole.checkpoint();
        run(whole, frames / 2);
        resumed.restore(middle);
        run(resumed, frames / 2);
        QCOMPARE(resumed.stateHash(), whole.stateHash());
    }

  private:
    static constexpr int frames = 12;

    static void addKinds() {
        QTest::addColumn<bool>("balls");
        QTest::addRow("balls") << true;
        QTest::addRow("of all shapes") << false;
    }
};

} // namespace carom::test

CAROM_TEST(divided_islands_test, carom::test::DividedIslandsTest)
#include "divided_islands_test.moc"
