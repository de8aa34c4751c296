// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/failing_files.h"
#include "tests/support/faults.h"
#include "tests/support/process_figures.h"
#include "tests/support/program.h"
#include "tests/support/test_class.h"

#include <QDir>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTest>

#include <sys/stat.h>

#include <cerrno>
#include <csignal>
#include <system_error>

// Disks that are full, files that are each other, and people who have waited long
// enough. Whatever happens, what was computed or written before is there, and the program ends with a
// sentence and a number of its own.

namespace carom::test {

namespace {

const QByteArray ball = "wall { normal 0, 1, 0 toOrig 0 }\n"
                        "sphere { radius 0.1 mass 1 centre 0, 1, 0 vel 0.5, 0, 0 }\n";

/// A command that writes, and the file it writes; streams grow as they are written, the others are replaced.
struct Writer {
    const char* name;
    QStringList words; ///< {} is the scene, {out} the folder
    const char* file;
    bool isStream;
};

const std::vector<Writer>& writers() {
    static const std::vector<Writer> rows = {
        {"trace", {"run", "{}", "-n", "3", "--trace", "{out}/t.csv"}, "t.csv", true},
        {"statistics", {"run", "{}", "-n", "3", "--stats", "{out}/s.csv"}, "s.csv", true},
        {"format", {"format", "--in-place", "{out}/a.sdl"}, "a.sdl", false},
        {"bench",
         {"bench", "--scene=pyramid", "-n", "10", "--broadphase=all_pairs", "--frames=4", "-o", "{out}"},
         "performance.csv",
         false},
        {"stability",
         {"study", "stability", "elastic_ball", "--column=exact", "-o", "{out}"},
         "stability.csv",
         false},
        {"accuracy",
         {"study", "accuracy", "{}", "--duration=.2", "--substeps=1", "--runs=1", "-o", "{out}"},
         "accuracy.csv",
         false},
        {"gas", {"study", "gas", "{gas}", "-o", "{out}"}, "gas.csv", false},
        {"sweep", {"sweep", "{}", "--measure=max speed", "--frames=3", "-o", "{out}"}, "sweep.csv", false},
#ifdef CAROM_CHARTS
        {"chart",
         {"study", "accuracy", "{}", "--duration=.2", "--substeps=1", "--runs=1", "--chart", "{out}/c.svg"},
         "c.svg",
         false},
#endif
    };
    return rows;
}

} // namespace

class FaultsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void init() {
        m_folder = std::make_unique<QTemporaryDir>();
        writeFile(scene(), ball);
        writeFile(path("gas.sdl"),
                  "gravity { accel 0,0,0 } sphere { radius 0.1 mass 1 centre 0,0,0 vel 1,2,3 }\n"
                  "wall { normal 1,0,0 toOrig 1 } wall { normal -1,0,0 toOrig 1 }\n"
                  "wall { normal 0,1,0 toOrig 1 } wall { normal 0,-1,0 toOrig 1 }\n"
                  "wall { normal 0,0,1 toOrig 1 } wall { normal 0,0,-1 toOrig 1 }\n"
                  "sphere { radius 0.1 mass 1 centre 0.5,0,0 vel 1,-2,3 }\n"
                  "simulation { duration 5 }\n");
    }

