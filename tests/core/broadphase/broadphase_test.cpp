// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/broadphase/moving_boxes.h"
#include "tests/support/test_class.h"

#include <QTest>

#include <algorithm>

// Every algorithm against the obvious double loop, on random scenes of many kinds over several frames.

namespace carom {
namespace {

Aabb cube(const Vec3& centre, double half) {
    return {centre - Vec3::Constant(half), centre + Vec3::Constant(half)};
}

} // namespace

class BroadphaseTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everyAlgorithmFindsThePairsOfTheObviousDoubleLoop() {
        constexpr std::uint64_t scenes = 1000;
        constexpr int frames = 6;
        std::uint64_t pairs = 0;
        for (std::uint64_t seed = 1; seed <= scenes; ++seed) {
            Random random(seed);
            MovingBoxes scene = randomScene(random);
            std::vector<std::unique_ptr<Broadphase>> algorithms;
            for (const BroadphaseRow& row : broadphases()) algorithms.push_back(row.create());
            for (int frame = 0; frame < frames; ++frame) {
                const std::vector<BodyPair> expected = obviousPairs(scene.input());
                pairs += expected.size();
                for (std::size_t k = 0; k < algorithms.size(); ++k) {
                    algorithms[k]->update(scene.input());
                    const bool same = std::ranges::equal(algorithms[k]->pairs(), expected);
                    QVERIFY2(same, qPrintable(QStringLiteral("%1, seed %2, frame %3: %4 pairs, %5 expected")
                                                  .arg(broadphases()[k].name.data())
                                                  .arg(seed)
                                                  .arg(frame)
                                                  .arg(algorithms[k]->pairs().size())
                                                  .arg(expected.size())));
                }
                move(scene, random);
            }
        }
        QVERIFY2(pairs > 100'000, "the scenes must hold pairs to find");
    }

    void boxesThatOnlyTouchOverlap() {
        for (const BroadphaseRow& row : broadphases()) {
            MovingBoxes scene;
            scene.add(cube(Vec3(0, 0, 0), 0.5));
            scene.add(cube(Vec3(3, 0, 0), 0.5));
            const std::unique_ptr<Broadphase> algorithm = row.create();
            algorithm->update(scene.input());
            QCOMPARE(algorithm->pairs().size(), 0U);
            scene.boxes[1] = cube(Vec3(1, 1, -1), 0.5);
            algorithm->update(scene.input());
            QCOMPARE(algorithm->pairs().size(), 1U);
            QCOMPARE(algorithm->pairs()[0].a, scene.bodies[0]);
            QCOMPARE(algorithm->pairs()[0].b, scene.bodies[1]);
        }
    }

    void aSceneWithoutOrWithOneBoxHasNoPairs() {
        for (const BroadphaseRow& row : broadphases()) {
            MovingBoxes scene;
            const std::unique_ptr<Broadphase> none = row.create(), one = row.create();
            none->update(scene.input());
            none->update(scene.input());
            QVERIFY(none->pairs().empty());
            scene.add(cube(Vec3::Zero(), 1));
            one->update(scene.input());
            one->update(scene.input());
            QVERIFY(one->pairs().empty());
            QCOMPARE(one->counters().boxes, 1U);
        }
    }

    // Memory may differ: each thread has lists of its own.
    void threadsThatShareASearchFindAndCountTheSame() {
        Random random(11);
        MovingBoxes scene;
        for (int i = 0; i < 5000; ++i)
            scene.add(cube(uniformIn(random, 6), i % 50 == 0 ? 1.0 : 0.2), random.uniform(0, 1) < 0.9);
        Workers workers(4);
        BroadphaseInput shared = scene.input();
        shared.workers = &workers;
        for (const BroadphaseRow& row : broadphases()) {
            const std::unique_ptr<Broadphase> one = row.create(), several = row.create();
            one->update(scene.input());
            several->update(shared);
            QVERIFY(one->pairs().size() > 5000);
            QVERIFY2(std::ranges::equal(one->pairs(), several->pairs()), row.name.data());
            QCOMPARE(several->counters().tested, one->counters().tested);
            QCOMPARE(several->counters().cells, one->counters().cells);
        }
    }

    void countersCountBoxesPairsComparisonsAndMemory() {
        Random random(7);
        for (const BroadphaseRow& row : broadphases()) {
            MovingBoxes scene;
            for (int i = 0; i < 200; ++i) scene.add(cube(uniformIn(random, 3), 0.3));
            const std::unique_ptr<Broadphase> algorithm = row.create();
            for (int frame = 0; frame < 4; ++frame) {
                algorithm->update(scene.input());
                const BroadphaseCounters& counters = algorithm->counters();
                QCOMPARE(counters.boxes, 200U);
                QCOMPARE(counters.pairs, algorithm->pairs().size());
                QVERIFY(counters.tested <= 200U * 199U * 3U);
                QVERIFY(counters.memoryBytes >= algorithm->pairs().size() * sizeof(BodyPair));
                for (Aabb& box : scene.boxes) shift(box, uniformIn(random, 0.05));
            }
        }
    }

    void pairsOfImmobileBoxesAreNeverReported() {
        for (const BroadphaseRow& row : broadphases()) {
            MovingBoxes scene;
            for (int i = 0; i < 40; ++i) scene.add(cube(Vec3(0.1 * i, 0, 0), 1), i == 20);
            const std::unique_ptr<Broadphase> algorithm = row.create();
            for (int frame = 0; frame < 3; ++frame) {
                algorithm->update(scene.input());
                QVERIFY(std::ranges::equal(algorithm->pairs(), obviousPairs(scene.input())));
                QVERIFY(!algorithm->pairs().empty());
                for (const BodyPair& pair : algorithm->pairs())
                    QVERIFY(pair.a == scene.bodies[20] || pair.b == scene.bodies[20]);
                shift(scene.boxes[20], Vec3(0.3, 0.1, 0));
            }
        }
    }

    void anyScaleThatDoublesHoldWillDo() {
        for (const double scale : {0.0, 1e-310, 1e-160, 1e-30, 1e30, 1e150, 1e300}) {
            for (const BroadphaseRow& row : broadphases()) {
                Random random(3);
                MovingBoxes scene;
                for (int i = 0; i < 120; ++i) {
                    const Aabb box = cube(uniformIn(random, 2), random.uniform(0, 0.3));
                    scene.add({scale * box.lower, scale * box.upper}, i % 7 != 0);
                }
                scene.add(cube(Vec3(1e6, -1e12, 3), 1e-3));
                scene.add(cube(Vec3(1e6, -1e12, 3), 1e-9));
                const std::unique_ptr<Broadphase> algorithm = row.create();
                for (int frame = 0; frame < 3; ++frame) {
                    algorithm->update(scene.input());
                    QVERIFY2(std::ranges::equal(algorithm->pairs(), obviousPairs(scene.input())),
                             row.name.data());
                    for (Aabb& box : scene.boxes) shift(box, scale * uniformIn(random, 0.2));
                }
            }
        }
    }

    void everyAlgorithmSaysWhatItIs() {
        for (const BroadphaseRow& row : broadphases()) {
            QVERIFY(!row.title.empty() && !row.cost.empty() && !row.source.empty());
            QCOMPARE(findBroadphase(row.name), &row);
        }
        QCOMPARE(findBroadphase("octree"), nullptr);
    }
};

} // namespace carom

CAROM_TEST(broadphase_test, carom::BroadphaseTest)
#include "broadphase_test.moc"
