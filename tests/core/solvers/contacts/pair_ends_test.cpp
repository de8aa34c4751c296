// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/solvers/contacts/pair_ends.h"

#include <QTest>

#include <cstdint>
#include <set>
#include <vector>

// The pairs of each body, and sets of pairs.

namespace carom {

class PairEndsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // As a search through all pairs finds them, also where a body has none and where one of a pair is number
    // 0.
    void eachBodyHasItsPairs() {
        Random random(test::seed, 1);
        PairEnds ends;
        for (int trial = 0; trial < 100; ++trial) {
            const std::uint32_t bodies = 2 + static_cast<std::uint32_t>(random.below(20));
            std::vector<PairEnds::Ends> pairs(random.below(60));
            for (PairEnds::Ends& pair : pairs) {
                pair.first = static_cast<std::uint32_t>(random.below(bodies));
                pair.second =
                    (pair.first + 1 + static_cast<std::uint32_t>(random.below(bodies - 1))) % bodies;
            }
            ends.forget();
            QVERIFY(!ends.isKnown());
            ends.make(pairs.size(), bodies, [&](std::size_t pair) { return pairs[pair]; });
            QVERIFY(ends.isKnown());
            for (std::uint32_t body = 1; body < bodies; ++body) {
                std::vector<std::uint32_t> wanted;
                for (std::uint32_t pair = 0; pair < pairs.size(); ++pair)
                    if (pairs[pair].first == body || pairs[pair].second == body) wanted.push_back(pair);
                const auto found = ends.pairsOf(body);
                QCOMPARE(std::vector<std::uint32_t>(found.begin(), found.end()), wanted);
            }
        }
    }

    // A set is visited in ascending order, each pair once.
    void aSetAscends() {
        Random random(test::seed, 2);
        PairSet set;
        for (int trial = 0; trial < 100; ++trial) {
            const std::size_t pairs = 1 + random.below(300);
            set.clear(pairs);
            std::set<std::uint32_t> wanted;
            for (std::size_t k = random.below(80); k > 0; --k) {
                const std::uint32_t pair = static_cast<std::uint32_t>(random.below(pairs));
                set.add(pair);
                wanted.insert(pair);
            }
            std::vector<std::uint32_t> found;
            set.forEach([&](std::uint32_t pair) { found.push_back(pair); });
            QCOMPARE(found, std::vector<std::uint32_t>(wanted.begin(), wanted.end()));
        }
    }
};

} // namespace carom

CAROM_TEST(pair_ends_test, carom::PairEndsTest)
#include "pair_ends_test.moc"
