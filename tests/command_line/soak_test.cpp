// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/process_figures.h"
#include "tests/support/program.h"
#include "tests/support/test_class.h"

#include <QTest>

#include <sys/resource.h>

// Long runs hold no more at their end than at their beginning. CAROM_SOAK says how many thousand frames;
// packaging/test soak takes hours.

namespace carom::test {

namespace {

constexpr int warmUp = 2;          // [thousand frames]: lists have their size
constexpr int thousand = 1000;     // frames
constexpr qint64 allowance = 1024; // [KiB]: a list that grows once more; a byte a frame would be as much

const QByteArray movingBall = "wall { normal 0,1,0 toOrig 0 }\nwall { normal 0,-1,0 toOrig 3 }\n"
                              "sphere { radius .1 mass 1 centre 0,1,0 vel .1,2,0 angvel 0,3,1 friction .2 }\n"
                              "sphere { radius .2 mass 1 centre .1,2,0 }\n";

} // namespace

class SoakTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void memoryIsInProportionToBodiesAndPairsThatTouch() {
        // All in one place, every body touches every other one. core/README.md states the figures.
        constexpr int bodies = 200, pairs = bodies * (bodies - 1) / 2;
        constexpr double ofProgram = 16 * 1024, ofBody = 4, ofPair = 2.5, ofEmptyPair = 1; // [KiB]
        const QTemporaryDir folder;
        const QString scene = folder.filePath("heap.sdl");
        writeFile(scene, QByteArray("sphere { radius 1 mass 1 centre 0,0,0 }\n").repeated(bodies));
        const Ended ended = carom({"run", scene, "-n", "1", "--method=contacts", "--substeps=1"});
        QVERIFY2(ended.out.contains("frames"), qPrintable(ended.err));
        rusage used{}; // of all children until now; this one is the first
        QCOMPARE(::getrusage(RUSAGE_CHILDREN, &used), 0);
        qInfo("%d bodies, %d pairs: %ld KiB", bodies, pairs, used.ru_maxrss);
        QVERIFY(static_cast<double>(used.ru_maxrss) <= ofProgram + bodies * ofBody + pairs * ofPair);
        QVERIFY(static_cast<double>(used.ru_maxrss) > pairs * ofEmptyPair); // they were all there
    }

    void aLongRunHoldsNoMoreThanAShortOne_data() {
        QTest::addColumn<QString>("method");
        for (const char* method : {"contacts", "microcollisions", "events"})
            QTest::newRow(method) << QString::fromLatin1(method);
    }
    void aLongRunHoldsNoMoreThanAShortOne() {
        QFETCH(QString, method);
        const int rounds = roundsOf("CAROM_SOAK", 60);
        const QTemporaryDir folder;
        const QString scene = folder.filePath("balls.sdl");
        QByteArray text = movingBall;
        if (method == "events") text.replace(" friction .2", "").replace("angvel 0,3,1", "");
        writeFile(scene, text);
        QProcess process;
        process.setStandardErrorFile(QProcess::nullDevice());
        // Pages of 2 MiB, and what is kept for later, would hide what is held.
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        environment.insert("MALLOC_CONF", "thp:never,dirty_decay_ms:0");
        process.setProcessEnvironment(environment);
        process.start(QStringLiteral(CAROM_PROGRAM),
                      {"run", scene, "--method", method, "-n", "2000000000", "--keep-going", "--stats", "-"});
        Holdings early, late;
        for (qint64 rows = 0; rows < qint64{rounds} * thousand;) {
            QVERIFY(process.waitForReadyRead(longestWait));
            rows += process.readAllStandardOutput().count('\n');
            if (early.files < 0 && rows >= warmUp * thousand)
                early = holdingsOf(QString::number(process.processId()));
        }
        late = holdingsOf(QString::number(process.processId()));
        process.kill();
        process.waitForFinished(longestWait);
        qInfo("%d,000 frames: %lld KiB, then %lld; %lld files, then %lld", rounds,
              static_cast<long long>(early.memory), static_cast<long long>(late.memory),
              static_cast<long long>(early.files), static_cast<long long>(late.files));
        QVERIFY(early.memory > 0 && late.memory > 0);
        QVERIFY(late.memory <= early.memory + allowance);
        QCOMPARE(late.files, early.files);
    }
};

} // namespace carom::test

CAROM_TEST_WITH(QCoreApplication, soak_test, carom::test::SoakTest)
#include "soak_test.moc"
