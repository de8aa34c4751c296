// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/files.h"
#include "tests/support/test_class.h"

#include "ui/viewport/drawing_thread.h"

#include <QApplication>
#include <QSignalSpy>
#include <QTest>

namespace carom::test {

class DrawingThreadTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    // Once in thirty starts the thread had found out that there is no OpenGL before anybody listened, and
    // `carom
    // --picture` waited a minute for a picture. The same loss of `ready` left the viewport empty.
    void whatTheThreadFindsOutIsToldToThoseWhoConnectAfterIt() {
        DrawingThread drawing;
        const bool hasGraphicsCard = drawing.hasGraphicsCard(); // waits until the thread knows
        QSignalSpy ready(&drawing, &DrawingThread::ready);
        QSignalSpy failed(&drawing, &DrawingThread::failed);
        QTRY_COMPARE_WITH_TIMEOUT(ready.count() + failed.count(), 1, patience);
        QCOMPARE(ready.count(), 1);
        QCOMPARE(ready.first().first().toBool(), !hasGraphicsCard);
    }
};

} // namespace carom::test

CAROM_TEST_WITH(QApplication, drawing_thread_test, carom::test::DrawingThreadTest)
#include "drawing_thread_test.moc"
