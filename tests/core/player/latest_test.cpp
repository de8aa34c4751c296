// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/player/latest.h"

#include <thread>
#include <vector>

namespace carom::test {

class LatestTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void aValueIsTakenOnce() {
        Latest<int> slot;
        QVERIFY(!slot.take());
        slot.publish(1);
        slot.publish(2);
        QCOMPARE(slot.take(), std::optional(2));
        QVERIFY(!slot.take());
    }

    void betweenTwoThreadsValuesOnlyGrowNewerAndTheLastArrives() {
        constexpr int last = 100'000;
        Latest<std::vector<int>> slot; // something that can be seen half written
        std::jthread writer([&slot] {
            for (int value = 1; value <= last; ++value) slot.publish(std::vector<int>(3, value));
        });
        int newest = 0;
        while (newest < last) {
            const std::optional<std::vector<int>> taken = slot.take();
            if (!taken) {
                std::this_thread::yield();
                continue;
            }
            QCOMPARE(*taken, std::vector<int>(3, taken->front()));
            QVERIFY(taken->front() > newest);
            newest = taken->front();
        }
        QVERIFY(!slot.take());
    }
};

} // namespace carom::test

CAROM_TEST(latest_test, carom::test::LatestTest)
#include "latest_test.moc"