    void aWriterThatFailsEndsWithThreeAndKeepsWhatWasThere_data() {
        QTest::addColumn<int>("writer");
        QTest::addColumn<QString>("call");
        QTest::addColumn<int>("cause");
        for (std::size_t i = 0; i < writers().size(); ++i)
            for (const Fault& fault : faultsToTry(i)) {
                const QByteArray call = fault.call;
                if (!writers()[i].isStream || (call != "fsync" && call != "rename"))
                    QTest::addRow("%s: %s %s", writers()[i].name, fault.call, fault.name)
                        << int(i) << QString(call) << fault.cause;
            }
    }
    void aWriterThatFailsEndsWithThreeAndKeepsWhatWasThere() {
        QFETCH(int, writer);
        QFETCH(QString, call);
        QFETCH(int, cause);
        const Writer& row = writers()[static_cast<std::size_t>(writer)];
        const QString out = path("out");
        QVERIFY(QDir().mkpath(out));
        const QString file = out + "/" + row.file;
        const QByteArray before = row.file == QByteArray("a.sdl") ? "sphere  {radius 1   mass 1}" : "old\n";
        writeFile(file, before);
        QStringList words = row.words;
        words.replaceInStrings("{}", scene())
            .replaceInStrings("{out}", out)
            .replaceInStrings("{gas}", path("gas.sdl"));
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        environment.insert("LD_PRELOAD", CAROM_FAILING_FILES);
        environment.insert(failingFilesVariable,
                           QString("%1 1 %2 %3").arg(call, QString::number(cause), out));
        const Ended ended = carom(words, environment);
        QVERIFY2(ended.exitCode == 3, qPrintable(QString::number(ended.exitCode) + ended.err));
        QVERIFY2(ended.err.contains(QString::fromStdString(std::generic_category().message(cause))) &&
                     (ended.err.contains("cannot write") || ended.err.contains("cannot be written")),
                 qPrintable(ended.err));
        if (row.isStream) { // what was computed is said all the same
            if (call != "open") QVERIFY2(ended.out.contains("state hash"), qPrintable(ended.out));
            return;
        }
        // A study goes on, says what it has found and tries again at its end.
        if (row.file == QByteArray("stability.csv"))
            QVERIFY2(ended.out.contains("1 of 1 hold"), qPrintable(ended.out));
        QCOMPARE(readFile(file), before);
        QCOMPARE(QDir(out).entryList(QDir::Files | QDir::Hidden), QStringList{row.file});
    }

    void aStandardOutputThatIsFullEndsWithThree_data() {
        QTest::addColumn<QString>("words");
        for (const char* words :
             {"run {} -n 3", "run {} -n 3 --json --stats -", "generate pyramid", "format {}", "effects {}",
              "contacts {}", "bench --scene=pyramid -n 10 --frames=3",
              "study stability elastic_ball --column=exact", "study gas gas.sdl", "test {}", "test --tap {}"})
            QTest::newRow(words) << QString::fromLatin1(words);
    }
    void aStandardOutputThatIsFullEndsWithThree() {
        QFETCH(QString, words);
        words.replace("{}", scene()).replace("gas.sdl", path("gas.sdl"));
        const Ended ended = shell("exec \"$carom\" " + words + " > /dev/full");
        QCOMPARE(ended.exitCode, 3);
        QVERIFY2(ended.err.contains("cannot write standard output: No space left on device"),
                 qPrintable(ended.err));
    }

