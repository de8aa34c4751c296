// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/whole_ide.h"

#include "ui/docks/outline_dock.h"
#include "ui/editor/call_tip_box.h"
#include "ui/editor/colour_marks.h"
#include "ui/editor/rename_box.h"
#include "ui/window/live_preview.h"

#include <QColorDialog>
#include <QLineEdit>
#include <QScrollBar>
#include <QTreeView>
#include <QWheelEvent>

using namespace carom;
using namespace carom::test;
using Sci = QsciScintillaBase;

// The Text menu and the outline, driven by keys and mouse in the whole IDE.

namespace {

const QByteArray tied = twoBalls + "spring { from left to right stiffness 5 }\n";

QPoint placeOfText(const SceneEditor& editor, const QByteArray& behind) {
    const qsizetype at = editor.bytes().indexOf(behind) + behind.size();
    return {static_cast<int>(editor.send(Sci::SCI_POINTXFROMPOSITION, 0, at)) + 2,
            static_cast<int>(editor.send(Sci::SCI_POINTYFROMPOSITION, 0, at)) + 6};
}

void turnWheel(SceneEditor& editor, const QPoint& place, int notches) {
    for (int i = 0; i < std::abs(notches); ++i) {
        QWheelEvent event(place, editor.viewport()->mapToGlobal(place), {}, {0, notches > 0 ? 120 : -120},
                          Qt::NoButton, Qt::AltModifier, Qt::NoScrollPhase, false);
        QApplication::sendEvent(editor.viewport(), &event);
    }
}

void turnWheelWith(SceneEditor& editor, const QPoint& place, Qt::KeyboardModifiers keys) {
    QWheelEvent event(place, editor.viewport()->mapToGlobal(place), {}, {0, 120}, Qt::NoButton, keys,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(editor.viewport(), &event);
}

void dragWithAlt(SceneEditor& editor, const QPoint& from, const QPoint& way) {
    QTest::mousePress(editor.viewport(), Qt::LeftButton, Qt::AltModifier, from);
    for (int i = 1; i <= 10; ++i) {
        const QPoint at = from + way * i / 10;
        QMouseEvent move(QEvent::MouseMove, at, editor.viewport()->mapToGlobal(at), Qt::NoButton,
                         Qt::LeftButton, Qt::AltModifier);
        QApplication::sendEvent(editor.viewport(), &move);
    }
    QTest::mouseRelease(editor.viewport(), Qt::LeftButton, Qt::AltModifier, from + way);
}

void hover(SceneEditor& editor, const QPoint& place) {
    QMouseEvent move(QEvent::MouseMove, place, editor.viewport()->mapToGlobal(place), Qt::NoButton,
                     Qt::NoButton, Qt::NoModifier);
    QApplication::sendEvent(editor.viewport(), &move);
}

void moveHandle(QWidget& handle, const QPoint& to, Qt::KeyboardModifiers keys) {
    QMouseEvent move(QEvent::MouseMove, to, handle.mapToGlobal(to), Qt::NoButton, Qt::LeftButton, keys);
    QApplication::sendEvent(&handle, &move);
}

void dragHandle(QWidget& handle, int way, Qt::KeyboardModifiers keys) {
    const QPoint from = handle.rect().center();
    QTest::mousePress(&handle, Qt::LeftButton, keys, from);
    moveHandle(handle, from + QPoint(way, 0), keys);
    QTest::mouseRelease(&handle, Qt::LeftButton, keys, from + QPoint(way, 0));
}

} // namespace

class LanguageTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void f12GoesFromASpringToTheBodyItNames() {
        Ide ide(tied);
        placeCaretBehind(ide.editor, "to ri");
        QTest::keyClick(&ide.editor, Qt::Key_F12);
        QCOMPARE(ide.editor.caret(), static_cast<std::uint32_t>(ide.editor.bytes().indexOf("right {")));
    }

    void f2RenamesALabelEverywhereInOneUndoStep() {
        Ide ide(tied);
        placeCaretBehind(ide.editor, "sphere le");
        QTest::keyClick(&ide.editor, Qt::Key_F2);
        RenameBox* box = ide.editor.findChild<RenameBox*>();
        QVERIFY(box->isVisible());
        QLineEdit* name = box->findChild<QLineEdit*>();
        QTest::keyClicks(name, QStringLiteral("right"));
        QTest::keyClick(name, Qt::Key_Return);
        QVERIFY(box->isVisible()); // taken: refused, and said so
        QCOMPARE(ide.editor.bytes(), tied);
        name->selectAll();
        QTest::keyClicks(name, QStringLiteral("cue"));
        QTest::keyClick(name, Qt::Key_Return);
        QVERIFY(!box->isVisible());
        QVERIFY(ide.editor.bytes().contains("sphere cue {"));
        QVERIFY(ide.editor.bytes().contains("from cue to right"));
        ide.editor.undo();
        QCOMPARE(ide.editor.bytes(), tied);
    }

