// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/player/sample_queue.h"

#include <thread>

namespace carom::test {

class SampleQueueTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void anotherRunForgetsWhatWasNotTakenOfTheOneBefore() {
        SampleQueue queue;
        queue.push(1, frame(1));
        queue.push(2, frame(7));
        const SampleQueue::Batch batch = queue.takeAll();
        QCOMPARE(batch.run, std::uint64_t{2});
        QCOMPARE(batch.frames.size(), std::size_t{1});
        QCOMPARE(batch.frames.front().frame, std::int64_t{7});
        QVERIFY(queue.takeAll().frames.empty());
    }

    void betweenTwoThreadsNothingIsLostAndTheOrderStays() {
        constexpr std::int64_t last = 100'000;
        SampleQueue queue;
        std::jthread writer([&queue] {
            for (std::int64_t number = 1; number <= last; ++number) queue.push(1, frame(number));
        });
        std::int64_t expected = 1;
        while (expected <= last) {
            const SampleQueue::Batch batch = queue.takeAll();
            if (batch.frames.empty()) std::this_thread::yield();
            for (const FrameStatistics& taken : batch.frames) QCOMPARE(taken.frame, expected++);
        }
    }

  private:
    static FrameStatistics frame(std::int64_t number) {
        FrameStatistics statistics;
        statistics.frame = number;
        return statistics;
    }
};

} // namespace carom::test

CAROM_TEST(sample_queue_test, carom::test::SampleQueueTest)
#include "sample_queue_test.moc"
