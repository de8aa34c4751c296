// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/simulation/build.h"
#include "core/simulation/world.h"
#include "core/study/impacts.h"
#include "core/study/references.h"

#include <QTest>

#include <cmath>

// Impacts seen from outside, against closed forms and against records made by hand.

namespace carom {
namespace {

/// Rounding of a few hundred places and velocities, as times [s].
constexpr double timeRounding = 1e-11;

ImpactRecord watched(const char* text, int frames) {
    World world(build(text).pipeline);
    const Pipeline& pipeline = world.pipeline();
    ImpactWatch watch(pipeline.bodies(), pipeline.gravity(), pipeline.settings().step, world.state());
    for (int frame = 0; frame < frames; ++frame) {
        world.step();
        watch.look(world.state());
    }
    return watch.record();
}

SeenImpact hit(double time, double change) { return {time, Vec3(0, change, 0)}; }

} // namespace

class ImpactsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void theBouncesOfABallAreSeenAtTheirTimesBetweenTheFrames() {
        const ImpactRecord record =
            watched("gravity { accel 0, -9.81, 0 }  wall { normal 0, 1, 0 toOrig 0 elastic .9 }\n"
                    "sphere { radius 0.1 mass 1 centre 0, 1.1, 0 elastic .9 }\n"
                    "simulation { method events }",
                    120);
        const reference::BouncingPoint ball{.height = 1, .gravity = 9.81, .restitution = 0.9};
        const std::vector<SeenImpact>& impacts = record[1];
        QVERIFY(impacts.size() >= 2 && impacts.size() <= 4);
        for (std::size_t k = 0; k < impacts.size(); ++k)
            QVERIFY(std::abs(impacts[k].time - ball.impactTime(static_cast<int>(k) + 1)) < timeRounding);
    }

    // Air slows this one by twenty times what gravity does: that is no impact; the wall is, and it comes at
    // x(t) = ln(1 + k v₀ t)/k.
    void airIsNoImpactAndTheWallBehindItIsOne() {
        const ImpactRecord record = watched("air { density 1.2 }  wall { normal -1, 0, 0 toOrig 10 }\n"
                                            "sphere { radius 0.02 mass 0.0027 centre 0, 0, 0 vel 40, 0, 0 "
                                            "drag 0.47 }\n"
                                            "simulation { method contacts substeps 8 }\n"
                                            "gravity { accel 0, -1e-9, 0 }",
                                            60);
        const double k = 0.5 * 1.2 * 0.47 * 3.141592653589793 * 0.0004 / 0.0027;
        const double time = (std::exp(k * (10 - 0.02)) - 1) / (k * 40);
        QCOMPARE(record[1].size(), std::size_t{1});
        constexpr double asDragChanges = 1e-3; // [s], within a frame; the parabolas do not know
        QVERIFY(std::abs(record[1].front().time - time) < asDragChanges);
    }

    void bothBallsOfACollisionAreHit() {
        const ImpactRecord record = watched("gravity { accel 0, 0, 0 }\n"
                                            "sphere { radius 0.1 mass 1 centre 0, 0, 0 vel 1, 0, 0 }\n"
                                            "sphere { radius 0.1 mass 1 centre 0.5, 0, 0 }\n"
                                            "simulation { method events }",
                                            60);
        for (const std::vector<SeenImpact>& impacts : record) {
            QCOMPARE(impacts.size(), std::size_t{1});
            QVERIFY(std::abs(impacts[0].time - 0.3) < timeRounding);
            QVERIFY(std::abs(impacts[0].change.norm() - 1) < timeRounding);
        }
    }

    void whatLiesOrSlidesIsNotHit() {
        const ImpactRecord record =
            watched("wall { normal 0, 1, 0 toOrig 0 friction .5 elastic 0 }\n"
                    "cuboid { size 1, 1, 1 mass 1 centre 0, .5, 0 friction .5 elastic 0 }\n"
                    "cuboid { size 1, 1, 1 mass 1 centre 5, .5, 0 vel 2, 0, 0 friction .5 elastic 0 }",
                    60);
        for (const std::vector<SeenImpact>& impacts : record) QVERIFY(impacts.empty());
    }

    void recordsAreComparedImpactByImpact() {
        const ImpactRecord reference = {{hit(1, 2), hit(2, -3), hit(3, 4)}};
        ImpactErrors errors =
            compareImpacts(reference, {{hit(1.01, 2), hit(2.03, -3.1), hit(2.98, 4)}}, {10});
        QCOMPARE(errors.expected, std::size_t{3});
        QCOMPARE(errors.seen, std::size_t{3});
        QCOMPARE(errors.matched, std::size_t{3});
        QVERIFY(std::abs(errors.time - 0.03) < timeRounding);

        errors = compareImpacts(reference, {{hit(1, 2), hit(3, 4)}}, {10}); // the second was missed
        QCOMPARE(errors.seen, std::size_t{2});
        QCOMPARE(errors.matched, std::size_t{1});
        QCOMPARE(errors.time, 0.0);

        // One just as strong, but far later than the longest time between impacts, is another one.
        errors = compareImpacts(reference, {{hit(1, 2), hit(8, -3)}}, {3.5});
        QCOMPARE(errors.matched, std::size_t{1});
    }

    void impactsBeyondTheEndDoNotCountNorDoFaintOnes() {
        const ImpactRecord reference = {{hit(1, 2), hit(2, -3)}};
        // The second lies before the end in the reference solution and behind it in the run: it is there.
        ImpactErrors errors = compareImpacts(reference, {{hit(1, 2), hit(2.2, -3)}}, {2.1});
        QCOMPARE(errors.seen, std::size_t{2});
        QVERIFY(std::abs(errors.time - 0.2) < timeRounding);
        // And the other way round: the run is early, which is no impact too many.
        errors = compareImpacts(reference, {{hit(1, 2), hit(1.8, -3)}}, {1.9});
        QCOMPARE(errors.expected, std::size_t{1});
        QCOMPARE(errors.seen, std::size_t{1});
        errors = compareImpacts(reference, {{hit(0.5, 0.001), hit(1, 2), hit(2, -3)}}, {10});
        QCOMPARE(errors.seen, std::size_t{2});
        QCOMPARE(errors.matched, std::size_t{2});
    }
};

} // namespace carom

CAROM_TEST(impacts_test, carom::ImpactsTest)
#include "impacts_test.moc"
