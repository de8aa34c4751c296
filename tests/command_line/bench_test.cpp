// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/program.h"
#include "tests/support/test_class.h"

#include <QDir>
#include <QTest>

namespace carom::test {

class BenchTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void itWritesFiguresTracesAndASummary() {
        const QTemporaryDir folder;
        const QString results = folder.filePath("new/results");
        const Ended ended = carom({"bench", "--scene", "brownian", "pyramid", "-n", "30,15", "--broadphase",
                                   "all_pairs,sweep_and_sort", "--frames", "6", "-o", results});
        QCOMPARE(ended.exitCode, 0);
        const QStringList points = linesOf(QString::fromUtf8(readFile(results + "/performance.csv")));
        QCOMPARE(points.size(), 1 + 2 * 2 * 2);
        QVERIFY(points[1].startsWith("brownian,15,20,all_pairs,6,"));
        QVERIFY(points[8].startsWith("pyramid,30,37,sweep_and_sort,6,"));
        for (const QString& row : points) QCOMPARE(row.count(','), points[0].count(','));
        QCOMPARE(linesOf(QString::fromUtf8(readFile(results + "/trace.csv"))).size(), 1 + 2 * 6);
        QCOMPARE(QString::fromUtf8(readFile(results + "/summary.txt")), ended.out);
        QVERIFY(ended.out.contains("sweep_and_sort"));
    }

#ifdef CAROM_CHARTS
    void itDrawsTheFiguresOfTheReferenceWithoutADisplay() {
        const QTemporaryDir folder;
        const Ended ended =
            shell("unset DISPLAY WAYLAND_DISPLAY QT_QPA_PLATFORM; exec \"$carom\" bench --scene pyramid "
                  "-n 10,20,40 --frames 6 -o " +
                  folder.path());
        QVERIFY2(ended.exitCode == 0, qPrintable(ended.err));
        for (const char* name : {"frame_rate_pyramid", "naive_and_baraff_pyramid", "trace_all_pairs",
                                 "trace_first_frame", "trace_sweep_and_sort", "trace"}) {
            const QString path = folder.filePath(name);
            QVERIFY2(readFile(path + ".svg").contains("</svg>"), name);
            QVERIFY2(readFile(path + ".png").startsWith("\x89PNG"), name);
        }
        QVERIFY(readFile(folder.filePath("naive_and_baraff_pyramid.svg")).contains("parabola"));
    }
#endif

    // Two scenes in three parts, one of which is left with none: the same rows, but for the times.
    void scenesAreSharedByShards() {
        const QTemporaryDir folder;
        const auto bench = [](const QString& into, const QStringList& more) {
            return carom(
                QStringList{"bench", "--scene=pyramid,brownian", "-n", "10,20", "--frames=4", "-o", into} +
                more);
        };
        const auto rowsOf = [](const QString& file) {
            QStringList rows = linesOf(QString::fromUtf8(readFile(file)));
            for (QString& row : rows) row = row.split(',').mid(0, 4).join(',');
            return rows;
        };
        const QString parts = folder.filePath("parts"), whole = folder.filePath("whole");
        QCOMPARE(bench(whole, {}).exitCode, 0);
        for (const char* shard : {"--shard=1/3", "--shard=2/3", "--shard=3/3"})
            QCOMPARE(bench(parts, {shard}).exitCode, 0);
        QCOMPARE(carom({"bench", "--merge", parts}).exitCode, 0);
        for (const char* table : {"/performance.csv", "/trace.csv"}) {
            QVERIFY(rowsOf(whole + table).size() > 4);
            QCOMPARE(rowsOf(parts + table), rowsOf(whole + table));
        }
    }

    void aWrongWordIsNamedWithTheNearestRightOne() {
        const auto refused = [](const QStringList& words, const char* message) {
            const Ended ended = carom(QStringList{"bench"} + words);
            QCOMPARE(ended.exitCode, 2);
            QVERIFY2(ended.err.contains(message), qPrintable(ended.err));
        };
        refused({"--scene", "pyramids"}, "there is no generator `pyramids`; did you mean `pyramid`?");
        refused({"--broadphase", "sweep_and_sorts"}, "did you mean `sweep_and_sort`?");
        refused({"-n", "10,,20"}, "`-n` has ``; it must be a list of whole numbers from 1 on");
        refused({"-n", "0"}, "`-n` has `0`");
        refused({"--frames", "1"}, "`--frames`");
        refused({"pyramid"}, "scenes follow `--scene`");
    }

    void aFolderThatCannotBeMadeIsAFileError() {
        const Ended ended =
            carom({"bench", "--scene", "table", "-n", "1", "--frames", "2", "-o", "/dev/null/x"});
        QCOMPARE(ended.exitCode, 3);
        QVERIFY2(ended.err.contains("/dev/null/x"), qPrintable(ended.err));
    }

    void interruptedItWritesWhatItHas() {
        const QTemporaryDir folder;
        const QString results = folder.filePath("results");
        QProcess process;
        process.start(QStringLiteral(CAROM_PROGRAM),
                      {"bench", "--scene", "brownian", "-n", "2000", "--frames", "1000000", "-o", results});
        QVERIFY(process.waitForStarted(longestWait));
        QTRY_VERIFY_WITH_TIMEOUT(QDir(results).exists(), longestWait); // by then it catches signals
        process.terminate();
        const Ended ended = finish(process);
        QCOMPARE(ended.exitCode, 130);
        QVERIFY(readFile(results + "/summary.txt").contains("Stopped early"));
        QVERIFY(readFile(results + "/performance.csv").startsWith("scene,n,bodies,"));
    }
};

} // namespace carom::test

CAROM_TEST(bench_test, carom::test::BenchTest)
#include "bench_test.moc"
