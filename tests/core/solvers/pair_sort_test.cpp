// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/solvers/pair_sort.h"

#include <QTest>

#include <algorithm>
#include <set>
#include <vector>

// Sorting by pairs against the library's sort.

namespace carom {
namespace {

struct Numbered {
    BodyPair pair;
    int number = 0;
};

} // namespace

class PairSortTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void pairsAscendAndKeepWhatTheyCarry() {
        Random random(test::seed, 11);
        PairSort<Numbered> sort;
        for (int trial = 0; trial < 300; ++trial) {
            const std::uint32_t bodies = 2 + static_cast<std::uint32_t>(random.below(60));
            std::set<BodyPair> chosen;
            std::vector<Numbered> pairs;
            for (std::size_t k = random.below(400); k > 0; --k) {
                const BodyIndex a = static_cast<BodyIndex>(random.below(bodies));
                const BodyIndex b = static_cast<BodyIndex>(random.below(bodies));
                const BodyPair pair{std::min(a, b), std::max(a, b)};
                if (a != b && chosen.insert(pair).second) pairs.push_back({pair, static_cast<int>(k)});
            }
            std::vector<Numbered> expected = pairs;
            std::sort(expected.begin(), expected.end(),
                      [](const Numbered& one, const Numbered& other) { return one.pair < other.pair; });
            sort.sort(pairs, bodies);
            QCOMPARE(pairs.size(), expected.size());
            for (std::size_t i = 0; i < pairs.size(); ++i)
                QVERIFY(pairs[i].pair == expected[i].pair && pairs[i].number == expected[i].number);
        }
    }
};

} // namespace carom

CAROM_TEST(pair_sort_test, carom::PairSortTest)
#include "pair_sort_test.moc"
