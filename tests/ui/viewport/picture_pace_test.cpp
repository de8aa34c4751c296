// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "ui/viewport/picture_pace.h"

#include <QTest>

using namespace carom;

class PicturePaceTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void picturesOfAGraphicsCardAreWholeAndFollowEachOtherAtOnce() {
        PicturePace pace;
        for (int i = 0; i < 10; ++i) pace.note(2, true);
        QVERIFY(!pace.leavesShadowsOut());
        QCOMPARE(pace.pause(), 0.0);
    }

    void dearPicturesLoseTheirShadowsAndLeaveTheThreadFreeForAWhile() {
        PicturePace pace;
        pace.note(80, true);
        QVERIFY(pace.leavesShadowsOut());
        QCOMPARE(pace.pause(), 40.0);
        pace.note(20, false); // without them it is quick enough for 30 a second
        QVERIFY(pace.leavesShadowsOut());
        QCOMPARE(pace.pause(), 0.0);
    }

    void theyComeBackOnceTheyWouldNotBeDear() {
        PicturePace pace;
        pace.note(80, true);
        pace.note(5, false);
        QVERIFY(!pace.leavesShadowsOut());
        pace.note(80, true);
        pace.forget(); // another scene
        QVERIFY(!pace.leavesShadowsOut());
        QCOMPARE(pace.pause(), 0.0);
    }
};

CAROM_TEST(picture_pace_test, PicturePaceTest)
#include "picture_pace_test.moc"
