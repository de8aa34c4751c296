// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/csv.h"
#include "core/math/random.h"
#include "tests/support/process_figures.h"
#include "tests/support/program.h"
#include "tests/support/test_class.h"

#include <QDir>
#include <QElapsedTimer>
#include <QTest>

#include <algorithm>
#include <cstdint>

// The program is killed (SIGKILL) at random moments while it writes. What was there before, or the whole of
// what it was writing, must be found; of a study, whole rows. CAROM_KILLS says how often;
// packaging/test crash does it hundreds of times.

namespace carom::test {

namespace {

constexpr std::uint64_t seed = 20261122;
constexpr int mostTurns = 1000; // until one is killed in time

int kills() { return roundsOf("CAROM_KILLS", 4); }

std::size_t cellsIn(const QString& row) {
    const std::string text = row.toStdString();
    return csvSplit(text, ',').size();
}

/// Runs the program for so long, unless it ends before, and kills it; whether it was killed.
bool runAndKill(const QStringList& words, int milliseconds) {
    QProcess process;
    process.setStandardOutputFile(QProcess::nullDevice());
    process.setStandardErrorFile(QProcess::nullDevice());
    process.start(QStringLiteral(CAROM_PROGRAM), words);
    if (process.waitForFinished(milliseconds)) return false;
    process.kill();
    process.waitForFinished(longestWait);
    return true;
}

} // namespace

class KillTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void initTestCase() {
        qInfo("seed %llu, %d kills a test", static_cast<unsigned long long>(seed), kills());
    }

    void aFileIsFormattedOrAsItWas() {
        QByteArray before;
        for (int i = 0; i < 20'000; ++i) before += "sphere{radius 1 mass 1 centre 0,0,0}\n";
        const QTemporaryDir folder;
        const QString path = folder.filePath("large.sdl");
        writeFile(path, before);
        QElapsedTimer clock;
        clock.start();
        const QByteArray after = carom({"format", path}).out.toUtf8();
        const std::uint64_t longest =
            2 * static_cast<std::uint64_t>(clock.elapsed()) + 1; // half of them get done
        Random random(seed);
        int killed = 0, done = 0;
        for (int turn = 0; turn < kills() || (killed == 0 && turn < mostTurns); ++turn) {
            writeFile(path, before);
            killed +=
                runAndKill({"format", "--in-place", path}, static_cast<int>(random.below(longest))) ? 1 : 0;
            const QByteArray found = readFile(path);
            QVERIFY2(found == before || found == after, qPrintable(QString("turn %1").arg(turn)));
            done += found == after ? 1 : 0;
        }
        qInfo("%d were killed; %d found the file done", killed, done);
        QVERIFY(killed > 0);
    }

    void aStudyLeavesWholeRows_data() {
        QTest::addColumn<QStringList>("words");
        QTest::addColumn<QString>("file");
        QTest::newRow("accuracy") << QStringList{"study", "accuracy", "{}", "--runs=3", "--duration=.5"}
                                  << "accuracy.csv";
        QTest::newRow("stability") << QStringList{"study", "stability", "--column=exact"} << "stability.csv";
        QTest::newRow("bench") << QStringList{"bench", "--scene=pyramid", "-n", "10,20,40", "--frames=20"}
                               << "performance.csv";
    }
    void aStudyLeavesWholeRows() {
        QFETCH(QStringList, words);
        QFETCH(QString, file);
        const QTemporaryDir folder;
        const QString scene = folder.filePath("ball.sdl");
        writeFile(scene,
                  "wall { normal 0,1,0 toOrig 0 }\nsphere { radius .1 mass 1 centre 0,1,0 vel .5,0,0 }\n");
        words.replaceInStrings("{}", scene);
        Random random(seed);
        int killed = 0;
        qsizetype most = 0;
        for (int turn = 0; turn < kills() || (killed == 0 && turn < mostTurns); ++turn) {
            const QString out = folder.filePath(QString::number(turn));
            killed += runAndKill(words + QStringList{"-o", out}, static_cast<int>(random.below(700))) ? 1 : 0;
            if (!QFile::exists(out + "/" + file)) continue; // killed before its first row
            const QByteArray found = readFile(out + "/" + file);
            QVERIFY2(found.endsWith('\n'), found.constData());
            const QStringList rows = linesOf(QString::fromUtf8(found));
            for (const QString& row : rows) QCOMPARE(cellsIn(row), cellsIn(rows.first()));
            most = std::max(most, rows.size());
        }
        qInfo("%d were killed; up to %d rows were there", killed, static_cast<int>(most));
        QVERIFY(killed > 0);
    }

    void aTraceEndsWithAWholeRowOrInTheMiddleOfTheLast() {
        // A stream is written as it is computed: only its last row may be cut.
        const QTemporaryDir folder;
        Random random(seed);
        for (int turn = 0; turn < kills(); ++turn) {
            const QString path = folder.filePath("t.csv");
            runAndKill({"run", source("scenes/table.sdl"), "-n", "1000000", "--stats", path},
                       static_cast<int>(random.below(400)));
            QStringList rows = linesOf(QString::fromUtf8(readFile(path)));
            if (rows.size() < 3) continue;
            rows.removeLast();
            for (const QString& row : rows) QCOMPARE(cellsIn(row), cellsIn(rows.first()));
        }
    }
};

} // namespace carom::test

CAROM_TEST_WITH(QCoreApplication, kill_test, carom::test::KillTest)
#include "kill_test.moc"
