// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/files.h"
#include "tests/support/test_class.h"

#include "ui/viewport/picture_schedule.h"

#include <QCoreApplication>
#include <QSignalSpy>
#include <QTest>

namespace carom {

using test::longestWait;

class PictureScheduleTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void changesThatComeTogetherAreOnePictureAndThereIsOneAtATime() {
        PictureSchedule schedule([] { return true; });
        QSignalSpy due(&schedule, &PictureSchedule::due);
        schedule.changed(); // nothing can be drawn yet
        QCoreApplication::processEvents();
        QCOMPARE(due.count(), 0);
        schedule.setReady(false);
        schedule.changed();
        schedule.changed();
        QTRY_COMPARE_WITH_TIMEOUT(due.count(), 1, longestWait);
        QVERIFY(schedule.begin());
        QVERIFY(!schedule.begin());
        schedule.changed(); // while it is drawn
        QCoreApplication::processEvents();
        QCOMPARE(due.count(), 1);
        schedule.ended(2);
        QTRY_COMPARE_WITH_TIMEOUT(due.count(), 2, longestWait);
        QVERIFY(schedule.begin());
        schedule.ended(2);
        QVERIFY(!schedule.begin()); // nothing has changed
    }

    void whatNobodySeesIsNotDrawn() {
        bool seen = false;
        PictureSchedule schedule([&seen] { return seen; });
        QSignalSpy due(&schedule, &PictureSchedule::due);
        schedule.setReady(false);
        QCoreApplication::processEvents();
        QCOMPARE(due.count(), 0);
        QVERIFY(!schedule.begin());
        seen = true;
        schedule.changed();
        QTRY_COMPARE_WITH_TIMEOUT(due.count(), 1, longestWait);
        QVERIFY(schedule.begin());
    }

    // The processor simulates as well: while things move its pictures are plain, at rest they are smooth.
    void inSoftwarePicturesAreSmoothOnceNothingMoves() {
        PictureSchedule schedule([] { return true; });
        QSignalSpy due(&schedule, &PictureSchedule::due);
        schedule.setReady(true);
        QTRY_COMPARE_WITH_TIMEOUT(due.count(), 1, longestWait);
        QVERIFY(schedule.begin());
        QVERIFY(!schedule.isSmooth() && schedule.hasShadows());
        schedule.ended(80); // dear: the next one goes without shadows
        schedule.changed();
        QVERIFY(schedule.begin());
        QVERIFY(!schedule.hasShadows());
        schedule.ended(20);
        QTRY_VERIFY_WITH_TIMEOUT(schedule.isSmooth(), longestWait);
        QVERIFY(schedule.begin() && schedule.hasShadows()); // though nobody said changed()
    }

    void onAGraphicsCardEveryPictureIsSmooth() {
        PictureSchedule schedule([] { return true; });
        schedule.setReady(false);
        QVERIFY(schedule.begin());
        QVERIFY(schedule.isSmooth() && schedule.hasShadows());
        schedule.ended(500);
        schedule.changed();
        QVERIFY(schedule.begin());
        QVERIFY(schedule.hasShadows());
    }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, picture_schedule_test, carom::PictureScheduleTest)
#include "picture_schedule_test.moc"
