// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "ui/viewport/gestures.h"

#include <QSignalSpy>
#include <QTest>

namespace carom {

namespace {

MouseState down(double x, double y, Qt::MouseButtons buttons = Qt::LeftButton,
                Qt::MouseButton button = Qt::LeftButton, Qt::KeyboardModifiers keys = Qt::NoModifier) {
    return {{x, y}, button, buttons, keys};
}
MouseState over(double x, double y, Qt::MouseButtons buttons = Qt::LeftButton,
                Qt::KeyboardModifiers keys = Qt::NoModifier) {
    return {{x, y}, Qt::NoButton, buttons, keys};
}
MouseState up(double x, double y, Qt::MouseButtons left = Qt::NoButton,
              Qt::MouseButton button = Qt::LeftButton) {
    return {{x, y}, button, left, Qt::NoModifier};
}

/// Left of x = 100 there is a body to be taken.
std::optional<BodyGrab> bodyAt(const QPointF& place) {
    if (place.x() >= 100) return std::nullopt;
    BodyGrab grab;
    grab.body = 3;
    return grab;
}

/// What a row of mouse events has come to.
struct Told {
    Gestures gestures{bodyAt};
    QSignalSpy grabbed{&gestures, &Gestures::grabbed}, pulled{&gestures, &Gestures::pulled},
        dropped{&gestures, &Gestures::dropped}, viewDragged{&gestures, &Gestures::viewDragged},
        clicked{&gestures, &Gestures::clicked};
};

} // namespace

class GesturesTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void aShortWayIsAClickOnABodyToo() {
        Told told;
        told.gestures.press(down(50, 50));
        QCOMPARE(told.gestures.held()->body, BodyIndex{3});
        told.gestures.move(over(52, 51));
        told.gestures.release(up(52, 51));
        QCOMPARE(told.clicked.count(), 1);
        QCOMPARE(told.clicked[0][1].toPointF(), QPointF(52, 51));
        QCOMPARE(told.grabbed.count() + told.pulled.count() + told.viewDragged.count(), 0);
        QCOMPARE(told.dropped.count(), 1);
        QVERIFY(!told.dropped[0][0].toBool());
    }

    void aBodyFollowsFromTheFourthPixelToTheRelease() {
        Told told;
        told.gestures.press(down(50, 50));
        told.gestures.move(over(53, 50));
        QCOMPARE(told.pulled.count(), 0);
        told.gestures.move(over(54, 50));
        told.gestures.move(over(200, 60, Qt::LeftButton, Qt::ControlModifier));
        QCOMPARE(told.grabbed.count(), 1);
        QCOMPARE(told.pulled.count(), 2);
        QCOMPARE(told.pulled[1][0].toPointF(), QPointF(200, 60));
        QVERIFY(!told.pulled[0][1].toBool() && told.pulled[1][1].toBool()); // in round steps
        told.gestures.release(up(200, 60));
        QCOMPARE(told.dropped.count(), 1);
        QVERIFY(told.dropped[0][0].toBool());
        QVERIFY(told.gestures.held() == nullptr && !told.gestures.isDragging());
        QCOMPARE(told.clicked.count() + told.viewDragged.count(), 0);
    }

    void theViewFollowsWhereThereIsNoBodyAndWithShiftOverOne() {
        Told told;
        told.gestures.press(down(150, 50));
        told.gestures.move(over(160, 57));
        told.gestures.move(over(161, 59));
        told.gestures.release(up(161, 59));
        QCOMPARE(told.viewDragged.count(), 2);
        QCOMPARE(told.viewDragged[0][0].value<Gesture>(), Gesture::Orbit);
        QCOMPARE(told.viewDragged[0][1].toPointF(), QPointF(10, 7));
        QCOMPARE(told.viewDragged[1][1].toPointF(), QPointF(1, 2));
        QCOMPARE(told.clicked.count(), 0);
        told.gestures.press(down(50, 50, Qt::LeftButton, Qt::LeftButton, Qt::ShiftModifier));
        told.gestures.move(over(60, 50, Qt::LeftButton, Qt::ShiftModifier));
        QCOMPARE(told.viewDragged[2][0].value<Gesture>(), Gesture::Pan);
        QCOMPARE(told.pulled.count(), 0);
    }

    // The second button's release used to be taken for the end of the drag's, and undo stayed open.
    void aSecondButtonEndsADragAndNothingBeginsUntilBothAreUp() {
        Told told;
        told.gestures.press(down(50, 50));
        told.gestures.move(over(60, 50));
        told.gestures.press(down(60, 50, Qt::LeftButton | Qt::RightButton, Qt::RightButton));
        QCOMPARE(told.dropped.count(), 1);
        QVERIFY(told.dropped[0][0].toBool());
        told.gestures.move(over(80, 50, Qt::LeftButton | Qt::RightButton));
        told.gestures.release(up(80, 50, Qt::LeftButton, Qt::RightButton));
        told.gestures.move(over(90, 50));
        told.gestures.press(down(90, 50, Qt::LeftButton | Qt::MiddleButton, Qt::MiddleButton));
        told.gestures.release(up(90, 50, Qt::LeftButton, Qt::MiddleButton));
        told.gestures.release(up(90, 50));
        QCOMPARE(told.pulled.count(), 1);
        QCOMPARE(told.clicked.count() + told.viewDragged.count(), 0);
        told.gestures.press(down(50, 50));
        told.gestures.move(over(70, 50));
        QCOMPARE(told.pulled.count(), 2);
    }

    void afterLettingGoTheMouseDoesNothingUntilTheNextPress() {
        Told told;
        told.gestures.letGo(); // nothing is held
        told.gestures.press(down(50, 50));
        told.gestures.move(over(60, 50));
        told.gestures.letGo();
        told.gestures.letGo();
        QCOMPARE(told.dropped.count(), 1);
        told.gestures.move(over(70, 50));
        told.gestures.release(up(70, 50));
        QCOMPARE(told.pulled.count(), 1);
        QCOMPARE(told.clicked.count(), 0);
        // The release may have gone to another window.
        told.gestures.press(down(50, 50));
        told.gestures.letGo();
        told.gestures.press(down(50, 50));
        told.gestures.release(up(50, 50));
        QCOMPARE(told.clicked.count(), 1);
    }

    // An undo, asked for when the drag begins, lets go of the body.
    void whoeverHearsOfADragMayLetGo() {
        Told told;
        connect(&told.gestures, &Gestures::grabbed, &told.gestures, [&told] { told.gestures.letGo(); });
        told.gestures.press(down(50, 50));
        told.gestures.move(over(60, 50));
        QCOMPARE(told.pulled.count(), 0);
        QCOMPARE(told.dropped.count(), 1);
    }

    void theCameraFollowsAsNavigationSays() {
        const PictureSize picture{400, 300};
        Camera turned, zoomed, wheeled;
        follow(turned, picture, Gesture::Orbit, {10, 0});
        QCOMPARE(turned.yaw, Camera{}.yaw - 0.08);
        follow(zoomed, picture, Gesture::Zoom, {0, -60}); // two notches' way
        zoomByNotches(wheeled, wheeled.target, 2);
        QCOMPARE(zoomed.distance, wheeled.distance);
        QVERIFY(zoomed.distance < Camera{}.distance);
    }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, gestures_test, carom::GesturesTest)
#include "gestures_test.moc"