    void aDiskThatFillsUpInTheMiddleOfARunEndsItWithItsSummary() {
        // The kernel's own limit of a file, which fails like a full disk.
        const Ended ended =
            shell("ulimit -f 200; trap '' XFSZ; exec \"$carom\" run " + source("scenes/pyramid.sdl") +
                  " -n 100000000 --json --stats " + path("s.csv"));
        QCOMPARE(ended.exitCode, 3);
        QVERIFY2(ended.err.contains("File too large"), qPrintable(ended.err));
        QVERIFY(QJsonDocument::fromJson(ended.out.toUtf8()).object()["frames"].toInt() > 100);
        QVERIFY(QFileInfo(path("s.csv")).size() > 100'000);
    }

    void outputsThatAreTheSceneOrEachOtherAreRefused() {
        const auto refused = [this](const QStringList& words, const char* what) {
            const Ended ended = carom(words);
            QVERIFY2(ended.exitCode == 2, qPrintable(words.join(' ') + ended.err));
            QVERIFY2(ended.err.contains(what), qPrintable(ended.err));
            QCOMPARE(readFile(scene()), ball);
        };
        QVERIFY(QFile::link(scene(), path("link.sdl")));
        QCOMPARE(::link(qPrintable(scene()), qPrintable(path("twin.sdl"))), 0);
        refused({"run", scene(), "--trace", scene()}, "`--trace` would overwrite the scene");
        refused({"run", scene(), "--stats", m_folder->path() + "/./ball.sdl"},
                "`--stats` would overwrite the scene");
        refused({"run", scene(), "--trace", path("link.sdl")}, "`--trace` would overwrite the scene");
        refused({"run", scene(), "--trace", path("twin.sdl")}, "`--trace` would overwrite the scene");
        refused({"run", scene(), "--trace", path("x"), "--stats", path("x")},
                "`--stats` would overwrite `--trace`");
        refused({"study", "accuracy", scene(), "--chart", scene()}, "its ending must be");
        refused({scene(), "--picture", scene()}, "`--picture` would overwrite the scene");
        writeFile(path("accuracy.csv"), ball);
        refused({"study", "accuracy", path("accuracy.csv"), "-o", m_folder->path()},
                "`--output` would overwrite the scene");
        QVERIFY(!QFile::exists(path("x")));
        // Two to nowhere are no harm.
        QCOMPARE(carom({"run", scene(), "-n", "1", "--trace", "/dev/null", "--stats", "/dev/null"}).exitCode,
                 0);
    }

    void whatIsNoFileIsRefusedAtOnce() {
        QCOMPARE(::mkfifo(qPrintable(path("pipe")), 0600), 0);
        for (const QString& file : {path("pipe"), QString("/dev/zero"), m_folder->path()})
            for (const char* command : {"check", "run", "format", "effects"}) {
                const Ended ended = carom({command, file});
                QCOMPARE(ended.exitCode, 3);
                QVERIFY2(ended.err.contains("cannot read `" + file + "`: "), qPrintable(ended.err));
            }
        // The shell's own pipes are read.
        const Ended ended = runCommand(
            "/bin/bash", {"-c", QStringLiteral("'" CAROM_PROGRAM "' run -n 2 <(cat '%1')").arg(scene())});
        QVERIFY2(ended.exitCode == 0, qPrintable(ended.err));
    }

    void aTextThatIsTooLargeEndsWithOne() {
        QFile large(path("large.sdl"));
        QVERIFY(large.open(QIODevice::WriteOnly) &&
                large.resize((qint64{64} << 20) + 1)); // zeros, not on the disk
        for (const QStringList& words : {QStringList{"check"},
                                         {"run", "-n", "1"},
                                         {"format"},
                                         {"effects"},
                                         {"contacts"},
                                         {"study", "gas"}}) {
            const Ended ended = carom(words + QStringList{large.fileName()});
            QVERIFY2(ended.exitCode == 1, qPrintable(words.join(' ')));
            QVERIFY2((ended.err + ended.out).contains("more than 64 MiB"), qPrintable(ended.err));
        }
        QCOMPARE(shell("\"$carom\" check - < " + large.fileName()).exitCode, 1);
        // Just beyond. `bench` measured an empty scene: .004 ms a frame for a million bodies.
        for (const QStringList& words : {QStringList{"generate", "pile", "--n", "720000"},
                                         {"bench", "--scene", "pile", "-n", "720000", "--broadphase",
                                          "uniform_grid", "--frames", "2"}}) {
            const Ended generated = carom(words);
            QVERIFY2(generated.exitCode == 2, qPrintable(words.join(' ')));
            QVERIFY2(generated.err.contains("no more than 64 MiB can be read"), qPrintable(generated.err));
            QCOMPARE(generated.out, QString());
        }
    }

    void anInterruptEndsARunWithinItsFrame_data() {
        QTest::addColumn<int>("signal");
        QTest::newRow("Ctrl-C") << SIGINT;
        QTest::newRow("asked to end") << SIGTERM;
        QTest::newRow("the terminal goes away") << SIGHUP;
    }
    void anInterruptEndsARunWithinItsFrame() {
        QFETCH(int, signal);
        // A frame of this scene takes many minutes: a million times a wall of stones.
        const Ended scene = carom({"generate", "stone_wall"});
        writeFile(path("slow.sdl"), scene.out.toUtf8());
        QProcess process;
        process.start(CAROM_PROGRAM,
                      {"run", path("slow.sdl"), "--substeps=1000000", "--json", "--stats", path("slow.csv")});
        QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(path("slow.csv")), longestWait);
        constexpr int intoTheFrame = 100; // [ms] of processor time
        QTRY_VERIFY_WITH_TIMEOUT(processorTimeOf(process.processId(), "carom") > intoTheFrame, longestWait);
        ::kill(static_cast<pid_t>(process.processId()), signal);
        const Ended ended = finish(process);
        QCOMPARE(ended.exitCode, 130);
        const QJsonObject run = QJsonDocument::fromJson(ended.out.toUtf8()).object();
        QCOMPARE(run["frames"].toInt(-1), 0);
        QVERIFY(run["state_hash"].isNull());
        QVERIFY(readFile(path("slow.csv")).startsWith("frame,time"));
    }

