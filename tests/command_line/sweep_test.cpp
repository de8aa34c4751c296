// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/failing_files.h"
#include "tests/support/program.h"
#include "tests/support/test_class.h"

#include <QDir>
#include <QTest>

#include <cerrno>
#include <csignal>

// `carom sweep`: its files are the same bytes whoever makes the runs, and nothing that was computed is lost.

namespace carom::test {

namespace {

const QByteArray fallingBall = "wall { normal 0, 1, 0 toOrig 0 }\n"
                               "sphere ball { radius 0.1 mass 1 centre 0, 1, 0 vel 0.5, 0, 0 }\n"
                               "simulation { duration 0.5 }\n";

/// A table without its last column, the seconds, which alone may differ.
QString withoutSeconds(const QString& path) {
    QString rows;
    for (const QString& line : linesOf(QString::fromUtf8(readFile(path))))
        rows += line.section(',', 0, -2) + '\n';
    return rows;
}

} // namespace

class SweepCommandTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void init() {
        m_folder = std::make_unique<QTemporaryDir>();
        writeFile(scene(), fallingBall);
    }

    void itWritesTableSummaryAndWhatTheyAreOf() {
        const Ended ended = sweep("out", {});
        QVERIFY2(ended.exitCode == 0, qPrintable(ended.err));
        QVERIFY2(ended.out.startsWith("21 runs: ") && ended.out.contains("runs an hour"),
                 qPrintable(ended.out));
        const QStringList rows = linesOf(QString::fromUtf8(readFile(in("out/sweep.csv"))));
        QCOMPARE(rows.size(), 22);
        QCOMPARE(rows[0], QString("run,ball.vel.x,simulation.substeps,final x of ball,max speed of ball,"
                                  "outcome,frames,state_hash,work,seconds"));
        QVERIFY(rows[21].startsWith("20,4,8,2"));
        QCOMPARE(linesOf(QString::fromUtf8(readFile(in("out/summary.csv")))).size(), 1 + 2 * 21);
        QCOMPARE(QString::fromUtf8(readFile(in("out/summary.txt"))), ended.out);
        QCOMPARE(readFile(in("out/scene.sdl")), fallingBall);
        QVERIFY(!QFile::exists(in("out/sweep.csv.part")));
#ifdef CAROM_CHARTS
        for (const char* name : {"out/sweep-1.svg", "out/sweep-1.png", "out/sweep-2.svg"})
            QVERIFY2(QFile(in(name)).size() > 1000, name);
#endif
    }

    void threadsAndShardsGiveTheSameBytes() {
        QCOMPARE(sweep("one", {"--threads=1"}).exitCode, 0);
        QCOMPARE(sweep("two", {"--threads=2"}).exitCode, 0);
        const QString table = withoutSeconds(in("one/sweep.csv"));
        QCOMPARE(withoutSeconds(in("two/sweep.csv")), table);
        QCOMPARE(readFile(in("two/summary.csv")), readFile(in("one/summary.csv")));
        for (const int count : {1, 3, 8}) {
            const QString folder = QString("shards%1").arg(count);
            for (int number = count; number >= 1; --number)
                QCOMPARE(sweep(folder, {QString("--shard=%1/%2").arg(number).arg(count)}).exitCode, 0);
            const Ended merged = carom({"sweep", "--merge", in(folder)});
            QVERIFY2(merged.exitCode == 0, qPrintable(merged.err));
            QCOMPARE(withoutSeconds(in(folder + "/sweep.csv")), table);
            QCOMPARE(readFile(in(folder + "/summary.csv")), readFile(in("one/summary.csv")));
        }
    }

    void whatIsMissingInAMergeIsNamed() {
        for (const char* shard : {"--shard=1/3", "--shard=3/3"}) QCOMPARE(sweep("gap", {shard}).exitCode, 0);
        const Ended merged = carom({"sweep", "--merge", in("gap")});
        QCOMPARE(merged.exitCode, 3);
        const qsizetype there = linesOf(QString::fromUtf8(readFile(in("gap/sweep.csv")))).size() - 1;
        QVERIFY2(there > 0 && merged.out.startsWith(QString("%1 runs of 21").arg(there)),
                 qPrintable(merged.out));
        QVERIFY2(merged.err.contains("these runs are missing: ") && merged.err.contains(" to "),
                 qPrintable(merged.err));
        QCOMPARE(carom({"sweep", "--merge", m_folder->path()}).exitCode, 2);
    }

