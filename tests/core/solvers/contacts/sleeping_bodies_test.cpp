// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/solvers/contacts/sleeping_bodies.h"

#include <QTest>

#include <algorithm>
#include <vector>

// Islands put to sleep and woken, against lists that say of every body whether it rests: contacts follow
// their bodies, none is lost, none is doubled.

namespace carom {
namespace {

constexpr BodyIndex islandSize = 3, islandCount = 8;
constexpr BodyIndex bodyCount = 1 + islandSize * islandCount; // the floor first

Bodies stacks() {
    Scene scene;
    scene.bodies.push_back(test::wall(Vec3::UnitY(), 0));
    for (BodyIndex i = 1; i < bodyCount; ++i) scene.bodies.push_back(test::sphere(1, i, Vec3::Zero()));
    return bodiesOf(scene);
}

/// The bodies of an island are a stack: the first stands on the floor.
std::vector<BodyIndex> islandOf(BodyIndex island) {
    std::vector<BodyIndex> bodies;
    for (BodyIndex k = 0; k < islandSize; ++k) bodies.push_back(1 + island * islandSize + k);
    return bodies;
}

double overlapOf(BodyIndex a, BodyIndex b) { return 1e-3 * ((7 * a + 11 * b) % 29); } // [m], in no order

ContactSet contactsOfAll() {
    std::vector<BodyPair> pairs;
    for (BodyIndex island = 0; island < islandCount; ++island) {
        const std::vector<BodyIndex> bodies = islandOf(island);
        pairs.push_back({0, bodies[0]});
        for (BodyIndex k = 1; k < islandSize; ++k) pairs.push_back({bodies[k - 1], bodies[k]});
    }
    std::sort(pairs.begin(), pairs.end());
    ContactSet set;
    for (const BodyPair& bodies : pairs) {
        ContactPair pair;
        pair.a = bodies.a;
        pair.b = bodies.b;
        std::vector<ContactConstraint> points(1 + (bodies.a + bodies.b) % 4);
        for (ContactConstraint& point : points) point.separation = -overlapOf(bodies.a, bodies.b);
        set.append(pair, points);
    }
    return set;
}

/// The set has the pairs of `all` for which `belongs`, in their order, each with its points.
template<class Belongs>
bool isPartOf(const ContactSet& all, const ContactSet& set, const Belongs& belongs) {
    std::size_t next = 0;
    for (const ContactPair& pair : all.pairs) {
        if (!belongs(pair.b)) continue; // b of every pair is mobile
        if (next == set.pairs.size()) return false;
        const ContactPair& found = set.pairs[next++];
        if (!(found.bodies() == pair.bodies()) || found.count != pair.count) return false;
        for (const ContactConstraint& point : set.pointsOf(found))
            if (point.separation != -overlapOf(pair.a, pair.b)) return false;
    }
    return next == set.pairs.size();
}

} // namespace

class SleepingBodiesTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void contactsFollowTheirBodiesToRestAndBack() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 7);
        const Bodies bodies = stacks();
        const ContactSet all = contactsOfAll();
        ContactSet moving = all;
        SleepingBodies sleeping(bodyCount);
        std::vector<bool> isAsleep(islandCount, false);
        const auto shouldSleep = [&](BodyIndex body) { return isAsleep[(body - 1) / islandSize]; };
        for (int turn = 0; turn < 500; ++turn) {
            for (BodyIndex island = 0; island < islandCount; ++island) {
                if (random.below(4) != 0) continue;
                const std::vector<BodyIndex> members = islandOf(island);
                if (isAsleep[island]) {
                    std::vector<BodyIndex> woken{bodyCount};                 // what is there stays
                    sleeping.wake(members[random.below(islandSize)], woken); // whoever is touched wakes all
                    std::sort(woken.begin(), woken.end());
                    std::vector<BodyIndex> expected = members;
                    expected.push_back(bodyCount);
                    QCOMPARE(woken, expected);
                } else {
                    sleeping.putToSleep(members);
                }
                isAsleep[island] = !isAsleep[island];
            }
            sleeping.exchange(bodies, moving);
            std::vector<BodyIndex> expected;
            double deepest = 0;
            for (BodyIndex body = 1; body < bodyCount; ++body) {
                QCOMPARE(sleeping.isAsleep(body), shouldSleep(body));
                if (shouldSleep(body)) expected.push_back(body);
            }
            for (const ContactPair& pair : all.pairs)
                if (shouldSleep(pair.b)) deepest = std::max(deepest, overlapOf(pair.a, pair.b));
            QCOMPARE(std::vector<BodyIndex>(sleeping.bodies().begin(), sleeping.bodies().end()), expected);
            QCOMPARE(sleeping.deepest(), deepest);
            QVERIFY(isPartOf(all, sleeping.contacts(), shouldSleep));
            QVERIFY(isPartOf(all, moving, [&](BodyIndex body) { return !shouldSleep(body); }));
            QVERIFY(isPartOf(all, merged(sleeping.contacts(), moving), [](BodyIndex) { return true; }));
        }
    }

    void whoDoesNotRestWakesNobody() {
        SleepingBodies sleeping(bodyCount);
        sleeping.putToSleep(islandOf(0));
        std::vector<BodyIndex> woken;
        sleeping.wake(islandOf(1).front(), woken);
        QVERIFY(woken.empty());
        QVERIFY(sleeping.isAsleep(islandOf(0).front()));
    }

    void theFloorBearsTheWeightOfWhatRests() {
        const Bodies bodies = stacks();
        ContactSet moving = contactsOfAll();
        SleepingBodies sleeping(bodyCount);
        sleeping.putToSleep(islandOf(2)); // masses 7, 8 and 9 kg
        sleeping.exchange(bodies, moving);
        Ledger ledger;
        sleeping.record(bodies, State{}, Vec3(0, -10, 0), 0.5, ledger);
        QCOMPARE(ledger[LedgerAccount::Gravity].momentum.y(), -120.0);
        QCOMPARE(ledger[LedgerAccount::Contact].momentum.y(), 120.0);
    }

    // f = k (l - l₀) upwards on the one that hangs; springs between bodies that sleep give nothing together.
    void aSpringBearsItsPartOfTheWeight() {
        Scene scene = test::sceneOf({test::sphere(1, 7, Vec3(0, 3, 0)), test::sphere(1, 8, Vec3(0, 0, 0))});
        Spring hook, between;
        hook.to = 0;
        hook.fromAt = Vec3(0, 5, 0);
        hook.stiffness = 50;
        hook.length = 0.5;
        between.from = 0;
        between.to = 1;
        between.stiffness = 10;
        between.length = 1;
        scene.springs = {hook, between};
        Bodies bodies = bodiesOf(scene);
        bodies.springs = springsOf(scene);
        SleepingBodies sleeping(2);
        sleeping.putToSleep(std::vector<BodyIndex>{0, 1});
        Ledger ledger;
        ContactSet moving;
        sleeping.exchange(bodies, moving);
        sleeping.record(bodies, initialStateOf(scene), Vec3(0, -10, 0), 0.5, ledger);
        QCOMPARE(ledger[LedgerAccount::Gravity].momentum.y(), -75.0);
        QCOMPARE(ledger[LedgerAccount::Spring].momentum.y(), 0.5 * 50 * 1.5);
        QCOMPARE(ledger[LedgerAccount::Contact].momentum.y(), 75.0 - 0.5 * 50 * 1.5);
    }
};

} // namespace carom

CAROM_TEST(sleeping_bodies_test, carom::SleepingBodiesTest)
#include "sleeping_bodies_test.moc"
