// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/broadphase/sweep_and_sort.h"

#include "tests/core/broadphase/moving_boxes.h"
#include "tests/support/test_class.h"

#include <QTest>

#include <algorithm>

namespace carom {
namespace {

MovingBoxes gas(std::size_t count, double side, Random& random) {
    MovingBoxes scene;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 centre = uniformIn(random, 0.5 * side);
        scene.add({centre - Vec3::Constant(0.1), centre + Vec3::Constant(0.1)});
    }
    return scene;
}

/// Pairs of end points that stand the other way round: what an insertion sort must exchange.
std::uint64_t inversions(const MovingBoxes& before, const MovingBoxes& after) {
    std::uint64_t count = 0;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        std::vector<std::pair<double, double>> ends;
        for (std::size_t i = 0; i < before.boxes.size(); ++i) {
            ends.push_back({before.boxes[i].lower[axis], after.boxes[i].lower[axis]});
            ends.push_back({before.boxes[i].upper[axis], after.boxes[i].upper[axis]});
        }
        for (std::size_t i = 0; i < ends.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if ((ends[i].first < ends[j].first) != (ends[i].second < ends[j].second)) ++count;
    }
    return count;
}

} // namespace

class SweepAndSortTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void itExchangesEveryPairOfEndPointsThatChangedPlacesOnce() {
        Random random(11);
        MovingBoxes scene = gas(100, 2, random);
        SweepAndSort algorithm;
        algorithm.update(scene.input());
        QCOMPARE(algorithm.counters().swaps, 0U); // the first order comes from a sort
        for (int frame = 0; frame < 20; ++frame) {
            const MovingBoxes before = scene;
            for (Aabb& box : scene.boxes) shift(box, uniformIn(random, 0.05));
            algorithm.update(scene.input());
            QCOMPARE(algorithm.counters().swaps, inversions(before, scene));
        }
    }

    void whatIsAddedAndRemovedIsTheDifferenceOfTheFrames() {
        Random random(12);
        MovingBoxes scene = gas(150, 1.5, random);
        SweepAndSort algorithm;
        std::vector<BodyPair> before, added, removed;
        for (int frame = 0; frame < 30; ++frame) {
            algorithm.update(scene.input());
            const std::vector<BodyPair> now = obviousPairs(scene.input());
            added.clear();
            removed.clear();
            std::ranges::set_difference(now, before, std::back_inserter(added));
            std::ranges::set_difference(before, now, std::back_inserter(removed));
            QCOMPARE(algorithm.counters().added, added.size());
            QCOMPARE(algorithm.counters().removed, removed.size());
            before = now;
            for (Aabb& box : scene.boxes) shift(box, uniformIn(random, 0.1));
        }
    }

    void aSceneAtRestExchangesNothingEvenWhereEndPointsCoincide() {
        MovingBoxes scene;
        for (int i = 0; i < 60; ++i) { // a touching lattice: every coordinate occurs many times
            const Vec3 corner(i % 4, (i / 4) % 4, i / 16);
            scene.add({corner, corner + Vec3::Ones()});
        }
        SweepAndSort algorithm;
        for (int frame = 0; frame < 3; ++frame) {
            algorithm.update(scene.input());
            QVERIFY(std::ranges::equal(algorithm.pairs(), obviousPairs(scene.input())));
            QCOMPARE(algorithm.counters().swaps, 0U);
        }
    }

    // Reversing the order of 2,000 boxes on all axes would take 24 million exchanges.
    void afterATeleportItStartsAnewInsteadOfSortingByExchanges() {
        constexpr std::uint64_t insertionSortWouldTake = 24'000'000;
        Random random(13);
        MovingBoxes scene = gas(2000, 12, random);
        SweepAndSort algorithm;
        algorithm.update(scene.input());
        for (int frame = 0; frame < 6; ++frame) {
            const bool teleport = frame < 3;
            for (Aabb& box : scene.boxes)
                if (teleport)
                    box = {-box.upper, -box.lower};
                else
                    shift(box, uniformIn(random, 0.001));
            algorithm.update(scene.input());
            QVERIFY(std::ranges::equal(algorithm.pairs(), obviousPairs(scene.input())));
            QVERIFY(algorithm.counters().swaps < insertionSortWouldTake / 10);
        }
        QVERIFY(algorithm.counters().swaps > 0); // back to following frame by frame
    }
};

} // namespace carom

CAROM_TEST(sweep_and_sort_test, carom::SweepAndSortTest)
#include "sweep_and_sort_test.moc"
