// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/solvers/events/event_queue.h"

#include <QTest>

#include <cmath>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

// The calendar queue against a sorted set: the same events come out in the same order, whatever is put in,
// taken out and put off meanwhile, near, beyond the year, at one time and never.

namespace carom {
namespace {

constexpr auto lowestFirst = [](std::uint32_t i, std::uint32_t j) { return i < j; };
constexpr auto noPreview = [](std::uint32_t, bool) {};

/// The obvious queue beside the clever one.
class Queues {
  public:
    Queues(std::size_t count, double daysPerSecond) : records(count) {
        queue.restart(records, daysPerSecond, 0);
    }

    void put(std::uint32_t i, double pairTime, double otherTime) {
        records[i].pairTime = pairTime;
        records[i].otherTime = otherTime;
        records[i].other = i % 3 == 0 ? std::uint16_t{0} : EventRecord::crossing; // a wall
        queue.insert(records, i);
        const double time = std::min(pairTime, otherTime);
        if (time < never) sorted.insert(keyOf(i));
    }
    void take(std::uint32_t i) {
        queue.remove(records, i);
        sorted.erase(keyOf(i));
    }
    std::uint32_t earliest(double limit) { return queue.earliest(records, limit, lowestFirst, noPreview); }
    std::uint32_t expected(double limit) const {
        const bool isAny = !sorted.empty() && std::get<0>(*sorted.begin()) <= limit;
        return isAny ? std::get<2>(*sorted.begin()) : EventQueue::nobody;
    }

    std::vector<EventRecord> records;
    EventQueue queue;
    std::set<std::tuple<double, int, std::uint32_t>> sorted;

  private:
    /// Crossings, walls, pairs; each by number.
    std::tuple<double, int, std::uint32_t> keyOf(std::uint32_t i) const {
        const EventRecord& record = records[i];
        const int kind = record.collidesNext() ? 2 : record.other == EventRecord::crossing ? 0 : 1;
        return {record.earliest(), kind, i};
    }
};

/// Mostly a few days on, some at one time with others, some years on, some never.
double timeAfter(Random& random, double now) {
    const std::uint64_t kind = random.below(20);
    if (kind == 0) return never;
    if (kind == 1) return now + 1000 * random.uniform();
    const double wait = -std::log(1 - random.uniform());
    return kind < 8 ? std::ceil(8 * (now + wait)) / 8 : now + wait;
}

} // namespace

class EventQueueTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void eventsComeInTheOrderOfASortedSet_data() {
        QTest::addColumn<int>("count");
        QTest::addColumn<double>("daysPerSecond");
        QTest::newRow("one ball") << 1 << 1.0;
        QTest::newRow("two events a day") << 100 << 50.0;
        QTest::newRow("all on one day") << 100 << 1e-3;
        QTest::newRow("days that are mostly empty") << 40 << 1e4;
        QTest::newRow("a year of a second") << 20 << 64.0;
    }
    void eventsComeInTheOrderOfASortedSet() {
        QFETCH(int, count);
        QFETCH(double, daysPerSecond);
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, static_cast<std::uint64_t>(count));
        Queues queues(static_cast<std::size_t>(count), daysPerSecond);
        for (std::uint32_t i = 0; i < queues.records.size(); ++i)
            queues.put(i, timeAfter(random, 0), timeAfter(random, 0));
        double now = 0, limit = 0;
        int happened = 0;
        for (int turn = 0; turn < 20'000; ++turn) {
            const std::uint32_t next = queues.earliest(limit);
            QCOMPARE(next, queues.expected(limit));
            if (next == EventQueue::nobody) { // what is next lies behind the limit: move it
                now = limit;
                limit += 0.5 * random.uniform();
                continue;
            }
            now = queues.records[next].earliest();
            ++happened;
            const bool isMore =
                queues.sorted.size() > 1 && std::get<0>(*std::next(queues.sorted.begin())) <= limit;
            QVERIFY(!isMore || queues.queue.mayHaveMore(limit));
            // It and another one have new times, as after an impact.
            const std::uint32_t other = static_cast<std::uint32_t>(random.below(queues.records.size()));
            for (const std::uint32_t i : {next, other}) queues.take(i); // of one that is out nothing is taken
            queues.put(next, timeAfter(random, now), timeAfter(random, now));
            if (other != next) queues.put(other, timeAfter(random, now), timeAfter(random, now));
        }
        QVERIFY(happened > 10);
    }

    void whoIsSoonIsForeseenBeforeItIsDue() {
        Queues queues(1, 1);
        queues.put(0, 10.5, never); // day 10
        std::vector<bool> soon;
        QCOMPARE(queues.queue.earliest(queues.records, 20, lowestFirst,
                                       [&](std::uint32_t, bool isSoon) { soon.push_back(isSoon); }),
                 0U);
        QCOMPARE(soon, (std::vector<bool>{false, true}));
    }

    void ofEqualTimesTheOneComesThatIsSaidToBeBefore() {
        constexpr std::uint32_t count = 5;
        Queues queues(count, 1);
        for (std::uint32_t i = 0; i < count; ++i) queues.put(i, 0.5, never);
        const auto highestFirst = [](std::uint32_t i, std::uint32_t j) { return i > j; };
        for (std::uint32_t left = count; left > 0; --left) {
            QCOMPARE(queues.queue.earliest(queues.records, 1, highestFirst, noPreview), left - 1);
            QCOMPARE(queues.queue.mayHaveMore(0.75), left > 1);
            queues.take(left - 1);
        }
    }

    // 20,000 balls on as many tables start on their cloths at one time: each took a look at all others.
    void thousandsOfEventsAtOneTimeAreNotComparedAgainAndAgain() {
        constexpr std::uint32_t count = 2000, pairs = 100;
        Queues queues(count, 1);
        for (std::uint32_t i = 0; i < count; ++i)
            queues.put(i, i < pairs ? 0.5 : never, i < pairs ? never : 0.5);
        std::size_t compared = 0;
        const auto counted = [&](std::uint32_t i, std::uint32_t j) {
            ++compared;
            return i < j;
        };
        for (std::uint32_t left = count; left > 0; --left) {
            const std::uint32_t next = queues.queue.earliest(queues.records, 1, counted, noPreview);
            QCOMPARE(next, queues.expected(1));
            queues.take(next);
        }
        QVERIFY(compared <= std::size_t{pairs} * pairs); // of pairs alone nobody else knows the order
    }
};

} // namespace carom

CAROM_TEST(event_queue_test, carom::EventQueueTest)
#include "event_queue_test.moc"
