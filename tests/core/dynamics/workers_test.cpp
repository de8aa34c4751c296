// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/base/shared_loops.h"

#include <QThread>

#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

namespace carom::test {

// Elements are plain numbers: that two threads never write one, and that the caller sees what they wrote, is
// what the thread sanitizer holds.
class WorkersTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void rangesCoverEveryElementOnce_data() { addCases(); }
    void rangesCoverEveryElementOnce() {
        QFETCH(int, threads);
        QFETCH(int, count);
        Workers workers(threads);
        std::vector<int> calls(static_cast<std::size_t>(count), 0);
        for (int turn = 1; turn <= 20; ++turn) {
            workers.forRanges(calls.size(), [&calls](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) ++calls[i];
            });
            QCOMPARE(calls, std::vector<int>(calls.size(), turn));
        }
    }

    void everyElementIsCalledOnceAndNoTwoAtATimeByOneThread_data() { addCases(); }
    void everyElementIsCalledOnceAndNoTwoAtATimeByOneThread() {
        QFETCH(int, threads);
        QFETCH(int, count);
        Workers workers(threads);
        std::vector<int> calls(static_cast<std::size_t>(count), 0);
        std::vector<std::atomic<int>> busy(static_cast<std::size_t>(workers.threads()));
        std::atomic<int> wrong = 0;
        workers.forEach(calls.size(), [&](std::size_t thread, std::size_t i) {
            if (thread >= busy.size() || busy[thread].exchange(1) != 0) {
                ++wrong;
                return;
            }
            ++calls[i];
            busy[thread] = 0;
        });
        QCOMPARE(wrong.load(), 0);
        QCOMPARE(calls, std::vector<int>(calls.size(), 1));
    }

    void partsHaveAsManyElementsAsIsAskedFor() {
        Workers workers(2);
        std::atomic<int> few = 0, parts = 0;
        workers.forRanges(10'000, 100, [&](std::size_t begin, std::size_t end) {
            ++parts;
            if (end - begin < 50) ++few; // a part of up to 200 is halved
        });
        QCOMPARE(few.load(), 0);
        QVERIFY(parts <= 200);
        parts = 0;
        workers.forRanges(199, 100, [&](std::size_t, std::size_t) { ++parts; });
        QCOMPARE(parts.load(), 1);
    }

    void listsAreInTheOrderOfTheParts_data() { addCases(); }
    void listsAreInTheOrderOfTheParts() {
        QFETCH(int, threads);
        QFETCH(int, count);
        Workers workers(threads);
        std::vector<std::size_t> odd{7}, expected{7};
        for (std::size_t i = 1; i < static_cast<std::size_t>(count); i += 2) expected.push_back(i);
        workers.forLists(static_cast<std::size_t>(count), 10, odd,
                         [](std::size_t begin, std::size_t end, std::vector<std::size_t>& list) {
                             for (std::size_t i = begin; i < end; ++i)
                                 if (i % 2 == 1) list.push_back(i);
                         });
        QCOMPARE(odd, expected);
    }

    void listsThatAreKeptHoldWhatTheirPartsFindInOrder_data() { addCases(); }
    void listsThatAreKeptHoldWhatTheirPartsFindInOrder() {
        QFETCH(int, threads);
        QFETCH(int, count);
        Workers workers(threads);
        std::vector<std::vector<std::size_t>> kept;
        for (std::size_t turn = 1; turn <= 3; ++turn) {
            const std::size_t elements = static_cast<std::size_t>(count) / turn;
            const std::span<const std::vector<std::size_t>> lists = workers.forKeptLists(
                elements, 10, kept, [](std::size_t begin, std::size_t end, std::vector<std::size_t>& list) {
                    for (std::size_t i = begin; i < end; ++i) list.push_back(i);
                });
            std::vector<std::size_t> all, expected(elements);
            for (const std::vector<std::size_t>& list : lists)
                all.insert(all.end(), list.begin(), list.end());
            std::iota(expected.begin(), expected.end(), std::size_t{0});
            QCOMPARE(all, expected);
        }
    }

    // Sums of numbers of many sizes: any other order gives other bits.
    void termsAreAddedInOrder_data() { addCases(); }
    void termsAreAddedInOrder() {
        QFETCH(int, threads);
        QFETCH(int, count);
        Workers workers(threads);
        const auto termOf = [](std::size_t i) { return i % 3 == 0 ? 1e16 : 1.0 / static_cast<double>(i); };
        double expected = 0, sum = 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) expected += termOf(i);
        std::vector<double> kept;
        forTerms(static_cast<std::size_t>(count), 10, kept, workers, termOf,
                 [&sum](double term) { sum += term; });
        QCOMPARE(std::bit_cast<std::uint64_t>(sum), std::bit_cast<std::uint64_t>(expected));
    }

    void oneOfManyIsFound_data() { addCases(); }
    void oneOfManyIsFound() {
        QFETCH(int, threads);
        QFETCH(int, count);
        Workers workers(threads);
        const std::size_t elements = static_cast<std::size_t>(count);
        QVERIFY(!holdsForAny(elements, 10, workers, [](std::size_t) { return false; }));
        if (count == 0) return;
        for (const std::size_t one : {std::size_t{0}, elements / 2, elements - 1})
            QVERIFY(holdsForAny(elements, 10, workers, [one](std::size_t i) { return i == one; }));
    }

    void thereAreNeverFewerThanOneThread() {
        QCOMPARE(Workers(0).threads(), 1);
        QCOMPARE(Workers(-3).threads(), 1);
        QCOMPARE(Workers(1).threads(), 1);
        QVERIFY(Workers(1000).threads() <= 1000);
    }

    void whatAPartThrowsReachesTheCallerWhoMayGoOn() {
        Workers workers(2);
        for (std::size_t thrower = 0; thrower < 8; ++thrower) {
            std::vector<int> calls(8, 0);
            const auto count = [&](std::size_t, std::size_t i) { ++calls[i]; };
            QVERIFY_THROWS_EXCEPTION(std::length_error, workers.forEach(8, [&](std::size_t, std::size_t i) {
                if (i == thrower) throw std::length_error("a part");
            }));
            workers.forEach(8, count);
            QCOMPARE(calls, std::vector<int>(8, 1));
        }
    }

    void threadsThatFellAsleepWorkOn() {
        Workers workers(2);
        std::atomic<int> calls = 0;
        for (const int pause : {0, 5, 0, 20, 1}) { // [ms]
            QThread::msleep(static_cast<unsigned long>(pause));
            workers.forEach(100, [&](std::size_t, std::size_t) { ++calls; });
        }
        QCOMPARE(calls.load(), 500);
    }

    // Parts take a few microseconds. A loop of less has one.
    void loopsOverFewElementsAreNotShared() {
        QCOMPARE(Workers::enoughOf(1), std::size_t{2000});
        QCOMPARE(Workers::enoughOf(20), std::size_t{100});
        QCOMPARE(Workers::enoughOf(1e6), std::size_t{1});
    }

    void workersThatWereMovedWorkOn() {
        Workers first(2);
        Workers second(std::move(first));
        std::vector<int> numbers(100'000);
        std::iota(numbers.begin(), numbers.end(), 0);
        second.forRanges(numbers.size(), [&numbers](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) numbers[i] *= 2;
        });
        QCOMPARE(numbers.back(), 199'998);
    }

  private:
    static void addCases() {
        QTest::addColumn<int>("threads");
        QTest::addColumn<int>("count");
        for (const int threads : {1, 2, 5})
            for (const int count : {0, 1, 2, 1000, 5000, 100'000})
                QTest::addRow("%d threads, %d elements", threads, count) << threads << count;
    }
};

} // namespace carom::test

CAROM_TEST(workers_test, carom::test::WorkersTest)
#include "workers_test.moc"
