// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/random.h"
#include "core/study/shard.h"

#include "tests/support/test_class.h"

#include <QTest>

#include <algorithm>

// Lists cut into parts of equal work.

namespace carom {

class ShardTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aShardIsWrittenAsPartAndNumber() {
        QCOMPARE(shardIn("2/8").value(), (Shard{2, 8}));
        QCOMPARE(textOf(Shard{2, 8}), std::string("2/8"));
        for (const char* wrong : {"", "2", "0/8", "9/8", "2/", "/8", "2/0", "-1/3", "1/2/3", "1/999999999"})
            QVERIFY2(!shardIn(wrong), wrong);
    }

    // 12 of work for three: the item of 4 is one part, and so are the four of 1 before it.
    void partsAreOfEqualWorkNotOfEqualNumber() {
        const std::vector<double> weights = {1, 1, 1, 1, 4, 2, 2};
        QCOMPARE(stretchOf({1, 3}, weights), (ItemRange{0, 4}));
        QCOMPARE(stretchOf({2, 3}, weights), (ItemRange{4, 5}));
        QCOMPARE(stretchOf({3, 3}, weights), (ItemRange{5, 7}));
    }

    // Each item in exactly one part, parts in order, no part off the mean by more than the heaviest item.
    void partsCoverTheListOnce() {
        for (std::uint64_t seed = 1; seed <= 50; ++seed) {
            Random random(seed);
            std::vector<double> weights(random.below(200));
            double total = 0, heaviest = 0;
            for (double& weight : weights) {
                weight = random.uniform(0.1, 5);
                total += weight;
                heaviest = std::max(heaviest, weight);
            }
            for (const int count : {1, 2, 3, 8, 31}) {
                std::size_t next = 0, nextEqual = 0;
                for (int number = 1; number <= count; ++number) {
                    const ItemRange part = stretchOf({number, count}, weights);
                    if (part.count() > 0) QCOMPARE(part.first, next);
                    next = std::max(next, part.end);
                    double work = 0;
                    for (std::size_t i = part.first; i < part.end; ++i) work += weights[i];
                    QVERIFY2(std::abs(work - total / count) <= heaviest * (1 + 1e-9) || weights.empty(),
                             qPrintable(QString("seed %1, part %2 of %3").arg(seed).arg(number).arg(count)));
                    const ItemRange equal = stretchOf({number, count}, weights.size());
                    QCOMPARE(equal.first, nextEqual);
                    nextEqual = equal.end;
                }
                QCOMPARE(next, weights.size());
                QCOMPARE(nextEqual, weights.size());
            }
        }
    }
};

} // namespace carom

CAROM_TEST(shard_test, carom::ShardTest)
#include "shard_test.moc"
