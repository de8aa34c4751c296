// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/whole_ide.h"

#include "ui/window/live_preview.h"

#include <QSettings>

using namespace carom;
using namespace carom::test;

namespace {

const QByteArray scene = "camera { position 0,1,6 target 0,1,0 fov 40 }\n"
                         "sphere ball { radius .5 mass 1 centre -1.00, # left, 1\n"
                         " 1.00, 0 vel 0,3.0,0 }\n"
                         "sphere other { radius .5 mass 1 centre 1,1,0 }\n";

QPoint pixelOf(const Ide& ide, const Vec3& point) {
    const PictureSize size{double(ide.viewport.width()), double(ide.viewport.height())};
    const Eigen::Vector2d at = *projected(ide.viewport.camera(), size, point);
    return {static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y()))};
}

void drag(Ide& ide, QPoint from, QPoint to, Qt::KeyboardModifiers keys = {}) {
    QTest::mousePress(&ide.viewport, Qt::LeftButton, keys, from);
    for (int i = 1; i <= 5; ++i) {
        const QPoint at = from + (to - from) * i / 5;
        QMouseEvent move(QEvent::MouseMove, at, ide.viewport.mapToGlobal(at), Qt::NoButton, Qt::LeftButton,
                         keys);
        QApplication::sendEvent(&ide.viewport, &move);
    }
    QTest::mouseRelease(&ide.viewport, Qt::LeftButton, keys, to);
}

const Body& ballOf(const Ide& ide) { return ide.bench.preview().shown()->scene().bodies[0]; }

/// [m], of what a drag by whole pixels can hit.
constexpr double pixel = 0.02;

} // namespace

class BodyDragTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void init() { QSettings().clear(); }

    void draggingABodyRewritesTheNumbersOfItsCentreOnly() {
        Ide ide(scene);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, patience);
        const Camera camera = ide.viewport.camera();
        drag(ide, pixelOf(ide, {-1, 1, 0}), pixelOf(ide, {-1, 2, 0}));
        const QByteArray text = ide.editor.bytes();
        QVERIFY2(text.contains("{ radius .5 mass 1 centre -1.00, # left, 1\n "), text.constData());
        QVERIFY2(text.contains(", 0 vel 0,3.0,0 }\nsphere other {"), text.constData());
        QTRY_VERIFY_WITH_TIMEOUT((ballOf(ide).pose.position - Vec3(-1, 2, 0)).norm() < pixel, patience);
        QCOMPARE(ide.viewport.camera().yaw, camera.yaw); // the view has not turned
        QCOMPARE(ide.bench.preview().shown()->scene().bodies[1].pose.position, Vec3(1, 1, 0));

        ide.editor.undo(); // one step
        QCOMPARE(ide.editor.bytes(), scene);
    }

    void theBodyFollowsTheMouseBeforeTheTextIsBuilt() {
        Ide ide(scene);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, patience);
        const QPoint there = pixelOf(ide, {-1, 2, 0});
        QVERIFY(ide.viewport.hitAt(there).body != 0);
        QTest::mousePress(&ide.viewport, Qt::LeftButton, {}, pixelOf(ide, {-1, 1, 0}));
        QMouseEvent move(QEvent::MouseMove, there, ide.viewport.mapToGlobal(there), Qt::NoButton,
                         Qt::LeftButton, {});
        QApplication::sendEvent(&ide.viewport, &move);
        QCOMPARE(ide.viewport.hitAt(there).body, BodyIndex{0});
        QTest::mouseRelease(&ide.viewport, Qt::LeftButton, {}, there);
    }

    void whateverInterruptsADragClosesItAndItsUndoStep_data() {
        QTest::addColumn<QString>("how");
        for (const char* how :
             {"another button", "a shortcut", "the keyboard goes", "the viewport is hidden"})
            QTest::newRow(how) << how;
    }
    void whateverInterruptsADragClosesItAndItsUndoStep() {
        QFETCH(QString, how);
        Ide ide(scene);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, patience);
        const QPoint from = pixelOf(ide, {-1, 1, 0}), to = pixelOf(ide, {-1, 2, 0});
        ide.viewport.setFocus();
        QTest::mousePress(&ide.viewport, Qt::LeftButton, {}, from);
        const auto moveTo = [&](const QPoint& at, Qt::MouseButtons buttons) {
            QMouseEvent move(QEvent::MouseMove, at, ide.viewport.mapToGlobal(at), Qt::NoButton, buttons, {});
            QApplication::sendEvent(&ide.viewport, &move);
        };
        moveTo(to, Qt::LeftButton);
        const QByteArray dragged = ide.editor.bytes();
        QVERIFY(dragged != scene);
        if (how == QStringLiteral("another button")) {
            QMouseEvent press(QEvent::MouseButtonPress, to, ide.viewport.mapToGlobal(to), Qt::RightButton,
                              Qt::LeftButton | Qt::RightButton, {});
            QApplication::sendEvent(&ide.viewport, &press);
        } else if (how == QStringLiteral("a shortcut")) {
            QKeyEvent key(QEvent::ShortcutOverride, Qt::Key_S, Qt::ControlModifier);
            QApplication::sendEvent(&ide.viewport, &key);
        } else if (how == QStringLiteral("the keyboard goes")) {
            ide.editor.setFocus();
        } else {
            ide.viewport.hide();
        }
        moveTo(from, Qt::LeftButton); // the button is down, and nothing moves any more
        QCOMPARE(ide.editor.bytes(), dragged);
        ide.viewport.show();
        QTest::mouseRelease(&ide.viewport, Qt::LeftButton, {}, from);
        typeAtTheEnd(ide.editor, "// x");
        ide.editor.undo(); // the typing alone
        QCOMPARE(ide.editor.bytes(), dragged);
        ide.editor.undo();
        QCOMPARE(ide.editor.bytes(), scene);
        // And one can drag again.
        QTRY_VERIFY_WITH_TIMEOUT(ide.current(), patience);
        QTRY_VERIFY_WITH_TIMEOUT((ballOf(ide).pose.position - Vec3(-1, 1, 0)).norm() < pixel, patience);
        drag(ide, pixelOf(ide, {-1, 1, 0}), pixelOf(ide, {-1, 2, 0}));
        QVERIFY(ide.editor.bytes() != scene);
    }

    void withCtrlABodyStaysAtItsHeight() {
        Ide ide(scene);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, patience);
        Camera above = ide.viewport.camera();
        above.pitch = 0.7;
        ide.viewport.setCamera(above);
        drag(ide, pixelOf(ide, {-1, 1, 0}), pixelOf(ide, {-2, 1, 0.5}), Qt::ControlModifier);
        QTRY_VERIFY_WITH_TIMEOUT((ballOf(ide).pose.position - Vec3(-2, 1, 0.5)).norm() < 3 * pixel, patience);
        QCOMPARE(ballOf(ide).pose.position.y(), 1.0);
    }

    void draggingTheTipOfAVelocityRewritesIt() {
        Ide ide(scene);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, patience);
        ide.trigger(ActionId::ShowVelocities);
        drag(ide, pixelOf(ide, {-1, 1.3, 0}), pixelOf(ide, {-0.6, 1.3, 0}));
        QTRY_VERIFY_WITH_TIMEOUT((ballOf(ide).velocity - Vec3(4, 3, 0)).norm() < 10 * pixel, patience);
        QCOMPARE(ballOf(ide).pose.position, Vec3(-1, 1, 0));
        QVERIFY(ide.editor.bytes().contains("centre -1.00, # left, 1\n"
                                            " 1.00, 0 vel "));
    }

    void laterInARunADragTurnsTheView() {
        Ide ide(scene);
        ide.trigger(ActionId::Step);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 1, patience);
        const double yaw = ide.viewport.camera().yaw;
        drag(ide, pixelOf(ide, {-1, 1, 0}), pixelOf(ide, {0, 1, 0}));
        QCOMPARE(ide.editor.bytes(), scene);
        QVERIFY(ide.viewport.camera().yaw != yaw);
    }

    void onEmptySpaceADragTurnsTheViewAsEver() {
        Ide ide(scene);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, patience);
        const double yaw = ide.viewport.camera().yaw;
        drag(ide, ide.place(0.5, 0.05), ide.place(0.7, 0.05));
        QCOMPARE(ide.editor.bytes(), scene);
        QVERIFY(ide.viewport.camera().yaw != yaw);
    }
};

CAROM_TEST_WITH(IdeApplication, body_drag_test, BodyDragTest)
#include "body_drag_test.moc"
