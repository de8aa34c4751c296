// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/breakpoint.h"

#include "tests/support/scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include <QTest>

#include <algorithm>
#include <cmath>

using namespace carom;

namespace {

/// The first frame at which the breakpoint holds, 0 where it never does.
std::int64_t firstHit(const Scene& scene, const Breakpoint& breakpoint, int frames,
                      std::string_view method = "microcollisions") {
    SimulationSettings options;
    options.method = std::string(method);
    World world = test::worldOf(scene, options);
    BreakWatch watch({breakpoint});
    watch.begin(world);
    for (int frame = 0; frame < frames; ++frame) {
        world.step();
        if (watch.check(world)) return world.state().frame;
    }
    return 0;
}

/// Two balls move towards each other at 6 m/s, 5.9 m apart between their surfaces: they meet in frame 59.
Scene approachingBalls() {
    return test::sceneOf({test::sphere(0.5, 1, {-3.45, 0, 0}, {3, 0, 0}),
                          test::sphere(0.5, 1, {3.45, 0, 0}, {-3, 0, 0}), test::sphere(0.5, 1, {0, 9, 0})});
}

} // namespace

class BreakpointTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aContactIsSeenInTheFrameOfTheBounce() {
        for (const std::string_view method : {"microcollisions", "contacts", "events"}) {
            const std::int64_t hit =
                firstHit(approachingBalls(), {.kind = BreakKind::Contact, .a = 0, .b = 1}, 90, method);
            QVERIFY2(hit == 59 || hit == 60, method.data());
            QCOMPARE(firstHit(approachingBalls(), {.kind = BreakKind::Contact, .a = 2}, 90, method),
                     std::int64_t{0});
            QCOMPARE(firstHit(approachingBalls(), {.kind = BreakKind::Contact}, 90, method), hit);
            QCOMPARE(firstHit(approachingBalls(), {.kind = BreakKind::Contact, .a = 1}, 90, method), hit);
        }
    }

    void aBounceOffAWallIsAContact() {
        // 2 m of way at 6 m/s: frame 20, or 21 where rounding leaves a trace of it.
        const Scene scene = test::sceneOf({test::wall(Vec3::UnitX(), -2.5), test::wall(-Vec3::UnitX(), -2.5),
                                           test::sphere(0.5, 1, {0, 0, 0}, {6, 0, 0})});
        for (const std::string_view method : {"microcollisions", "contacts", "events"}) {
            const std::int64_t hit = firstHit(scene, {.kind = BreakKind::Contact, .a = 2}, 40, method);
            QVERIFY2(hit == 20 || hit == 21,
                     qPrintable(QStringLiteral("%1 %2").arg(QLatin1StringView(method.data())).arg(hit)));
        }
    }

    void passingByIsNoContact() {
        const Scene scene =
            test::sceneOf({test::sphere(0.5, 1, {-2, 1.05, 0}, {6, 0, 0}), test::sphere(0.5, 1, {0, 0, 0})});
        QCOMPARE(firstHit(scene, {.kind = BreakKind::Contact, .a = 0, .b = 1}, 60), std::int64_t{0});
    }

    void restingContactIsOneEventNotOneAFrame() {
        const Scene scene = test::sceneOf(
            {test::wall(Vec3::UnitY(), 0), test::cuboid({1, 1, 1}, 1, {0, 0.5, 0})}, Vec3(0, -9.8, 0));
        QCOMPARE(firstHit(scene, {.kind = BreakKind::Contact, .a = 0, .b = 1}, 30, "contacts"),
                 std::int64_t{0});
    }

    // Each was at rest and touched the next, or nearly: none of them closed in, and those in the middle are
    // at rest afterwards as well. Only the first contact was seen.
    void whatIsStruckThroughOthersIsAContact() {
        for (const double gap : {0.0, 1e-3}) {
            const double apart = 1 + gap;
            const Scene row = test::sceneOf(
                {test::sphere(0.5, 1, {-2, 0, 0}, {6, 0, 0}), test::sphere(0.5, 1, {0, 0, 0}),
                 test::sphere(0.5, 1, {apart, 0, 0}), test::sphere(0.5, 1, {2 * apart, 0, 0}),
                 test::sphere(0.5, 1, {2 * apart, apart, 0}), test::sphere(0.5, 1, {-1, 9, 0})});
            for (const std::string_view method : {"microcollisions", "contacts", "events"}) {
                const auto hit = [&](BodyIndex a, BodyIndex b) {
                    return firstHit(row, {.kind = BreakKind::Contact, .a = a, .b = b}, 60, method);
                };
                const std::int64_t first = hit(0, 1);
                QVERIFY2(first == 10 || first == 11, method.data());
                for (const BodyIndex b : {2, 3}) {
                    const std::int64_t there = hit(b - 1, b);
                    QVERIFY2(there >= first && there <= first + 1,
                             qPrintable(QStringLiteral("%1, gap %2: %3 in frame %4")
                                            .arg(QLatin1StringView(method.data()))
                                            .arg(gap)
                                            .arg(b)
                                            .arg(there)));
                }
                QCOMPARE(hit(3, 4), std::int64_t{0}); // beside the last, across its way
                QCOMPARE(hit(5, noBody), std::int64_t{0});
            }
        }
    }

    // The lower one is held between floor and upper one, and does not move at all.
    void aStackThatIsStruckFromAboveIsStruckToTheFloor() {
        const Scene stack = test::sceneOf(
            {test::wall(Vec3::UnitY(), 0), test::cuboid({1, 1, 1}, 1, {0, 0.5, 0}),
             test::cuboid({1, 1, 1}, 1, {0, 1.5, 0}), test::sphere(0.5, 1, {0, 4, 0}, {0, -6, 0})},
            Vec3(0, -9.8, 0));
        const auto hit = [&](BodyIndex a, BodyIndex b) {
            return firstHit(stack, {.kind = BreakKind::Contact, .a = a, .b = b}, 60, "contacts");
        };
        const std::int64_t first = hit(2, 3);
        QVERIFY(first > 10 && first < 16);
        QCOMPARE(hit(1, 2), first);
        QCOMPARE(hit(0, 1), first);
    }

    // What is below carries 20 weights, and no frame of that is an impact.
    void aHighStackAtRestIsNoContact() {
        Scene stack = test::sceneOf({test::wall(Vec3::UnitY(), 0)}, Vec3(0, -9.8, 0));
        for (int i = 0; i < 20; ++i) stack.bodies.push_back(test::cuboid({1, 1, 1}, 1, {0, 0.5 + i, 0}));
        QCOMPARE(firstHit(stack, {.kind = BreakKind::Contact}, 60, "contacts"), std::int64_t{0});
    }

    void aSpeedIsReachedOnce() {
        // v = g t > 4.9 m/s from the frame after half a second.
        const Scene scene = test::sceneOf({test::sphere(1, 1, {0, 0, 0})}, Vec3(0, -9.8, 0));
        QCOMPARE(firstHit(scene, {.kind = BreakKind::Speed, .a = 0, .limit = 4.91}, 60), std::int64_t{31});
        QCOMPARE(firstHit(scene, {.kind = BreakKind::Speed, .limit = 4.91}, 60), std::int64_t{31});
        QCOMPARE(firstHit(scene, {.kind = BreakKind::Speed, .limit = 99}, 60), std::int64_t{0});
    }

    void aPlaneIsCrossedInEitherDirection() {
        const Scene scene = test::sceneOf(
            {test::sphere(1, 1, {0, 0, 0}, {6, 0, 0}), test::sphere(1, 1, {0, 9, 0}, {-6, 0, 0})});
        // 0.1 m a frame
        const Breakpoint right{.kind = BreakKind::PlaneCrossed, .a = 0, .limit = 1.05, .axis = 0};
        const Breakpoint left{.kind = BreakKind::PlaneCrossed, .a = 1, .limit = -2.05, .axis = 0};
        QCOMPARE(firstHit(scene, right, 60), std::int64_t{11});
        QCOMPARE(firstHit(scene, left, 60), std::int64_t{21});
        QCOMPARE(firstHit(scene, {.kind = BreakKind::PlaneCrossed, .limit = 1, .axis = 2}, 60),
                 std::int64_t{0});
    }

    void penetrationAndDriftHoldFromTheirLimitOn() {
        const Scene deep =
            test::sceneOf({test::wall(Vec3::UnitY(), 0), test::sphere(0.5, 1, {0, 0.6, 0}, {0, -12, 0})});
        QCOMPARE(firstHit(deep, {.kind = BreakKind::Penetration, .limit = 0.05}, 10), std::int64_t{1});
        QCOMPARE(firstHit(deep, {.kind = BreakKind::Penetration, .limit = 0.5}, 10), std::int64_t{0});
        // A ball that hits the floor without a bounce loses all its energy of motion.
        Scene lossy = deep;
        lossy.bodies[1].elastic = 0;
        QCOMPARE(firstHit(lossy, {.kind = BreakKind::EnergyDrift, .limit = 0.5}, 10), std::int64_t{1});
        QCOMPARE(firstHit(deep, {.kind = BreakKind::EnergyDrift, .limit = 0.01}, 10), std::int64_t{0});
    }
};

CAROM_TEST(breakpoint_test, BreakpointTest)
#include "breakpoint_test.moc"