    void whatIsNoTableOfTheSweepIsNotMerged() {
        QCOMPARE(sweep("mixed", {"--shard=1/3"}).exitCode, 0);
        writeFile(in("mixed/shard-9.csv"), "run,other,columns\n7,1,2\n");
        const Ended merged = carom({"sweep", "--merge", in("mixed")});
        QCOMPARE(merged.exitCode, 3);
        QVERIFY2(merged.err.contains("shard-9.csv` is no table of this sweep: it has other columns"),
                 qPrintable(merged.err));
        QVERIFY(!QFile::exists(in("mixed/sweep.csv")));
    }

    // Long runs: the signal meets the first of them.
    void anInterruptedSweepGoesOnToTheSameBytes() {
        QCOMPARE(sweep("whole", {"--frames=3000"}).exitCode, 0);
        QProcess process;
        process.start(QStringLiteral(CAROM_PROGRAM), words("cut", {"--frames=3000", "--threads=2"}));
        QVERIFY(process.waitForStarted(longestWait));
        const QString part = in("cut/sweep.csv.part");
        QTRY_VERIFY_WITH_TIMEOUT(linesOf(QString::fromUtf8(readFile(part))).size() > 2, longestWait);
        ::kill(static_cast<pid_t>(process.processId()), SIGINT);
        const Ended first = finish(process);
        if (first.exitCode == 130) { // else it was done before the signal came
            QVERIFY2(first.err.contains("are kept; `--resume` goes on"), qPrintable(first.err));
            const QByteArray kept = readFile(part);
            writeFile(part, kept + "19,4,8,12.3"); // a row that was being written when the machine stopped
        }
        const Ended second = sweep("cut", {"--frames=3000", "--resume"});
        QVERIFY2(second.exitCode == 0, qPrintable(second.err));
        QCOMPARE(withoutSeconds(in("cut/sweep.csv")), withoutSeconds(in("whole/sweep.csv")));
        QCOMPARE(readFile(in("cut/summary.csv")), readFile(in("whole/summary.csv")));
    }

    // A machine was taken for dead: its part is gone on with elsewhere, and then it writes on.
    void whoWritesOnDisturbsNobody() {
        QCOMPARE(sweep("calm", {"--frames=3000", "--shard=1/1"}).exitCode, 0);
        QProcess dead;
        dead.start(QStringLiteral(CAROM_PROGRAM),
                   words("both", {"--frames=3000", "--shard=1/1", "--threads=1"}));
        QVERIFY(dead.waitForStarted(longestWait));
        const QString part = in("both/shard-1.csv.part");
        QTRY_VERIFY_WITH_TIMEOUT(linesOf(QString::fromUtf8(readFile(part))).size() > 2, longestWait);
        ::kill(static_cast<pid_t>(dead.processId()), SIGSTOP);
        const Ended other = sweep("both", {"--frames=3000", "--shard=1/1", "--resume"});
        ::kill(static_cast<pid_t>(dead.processId()), SIGCONT);
        const QString table = withoutSeconds(in("both/shard-1.csv"));
        QCOMPARE(other.exitCode, 0);
        QCOMPARE(table, withoutSeconds(in("calm/shard-1.csv")));
        QCOMPARE(finish(dead).exitCode, 0);
        QCOMPARE(withoutSeconds(in("both/shard-1.csv")), table);
        QCOMPARE(QDir(in("both")).entryList(QDir::Files, QDir::Name),
                 (QStringList{"scene.sdl", "shard-1.csv", "sweep.txt"}));
    }

    // Rows that are there are not made again: the seconds of the first, which no run could have, stay.
    void resumeMakesOnlyWhatIsMissing() {
        QCOMPARE(sweep("again", {}).exitCode, 0);
        QStringList rows = linesOf(QString::fromUtf8(readFile(in("again/sweep.csv"))));
        rows[1] = rows[1].section(',', 0, -2) + ",77.5";
        rows.removeAt(12);
        writeFile(in("again/sweep.csv.part"), (rows.join('\n') + '\n').toUtf8());
        QVERIFY(QFile::remove(in("again/sweep.csv")));
        QCOMPARE(sweep("again", {"--resume"}).exitCode, 0);
        const QStringList after = linesOf(QString::fromUtf8(readFile(in("again/sweep.csv"))));
        QCOMPARE(after.size(), 22);
        QCOMPARE(after[1], rows[1]);
        QVERIFY(after[12].startsWith("11,"));
        // Done already: nothing is made.
        const Ended done = sweep("again", {"--resume"});
        QCOMPARE(done.exitCode, 0);
        QCOMPARE(linesOf(QString::fromUtf8(readFile(in("again/sweep.csv")))), after);
    }

