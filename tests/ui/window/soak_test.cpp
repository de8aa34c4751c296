// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/process_figures.h"
#include "tests/support/test_class.h"
#include "tests/support/whole_ide.h"

#include "ui/widgets/timeline.h"
#include "ui/window/live_preview.h"

#include <QSettings>

#include <malloc.h>

#include <algorithm>
#include <vector>

// A window that is worked in for hours holds no more at the end than after the first minutes. CAROM_SOAK says
// how many rounds; packaging/test soak takes hours.

using namespace carom;
using namespace carom::test;

namespace {

constexpr int warmUp = 10;          // rounds, in which fonts, pictures and lists come to their size
constexpr std::int64_t played = 60; // frames a round
constexpr double speed = 40;        // of real time: the frame that a pause meets differs by some tens

/// [KiB] that the program has asked for and not given back: what is in memory besides depends on the order in
/// which the allocator got it.
qint64 inUse() {
    const struct mallinfo2 figures = mallinfo2();
    return static_cast<qint64>((figures.uordblks + figures.hblkhd) / 1024);
}

/// [KiB] by which held grows over span rounds: the median, so that what is taken once does not count, however
/// late. Mesa's software renderer keeps 2.5 MiB from the first picture on that needs a second pool.
qint64 growthOver(std::size_t span, const std::vector<qint64>& held) {
    std::vector<qint64> growth;
    for (std::size_t at = span; at < held.size(); ++at) growth.push_back(held[at] - held[at - span]);
    const auto middle = growth.begin() + static_cast<std::ptrdiff_t>((growth.size() - 1) / 2);
    std::nth_element(growth.begin(), middle, growth.end());
    return *middle;
}

// [KiB]: what the lines of a round in the Output panel and an edit that can be undone take, and by how much
// rounds differ. The panel keeps 5,000 lines, two a round.
constexpr qint64 allowanceOfRound = 4, allowance = 128;
constexpr int keptLines = 2500;     // rounds
constexpr int reportInterval = 500; // rounds

void report(int round) {
    const Holdings held = holdingsOf(QStringLiteral("self"));
    qInfo("round %d: %lld KiB in use, %lld in memory, %lld files", round, static_cast<long long>(inUse()),
          static_cast<long long>(held.memory), static_cast<long long>(held.files));
}

} // namespace

class WindowSoakTest : public QObject {
    Q_OBJECT

    /// What somebody does all day: change a number, play, go back, save, undo.
    static void work(Ide& ide, int round) {
        ide.trigger(ActionId::Reset);
        const QByteArray text = ide.editor.bytes();
        const qsizetype at = text.indexOf("0,3,0") >= 0 ? text.indexOf("0,3,0") : text.indexOf("0,4,0");
        ide.editor.replaceRange({static_cast<std::uint32_t>(at), 5}, round % 2 == 0 ? "0,4,0" : "0,3,0");
        ide.bench.builds().hurry(); // nobody types on
        QTRY_VERIFY_WITH_TIMEOUT(ide.current(), longestWait);
        ide.simulation.setSpeed(speed);
        ide.trigger(ActionId::Play);
        QTRY_VERIFY_WITH_TIMEOUT(ide.frame > played, longestWait);
        ide.trigger(ActionId::Play);
        QTRY_VERIFY_WITH_TIMEOUT(!ide.simulation.isRunning(), longestWait);
        ide.simulation.seek(played / 2);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, played / 2, longestWait);
        ide.trigger(ActionId::Save);
    }

  private Q_SLOTS:
    void init() { QSettings().clear(); }

    void aDayOfWorkHoldsNoMoreThanItsFirstMinutes() {
        const int rounds = roundsOf("CAROM_SOAK", 40);
        NewIde ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        std::vector<qint64> held; // after each round that follows the first ones
        qint64 files = 0;
        for (int round = 0; round < rounds; ++round) {
            work(ide, round);
            if (QTest::currentTestFailed()) return;
            if (round % reportInterval == reportInterval - 1) report(round);
            if (round >= warmUp) held.push_back(inUse());
            if (round != warmUp) continue;
            report(round);
            files = holdingsOf(QStringLiteral("self")).files;
        }
        report(rounds);
        const std::size_t span = held.size() / 5;
        QVERIFY(span > 0 && held.front() > 0);
        QCOMPARE_LE(growthOver(span, held), allowance + allowanceOfRound * std::min<qint64>(span, keptLines));
        QVERIFY(holdingsOf(QStringLiteral("self")).files <= files);
    }
};

CAROM_TEST_WITH(IdeApplication, soak_test, WindowSoakTest)
#include "soak_test.moc"