    void escapeLeavesTheLabelAsItIs() {
        Ide ide(tied);
        placeCaretBehind(ide.editor, "sphere le");
        QTest::keyClick(&ide.editor, Qt::Key_F2);
        RenameBox* box = ide.editor.findChild<RenameBox*>();
        QTest::keyClicks(box->findChild<QLineEdit*>(), QStringLiteral("cue"));
        QTest::keyClick(box->findChild<QLineEdit*>(), Qt::Key_Escape);
        QVERIFY(!box->isVisible());
        QVERIFY(ide.editor.hasFocus());
        QCOMPARE(ide.editor.bytes(), tied);
    }

    void formattingKeepsTheCaretAtItsWordAndIsOneUndoStep() {
        const QByteArray ragged = "sphere  left{radius .5 mass 1\ncentre -1,1,0 // here\n}\n";
        Ide ide(ragged);
        placeCaretBehind(ide.editor, "centre");
        QTest::keyClick(&ide.editor, Qt::Key_F, Qt::ShiftModifier | Qt::AltModifier);
        QVERIFY(ide.editor.bytes().contains("sphere left {"));
        QVERIFY(ide.editor.bytes().left(ide.editor.caret()).endsWith("centre"));
        ide.editor.undo();
        QCOMPARE(ide.editor.bytes(), ragged);
    }

    void theCallTipFollowsTheCaretUntilEscape() {
        Ide ide;
        placeCaretBehind(ide.editor, "sphere left { ");
        QTest::keyClick(&ide.editor, Qt::Key_Space, Qt::ControlModifier | Qt::ShiftModifier);
        const CallTipBox* tip = ide.editor.findChild<CallTipBox*>();
        QVERIFY(tip->isShown());
        QTest::keyClicks(&ide.editor, QStringLiteral("1"));
        QVERIFY(tip->isShown());
        QTest::keyClick(&ide.editor, Qt::Key_Escape);
        QVERIFY(!tip->isShown());
        QTest::keyClick(&ide.editor, Qt::Key_Right);
        QVERIFY(!tip->isShown());
        placeCaretBehind(ide.editor, "}\n");
        ide.trigger(ActionId::CallTip);
        QVERIFY(!tip->isShown()); // between declarations there is nothing to say
    }

    void tabBehindATypeInsertsADeclarationAndGoesThroughItsValues() {
        Ide ide;
        typeAtTheEnd(ide.editor, "sphere");
        QTest::keyClick(&ide.editor, Qt::Key_Tab);
        QVERIFY(ide.editor.bytes().contains("radius"));
        QVERIFY(ide.editor.hasSelectedText());
        QTest::keyClicks(&ide.editor, QStringLiteral("3"));
        QTest::keyClick(&ide.editor, Qt::Key_Tab);
        QTest::keyClicks(&ide.editor, QStringLiteral("7"));
        QVERIFY(ide.editor.bytes().contains("radius 3\n"));
        QVERIFY(ide.editor.bytes().contains("mass 7\n"));
        QTest::keyClick(&ide.editor, Qt::Key_Tab);
        QTest::keyClick(&ide.editor, Qt::Key_Tab);
        QCOMPARE(ide.editor.caret(), static_cast<std::uint32_t>(ide.editor.bytes().size()));
        QTRY_COMPARE_WITH_TIMEOUT(ide.bench.preview().shown()->scene().bodies.size(), std::size_t{4},
                                  longestWait);
    }

    void altAndTheWheelTurnTheNumberUnderTheMouse() {
        Ide ide;
        turnWheel(ide.editor, placeOfText(ide.editor, "centre -"), 3);
        QVERIFY(ide.editor.bytes().contains("centre -0.7,1,0 vel"));
        turnWheel(ide.editor, placeOfText(ide.editor, "centre -"), -1);
        QVERIFY(ide.editor.bytes().contains("centre -0.8,1,0 vel"));
        ide.editor.undo(); // one turn without a pause is one step
        QCOMPARE(ide.editor.bytes(), twoBalls);
    }

