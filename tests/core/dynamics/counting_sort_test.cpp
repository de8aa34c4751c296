// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/test_class.h"

#include "core/base/counting_sort.h"
#include "core/math/random.h"

#include <QTest>

#include <algorithm>
#include <utility>
#include <vector>

// Sorting by counting, by one thread and by several, against the library's stable sort.

namespace carom {

class CountingSortTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void itIsThatOfAStableSort_data() {
        QTest::addColumn<int>("threads");
        for (const int threads : {1, 2, 5}) QTest::addRow("%d threads", threads) << threads;
    }
    void itIsThatOfAStableSort() {
        QFETCH(int, threads);
        using Item = std::pair<std::size_t, std::size_t>; // its key, its number
        Random random(test::seed, 21);
        Workers workers(threads);
        CountingSort sort;
        for (const std::size_t count : {0, 1, 100, 2000, 30'000})
            for (const std::size_t keys : {1, 2, 300, 5000}) {
                std::vector<Item> items(count), sorted(count);
                for (std::size_t i = 0; i < count; ++i) items[i] = {random.below(keys), i};
                sort.sort(
                    count, keys, [&](std::size_t i, const auto& visit) { visit(items[i].first); },
                    [&](std::size_t i, std::size_t place) { sorted[place] = items[i]; }, workers);
                std::ranges::stable_sort(items, {}, &Item::first);
                QVERIFY(sorted == items);
                for (std::size_t key = 0; key < keys; ++key)
                    QCOMPARE(static_cast<std::ptrdiff_t>(sort.endOf(key)),
                             std::ranges::upper_bound(items, key, {}, &Item::first) - items.begin());
            }
    }
};

} // namespace carom

CAROM_TEST(counting_sort_test, carom::CountingSortTest)
#include "counting_sort_test.moc"
