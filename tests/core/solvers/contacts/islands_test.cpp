// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/solvers/contacts/islands.h"

#include <QTest>

#include <algorithm>
#include <vector>

// Islands against a flood that spreads from body to body along whatever couples two members.

namespace carom {
namespace {

struct Case {
    Bodies bodies;
    std::vector<BodyIndex> members;
    std::vector<BodyPair> pairs, links;
    std::vector<std::uint8_t> isUsed; // empty: all

    bool isMember(BodyIndex body) const {
        return body != noBody && std::binary_search(members.begin(), members.end(), body);
    }
    bool uses(std::size_t pair) const { return isUsed.empty() || isUsed[pair] != 0; }
};

BodyPair drawPair(Random& random, std::size_t count) {
    const BodyIndex a = static_cast<BodyIndex>(random.below(count));
    const BodyIndex b = static_cast<BodyIndex>((a + 1 + random.below(count - 1)) % count);
    return {std::min(a, b), std::max(a, b)};
}

Case drawCase(Random& random) {
    Case drawn;
    Scene scene;
    const std::size_t count = 2 + random.below(40);
    for (std::size_t i = 0; i < count; ++i) {
        const bool isWall = random.below(6) == 0;
        scene.bodies.push_back(isWall ? test::wall(Vec3::UnitY(), 0) : test::sphere(1, 1, Vec3::Zero()));
        if (!isWall && random.below(5) != 0) drawn.members.push_back(static_cast<BodyIndex>(i));
    }
    drawn.bodies = bodiesOf(scene);
    for (std::size_t k = random.below(count); k > 0; --k)
        if (const BodyPair pair = drawPair(random, count); drawn.isMember(pair.a) || drawn.isMember(pair.b))
            drawn.pairs.push_back(pair);
    for (std::size_t k = random.below(count / 2 + 1); k > 0; --k) {
        BodyPair link = drawPair(random, count);
        if (random.below(3) == 0) link.b = noBody; // a spring that ends in the world
        drawn.links.push_back(link);
    }
    if (random.below(2) == 0)
        for (std::size_t i = 0; i < drawn.pairs.size(); ++i)
            drawn.isUsed.push_back(static_cast<std::uint8_t>(random.below(2)));
    return drawn;
}

/// By body: the smallest member it is coupled to, however indirectly.
std::vector<BodyIndex> floodOf(const Case& drawn) {
    std::vector<BodyIndex> lowest(drawn.bodies.count());
    for (BodyIndex i = 0; i < lowest.size(); ++i) lowest[i] = i;
    const auto couple = [&](const BodyPair& pair) {
        if (!drawn.isMember(pair.a) || !drawn.isMember(pair.b) || lowest[pair.a] == lowest[pair.b])
            return false;
        lowest[pair.a] = lowest[pair.b] = std::min(lowest[pair.a], lowest[pair.b]);
        return true;
    };
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = 0; i < drawn.pairs.size(); ++i)
            if (drawn.uses(i)) changed = couple(drawn.pairs[i]) || changed;
        for (const BodyPair& link : drawn.links) changed = couple(link) || changed;
    }
    return lowest;
}

/// Which of the couplings belong to the island of this first member, ascending.
std::vector<std::uint32_t> couplingsOf(const Case& drawn, const std::vector<BodyPair>& couplings,
                                       bool arePairs, const std::vector<BodyIndex>& lowest, BodyIndex first) {
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < couplings.size(); ++i) {
        if (arePairs && !drawn.uses(i)) continue;
        const auto [a, b] = couplings[i];
        if (drawn.isMember(a) ? lowest[a] == first : drawn.isMember(b) && lowest[b] == first)
            result.push_back(i);
    }
    return result;
}

template<class Value>
std::vector<Value> listOf(std::span<const Value> values) {
    return {values.begin(), values.end()};
}

} // namespace

class IslandsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void theyAreThoseOfAFlood() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 23);
        Islands islands;
        std::size_t largest = 0, most = 0;
        for (int trial = 0; trial < 2000; ++trial) {
            const Case drawn = drawCase(random);
            islands.find(drawn.bodies, drawn.members, drawn.pairs, drawn.links, drawn.isUsed);
            const std::vector<BodyIndex> lowest = floodOf(drawn);
            std::size_t found = 0;
            for (const BodyIndex first : drawn.members) {
                if (lowest[first] != first) continue;
                QVERIFY(found < islands.count());
                const Island island = islands[found++];
                std::vector<BodyIndex> bodies;
                for (const BodyIndex body : drawn.members)
                    if (lowest[body] == first) bodies.push_back(body);
                QCOMPARE(listOf(island.bodies), bodies);
                QCOMPARE(listOf(island.pairs), couplingsOf(drawn, drawn.pairs, true, lowest, first));
                QCOMPARE(listOf(island.links), couplingsOf(drawn, drawn.links, false, lowest, first));
                largest = std::max(largest, bodies.size());
            }
            QCOMPARE(islands.count(), found);
            most = std::max(most, found);
        }
        QVERIFY(largest > 10 && most > 10);
    }

    void ofNobodyThereAreNone() {
        const Bodies bodies = bodiesOf(test::sceneOf({test::wall(Vec3::UnitY(), 0)}));
        Islands islands;
        QCOMPARE(islands.count(), std::size_t{0});
        islands.find(bodies, {}, std::vector<BodyPair>{}, {});
        QCOMPARE(islands.count(), std::size_t{0});
    }

    void aWallJoinsNobodyAndASpringJoinsTwo() {
        const Bodies bodies =
            bodiesOf(test::sceneOf({test::wall(Vec3::UnitY(), 0), test::sphere(1, 1, Vec3(0, 1, 0)),
                                    test::sphere(1, 1, Vec3(3, 1, 0))}));
        const std::vector<BodyIndex> members{1, 2};
        const std::vector<BodyPair> onFloor{{0, 1}, {0, 2}}, spring{{1, 2}};
        Islands islands;
        islands.find(bodies, members, onFloor, {});
        QCOMPARE(islands.count(), std::size_t{2});
        islands.find(bodies, members, onFloor, spring);
        QCOMPARE(islands.count(), std::size_t{1});
    }
};

} // namespace carom

CAROM_TEST(islands_test, carom::IslandsTest)
#include "islands_test.moc"
