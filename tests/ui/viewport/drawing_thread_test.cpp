// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/files.h"
#include "tests/support/test_class.h"

#include "ui/viewport/drawing_thread.h"

#include <QApplication>
#include <QProcess>
#include <QSignalSpy>
#include <QTest>

namespace carom::test {

class DrawingThreadTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    // Once in thirty starts the thread had found out that there is no OpenGL before anybody listened, and
    // `carom --picture` waited a minute for a picture. The same loss of `ready` left the viewport empty.
    void whatTheThreadFindsOutIsToldToThoseWhoConnectAfterIt() {
        DrawingThread drawing;
        const bool hasGraphicsCard = drawing.hasGraphicsCard(); // waits until the thread knows
        QSignalSpy ready(&drawing, &DrawingThread::ready);
        QSignalSpy failed(&drawing, &DrawingThread::failed);
        QTRY_COMPARE_WITH_TIMEOUT(ready.count() + failed.count(), 1, longestWait);
        QCOMPARE(ready.count(), 1);
        QCOMPARE(ready.first().first().toBool(), !hasGraphicsCard);
    }

    void twoDrawAtOnce() {
        constexpr int times = 25;
        for (int i = 0; i < times; ++i) {
            DrawingThread one, other;
            QCOMPARE(one.hasGraphicsCard(), other.hasGraphicsCard());
        }
    }

    // There Qt shares one connection to the X server between all threads, without a lock: two drawing threads
    // hung, or ended in malloc.
    void twoDrawAtOnceOnTheOffscreenPlatform() {
        QProcess again;
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        environment.insert(QStringLiteral("QT_QPA_PLATFORM"), QStringLiteral("offscreen"));
        again.setProcessEnvironment(environment);
        again.setProcessChannelMode(QProcess::MergedChannels);
        again.start(QCoreApplication::applicationFilePath(),
                    {QStringLiteral("drawing_thread_test"), QStringLiteral("twoDrawAtOnce")});
        const bool ended = again.waitForFinished(longestWait);
        if (!ended) again.kill();
        again.waitForFinished(longestWait);
        QVERIFY2(ended && again.exitStatus() == QProcess::NormalExit && again.exitCode() == 0,
                 again.readAll().constData());
    }
};

} // namespace carom::test

CAROM_TEST_WITH(QApplication, drawing_thread_test, carom::test::DrawingThreadTest)
#include "drawing_thread_test.moc"
