// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/solvers/contacts/ball_scene.h"
#include "tests/support/constants.h"
#include "tests/support/test_class.h"

#include <QTest>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

// The order of contacts of balls: what comes, goes, stops and is sorted changes no bit that it should not.

namespace carom {

class BallRowsOrderTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // Pairs that are put in another order, some of them left out, are solved as if they had come in it.
    void anotherOrderIsThatInWhichPairsMightHaveCome() {
        Random random(test::seed, 9);
        for (int trial = 0; trial < 100; ++trial) {
            BallScene reordered = randomBalls(random, 2 + random.below(60)), added = reordered;
            std::vector<std::uint32_t> order;
            for (std::uint32_t i = 0; i < reordered.pairs.size(); ++i)
                if (random.below(5) != 0) order.push_back(i);
            for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
            BallRows rows, others;
            reordered.fill(rows);
            rows.reorder(placesOf(rows, order), reordered.immobile());
            for (const std::uint32_t i : order) others.add(added.pairs[i], i, added.immobile(), added.bodies);
            QCOMPARE(rows.groups(), others.groups());
            QCOMPARE(seenIn(rows, added.pairs.size()).sources, seenIn(others, added.pairs.size()).sources);
            const StepSettings settings = randomSettings(random, added.duration);
            for (int n = 0; n < 3; ++n) {
                reordered.refresh(rows);
                added.refresh(others);
                step(rows, reordered, settings, 2);
                step(others, added, settings, 2);
                QVERIFY(std::ranges::equal(reordered.bodies, added.bodies, sameBits));
            }
        }
    }

    // Pairs that are removed leave no trace, and those that are added after that come after all others.
    void withoutSomePairsTheOthersAreSolvedAsBefore() {
        Random random(test::seed, 15);
        for (int trial = 0; trial < 100; ++trial) {
            BallScene some = randomBalls(random, 2 + random.below(60)), never = some;
            std::vector<std::uint8_t> isGone(some.pairs.size());
            for (std::uint8_t& is : isGone) is = random.below(3) == 0;
            BallRows rows, others;
            some.fill(rows);
            std::vector<std::uint32_t> numbers(some.pairs.size());
            for (std::uint32_t i = 0; i < numbers.size(); ++i)
                numbers[i] = isGone[i] != 0 ? BallRows::noPair : i;
            rows.renumber(numbers, some.immobile());
            const auto addAll = [&never](BallRows& to, const auto& are) {
                for (std::uint32_t i = 0; i < never.pairs.size(); ++i)
                    if (are(i)) to.add(never.pairs[i], i, never.immobile(), never.bodies);
            };
            addAll(others, [&](std::uint32_t i) { return isGone[i] == 0; });
            const StepSettings settings = randomSettings(random, some.duration);
            for (int n = 0; n < 3; ++n) {
                const std::vector<std::uint32_t> left = seenIn(rows, some.pairs.size()).sources;
                QVERIFY(std::ranges::is_permutation(left, seenIn(others, some.pairs.size()).sources));
                some.refresh(rows);
                never.refresh(others);
                step(rows, some, settings, 2);
                step(others, never, settings, 2);
                QVERIFY(std::ranges::equal(some.bodies, never.bodies, sameBits));
                if (n > 0) continue;
                addAll(rows, [&](std::uint32_t i) { return isGone[i] != 0; });
                addAll(others, [&](std::uint32_t i) { return isGone[i] != 0; });
            }
        }
    }

    // Bodies stop and move on, one after the other: only pairs of those that have are looked at.
    void holdingWhatHasChangedHoldsAllOfIt() {
        Random random(test::seed, 14);
        std::size_t held = 0;
        for (int trial = 0; trial < 60; ++trial) {
            BallScene some = randomBalls(random, 2 + random.below(60)), all = some;
            BallRows few, every;
            some.fill(few);
            all.fill(every);
            const StepSettings settings = randomSettings(random, some.duration);
            std::vector<std::uint8_t> still(some.bodies.size(), 0);
            still[some.immobile()] = 1;
            for (int n = 0; n < 10; ++n) {
                std::vector<std::uint8_t> changed(still.size(), 0);
                for (std::uint32_t i = 0; i < some.immobile(); ++i) {
                    if (random.below(4) != 0) continue;
                    changed[i] = 1;
                    still[i] ^= 1;
                    for (BallScene* scene : {&some, &all})
                        setInverseMass(scene->bodies[i], still[i] != 0 ? 0 : 1 + 0.1 * i);
                }
                few.hold(still, changed, some.bodies);
                every.hold(still, std::vector<std::uint8_t>(still.size(), 1), all.bodies);
                QCOMPARE(few.heldContacts(), every.heldContacts());
                QCOMPARE(few.heldDeepest(), every.heldDeepest());
                some.refresh(few);
                all.refresh(every);
                step(few, some, settings, 2);
                step(every, all, settings, 2);
                QCOMPARE(few.activeGroups(), every.activeGroups());
                QVERIFY(std::ranges::equal(some.bodies, all.bodies, sameBits));
                held += few.heldContacts();
            }
        }
        QVERIFY(held > 100);
    }

    void groupsDependOnTheOrderOfPairsAlone() {
        Random random(test::seed, 6);
        for (int trial = 0; trial < 100; ++trial) {
            BallScene scene = randomBalls(random, 2 + random.below(100));
            BallRows rows;
            scene.fill(rows);
            const std::vector<std::uint32_t> expected = ObviousBalls(scene).sources();
            QVERIFY(seenIn(rows, scene.pairs.size()).sources == expected);
            // Elsewhere, with other speeds, after some steps: rows stay.
            scene.refresh(rows);
            step(rows, scene, {.duration = scene.duration}, 1);
            scene.refresh(rows);
            QVERIFY(seenIn(rows, scene.pairs.size()).sources == expected);
            for (BodyPlace& place : scene.places) place.position = arrayOf(test::uniformIn(random, 9));
            for (SolverBody& body : scene.bodies) body.velocity = arrayOf(test::uniformIn(random, 9));
            for (BallPair& pair : scene.pairs) pair.friction = pair.restitution = 0;
            scene.fill(rows);
            scene.refresh(rows);
            QVERIFY(seenIn(rows, scene.pairs.size()).sources == expected);
        }
    }
};

} // namespace carom

CAROM_TEST(ball_rows_order_test, carom::BallRowsOrderTest)
#include "ball_rows_order_test.moc"