    // The disk is full from the sixth write on: two files, the columns and two rows are there, and half a
    // row.
    void aFullDiskKeepsTheRowsThatAreThere() {
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        environment.insert("LD_PRELOAD", CAROM_FAILING_FILES);
        environment.insert(failingFilesVariable, QString("write 6 %1 %2").arg(ENOSPC).arg(in("full")));
        const Ended full = carom(words("full", {"--threads=1"}), environment);
        QCOMPARE(full.exitCode, 3);
        QVERIFY2(full.err.contains("sweep.csv.part") && full.err.contains("No space left on device"),
                 qPrintable(full.err));
        const QStringList kept = linesOf(QString::fromUtf8(readFile(in("full/sweep.csv.part"))));
        QVERIFY2(kept.size() == 3 || kept.size() == 4, qPrintable(kept.join('\n')));
        QCOMPARE(sweep("full", {"--resume"}).exitCode, 0);
        QCOMPARE(sweep("one", {}).exitCode, 0);
        QCOMPARE(withoutSeconds(in("full/sweep.csv")), withoutSeconds(in("one/sweep.csv")));
    }

    void aFolderTakesOneSweepOnly() {
        QCOMPARE(sweep("own", {}).exitCode, 0);
        const QByteArray before = readFile(in("own/sweep.csv"));
        const Ended other = sweep("own", {"--frames=7", "--resume"});
        QCOMPARE(other.exitCode, 2);
        QVERIFY2(other.err.contains("has the runs of another sweep"), qPrintable(other.err));
        QCOMPARE(readFile(in("own/sweep.csv")), before);
    }

    void wrongUseSaysWhatWouldBeRight() {
        const std::pair<QStringList, const char*> rows[] = {
            {{}, "missing SCENE (or `--generate`)"},
            {{scene(), "--generate=pile"}, "`--generate` makes the scene"},
            {{scene(), "--measure=final x of ball", "--vary=bal.vel.x=1,2"}, "did you mean `ball`?"},
            {{scene(), "--vary=ball.vel.x=1,2"}, "there is nothing to measure"},
            {{scene(), "--shard=0/4"}, "it must be a part and a number of parts such as `3/8`"},
            {{"--generate=pil --n 4", "--measure=max speed"}, "did you mean `pile`?"},
            {{scene(), "--merge", m_folder->path()}, "`--merge` takes no scene"}};
        for (const auto& [given, message] : rows) {
            QStringList line = QStringList{"sweep"} + given;
            if (!given.contains("--merge")) line += {"-o", in("wrong")};
            const Ended ended = carom(line);
            QCOMPARE(ended.exitCode, 2);
            QVERIFY2(ended.err.contains(message), qPrintable(ended.err));
        }
        QVERIFY(!QFile::exists(in("wrong")));
        QCOMPARE(carom({"sweep", scene(), "--measure=max speed"}).exitCode, 2);
    }

    // 317² points are more than a chart can show, and a part of them would look like the whole. The rows of
    // all but the first are made of its row.
    void ofTooManyPointsThereIsNoChart() {
        const QStringList words{"sweep",
                                scene(),
                                "--frames=1",
                                "--vary=ball.vel.x=0:1:317",
                                "-o",
                                in("many"),
                                "--vary=ball.vel.z=0:1:317",
                                "--measure=final x of ball"};
        QCOMPARE(carom(words + QStringList{"--shard=1/100000"}).exitCode, 0);
        const QStringList tables = QDir(in("many")).entryList({"*.csv"});
        QCOMPARE(tables.size(), 1);
        const QStringList rows = linesOf(QString::fromUtf8(readFile(in("many/" + tables[0]))));
        const QByteArray behindRun = rows[1].mid(rows[1].indexOf(',')).toUtf8() + '\n';
        QByteArray table = rows[0].toUtf8() + '\n';
        for (int run = 0; run < 317 * 317; ++run) table += QByteArray::number(run) + behindRun;
        writeFile(in("many/sweep.csv"), table);
        const Ended ended = carom(words + QStringList{"--resume"});
        QVERIFY2(ended.exitCode == 0, qPrintable(ended.err));
        QVERIFY2(ended.out.contains("There is no chart of more than 100000 points."), qPrintable(ended.out));
        QCOMPARE(readFile(in("many/sweep.csv")), table);
        QCOMPARE(linesOf(QString::fromUtf8(readFile(in("many/summary.csv")))).size(), 1 + 317 * 317);
        QVERIFY(!QFile::exists(in("many/sweep-1.svg")));
    }

