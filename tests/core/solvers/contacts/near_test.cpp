// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/solvers/contacts/near.h"

#include <QTest>

#include <cmath>
#include <vector>

// Lists of neighbours with their times in half the memory, against the times themselves.

namespace carom {

class NearTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void timesAreRoundedOutwards() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 91);
        constexpr double part = 0x1p-20; // no more than this part of a time is added to it
        for (int trial = 0; trial < 10'000; ++trial) {
            TimeSpan when;
            when.from = std::exp(random.uniform(-20, 5));
            when.until = when.from + std::exp(random.uniform(-20, 5));
            const Neighbour neighbour(7, when);
            QCOMPARE(neighbour.body, BodyIndex{7});
            QVERIFY(double{neighbour.from} <= when.from && double{neighbour.from} >= when.from * (1 - part));
            QVERIFY(double{neighbour.until} >= when.until &&
                    double{neighbour.until} <= when.until * (1 + part));
        }
        const Neighbour always(1, TimeSpan{0, INFINITY}), none(1, TimeSpan());
        QVERIFY(always.from == 0 && std::isinf(always.until));
        const std::vector<Neighbour> list{none};
        for (const BodyIndex body : Near(list, {0, INFINITY})) QFAIL(qPrintable(QString::number(body)));
    }

    void aListGivesThoseOfASpanInItsOrder() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 92);
        int given = 0, left = 0;
        for (int trial = 0; trial < 500; ++trial) {
            std::vector<Neighbour> list;
            for (std::uint64_t k = random.below(12); k > 0; --k) {
                const double from = random.uniform(), lasts = random.uniform(-0.1, 0.3);
                list.emplace_back(static_cast<BodyIndex>(random.below(1000)), TimeSpan{from, from + lasts});
            }
            const double begin = random.uniform();
            const TimeSpan when{begin, begin + random.uniform(0, 0.3)};
            std::vector<BodyIndex> expected, found;
            for (const Neighbour& neighbour : list)
                if (neighbour.from <= when.until && neighbour.until >= when.from)
                    expected.push_back(neighbour.body);
            for (const BodyIndex body : Near(list, when)) found.push_back(body);
            QCOMPARE(found, expected);
            given += static_cast<int>(found.size());
            left += static_cast<int>(list.size() - found.size());
        }
        QVERIFY(given > 500 && left > 500);
    }
};

} // namespace carom

CAROM_TEST(near_test, carom::NearTest)
#include "near_test.moc"