    void shiftAndCtrlMakeTheStepLargerAndSmallerAndAltCanBeDoneWithout() {
        Ide ide("simulation { substeps 4 }\nsphere { radius 2.345678901 mass 1 centre 0,0,0 }");
        const QPoint place = placeOfText(ide.editor, "radius 2.");
        turnWheelWith(ide.editor, place, Qt::ControlModifier | Qt::ShiftModifier);
        QVERIFY2(ide.editor.bytes().contains("radius 2.445678901 "), ide.editor.bytes().constData());
        turnWheelWith(ide.editor, place, Qt::AltModifier | Qt::ShiftModifier);
        QVERIFY2(ide.editor.bytes().contains("radius 3.445678901 "), ide.editor.bytes().constData());
        turnWheelWith(ide.editor, place, Qt::AltModifier | Qt::ControlModifier);
        QVERIFY2(ide.editor.bytes().contains("radius 3.455678901 "), ide.editor.bytes().constData());
        turnWheelWith(ide.editor, placeOfText(ide.editor, "substeps "), Qt::AltModifier);
        QVERIFY(ide.editor.bytes().contains("substeps 5 ")); // a whole number stays one
    }

    void anotherSceneEndsWhatTheWheelTurns() {
        // The undo step was open for another 600 ms, and closing it ended the program: its text was gone.
        Ide ide;
        turnWheel(ide.editor, placeOfText(ide.editor, "centre -"), 1);
        ide.bench.document().startNew(twoBalls + "// another\n");
        turnWheel(ide.editor, placeOfText(ide.editor, "centre -"), 2);
        QVERIFY(ide.editor.bytes().contains("centre -0.8,1,0 vel"));
        ide.editor.undo();
        QCOMPARE(ide.editor.bytes(), twoBalls + "// another\n");
    }

