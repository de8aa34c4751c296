// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/solvers/events/event_cells.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

// The cells against the obvious way, which looks at every pair: whoever may touch a ball before one of the
// two crosses into another cell is around it, once.

namespace carom {
namespace {

constexpr double roundingOfGaps = 1e-12; // relative to the region

struct Balls {
    std::vector<EventRecord> records;
    std::vector<TrajectoryOrigin> origins;
    EventCells cells;

    /// Anywhere in a region of that size, and a part of them beyond it.
    Balls(Random& random, std::size_t count, const Vec3& size, double largestRatio, double beyond)
        : records(count), origins(count) {
        for (TrajectoryOrigin& origin : origins) {
            origin.radius = 0.01 * std::pow(largestRatio, std::pow(random.uniform(), 12)); // mostly small
            const double reach = random.uniform() < beyond ? 3 : 1;
            for (int axis = 0; axis < 3; ++axis)
                origin.position[axis] = size[axis] * (0.5 + reach * (random.uniform() - 0.5));
        }
        cells.restart(records, origins, {Vec3::Zero(), size});
        for (std::uint32_t i = 0; i < count; ++i) cells.insert(records, i, origins[i].position);
    }

    /// How often each ball is around ball i.
    std::vector<int> around(std::uint32_t i) const {
        std::vector<int> times(records.size());
        cells.aroundBall(records, i, [&times](std::uint32_t j) { ++times[j]; });
        return times;
    }
    double gap(std::uint32_t i, std::uint32_t j) const {
        return (origins[i].position - origins[j].position).norm() - origins[i].radius - origins[j].radius;
    }
    /// By the numbers of their cells, on the coarser one's level.
    bool areInNeighbouringCells(std::uint32_t i, std::uint32_t j) const {
        const EventRecord &a = records[i], &b = records[j];
        const int level = std::max(a.level, b.level);
        for (std::size_t k = 0; k < 3; ++k)
            if (std::abs((a.place[k] >> (level - a.level)) - (b.place[k] >> (level - b.level))) > 1)
                return false;
        return true;
    }
};

} // namespace

class EventCellsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void whoeverMayTouchABallIsAroundItOnce_data() {
        QTest::addColumn<int>("count");
        QTest::addColumn<double>("largestRatio");
        QTest::addColumn<double>("beyond");
        QTest::addColumn<double>("flatness");
        QTest::newRow("of one size") << 300 << 1.0 << 0.0 << 1.0;
        QTest::newRow("few") << 3 << 1.0 << 0.0 << 1.0;
        QTest::newRow("of many sizes") << 300 << 30.0 << 0.0 << 1.0;
        QTest::newRow("half of them beyond the region") << 300 << 10.0 << 0.5 << 1.0;
        QTest::newRow("in a plane") << 200 << 5.0 << 0.1 << 0.0;
        QTest::newRow("in a tube") << 200 << 30.0 << 0.1 << 20.0;
    }
    void whoeverMayTouchABallIsAroundItOnce() {
        QFETCH(int, count);
        QFETCH(double, largestRatio);
        QFETCH(double, beyond);
        QFETCH(double, flatness);
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 81);
        std::size_t near = 0, seen = 0;
        int levels = 0;
        for (int trial = 0; trial < 5; ++trial) {
            const Vec3 size(1, flatness, 1);
            const Balls balls(random, static_cast<std::size_t>(count), size, largestRatio, beyond);
            for (std::uint32_t i = 0; i < balls.records.size(); ++i) {
                const EventRecord& ball = balls.records[i];
                levels = std::max(levels, ball.level + 1);
                const std::vector<int> around = balls.around(i);
                QCOMPARE(around[i], 0);
                for (std::uint32_t j = 0; j < balls.records.size(); ++j) {
                    QVERIFY(around[j] <= 1);
                    seen += static_cast<std::size_t>(around[j]);
                    if (j == i) continue;
                    const bool isNear = balls.areInNeighbouringCells(i, j);
                    near += isNear ? 1U : 0U;
                    if (isNear) QCOMPARE(around[j], 1);
                    const double apart =
                        balls.cells.tolerance(ball.level) + balls.cells.tolerance(balls.records[j].level);
                    if (!isNear) QVERIFY(balls.gap(i, j) >= apart - roundingOfGaps * size.maxCoeff());
                }
                for (int axis = 0; axis < 3; ++axis) {
                    const double within =
                        balls.origins[i].position[axis] - balls.cells.lowerFaceOf(ball, axis);
                    const double tolerance = roundingOfGaps * size.maxCoeff();
                    QVERIFY(within >= -tolerance && within <= balls.cells.sideOf(ball) + tolerance);
                }
            }
        }
        qInfo("%zu in neighbouring cells, %zu looked at, on %d levels", near, seen, levels);
        QVERIFY(seen > 0);
        QVERIFY(largestRatio == 1 || levels > 1);
    }

    void aCrossingShowsWhoCameIntoView() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 82);
        int came = 0;
        for (const double largestRatio : {1.0, 30.0}) {
            Balls balls(random, 300, {1, 0.6, 0.8}, largestRatio, 0.1);
            for (int turn = 0; turn < 3000; ++turn) {
                const std::uint32_t i = static_cast<std::uint32_t>(random.below(balls.records.size()));
                const int axis = static_cast<int>(random.below(3));
                const int direction = random.below(2) == 0 ? -1 : 1;
                const std::vector<int> before = balls.around(i);
                balls.cells.cross(balls.records, i, axis, direction);
                const std::vector<int> after = balls.around(i);
                std::vector<int> shown(balls.records.size());
                balls.cells.newlyAround(balls.records, i, axis, direction,
                                        [&shown](std::uint32_t j) { ++shown[j]; });
                for (std::uint32_t j = 0; j < balls.records.size(); ++j) {
                    if (j == i) continue;
                    QVERIFY(after[j] <= 1 && shown[j] <= after[j]);
                    if (balls.areInNeighbouringCells(i, j)) QCOMPARE(after[j], 1);
                    if (after[j] > before[j]) QCOMPARE(shown[j], 1);
                    came += after[j] > before[j] ? 1 : 0;
                }
            }
        }
        qInfo("%d came into view", came);
        QVERIFY(came > 1000);
    }

    void aCellKnowsTheWallsThatABallOfItCanReach() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 83);
        struct Side {
            Vec3 normal;
            double offset;
        };
        int reached = 0, spared = 0;
        for (int trial = 0; trial < 10; ++trial) {
            Balls balls(random, 300, {1, 1, 1}, 4, 0.2);
            std::vector<Side> walls(4 + random.below(10)); // the later ones share a bit
            for (Side& wall : walls) {
                wall.normal = uniformDirection(random);
                wall.offset = wall.normal.dot(Vec3::Constant(0.5)) - random.uniform(0.2, 0.8);
                balls.cells.addWall(wall.normal, wall.offset);
            }
            for (std::uint32_t i = 0; i < balls.records.size(); ++i)
                for (std::size_t k = 0; k < walls.size(); ++k) {
                    const TrajectoryOrigin& ball = balls.origins[i];
                    const bool touches = walls[k].normal.dot(ball.position) - walls[k].offset <= ball.radius;
                    const std::size_t bit = std::min<std::size_t>(k, EventCells::wallBits - 1);
                    const bool isNamed = (balls.cells.wallsNear(balls.records[i]) >> bit & 1U) != 0;
                    QVERIFY(isNamed || !touches);
                    reached += touches ? 1 : 0;
                    spared += isNamed ? 0 : 1;
                }
        }
        qInfo("%d touch a wall, %d are spared one", reached, spared);
        QVERIFY(reached > 1000 && spared > 1000);
    }

    void cellsAreOutgrownWhenMoreThanAQuarterIsBeyondThem() {
        Random random(test::seed, 84);
        Balls balls(random, 100, {1, 1, 1}, 1, 0);
        QVERIFY(!balls.cells.areOutgrown(balls.records));
        const auto leave = [&balls](std::uint32_t i) {
            for (int step = 0; step < 1000; ++step) balls.cells.cross(balls.records, i, 0, 1);
        };
        for (std::uint32_t i = 0; i < 25; ++i) leave(i);
        QVERIFY(!balls.cells.areOutgrown(balls.records));
        leave(25);
        QVERIFY(balls.cells.areOutgrown(balls.records));
        balls.cells.clear();
        for (std::uint32_t i = 0; i < 100; ++i) QCOMPARE(balls.around(i), std::vector<int>(100));
    }

    void aBallFarOutNeverLeavesItsCell() {
        std::vector<EventRecord> records(1);
        std::vector<TrajectoryOrigin> origins(1);
        origins[0].radius = 1;
        EventCells cells;
        cells.restart(records, origins, {Vec3::Zero(), Vec3::Ones()});
        cells.insert(records, 0, Vec3(1e30, 0.5, -1e30));
        QVERIFY(EventCells::isOutermost(records[0], 0));
        QVERIFY(!EventCells::isOutermost(records[0], 1));
        QVERIFY(EventCells::isOutermost(records[0], 2));
    }
};

} // namespace carom

CAROM_TEST(event_cells_test, carom::EventCellsTest)
#include "event_cells_test.moc"
