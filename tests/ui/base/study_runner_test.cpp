// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/files.h"
#include "tests/support/test_class.h"
#include "ui/base/study_runner.h"

#include <QCoreApplication>
#include <QSignalSpy>
#include <QThread>

#include <atomic>
#include <memory>
#include <new>
#include <stdexcept>

using namespace carom;
using namespace carom::test;

class StudyRunnerTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void itsResultArrivesOnTheThreadThatStartedIt() {
        StudyRunner runner;
        QSignalSpy failures(&runner, &StudyRunner::failed);
        for (int turn = 1; turn <= 3; ++turn) {
            QThread *worked = nullptr, *finished = nullptr;
            runner.start([&](const std::stop_token&) {
                worked = QThread::currentThread();
                return [&] { finished = QThread::currentThread(); };
            });
            QVERIFY(runner.isRunning());
            QTRY_VERIFY_WITH_TIMEOUT(finished != nullptr, longestWait);
            QVERIFY(!runner.isRunning());
            QCOMPARE(finished, QThread::currentThread());
            QVERIFY(worked != finished);
        }
        QCOMPARE(failures.count(), 0);
    }

    void aStudyThatFailsSaysWhyAndTheNextOneRuns() {
        StudyRunner runner;
        QSignalSpy failures(&runner, &StudyRunner::failed);
        bool finished = false;
        const StudyRunner::Finish finish = [&] { finished = true; };
        runner.start([&](const std::stop_token&) {
            throw std::bad_alloc();
            return finish;
        });
        QTRY_COMPARE_WITH_TIMEOUT(failures.count(), 1, longestWait);
        QCOMPARE(failures.takeFirst().first().toString(),
                 QStringLiteral("Stopped: there is not enough memory for it"));
        QVERIFY(!runner.isRunning());
        QVERIFY(!finished);
        runner.start([&](const std::stop_token&) { return finish; });
        QTRY_VERIFY_WITH_TIMEOUT(finished, longestWait);
    }

    void itIsToldToStopAndWaitedFor() {
        std::atomic<bool> ended = false;
        bool finished = false;
        {
            StudyRunner runner;
            runner.start([&](const std::stop_token& stop) {
                while (!stop.stop_requested()) QThread::yieldCurrentThread();
                ended = true;
                return [&] { finished = true; };
            });
        }
        QVERIFY(ended);
        QCoreApplication::processEvents();
        QVERIFY(!finished); // whoever would show it is gone
    }
};

CAROM_TEST_WITH(QCoreApplication, study_runner_test, StudyRunnerTest)
#include "study_runner_test.moc"
