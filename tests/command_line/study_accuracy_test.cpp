// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/program.h"
#include "tests/support/test_class.h"

#include <QDir>
#include <QTest>

#include <csignal>

namespace carom::test {

namespace {

const QByteArray bounce = "wall { normal 0, 1, 0 toOrig 0 }\n"
                          "sphere { radius 0.1 mass 1 centre 0, 1, 0 vel 0.5, 0, 0 }\n";

/// The cells of a column, by its name, below the header.
QStringList column(const QStringList& rows, const QString& name) {
    const qsizetype at = rows[0].split(QLatin1Char(',')).indexOf(name);
    QStringList cells;
    for (qsizetype k = 1; k < rows.size(); ++k)
        if (at >= 0) cells.append(rows[k].split(QLatin1Char(','))[at]);
    return cells;
}

} // namespace

class StudyAccuracyTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void init() { writeFile(m_scene, bounce); }

    void itWritesFiguresSummaryAndChart() {
        const QString folder = m_folder.filePath("new");
        QStringList words = {"-o", folder};
#ifdef CAROM_CHARTS
        words << "--chart" << m_folder.filePath("one.svg");
#endif
        const Ended ended = study(words);
        QCOMPARE(ended.exitCode, 0);
        QCOMPARE(QString::fromUtf8(readFile(folder + "/summary.txt")), ended.out);
        QVERIFY(ended.out.startsWith("Errors are against the exact events"));
        const QStringList rows = linesOf(QString::fromUtf8(readFile(folder + "/accuracy.csv")));
        QVERIFY(rows.size() > 4);
        for (const QString& cell : column(rows, "impacts_true")) QCOMPARE(cell, "2");
        QVERIFY(ended.out.contains("2 of 2"));
        QVERIFY(rows[1].contains("carom study accuracy "));
#ifdef CAROM_CHARTS
        for (const char* name : {"accuracy.svg", "accuracy.png", "accuracy.pdf"})
            QVERIFY2(QFile(folder + "/" + name).size() > 1000, name);
        QVERIFY(readFile(m_folder.filePath("one.svg")).contains("<svg"));
#endif
    }

    void aStudyGoesOnWhereOneWasInterrupted() {
        const QString folder = m_folder.filePath("again");
        QProcess process;
        process.start(QStringLiteral(CAROM_PROGRAM),
                      {"study", "accuracy", m_scene, "-o", folder, "--duration=1000"});
        QVERIFY(process.waitForStarted(longestWait));
        QTRY_VERIFY_WITH_TIMEOUT(QDir(folder).exists(), longestWait); // by then it catches signals
        ::kill(static_cast<pid_t>(process.processId()), SIGINT);
        const Ended first = finish(process);
        QCOMPARE(first.exitCode, 130);
        const QStringList interrupted = linesOf(QString::fromUtf8(readFile(folder + "/accuracy.csv")));
        QVERIFY2(interrupted.size() >= 1, qPrintable(first.out));
        QVERIFY(readFile(folder + "/summary.txt").contains("The study was interrupted"));

        const Ended whole = study({"-o", folder});
        QCOMPARE(whole.exitCode, 0);
        const QString csv = folder + "/accuracy.csv";
        const QStringList measured = linesOf(QString::fromUtf8(readFile(csv)));
        QVERIFY(measured.size() > 3);
        QCOMPARE(interrupted.front(), measured.front());
        const QStringList part = measured.mid(0, measured.size() - 1);
        writeFile(csv, (part.join('\n') + '\n').toUtf8()); // as if it had been interrupted before the last
        const Ended resumed = study({"-o", folder, "--resume"});
        QCOMPARE(resumed.exitCode, 0);
        const QStringList after = linesOf(QString::fromUtf8(readFile(csv)));
        QCOMPARE(after.size(), measured.size());
        // What was there was not measured again: the times of the runs are those of before.
        QCOMPARE(column(after, "runs_ms").mid(0, part.size() - 1), column(part, "runs_ms"));
    }