    void aShortcutBetweenTwoTurnsOfTheWheelEatsNoByte() {
        Ide ide;
        turnWheel(ide.editor, placeOfText(ide.editor, "centre -"), 11); // from -1: a letter more
        QVERIFY(ide.editor.bytes().contains("centre 0.1,1,0 vel"));
        QTest::keyClick(&ide.editor, Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(ide.editor.bytes(), twoBalls);
        turnWheel(ide.editor, placeOfText(ide.editor, "centre -"), 3);
        QByteArray turned = twoBalls;
        turned.replace("centre -1,1,0 vel", "centre -0.7,1,0 vel");
        QCOMPARE(ide.editor.bytes(), turned);
        // Nor does a change that no key announces.
        ide.editor.undo();
        QCOMPARE(ide.editor.bytes(), twoBalls);
        turnWheel(ide.editor, placeOfText(ide.editor, "centre -"), 1);
        turned = twoBalls;
        turned.replace("centre -1,1,0 vel", "centre -0.9,1,0 vel");
        QCOMPARE(ide.editor.bytes(), turned);
    }

    void aDragTurnsANumberLiveInThePictureAsOneUndoStep() {
        Ide ide;
        dragWithAlt(ide.editor, placeOfText(ide.editor, "left { radius ."), {12, 0});
        QVERIFY(ide.editor.bytes().contains("left { radius .52 mass"));
        QTRY_VERIFY_WITH_TIMEOUT(
            std::get<Sphere>(ide.bench.preview().shown()->scene().bodies[1].shape).radius == 0.52,
            longestWait);
        dragWithAlt(ide.editor, placeOfText(ide.editor, "left { radius ."), {-400, 0});
        QVERIFY(ide.editor.bytes().contains("left { radius .01 mass")); // a radius stays above 0
        ide.editor.undo();
        QVERIFY(ide.editor.bytes().contains("left { radius .52 mass"));
        ide.editor.undo();
        QCOMPARE(ide.editor.bytes(), twoBalls);
    }

    // Some window managers keep Alt to themselves: the handle does without.
    void underTheMouseANumberHasAHandleWhoseDragTurnsIt() {
        Ide ide;
        hover(ide.editor, placeOfText(ide.editor, "left { radius "));
        QWidget* handle = ide.editor.viewport()->findChild<QWidget*>(QStringLiteral("numberHandle"));
        QVERIFY(handle->isVisible());
        dragHandle(*handle, 12, Qt::NoModifier);
        QVERIFY(ide.editor.bytes().contains("left { radius .52 mass"));
        dragHandle(*handle, 6, Qt::ShiftModifier);
        QVERIFY(ide.editor.bytes().contains("left { radius .62 mass"));
        ide.editor.undo(); // a drag is a step
        QVERIFY(ide.editor.bytes().contains("left { radius .52 mass"));
        ide.editor.undo();
        QCOMPARE(ide.editor.bytes(), twoBalls);

        hover(ide.editor, placeOfText(ide.editor, "left { radi")); // no number, and the handle goes
        QTRY_VERIFY_WITH_TIMEOUT(!handle->isVisible(), longestWait);
    }

    void aSelectedNumberHasAHandleAndASecondButtonEndsItsDrag() {
        Ide ide;
        const qsizetype at = twoBalls.indexOf("left { radius ") + 14;
        ide.editor.send(Sci::SCI_SETSEL, at, at + 2);
        QWidget* handle = ide.editor.viewport()->findChild<QWidget*>(QStringLiteral("numberHandle"));
        QTRY_VERIFY_WITH_TIMEOUT(handle->isVisible(), longestWait);
        QTest::mousePress(handle, Qt::LeftButton, Qt::NoModifier, {5, 5});
        QTest::mousePress(handle, Qt::RightButton, Qt::NoModifier, {5, 5});
        moveHandle(*handle, {50, 5}, Qt::NoModifier);
        QCOMPARE(ide.editor.bytes(), twoBalls);
        placeCaretBehind(ide.editor, "sphere lef");
        QTest::keyClicks(&ide.editor, QStringLiteral("x")); // typing is a step of its own
        ide.editor.undo();
        QCOMPARE(ide.editor.bytes(), twoBalls);
    }

    void theSquareBesideAColourAsksForAnotherOne() {
        Ide ide("sphere { radius 1 mass 1 centre 0,0,0 colour 1, 0, 0 }\n");
        QTRY_VERIFY_WITH_TIMEOUT(ide.editor.send(Sci::SCI_INDICATORVALUEAT, colourIndicator,
                                                 ide.editor.bytes().indexOf("1, 0, 0")) != 0,
                                 longestWait);
        hover(ide.editor, placeOfText(ide.editor, "colour "));
        QWidget* swatch = ide.editor.viewport()->findChild<QWidget*>(QStringLiteral("colourSwatch"));
        QVERIFY(swatch->isVisible());
        const std::uint32_t caret = ide.editor.caret();
        QTest::mouseClick(swatch, Qt::RightButton);
        QVERIFY(ide.editor.findChild<QColorDialog*>() == nullptr);
        QTest::mouseClick(swatch, Qt::LeftButton);
        QCOMPARE(ide.editor.caret(), caret); // it went to the place under the square
        QColorDialog* dialog = ide.editor.findChild<QColorDialog*>();
        QVERIFY(dialog != nullptr);
        QCOMPARE(dialog->currentColor(), QColor(255, 0, 0));
        Q_EMIT dialog->colorSelected(QColor(0, 51, 255));
        dialog->close();
        QVERIFY2(ide.editor.bytes().contains("colour 0, 0.2, 1 }"), ide.editor.bytes().constData());
        ide.editor.undo();
        QVERIFY(ide.editor.bytes().contains("colour 1, 0, 0 }"));
        placeCaretBehind(ide.editor, "colour 1");
        QTRY_VERIFY_WITH_TIMEOUT(ide.current(), longestWait);
        ide.trigger(ActionId::PickColour);
        QTRY_VERIFY_WITH_TIMEOUT(ide.editor.findChild<QColorDialog*>() != nullptr, longestWait);
        ide.editor.findChild<QColorDialog*>()->close();
    }

    void aDragWithAltBesideNumbersSelectsARectangle() {
        Ide ide;
        ide.editor.setWrapsLines(false); // the place below is on the next line
        QTRY_COMPARE_WITH_TIMEOUT(ide.editor.send(Sci::SCI_WRAPCOUNT, 2), 1L, longestWait);
        QTRY_COMPARE_WITH_TIMEOUT(ide.editor.send(Sci::SCI_VISIBLEFROMDOCLINE, 3), 3L, longestWait);
        const QPoint line(0, static_cast<int>(ide.editor.send(Sci::SCI_TEXTHEIGHT, 0)));
        dragWithAlt(ide.editor, placeOfText(ide.editor, "sph"), line + QPoint(12, 0));
        QVERIFY(ide.editor.send(Sci::SCI_SELECTIONISRECTANGLE) != 0);
        QCOMPARE(ide.editor.send(Sci::SCI_GETSELECTIONS), 2L);
        QCOMPARE(ide.editor.bytes(), twoBalls);
    }

    void aDeclarationsNameAndTabInsertAllOfIt() { // the tutorial's first step
        Ide ide("");
        QTest::keyClicks(&ide.editor, QStringLiteral("sphere"));
        QTest::keyClick(&ide.editor, Qt::Key_Tab);
        QVERIFY2(ide.editor.bytes().contains("radius"), ide.editor.bytes().constData());
        constexpr long veil = 100; // of 255: the values are read through what marks them
        constexpr int fieldIndicator = 13;
        QVERIFY(ide.editor.send(Sci::SCI_INDICATORVALUEAT, fieldIndicator,
                                ide.editor.bytes().indexOf("mass ") + 5) != 0);
        QVERIFY(ide.editor.send(Sci::SCI_INDICGETALPHA, fieldIndicator) < veil);
    }

    void ctrlHomeGoesToTheBeginningOfTheText() { // it is no action's key
        Ide ide;
        placeCaretBehind(ide.editor, "sphere left");
        QTest::keyClick(&ide.editor, Qt::Key_Home, Qt::ControlModifier);
        QCOMPARE(ide.editor.caret(), 0U);
    }

    void theNumberAtTheCaretTurnsByKey() {
        Ide ide;
        placeCaretBehind(ide.editor, "vel 0,");
        QTest::keyClick(&ide.editor, Qt::Key_Up, Qt::AltModifier);
        QTest::keyClick(&ide.editor, Qt::Key_Up, Qt::AltModifier);
        QTest::keyClick(&ide.editor, Qt::Key_Down, Qt::AltModifier);
        QVERIFY(ide.editor.bytes().contains("vel 0,3.1,0"));
        ide.editor.undo();
        QVERIFY(ide.editor.bytes().contains("vel 0,3.2,0"));
    }

    void theOutlineListsTheDeclarationsAndGoesToThem() {
        Ide ide(tied);
        OutlineDock& outline = ide.bench.window().outline();
        QTreeView* rows = outline.findChild<QTreeView*>();
        QCOMPARE(rows->model()->rowCount(), 5);
        QCOMPARE(rows->model()->index(3, 0).data().toString(), QStringLiteral("right"));
        QTest::mouseClick(rows->viewport(), Qt::LeftButton, {},
                          rows->visualRect(rows->model()->index(3, 0)).center());
        QCOMPARE(ide.editor.caret(), static_cast<std::uint32_t>(ide.editor.bytes().indexOf("right {")));
        placeCaretBehind(ide.editor, "stiff");
        QTRY_COMPARE_WITH_TIMEOUT(rows->currentIndex().row(), 4, longestWait);
    }

    void theOutlineMakesThePictureOfAColourOnce() {
        // One made anew for every look stays in Qt's cache: it grew by 5 KiB with every edit, up to 10 MiB.
        Ide ide;
        const QAbstractItemModel& rows = *ide.bench.window().outline().findChild<QTreeView*>()->model();
        const auto picture = [&rows] {
            return rows.index(0, 0).data(Qt::DecorationRole).value<QIcon>().cacheKey();
        };
        const qint64 before = picture();
        QCOMPARE(picture(), before);
        ide.editor.replaceRange({0, 0}, "// another text\n");
        QTRY_VERIFY_WITH_TIMEOUT(ide.current(), longestWait);
        QCOMPARE(picture(), before);
    }

    void theOutlineIsNarrowedByWhatOneWritesAboveIt() {
        Ide ide(tied);
        OutlineDock& outline = ide.bench.window().outline();
        QTest::keyClick(&ide.bench.window(), Qt::Key_7, Qt::AltModifier);
        QLineEdit* filter = outline.findChild<QLineEdit*>(QStringLiteral("outlineFilter"));
        QTRY_VERIFY_WITH_TIMEOUT(filter->hasFocus(), longestWait);
        QTest::keyClicks(filter, QStringLiteral("RIGHT"));
        QCOMPARE(outline.findChild<QTreeView*>()->model()->rowCount(), 1);
        QTest::keyClick(filter, Qt::Key_Return);
        QCOMPARE(ide.editor.caret(), static_cast<std::uint32_t>(ide.editor.bytes().indexOf("right {")));
    }
};

CAROM_TEST_WITH(IdeApplication, language_test, LanguageTest)
#include "language_test.moc"
