// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/whole_ide.h"

#include "core/math/rotation.h"
#include "ui/docks/inspector_dock.h"
#include "ui/viewport/gizmo.h"
#include "ui/window/live_preview.h"

#include <QRegularExpression>

#include <QColorDialog>
#include <QMenu>
#include <QTreeWidget>
#include <QSettings>

#include <numbers>

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

void lookDown(Ide& ide) {
    Camera above = ide.viewport.camera();
    above.pitch = 0.7;
    ide.viewport.setCamera(above);
}

/// A place of the selected body's gizmo at which a part of it is held.
QPoint handleOf(const Ide& ide, GizmoPart part) {
    const PictureSize size{double(ide.viewport.width()), double(ide.viewport.height())};
    const Pose pose = ide.bench.preview().shown()->scene().bodies[ide.viewport.selectedBody()].pose;
    const std::vector<GizmoHandle> handles = gizmoOf(ide.viewport.camera(), size, pose.position, true);
    for (const GizmoHandle& handle : handles) {
        if (handle.part != part) continue;
        std::vector<Eigen::Vector2d> places = handle.line;
        if (handle.closed) places = {(handle.line[0] + handle.line[2]) / 2};
        if (isAxis(part)) places = {0.25 * handle.line.front() + 0.75 * handle.line.back()};
        // Rings cross each other: a place at which this one is nearest, away from its ends.
        for (std::size_t i = 0; i < places.size(); ++i) {
            const Eigen::Vector2d& at = places[(i + places.size() / 3) % places.size()];
            const QPoint pixel(static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y())));
            if (partAt(handles, Eigen::Vector2d(pixel.x(), pixel.y())) == part) return pixel;
        }
    }
    qFatal("no such handle");
}

const Body& ballOf(const Ide& ide) { return ide.bench.preview().shown()->scene().bodies[0]; }

/// A cuboid's rotation [degrees].
Vec3 turnOf(const Ide& ide) {
    return 180 / std::numbers::pi * toRotationVector(ballOf(ide).pose.orientation);
}

/// [m], of what a drag by whole pixels can hit.
constexpr double pixel = 0.02;

} // namespace

class BodyDragTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void init() { QSettings().clear(); }

    void draggingABodyRewritesTheNumbersOfItsCentreOnly() {
        Ide ide(scene);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        const Camera camera = ide.viewport.camera();
        drag(ide, pixelOf(ide, {-1, 1, 0}), pixelOf(ide, {-1, 2, 0}));
        const QByteArray text = ide.editor.bytes();
        QVERIFY2(text.contains("{ radius .5 mass 1 centre -1.00, # left, 1\n "), text.constData());
        QVERIFY2(text.contains(", 0 vel 0,3.0,0 }\nsphere other {"), text.constData());
        QTRY_VERIFY_WITH_TIMEOUT((ballOf(ide).pose.position - Vec3(-1, 2, 0)).norm() < pixel, longestWait);
        QCOMPARE(ide.viewport.camera().yaw, camera.yaw); // the view has not turned
        QCOMPARE(ide.bench.preview().shown()->scene().bodies[1].pose.position, Vec3(1, 1, 0));

        ide.editor.undo(); // one step
        QCOMPARE(ide.editor.bytes(), scene);
    }

    void theBodyFollowsTheMouseBeforeTheTextIsBuilt() {
        Ide ide(scene);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
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
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
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
        QTRY_VERIFY_WITH_TIMEOUT(ide.current(), longestWait);
        QTRY_VERIFY_WITH_TIMEOUT((ballOf(ide).pose.position - Vec3(-1, 1, 0)).norm() < pixel, longestWait);
        drag(ide, pixelOf(ide, {-1, 1, 0}), pixelOf(ide, {-1, 2, 0}));
        QVERIFY(ide.editor.bytes() != scene);
    }

    void seenFromAboveABodyStaysAtItsHeight() {
        Ide ide(scene);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        lookDown(ide);
        drag(ide, pixelOf(ide, {-1, 1, 0}), pixelOf(ide, {-2, 1, 0.5}));
        QTRY_VERIFY_WITH_TIMEOUT((ballOf(ide).pose.position - Vec3(-2, 1, 0.5)).norm() < 3 * pixel,
                                 longestWait);
        QCOMPARE(ballOf(ide).pose.position.y(), 1.0);
    }

    void withCtrlABodySnapsToRoundPlaces() {
        Ide ide(scene);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        lookDown(ide);
        drag(ide, pixelOf(ide, {-1, 1, 0}), pixelOf(ide, {-1.87, 1, 0.53}), Qt::ControlModifier);
        QTRY_VERIFY_WITH_TIMEOUT(ballOf(ide).pose.position.x() < -1.5, longestWait);
        const double step = snapStep(ide.viewport.pixelSize());
        const Vec3 place = ballOf(ide).pose.position / step;
        QVERIFY(std::abs(place.x() - std::round(place.x())) < 1e-9);
        QVERIFY(std::abs(place.z() - std::round(place.z())) < 1e-9);
        QVERIFY(step >= 10 * ide.viewport.pixelSize() && step <= 26 * ide.viewport.pixelSize());
    }

    void anArrowOfTheGizmoMovesAlongItsAxisOnly() {
        Ide ide(scene);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        lookDown(ide);
        ide.viewport.setSelectedBody(0);
        const QPoint arrow = handleOf(ide, GizmoPart::AxisY);
        drag(ide, arrow, arrow - QPoint(3, 60));
        QTRY_VERIFY_WITH_TIMEOUT(ballOf(ide).pose.position.y() > 1.3, longestWait);
        QCOMPARE(ballOf(ide).pose.position.x(), -1.0);
        QCOMPARE(ballOf(ide).pose.position.z(), 0.0);
        QVERIFY2(ide.editor.bytes().contains("centre -1.00, # left, 1\n 1."), ide.editor.bytes().constData());
        ide.editor.undo();
        QCOMPARE(ide.editor.bytes(), scene);
    }

    void aSquareOfTheGizmoMovesInItsPlane() {
        Ide ide(scene);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        lookDown(ide);
        ide.viewport.setSelectedBody(0);
        const QPoint square = handleOf(ide, GizmoPart::PlaneZ);
        drag(ide, square, square + QPoint(40, -50));
        QTRY_VERIFY_WITH_TIMEOUT(ballOf(ide).pose.position.y() > 1.1, longestWait);
        QVERIFY(ballOf(ide).pose.position.x() > -0.9);
        QCOMPARE(ballOf(ide).pose.position.z(), 0.0);
    }

    void aRingTurnsACuboidAndWritesItsRotation() {
        // The second gives no rotation: it gets one behind its centre.
        for (const char* rotation : {" rotation 0, 20.0, 0", ""}) {
            Ide ide("camera { position 0,2,6 target 0,1,0 fov 40 }\n"
                    "cuboid { size 1,1,1 mass 1 centre 0,1,0" +
                    QByteArray(rotation) + " }\n");
            QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
            ide.viewport.setSelectedBody(0);
            const QPoint ring = handleOf(ide, GizmoPart::TurnY);
            drag(ide, ring, ring + QPoint(50, 0), Qt::ControlModifier);
            const double before = *rotation != 0 ? 20 : 0;
            QTRY_VERIFY_WITH_TIMEOUT(turnOf(ide).y() > before + 10, longestWait);
            const double turned = (turnOf(ide).y() - before) / 15;
            QVERIFY2(std::abs(turned - std::round(turned)) < 1e-6, ide.editor.bytes().constData());
            QVERIFY(std::abs(turnOf(ide).x()) < 1e-9 && std::abs(turnOf(ide).z()) < 1e-9);
            QVERIFY2(ide.editor.bytes().contains("centre 0,1,0 rotation 0, "),
                     ide.editor.bytes().constData());
        }
    }

    void aCylinderTurnsByItsAxis() {
        Ide ide("camera { position 0,2,6 target 0,1,0 fov 40 }\n"
                "cylinder { radius .3 height 1 mass 1 centre 0,1,0 axis 0, 2, 0 }\n");
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        ide.viewport.setSelectedBody(0);
        const QPoint ring = handleOf(ide, GizmoPart::TurnZ);
        drag(ide, ring, ring + QPoint(45, 45), Qt::ControlModifier);
        QTRY_VERIFY_WITH_TIMEOUT(ide.current() && !ide.editor.bytes().contains("axis 0, 2, 0"), longestWait);
        const Vec3 axis = ballOf(ide).pose.orientation * Vec3::UnitY();
        QVERIFY2(std::abs(axis.z()) < 1e-3 && std::abs(axis.x()) > 0.2, ide.editor.bytes().constData());
    }

    void theDecimalsAreThoseOfTheText() {
        Ide ide("camera { position 0,1,6 target 0,1,0 fov 40 }\n"
                "sphere { radius .5 mass 1 centre 0.123456789, 1.0, 0 }\n");
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        drag(ide, pixelOf(ide, {0.1, 1, 0}), pixelOf(ide, {0.1, 1.62, 0}));
        const QByteArray text = ide.editor.bytes();
        QVERIFY2(QRegularExpression(QStringLiteral("centre 0\\.123456789, 1\\.\\d, 0 "))
                     .match(QString::fromUtf8(text))
                     .hasMatch(),
                 text.constData());
    }

    void theValueStandsBesideTheMouse() {
        Ide ide(scene);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        lookDown(ide);
        ide.viewport.setSelectedBody(0);
        const BodyGrab grab{.part = GizmoPart::AxisX, .start = {}};
        DraggedBody now;
        now.pose.position.x() = 1.25;
        QCOMPARE(tellOf(grab, now, 0.01), QStringLiteral("x 1.25 m"));
        const BodyGrab ring{.handle = BodyHandle::Turn, .part = GizmoPart::TurnY, .start = {}};
        now.pose.orientation = fromRotationVector({0, std::numbers::pi / 6, 0});
        QCOMPARE(tellOf(ring, now, 0.01), QStringLiteral("30°"));
    }

    void theValueBesideTheMouseIsTheOneInTheText() {
        // `0` moves in steps of a tenth: the text said 0.5 where 0.471 stood beside the mouse.
        Ide ide("camera { position 0,1,6 target 0,1,0 fov 40 }\n"
                "sphere { radius .5 mass 1 centre 0, 1.50, 0 }\n");
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        QTest::mousePress(&ide.viewport, Qt::LeftButton, {}, pixelOf(ide, {0, 1.5, 0}));
        const QPoint there = pixelOf(ide, {0.471, 1.787, 0});
        QMouseEvent move(QEvent::MouseMove, there, ide.viewport.mapToGlobal(there), Qt::NoButton,
                         Qt::LeftButton, {});
        QApplication::sendEvent(&ide.viewport, &move);
        const QRegularExpressionMatch text =
            QRegularExpression(QStringLiteral("centre ([-.0-9]+), ([-.0-9]+), ([-.0-9]+) "))
                .match(QString::fromUtf8(ide.editor.bytes()));
        const QRegularExpressionMatch told =
            QRegularExpression(QStringLiteral("^x ([-.0-9]+), ([yz]) ([-.0-9]+) m$"))
                .match(ide.viewport.told());
        QVERIFY2(text.hasMatch() && told.hasMatch(), qPrintable(ide.viewport.told()));
        QCOMPARE(told.captured(1).toDouble(), text.captured(1).toDouble());
        const int second = told.captured(2) == QStringLiteral("y") ? 2 : 3;
        QCOMPARE(told.captured(3).toDouble(), text.captured(second).toDouble());
        QTest::mouseRelease(&ide.viewport, Qt::LeftButton, {}, there);
        QVERIFY(ide.viewport.told().isEmpty());
    }

    void draggingTheTipOfAVelocityRewritesIt() {
        Ide ide(scene);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        ide.trigger(ActionId::ShowVelocities);
        drag(ide, pixelOf(ide, {-1, 1.3, 0}), pixelOf(ide, {-0.6, 1.3, 0}));
        QTRY_VERIFY_WITH_TIMEOUT((ballOf(ide).velocity - Vec3(4, 3, 0)).norm() < 10 * pixel, longestWait);
        QCOMPARE(ballOf(ide).pose.position, Vec3(-1, 1, 0));
        QVERIFY(ide.editor.bytes().contains("centre -1.00, # left, 1\n"
                                            " 1.00, 0 vel "));
    }

    void whatIsWrittenInTheInspectorStandsInTheText() {
        Ide ide(scene);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        placeCaretBehind(ide.editor, "sphere ball");
        InspectorDock& inspector = ide.bench.window().inspector();
        QTRY_COMPARE_WITH_TIMEOUT(inspector.valueOf(QStringLiteral("radius")), QStringLiteral("0.5"),
                                  longestWait);
        inspector.edit(QStringLiteral("radius"), QStringLiteral("0.25"));
        QVERIFY(ide.editor.bytes().contains("sphere ball { radius 0.25 mass 1 centre -1.00, # left, 1\n"));
        QTRY_COMPARE_WITH_TIMEOUT(inspector.valueOf(QStringLiteral("radius")), QStringLiteral("0.25"),
                                  longestWait);
        inspector.edit(QStringLiteral("friction"), QStringLiteral("0.5")); // which it does not give
        QVERIFY2(ide.editor.bytes().contains("vel 0,3.0,0 friction 0.5 }\nsphere other"),
                 ide.editor.bytes().constData());
        inspector.edit(QStringLiteral("mass"), QStringLiteral("2 }")); // no number
        // A double click on the colour opens a dialog; what is chosen there is written.
        QTRY_VERIFY_WITH_TIMEOUT(ide.current(), longestWait);
        ide.bench.window().open(inspector);
        QTreeWidget* tree = inspector.findChild<QTreeWidget*>();
        QTreeWidgetItem* colour =
            tree->findItems(QStringLiteral("colour"), Qt::MatchExactly | Qt::MatchRecursive).front();
        tree->editItem(colour, 1);
        QColorDialog* dialog = nullptr;
        QTRY_VERIFY_WITH_TIMEOUT((dialog = inspector.findChild<QColorDialog*>()) != nullptr, longestWait);
        Q_EMIT dialog->colorSelected(QColor::fromRgbF(1, 0.5F, 0));
        dialog->close();
        QVERIFY2(ide.editor.bytes().contains("friction 0.5 colour 1, 0.5, 0 }"),
                 ide.editor.bytes().constData());
        ide.editor.undo();
        ide.editor.undo();
        ide.editor.undo();
        QCOMPARE(ide.editor.bytes(), scene);
    }

    void aSliderOfTheInspectorWritesTheLiteralAsOneUndoStep() {
        Ide ide(scene);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        placeCaretBehind(ide.editor, "sphere ball");
        InspectorDock& inspector = ide.bench.window().inspector();
        ide.bench.window().open(inspector);
        QTRY_COMPARE_WITH_TIMEOUT(inspector.valueOf(QStringLiteral("radius")), QStringLiteral("0.5"),
                                  longestWait);
        QTRY_VERIFY_WITH_TIMEOUT(ide.current(), longestWait);
        const auto slider = [&](const char* name) {
            return inspector.findChild<ValueSlider*>(QString::fromLatin1(name));
        };
        ValueSlider* radius = slider("radiusSlider");
        radius->setSliderDown(true);
        radius->setValue(60);
        QVERIFY2(ide.editor.bytes().contains("sphere ball { radius 0.60 mass 1"),
                 ide.editor.bytes().constData());
        QTRY_VERIFY_WITH_TIMEOUT( // live, and the slider is still the one that is held
            std::get<Sphere>(ide.bench.preview().shown()->scene().bodies[0].shape).radius == 0.6,
            longestWait);
        radius->setValue(80);
        QCOMPARE(slider("radiusSlider"), radius);
        QVERIFY(ide.editor.bytes().contains("sphere ball { radius 0.80 mass 1"));
        radius->setSliderDown(false);
        QTRY_VERIFY_WITH_TIMEOUT(ide.current() && slider("radiusSlider") != radius, longestWait);
        QCOMPARE(inspector.valueOf(QStringLiteral("radius")), QStringLiteral("0.8"));

        ValueSlider* friction = slider("frictionSlider"); // which the text does not give
        friction->setSliderDown(true);
        friction->setValue(30);
        friction->setValue(35);
        QVERIFY2(ide.editor.bytes().contains("vel 0,3.0,0 friction 0.35 }\nsphere other"),
                 ide.editor.bytes().constData());
        QTest::keyClick(&ide.editor, Qt::Key_Z, Qt::ControlModifier); // ends the step, and takes it back
        QVERIFY(!ide.editor.bytes().contains("friction"));
        friction->setValue(50); // held still, but no longer of anything
        friction->setSliderDown(false);
        QVERIFY(!ide.editor.bytes().contains("friction"));
        ide.editor.undo();
        QCOMPARE(ide.editor.bytes(), scene);
    }

    void aRightClickOffersWhatOneDoesWithABodyAndWithTheView() {
        Ide ide(scene);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        QTest::mouseClick(&ide.viewport, Qt::RightButton, {}, pixelOf(ide, {1, 1, 0}));
        QMenu* menu = nullptr;
        QTRY_VERIFY_WITH_TIMEOUT((menu = qobject_cast<QMenu*>(QApplication::activePopupWidget())) != nullptr,
                                 longestWait);
        QCOMPARE(menu->actions().front()->text(), QStringLiteral("other"));
        QCOMPARE(ide.viewport.selectedBody(), BodyIndex{1});
        const QList<QAction*> offered = menu->actions();
        QVERIFY(offered.contains(&ide.bench.window().actions()[ActionId::FrameSelection]));
        QVERIFY(offered.contains(&ide.bench.window().actions()[ActionId::Orthographic]));
        menu->close();
        ide.trigger(ActionId::ViewTop);
        QVERIFY(std::abs(ide.viewport.camera().pitch - std::numbers::pi / 2) < 1e-9);
        ide.trigger(ActionId::Orthographic);
        QVERIFY(ide.viewport.camera().orthographic);
        // A drag with the right button moves the view and opens nothing.
        QTest::mousePress(&ide.viewport, Qt::RightButton, {}, ide.place(0.3, 0.8));
        const QPoint to = ide.place(0.4, 0.8);
        QMouseEvent move(QEvent::MouseMove, to, ide.viewport.mapToGlobal(to), Qt::NoButton, Qt::RightButton,
                         {});
        QApplication::sendEvent(&ide.viewport, &move);
        QTest::mouseRelease(&ide.viewport, Qt::RightButton, {}, to);
        QVERIFY(QApplication::activePopupWidget() == nullptr);
    }

    void laterInARunADragTurnsTheView() {
        Ide ide(scene);
        ide.trigger(ActionId::Step);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 1, longestWait);
        const double yaw = ide.viewport.camera().yaw;
        drag(ide, pixelOf(ide, {-1, 1, 0}), pixelOf(ide, {0, 1, 0}));
        QCOMPARE(ide.editor.bytes(), scene);
        QVERIFY(ide.viewport.camera().yaw != yaw);
    }

    void onEmptySpaceADragTurnsTheViewAsEver() {
        Ide ide(scene);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        const double yaw = ide.viewport.camera().yaw;
        drag(ide, ide.place(0.5, 0.05), ide.place(0.7, 0.05));
        QCOMPARE(ide.editor.bytes(), scene);
        QVERIFY(ide.viewport.camera().yaw != yaw);
    }
};

CAROM_TEST_WITH(IdeApplication, body_drag_test, BodyDragTest)
#include "body_drag_test.moc"