    void wrongOptionsSayWhatWouldBeRight() {
        Ended ended = study({"--chart", "a.gif"});
        QCOMPARE(ended.exitCode, 2);
        QVERIFY(ended.err.contains("its ending must be .svg, .png or .pdf"));
        ended = study({"--resume"});
        QCOMPARE(ended.exitCode, 2);
        QVERIFY(ended.err.contains("`--resume` needs `--output`"));
        ended = study({"--methods", "contact"});
        QCOMPARE(ended.exitCode, 2);
        QVERIFY(ended.err.contains("it must be"));
        ended = carom({"study", "accuracy", "-", "--instructions"}, bounce);
        QCOMPARE(ended.exitCode, 2);
        ended = carom({"study", "accuracy", "-"}, "wall { normal 0, 1, 0 toOrig 0 }\n");
        QCOMPARE(ended.exitCode, 2);
        QVERIFY(ended.err.contains("nothing in `<stdin>` can move; there is no error to study"));
    }

    void theEndOfTheBudgetIsNoInterruption() {
        const Ended ended = carom({"study", "accuracy", source("scenes/dominoes.sdl"), "--budget=.5"});
        QCOMPARE(ended.exitCode, 0);
        QVERIFY2(ended.out.contains("left out"), qPrintable(ended.out));
        QVERIFY(!ended.out.contains("interrupted"));
        QVERIFY(ended.out.contains("per simulated second"));
    }

    void aMeasureCanBeChosen() {
        const Ended ended = study({"--measure", "energy"});
        QCOMPARE(ended.exitCode, 0);
        QVERIFY(ended.out.contains("Measured by `energy`, as asked for."));
        QVERIFY(ended.out.contains("Error of energy below"));
        const Ended wrong = study({"--measure", "trajectori"});
        QCOMPARE(wrong.exitCode, 2);
        QVERIFY2(wrong.err.contains("`trajectory`"), qPrintable(wrong.err));
    }

    void anEngineWithoutAProgramIsRefused() {
        const Ended ended = study({"--engines", "bullet,nonesuch"});
        QCOMPARE(ended.exitCode, 2);
        QVERIFY2(ended.err.contains("carom-engine-"), qPrintable(ended.err));
        const Ended piped = carom({"study", "accuracy", "-", "--engines", "bullet"}, bounce);
        QCOMPARE(piped.exitCode, 2);
        QVERIFY2(piped.err.contains("give a file in place of `-`"), qPrintable(piped.err));
    }

