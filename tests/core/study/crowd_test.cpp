// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/generators/generator.h"
#include "core/simulation/build.h"
#include "core/simulation/world.h"
#include "core/study/benchmark.h"
#include "core/study/crowd_runs.h"

#include <QTest>

#include <cmath>

// Crowds: what is read off one run, and that exact copies are alike where others are not.

namespace carom {
namespace {

Scene brownian(int balls) {
    const GeneratorRow& gas = *findGenerator("brownian");
    return build(generate(gas, requestFor(gas, balls))).pipeline->scene();
}

CrowdRun runOf(const Scene& scene) {
    return {.scene = scene, .frames = 240, .first = 100, .step = 1.0 / 60, .nudge = crowdNudge, .goOn = [] {
                return true;
            }};
}

} // namespace

class CrowdTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void quartilesLieBetweenNeighbours() {
        const Quartiles quartiles = quartilesOf({4, 1, 3, 2, 5});
        QCOMPARE(quartiles.lower, 2.0);
        QCOMPARE(quartiles.median, 3.0);
        QCOMPARE(quartiles.upper, 4.0);
        QCOMPARE(quartilesOf({1, 2}).median, 1.5);
        QCOMPARE(quartilesOf({}).median, 0.0);
    }

    // A ball between two walls a metre apart, at 2 m/s: in the layer of .2 r at each wall for .02/2 s of
    // every half second.
    void aBallBetweenWallsHasThePressureOfItsMomentum() {
        const Build built = build("gravity { accel 0, 0, 0 }\n"
                                  "wall { normal 1, 0, 0 toOrig 0 }  wall { normal -1, 0, 0 toOrig 1.2 }\n"
                                  "sphere { radius .1 mass 3 centre .5, 0, 0 vel 2, 0, 0 }\n"
                                  "simulation { method events  step .0001 }");
        World world(built.pipeline);
        const Bodies& bodies = built.pipeline->bodies();
        ImpactWatch impacts(bodies, Vec3::Zero(), 0.0001, world.state());
        CrowdWatch crowd(bodies, 0, 5);
        for (int frame = 0; frame < 20'000; ++frame) {
            world.step();
            crowd.look(world.state(), impacts.look(world.state()));
        }
        const CrowdWatch::Sums& sums = crowd.sums();
        // Momentum flux m v² in a layer of .02 m: the mean over the looks is 2 m v / .5 s · .02 m a wall.
        constexpr double looks = 0.01; // of a frame more or less in the layer
        const double expected = 2 * 0.02 * 2 * 3 * 2 / 1.0;
        QVERIFY(std::abs(sums.momentum / sums.looks / expected - 1) < looks);
        QCOMPARE(sums.impacts, 4.0);
        QCOMPARE(sums.looks, 20'000.0);
    }

    void copiesAreAlikeWhetherTheyAreExactOrStepped() {
        const Scene scene = brownian(200);
        const CrowdRun run = runOf(scene);
        const World world(std::make_shared<const Pipeline>(scene, SimulationSettings{}));
        const std::optional<ExactCrowd> crowd = exactCrowd(run, world.pipeline().bodies(), 5);
        QVERIFY(crowd);
        QCOMPARE(crowd->scatter.copies, std::size_t{5});
        QVERIFY(crowd->scatter.speeds.median > 0); // they are not the same run
        QVERIFY(crowd->scatter.speeds.median < 0.05);
        QVERIFY(std::abs(crowd->scatter.pressure.median) < 0.2);
        QVERIFY(std::abs(crowd->scatter.freeTime.median) < 0.1);

        CrowdRun stepped = run;
        stepped.fastest = crowd->fastest;
        SimulationSettings options;
        options.method = "contacts";
        const std::optional<CrowdWatch::Sums> sums = runCopy(stepped, 1, options);
        QVERIFY(sums);
        const CrowdDeviation deviation = deviationOf(*sums, crowd->sums);
        QVERIFY(deviation.speeds < 0.08);
        QVERIFY(std::abs(deviation.freeTime) < 0.15);
    }

    void aHotterCrowdIsDistinguishedFromACoolOne() {
        Scene hot = brownian(200);
        const Scene cool = hot;
        for (Body& body : hot.bodies) body.velocity *= 1.2;
        const World world(std::make_shared<const Pipeline>(cool, SimulationSettings{}));
        const std::optional<ExactCrowd> crowd = exactCrowd(runOf(cool), world.pipeline().bodies(), 2);
        QVERIFY(crowd);
        CrowdRun run = runOf(hot);
        run.fastest = crowd->fastest;
        SimulationSettings options;
        options.method = "events";
        const std::optional<CrowdWatch::Sums> sums = runCopy(run, 1, options);
        QVERIFY(sums);
        QVERIFY(deviationOf(*sums, crowd->sums).speeds > 0.05);
    }

    void aFewBallsAreNoCrowdNorIsAShortRun() {
        const Scene few = brownian(20);
        const World one(std::make_shared<const Pipeline>(few, SimulationSettings{}));
        QVERIFY(!exactCrowd(runOf(few), one.pipeline().bodies(), 5));
        const Scene many = brownian(100);
        const World other(std::make_shared<const Pipeline>(many, SimulationSettings{}));
        CrowdRun hasty = runOf(many);
        hasty.first = 200;
        QVERIFY(!exactCrowd(hasty, other.pipeline().bodies(), 5));
    }
};

} // namespace carom

CAROM_TEST(crowd_test, carom::CrowdTest)
#include "crowd_test.moc"
