// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/solvers/contacts/pair_sort.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

// Sorting by pairs against the library's sort, and its work where one body has all pairs.

namespace carom {
namespace {

struct Numbered {
    BodyPair pair;
    int number = 0;
};

/// Counts how often one is written.
struct Counted {
    static inline long written = 0;
    BodyPair pair;

    Counted() = default;
    explicit Counted(BodyPair bodies) : pair(bodies) {}
    Counted(const Counted& other) : pair(other.pair) { ++written; }
    Counted& operator=(const Counted& other) {
        pair = other.pair;
        ++written;
        return *this;
    }
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
            std::size_t next = 0;
            for (BodyIndex first = 0; first < bodies; ++first)
                for (const Numbered& entry : sort.of(first, pairs)) {
                    QVERIFY(entry.pair.a == first);
                    QVERIFY(&entry == &pairs[next++]);
                }
            QCOMPARE(next, pairs.size());
        }
    }

    // A floor under n bodies whose pairs come in several ascending runs, as blocks of islands give them.
    void theWorkForAFloorGrowsWithItsPairs() {
        constexpr BodyIndex bodies = 4097, runs = 8;
        std::vector<Counted> pairs;
        for (BodyIndex run = 0; run < runs; ++run)
            for (BodyIndex b = runs - run; b < bodies; b += runs) pairs.emplace_back(BodyPair{0, b});
        PairSort<Counted> sort;
        Counted::written = 0;
        sort.sort(pairs, bodies);
        for (BodyIndex i = 0; i + 1 < bodies; ++i) QVERIFY((pairs[i].pair == BodyPair{0, i + 1}));
        const double n = static_cast<double>(pairs.size());
        QVERIFY2(static_cast<double>(Counted::written) < 4 * n * std::log2(n),
                 qPrintable(QString::number(Counted::written)));
    }
};

} // namespace carom

CAROM_TEST(pair_sort_test, carom::PairSortTest)
#include "pair_sort_test.moc"