    void anEngineIsAProgramThatAnybodyCanWrite() {
        // It has not even read the scene; a script that follows the protocol is enough.
        const QTemporaryDir folder;
        const QString program = folder.filePath(QStringLiteral("carom-engine-still"));
        writeFile(program, "#!/bin/sh\necho lacks,motion\n");
        QFile::setPermissions(program, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
        const QByteArray path = qgetenv("PATH");
        qputenv("PATH", folder.path().toUtf8() + ":" + path);
        const Ended ended = study({"--engines", "still", "--substeps", "1"});
        qputenv("PATH", path);
        QCOMPARE(ended.exitCode, 0);
        QVERIFY2(ended.out.contains("Engine still, tuned: it has no motion."), qPrintable(ended.out));
    }

    void severalScenesMakeATable() {
        const QString other = m_folder.filePath("second.sdl"), folder = m_folder.filePath("many");
        writeFile(other, bounce + "// another\n");
        const Ended ended = study({other, "-o", folder});
        QCOMPARE(ended.exitCode, 0);
        const QStringList lines = linesOf(ended.out);
        QCOMPARE(lines.size(), 3);
        QVERIFY(lines[0].startsWith("scene  ") && lines[0].contains("off the front"));
        QVERIFY(lines[1].startsWith("ball") && lines[1].contains("exact events"));
        QVERIFY(lines[2].startsWith("second") && lines[2].contains("per simulated second"));
        const QStringList rows = linesOf(QString::fromUtf8(readFile(folder + "/scenes.csv")));
        QCOMPARE(column(rows, "scene"), (QStringList{"ball", "second"}));
        QVERIFY(QFile::exists(folder + "/ball/accuracy.csv") &&
                QFile::exists(folder + "/second/summary.txt"));
        const Ended refused = study({other, "--resume"});
        QCOMPARE(refused.exitCode, 2);
        QVERIFY(refused.err.contains("`--resume` is for one scene; there are 2"));
    }

    void aSceneOfManyIsWarnedOfOnce() {
        QByteArray smooth = bounce;
        smooth.replace("vel", "friction 0.3 vel");
        writeFile(m_scene, smooth);
        const QString other = m_folder.filePath("rough.sdl");
        writeFile(other, smooth + "// another\n");
        const Ended ended = study({other, "--budget", "0.5"});
        QCOMPARE(ended.exitCode, 0);
        QVERIFY2(ended.err.count("`friction` has no effect") == 2, qPrintable(ended.err));
    }

    // The last of twenty scenes ended the command after nineteen minutes.
    void whatIsWrongWithASceneOfManyIsSaidBeforeTheFirst() {
        const QString still = m_folder.filePath("still.sdl"), folder = m_folder.filePath("refused");
        writeFile(still, "wall { normal 0, 1, 0 toOrig 0 }\n");
        const Ended ended = study({still, "-o", folder});
        QCOMPARE(ended.exitCode, 2);
        QVERIFY2(ended.err.contains("still.sdl` can move"), qPrintable(ended.err));
        QVERIFY(ended.out.isEmpty());
        QVERIFY(QDir().mkpath(m_folder.filePath("twin")));
        const QString twin = m_folder.filePath("twin/ball.sdl");
        writeFile(twin, bounce);
        const Ended alike = study({twin, "-o", folder});
        QCOMPARE(alike.exitCode, 2);
        QVERIFY2(alike.err.contains("have one name, `ball`"), qPrintable(alike.err));
    }

    void scenesAreSharedByShards() {
        const QString other = m_folder.filePath("third.sdl"), folder = m_folder.filePath("shared");
        writeFile(other, bounce + "// one more\n");
        for (const char* shard : {"--shard=1/2", "--shard=2/2"})
            QCOMPARE(study({other, "-o", folder, shard}).exitCode, 0);
        QCOMPARE(carom({"study", "accuracy", "--merge", folder}).exitCode, 0);
        const QStringList rows = linesOf(QString::fromUtf8(readFile(folder + "/scenes.csv")));
        QCOMPARE(column(rows, "scene"), (QStringList{"ball", "third"}));
        QCOMPARE(study({"--shard=1/2"}).exitCode, 2);
    }

    void figuresOfOtherSettingsAreNotGoneOnWith() {
        const QString folder = m_folder.filePath("other");
        QCOMPARE(study({"-o", folder, "--substeps", "1,2"}).exitCode, 0);
        const QByteArray before = readFile(folder + "/accuracy.csv");
        const Ended ended = study({"-o", folder, "--substeps", "1", "--resume"});
        QCOMPARE(ended.exitCode, 2);
        QVERIFY2(ended.err.contains("which these options leave out; another folder would be right"),
                 qPrintable(ended.err));
        QCOMPARE(readFile(folder + "/accuracy.csv"), before);
    }

    void gasesAreSharedAndMerged() {
        const QString gases = m_folder.filePath("gases");
        QVERIFY(QDir().mkpath(gases));
        QStringList words{"study", "gas", "--settle=2", "--collisions=8", "--batches=2"};
        for (const char* seed : {"1", "2", "3"}) {
            const QString path = gases + "/copy" + seed + ".sdl";
            writeFile(
                path,
                carom({"generate", "brownian", "--n=20", QStringLiteral("--seed=") + seed}).out.toUtf8());
            words << path;
        }
        const QString whole = m_folder.filePath("gases-whole"), shared = m_folder.filePath("gases-shared");
        QCOMPARE(carom(words + QStringList{"-o", whole}).exitCode, 0);
        QVERIFY(QFile::exists(whole + "/copy2/gas.csv"));
        for (const char* shard : {"--shard=2/2", "--shard=1/2"})
            QCOMPARE(carom(words + QStringList{"-o", shared, shard}).exitCode, 0);
        QVERIFY(!QFile::exists(shared + "/gases.csv"));
        QCOMPARE(carom({"study", "gas", "--merge", shared}).exitCode, 0);
        // The command, which names folder and shard, stands in every row.
        const auto figures = [](const QString& folder) {
            QByteArrayList rows;
            for (const QByteArray& row : readFile(folder + "/gases.csv").split('\n'))
                rows += row.left(row.indexOf(",carom "));
            return rows;
        };
        QVERIFY(figures(whole).size() > 6);
        QVERIFY(figures(whole)[1].startsWith("copy1,"));
        QCOMPARE(figures(shared), figures(whole));
        QCOMPARE(carom({"study", "gas", words[5], "--shard=1/2"}).exitCode, 2);
    }

    void whatIsNoGasIsRefusedWithItsPlace() {
        const Ended ended = carom({"study", "gas", source("scenes/tower.sdl")});
        QCOMPARE(ended.exitCode, 1);
        QVERIFY2(ended.err.contains("tower.sdl:10: not a gas: a cuboid is neither a sphere nor a wall"),
                 qPrintable(ended.err));
    }

    void withoutValgrindNoInstructionsAreCounted() {
        const Ended ended =
            shell(QStringLiteral("PATH=/nowhere \"$carom\" study accuracy '%1' --instructions").arg(m_scene));
        QCOMPARE(ended.exitCode, 2);
        QVERIFY2(ended.err.contains("needs valgrind"), qPrintable(ended.err));
    }

    // A valgrind of the test's own: a shell script that counts as many instructions as frames were asked for.
    void instructionsAreThoseOfTheFramesBehindTheFirst() {
        const QString tools = m_folder.filePath("tools");
        QVERIFY(QDir().mkpath(tools));
        writeFile(tools + "/valgrind",
                  "#!/bin/sh\n"
                  "for word; do case $word in\n"
                  "  --callgrind-out-file=*) file=${word#*=};;\n"
                  "  --frames=*) frames=${word#*=};;\n"
                  "esac; done\n"
                  "[ -z \"$file\" ] || echo \"totals: $((5000 + 60 * frames))\" > \"$file\"\n");
        QVERIFY(QFile::setPermissions(tools + "/valgrind", QFile::ReadOwner | QFile::ExeOwner));
        const QString folder = m_folder.filePath("counted");
        const Ended ended =
            shell(QStringLiteral("PATH='%1':$PATH \"$carom\" study accuracy '%2' --duration=.5 "
                                 "--substeps=1,2 --runs=1 --instructions -o '%3'")
                      .arg(tools, m_scene, folder));
        QVERIFY2(ended.exitCode == 0, qPrintable(ended.err));
        const QStringList rows = linesOf(QString::fromUtf8(readFile(folder + "/accuracy.csv")));
        for (const QString& cell : column(rows, "instructions")) QCOMPARE(qRound(cell.toDouble()), 3600);
        QVERIFY(ended.out.contains("instructions"));
    }

    void withoutAFolderForTemporaryFilesWhatWasMeasuredIsKept() {
        const QString tools = m_folder.filePath("idle");
        QVERIFY(QDir().mkpath(tools));
        writeFile(tools + "/valgrind", "#!/bin/sh\n");
        QVERIFY(QFile::setPermissions(tools + "/valgrind", QFile::ReadOwner | QFile::ExeOwner));
        const QString folder = m_folder.filePath("half");
        const Ended ended = shell(
            QStringLiteral("TMPDIR=/nowhere PATH='%1':$PATH \"$carom\" study accuracy '%2' --duration=.5 "
                           "--substeps=1,2 --runs=1 --instructions -o '%3'")
                .arg(tools, m_scene, folder));
        QCOMPARE(ended.exitCode, 3);
        QVERIFY2(ended.err.contains("no folder for temporary files at `/nowhere`"), qPrintable(ended.err));
        QVERIFY(linesOf(QString::fromUtf8(readFile(folder + "/accuracy.csv"))).size() > 2);
    }

  private:
    Ended study(const QStringList& further) {
        return carom(
            QStringList{"study", "accuracy", m_scene, "--duration=1.5", "--substeps=1,4", "--runs=1"} +
            further);
    }

    QTemporaryDir m_folder;
    QString m_scene = m_folder.filePath("ball.sdl");
};

} // namespace carom::test

CAROM_TEST_WITH(QCoreApplication, study_accuracy_test, carom::test::StudyAccuracyTest)
#include "study_accuracy_test.moc"