    void aSceneCanSayItsOwnSweep() {
        writeFile(in("own.sdl"),
                  fallingBall + "sweep { vary \"ball.vel.x=1:3:3\" measure \"final x of ball\" }\n");
        QCOMPARE(carom({"sweep", in("own.sdl"), "-o", in("declared")}).exitCode, 0);
        QCOMPARE(linesOf(QString::fromUtf8(readFile(in("declared/sweep.csv")))).size(), 4);
        // The command line wins.
        QCOMPARE(carom({"sweep", in("own.sdl"), "--vary=ball.vel.x=1,2", "-o", in("other")}).exitCode, 0);
        QCOMPARE(linesOf(QString::fromUtf8(readFile(in("other/sweep.csv")))).size(), 3);
        // Without the declaration nothing is measured.
        const Ended bare =
            carom({"sweep", in("own.sdl"), "--no-declaration", "--vary=ball.vel.x=1,2", "-o", in("bare")});
        QCOMPARE(bare.exitCode, 2);
        QVERIFY2(bare.err.contains("there is nothing to measure"), qPrintable(bare.err));
    }

    void whatADeclarationSwitchesOnCanBeSwitchedOff() {
        writeFile(in("zipped.sdl"), fallingBall +
                                        "sweep { vary \"ball.vel.x=1:3:3\" vary \"ball.vel.z=1:3:3\" "
                                        "measure \"final x of ball\" zip yes frames 5 }\n");
        QCOMPARE(carom({"sweep", in("zipped.sdl"), "-o", in("zipped")}).exitCode, 0);
        QCOMPARE(linesOf(QString::fromUtf8(readFile(in("zipped/sweep.csv")))).size(), 1 + 3);
        QCOMPARE(carom({"sweep", in("zipped.sdl"), "--no-declaration", "--vary=ball.vel.x=1:3:3",
                        "--vary=ball.vel.z=1:3:3", "--measure=final x of ball", "-o", in("product")})
                     .exitCode,
                 0);
        const QStringList rows = linesOf(QString::fromUtf8(readFile(in("product/sweep.csv"))));
        QCOMPARE(rows.size(), 1 + 9);
        QVERIFY2(rows[1].contains(",done,30,"), qPrintable(rows[1])); // frames of its duration, half a second
    }

    void aGeneratedSceneIsSweptOverItsOptionsAndSeeds() {
        const Ended ended = carom({"sweep", "--generate=pile --n 5", "--vary=generate.height=1,2",
                                   "--vary=bodies.friction=0.2,0.4", "--seeds=3",
                                   "--measure=final centre_of_mass_y", "-n", "20", "-o", in("piles")});
        QVERIFY2(ended.exitCode == 0, qPrintable(ended.err));
        const QStringList rows = linesOf(QString::fromUtf8(readFile(in("piles/sweep.csv"))));
        QCOMPARE(rows.size(), 13);
        QVERIFY(rows[0].startsWith("run,generate.height,bodies.friction,seed,final centre_of_mass_y,"));
        QVERIFY(rows[12].startsWith("11,2,0.4,3,"));
        QVERIFY(!QFile::exists(in("piles/scene.sdl")));
        const QStringList points = linesOf(QString::fromUtf8(readFile(in("piles/summary.csv"))));
        QCOMPARE(points.size(), 5);
        QVERIFY(points[1].startsWith("1,0.2,final centre_of_mass_y,3,0,0,"));
    }

  private:
    QString in(const QString& name) const { return m_folder->filePath(name); }
    QString scene() const { return in("ball.sdl"); }
    QStringList words(const QString& folder, const QStringList& more) const {
        return QStringList{"sweep",
                           scene(),
                           "--vary=ball.vel.x=-2:4:7",
                           "--vary=simulation.substeps=1,2,8",
                           "--measure=final x of ball",
                           "--measure=max speed of ball",
                           "-o",
                           in(folder)} +
               more;
    }
    Ended sweep(const QString& folder, const QStringList& more) const { return carom(words(folder, more)); }

    std::unique_ptr<QTemporaryDir> m_folder;
};

} // namespace carom::test

CAROM_TEST(sweep_test, carom::test::SweepCommandTest)
#include "sweep_test.moc"