    void anInterruptEndsAListOfContacts() {
        // Half a million pairs, more than a pipe holds: the list was made as a whole before the first row was
        // written, and nothing ended it.
        constexpr int bodies = 1000;
        writeFile(path("heap.sdl"), QByteArray("sphere { radius 1 mass 1 centre 0,0,0 }\n").repeated(bodies));
        QProcess process;
        process.setStandardErrorFile(QProcess::nullDevice());
        process.start(CAROM_PROGRAM, {"contacts", path("heap.sdl")});
        QVERIFY(process.waitForReadyRead(longestWait));
        ::kill(static_cast<pid_t>(process.processId()), SIGINT);
        const Ended ended = finish(process);
        QCOMPARE(ended.exitCode, 130);
        QVERIFY(ended.out.startsWith("a,b,depth"));
        QVERIFY(ended.out.count('\n') < bodies * (bodies - 1) / 2);
    }

    void nohupIsHeeded() {
        QProcess process;
        process.start("/bin/sh", {"-c", "trap '' HUP; exec '" CAROM_PROGRAM "' run " + scene() +
                                            " -n 1000000000 --stats " + path("s.csv")});
        QTRY_VERIFY_WITH_TIMEOUT(QFileInfo(path("s.csv")).size() > 1000, longestWait);
        ::kill(static_cast<pid_t>(process.processId()), SIGHUP);
        const qint64 size = QFileInfo(path("s.csv")).size();
        QTRY_VERIFY_WITH_TIMEOUT(QFileInfo(path("s.csv")).size() > size + 100'000, longestWait); // it goes on
        ::kill(static_cast<pid_t>(process.processId()), SIGINT);
        QCOMPARE(finish(process).exitCode, 130);
    }

    void whatAStudyHasMeasuredOutlivesAKill_data() {
        QTest::addColumn<QStringList>("words");
        QTest::addColumn<QString>("file");
        QTest::newRow("accuracy") << QStringList{"study", "accuracy", "{}", "--runs=1000"} << "accuracy.csv";
        QTest::newRow("stability") << QStringList{"study", "stability"} << "stability.csv";
        QTest::newRow("bench") << QStringList{"bench", "--frames=30"} << "performance.csv";
        QTest::newRow("gas") << QStringList{"study", "gas", "{gas}", "--collisions=10000000",
                                            "--batches=10000"}
                             << "gas.csv";
    }
    void whatAStudyHasMeasuredOutlivesAKill() {
        QFETCH(QStringList, words);
        QFETCH(QString, file);
        writeFile(path("gas.sdl"), carom({"generate", "brownian", "--n=100"}).out.toUtf8());
        words.replaceInStrings("{}", scene()).replaceInStrings("{gas}", path("gas.sdl"));
        QProcess process;
        process.start(CAROM_PROGRAM, words + QStringList{"-o", m_folder->path()});
        const auto rows = [&] { return linesOf(QString::fromUtf8(readFile(path(qPrintable(file))))); };
        QTRY_VERIFY_WITH_TIMEOUT(rows().size() > 3, longestWait);
        QCOMPARE(process.state(), QProcess::Running); // it is not done
        process.kill();
        process.waitForFinished(longestWait);
        QVERIFY(rows().size() > 3);
        for (const QString& row : rows()) QVERIFY2(!row.isEmpty(), "half a row");
    }

  private:
    QString path(const char* name) const { return m_folder->filePath(QString::fromLatin1(name)); }
    QString scene() const { return path("ball.sdl"); }

    std::unique_ptr<QTemporaryDir> m_folder;
};

} // namespace carom::test

CAROM_TEST_WITH(QCoreApplication, faults_test, carom::test::FaultsTest)
#include "faults_test.moc"
