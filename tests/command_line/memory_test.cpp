// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/failing_memory.h"
#include "tests/support/program.h"
#include "tests/support/test_class.h"

#include <QFileInfo>
#include <QTest>

// Memory that runs out: a sentence and exit code 3. (Not under a sanitizer, which allocates in its own way.)

namespace carom::test {

class MemoryTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void init() {
        m_folder = std::make_unique<QTemporaryDir>();
        writeFile(scene(), "wall { normal 0, 1, 0 toOrig 0 }\n"
                           "sphere { radius 0.1 mass 1 centre 0, 1, 0 vel 0.5, 0, 0 }\n");
    }

    void memoryThatRunsOutIsSaid() {
        const Ended many = carom({"generate", "brownian", "--n", "100000"});
        writeFile(path("many.sdl"), many.out.toUtf8());
        const Ended ended = shell("ulimit -v 200000; exec \"$carom\" run " + path("many.sdl") + " -n 2");
        QCOMPARE(ended.exitCode, 3);
        QVERIFY2(ended.err.contains("not enough memory"), qPrintable(ended.err));
    }

    void memoryThatTheMachineLacksIsNotPromised() {
        // 20,000 spheres at one place have 200 million contacts, for which contacts would take 350 GB: Linux
        // promises them and then ends the program, or another one.
        QProcess process;
        process.start(CAROM_PROGRAM, {"run", scene(), "-n", "1000000000", "--stats", path("s.csv")});
        QTRY_VERIFY_WITH_TIMEOUT(QFileInfo(path("s.csv")).size() > 0, longestWait);
        qint64 most = -1; // [bytes]; `unlimited` is no number
        for (const QByteArray& line :
             readFile(QString("/proc/%1/limits").arg(process.processId())).split('\n'))
            if (line.startsWith("Max data size"))
                most = line.mid(13).simplified().split(' ').first().toLongLong();
        process.kill();
        process.waitForFinished(longestWait);
        QVERIFY(most > 0);
        qint64 machine = 0;
        for (const QByteArray& line : readFile("/proc/meminfo").split('\n'))
            if (line.startsWith("MemTotal:") || line.startsWith("SwapTotal:"))
                machine +=
                    1024 * line.mid(line.indexOf(':') + 1).simplified().split(' ').first().toLongLong();
        QVERIFY2(most < machine, qPrintable(QString("%1 of %2").arg(most).arg(machine)));
    }

    // Each of the first requests for memory, and every second power of two of those behind them, is refused
    // once.
    void anyRequestForMemoryMayFail_data() {
        QTest::addColumn<QStringList>("words");
        QTest::newRow("check") << QStringList{"check", "{}"};
        QTest::newRow("run") << QStringList{"run", "{}", "-n", "20", "--stats", "{out}"};
        QTest::newRow("study") << QStringList{"study",         "accuracy",     "{}",
                                              "--duration=.2", "--substeps=1", "--runs=1"};
    }
    void anyRequestForMemoryMayFail() {
        QFETCH(QStringList, words);
        words.replaceInStrings("{}", scene()).replaceInStrings("{out}", path("out.csv"));
        const QString told = path("told");
        int failed = 0;
        for (long request = 1;; request *= 2) {
            QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
            environment.insert("LD_PRELOAD", CAROM_FAILING_MEMORY);
            environment.insert(failingMemoryVariable, QString("%1 %2").arg(request).arg(told));
            const Ended ended = carom(words, environment);
            if (!QFile::remove(told)) break; // so many are not made
            const bool said = ended.exitCode == 3 && ended.err.contains("not enough memory");
            const bool didWithout = ended.exitCode == 0; // somebody had another way
            QVERIFY2(said || didWithout,
                     qPrintable(
                         QString("request %1: code %2, %3").arg(request).arg(ended.exitCode).arg(ended.err)));
            failed += said ? 1 : 0;
        }
        QVERIFY(failed >= 5);
    }

  private:
    QString path(const char* name) const { return m_folder->filePath(QString::fromLatin1(name)); }
    QString scene() const { return path("ball.sdl"); }

    std::unique_ptr<QTemporaryDir> m_folder;
};

} // namespace carom::test

CAROM_TEST_WITH(QCoreApplication, memory_test, carom::test::MemoryTest)
#include "memory_test.moc"
