// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/whole_ide.h"

#include "ui/docks/accuracy_dock.h"
#include "ui/docks/broadphase_dock.h"
#include "ui/docks/effects_dock.h"
#include "ui/docks/inspector_dock.h"
#include "ui/docks/output_dock.h"
#include "ui/docks/problems_dock.h"
#include "ui/editor/colour_marks.h"
#include "ui/editor/find_bar.h"
#include "ui/viewport/viewport.h"
#include "ui/widgets/transport_bar.h"
#include "ui/window/file_commands.h"
#include "ui/window/live_preview.h"

#include <QAbstractItemView>
#include <QComboBox>
#include <QLabel>
#include <QMenu>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSettings>
#include <QSignalSpy>

using namespace carom;
using namespace carom::test;
using Sci = QsciScintillaBase;

namespace {

bool hasErrorSquiggle(const SceneEditor& editor, const QByteArray& word) {
    const qsizetype at = editor.bytes().indexOf(word);
    for (qsizetype i = 0; i < word.size(); ++i)
        if (editor.send(Sci::SCI_INDICATORVALUEAT, 12, at + i) == 0) return false;
    return editor.send(Sci::SCI_INDICATORVALUEAT, 12, at + word.size()) == 0;
}

} // namespace

class WorkbenchTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void init() { QSettings().clear(); }

    void aWrongWordIsMarkedAndListedUntilItIsCorrected() {
        Ide ide;
        QCOMPARE(ide.problems(), 0);
        placeCaretBehind(ide.editor, "colour red");
        QTest::keyClicks(&ide.editor, QStringLiteral(" raduis 2"));
        QTRY_COMPARE_WITH_TIMEOUT(ide.problems(), 1, longestWait);
        QVERIFY(hasErrorSquiggle(ide.editor, "raduis"));
        for (int i = 0; i < 9; ++i) QTest::keyClick(&ide.editor, Qt::Key_Backspace);
        QTRY_COMPARE_WITH_TIMEOUT(ide.problems(), 0, longestWait);
        QCOMPARE(ide.editor.send(Sci::SCI_INDICATOREND, 12, 0), 0L);
    }

    void theInspectorShowsTheBodyThatWasClicked() {
        // The viewport had selected it by then, and nobody was told.
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        const InspectorDock& inspector = ide.bench.window().inspector();
        QVERIFY(inspector.valueOf(QStringLiteral("radius")).isEmpty());
        QTest::mouseClick(&ide.viewport, Qt::LeftButton, {}, ide.placeOf(1));
        QTRY_COMPARE_WITH_TIMEOUT(inspector.valueOf(QStringLiteral("radius")), QStringLiteral("0.5"),
                                  longestWait);
    }

    void everyColourIsUnderlinedWithItself() {
        Ide ide;
        const auto markAt = [&](const char* word) {
            return ide.editor.send(Sci::SCI_INDICATORVALUEAT, colourIndicator,
                                   ide.editor.bytes().indexOf(word));
        };
        constexpr long isColour = 0x01000000;
        QTRY_COMPARE_WITH_TIMEOUT(markAt("red"), isColour | 0x0000FF, longestWait);
        QCOMPARE(markAt("blue"), isColour | 0xFF0000);
        QCOMPARE(markAt("radius"), 0L);
        const qsizetype at = ide.editor.bytes().indexOf("red");
        ide.editor.replaceRange({static_cast<std::uint32_t>(at), 3}, "0, 1, 0");
        QTRY_COMPARE_WITH_TIMEOUT(markAt("0, 1, 0"), isColour | 0x00FF00, longestWait);
    }

    void aFileThatIsNoSceneIsOpenedWithAWarning() {
        for (const QByteArray& text : {QByteArray("\x7f"
                                                  "ELF\0\1\2",
                                                  7),
                                       QByteArray("spere {} ").repeated(1200)}) {
            Ide ide(text);
            const QLabel* notice =
                ide.bench.window().transport().findChild<QLabel*>(QStringLiteral("transportNotice"));
            QTRY_VERIFY_WITH_TIMEOUT(notice->text().contains(QStringLiteral("does not look like a scene")),
                                     longestWait);
            QCOMPARE(ide.editor.bytes(), text);
        }
    }

    void aClickInTheProblemsGoesToThePlace() {
        Ide ide(twoBalls + "spere { radius 1 }\n");
        QCOMPARE(ide.problems(), 1);
        QAbstractItemView* rows = ide.bench.window().problems().findChild<QAbstractItemView*>();
        const QRect first = rows->visualRect(rows->model()->index(0, 0));
        QTest::mouseClick(rows->viewport(), Qt::LeftButton, {}, first.center());
        QCOMPARE(ide.editor.selectedText(), QStringLiteral("spere"));
    }

    void playMovesTheBallsAndResetBringsThemBack() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        const QImage start = ide.viewport.shownPicture();
        QTest::keyClick(&ide.bench.window(), Qt::Key_F5);
        QTRY_VERIFY_WITH_TIMEOUT(ide.frame > 8, longestWait);
        QTest::keyClick(&ide.bench.window(), Qt::Key_F5);
        QTRY_VERIFY_WITH_TIMEOUT(!ide.simulation.isRunning(), longestWait);
        QVERIFY(ide.viewport.shownPicture() != start);
        ide.simulation.seek(30); // the last state of the run may come after the word that it has stopped
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 30, longestWait);
        QTest::keyClick(&ide.bench.window(), Qt::Key_F10);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 31, longestWait);
        QTest::keyClick(&ide.bench.window(), Qt::Key_F5, Qt::ShiftModifier);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        QCOMPARE(ide.viewport.shownPicture(), start);
    }

    void spaceAndTheRightArrowWorkInTheViewportOnly() {
        Ide ide;
        ide.viewport.setFocus();
        QTest::keyClick(&ide.viewport, Qt::Key_Right);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 1, longestWait);
        QTest::keyClick(&ide.viewport, Qt::Key_Space);
        QTRY_VERIFY_WITH_TIMEOUT(ide.simulation.isRunning(), longestWait);
        QTest::keyClick(&ide.viewport, Qt::Key_Space);
        QTRY_VERIFY_WITH_TIMEOUT(!ide.simulation.isRunning(), longestWait);
        const QByteArray before = ide.editor.bytes();
        ide.editor.setFocus();
        QTest::keyClick(&ide.editor, Qt::Key_Space);
        QCOMPARE(ide.editor.bytes().size(), before.size() + 1);
        QVERIFY(!ide.simulation.isRunning());
    }

    void aSettingOfTheAccuracyPanelGoesIntoTheTextAndOutAgainInOneStep() {
        Ide ide;
        const QByteArray before = ide.editor.bytes();
        SimulationSettings settings;
        settings.method = "contacts";
        settings.integrator = "verlet";
        settings.substeps = 8;
        Q_EMIT ide.bench.window().accuracy().settingWanted(settings);
        QVERIFY(ide.editor.bytes().contains("integrator verlet"));
        QTRY_COMPARE_WITH_TIMEOUT(ide.bench.preview().shown()->build.pipeline->settings().substeps, 8,
                                  longestWait);
        ide.editor.undo();
        QCOMPARE(ide.editor.bytes(), before);
        QTRY_VERIFY_WITH_TIMEOUT(ide.current(), longestWait); // else its build ends the run that follows

        const auto pipeline =
            std::make_shared<const Pipeline>(ide.bench.preview().shown()->scene(), settings);
        Q_EMIT ide.bench.window().accuracy().runWanted(pipeline);
        QTRY_VERIFY_WITH_TIMEOUT(ide.frame > 3, longestWait);
    }

    void aSettingLosesNothingThatWasTypedWhileABuildIsUnderWay() {
        // The build on screen is older than the text: its places are not the text's.
        QByteArray balls = twoBalls;
        for (int i = 0; i < 6'000; ++i)
            balls += "sphere { radius .1 mass 1 centre " + QByteArray::number(i) + ",9,0 }\n";
        Ide ide(balls);
        QTRY_VERIFY_WITH_TIMEOUT(ide.current(), longestWait);
        ide.editor.send(Sci::SCI_GOTOPOS, 0);
        QTest::keyClicks(&ide.editor, QStringLiteral("// mine "));
        const QByteArray before = ide.editor.bytes();
        QCOMPARE(before, "// mine " + balls);
        QVERIFY(!ide.current());
        SimulationSettings settings;
        settings.method = "contacts";
        settings.substeps = 8;
        Q_EMIT ide.bench.window().accuracy().settingWanted(settings);
        QVERIFY(ide.editor.bytes().startsWith("// mine camera"));
        QVERIFY(ide.editor.bytes().contains("substeps 8"));
        QTRY_VERIFY_WITH_TIMEOUT(ide.current(), longestWait);
        QCOMPARE(ide.problems(), 0);
        ide.editor.undo();
        QCOMPARE(ide.editor.bytes(), before);
    }

    void aNameFullOfPlaceholdersIsShownAsItIs() {
        Ide ide;
        const QString name = QStringLiteral("%1 %2 <b>100%d<b> %L1.sdl");
        QSignalSpy reports(&ide.bench.files(), &FileCommands::reported);
        QVERIFY(!ide.bench.document().saveAs(ide.folder.filePath(name)));
        QVERIFY2(ide.bench.window().windowTitle().contains(name),
                 qPrintable(ide.bench.window().windowTitle()));
        QVERIFY(!ide.bench.document().open(ide.bench.document().path()));
        QTRY_VERIFY_WITH_TIMEOUT(ide.current(), longestWait);
        const QString said = ide.bench.window().output().findChild<QPlainTextEdit*>()->toPlainText();
        QVERIFY2(said.contains(name + QStringLiteral(": 3 bodies")), qPrintable(said));
        writeFile(ide.folder.filePath(name), "spere");
        QString question;
        answerNextDialog([&question](QWidget& box) {
            for (const QLabel* label : box.findChildren<QLabel*>()) question += label->text();
            box.close();
        });
        typeAtTheEnd(ide.editor, "// mine");
        ide.trigger(ActionId::Save);
        QVERIFY2(question.contains(name), qPrintable(question));
    }

    void anEditAtFrameZeroShowsTheNewSceneAtOnce() {
        Ide ide;
        QCOMPARE(ide.bench.preview().shown()->scene().bodies.size(), std::size_t{3});
        typeAtTheEnd(ide.editor, "sphere { radius .2 mass 1 centre 0,1,2 colour lime }");
        QTRY_COMPARE_WITH_TIMEOUT(ide.bench.preview().shown()->scene().bodies.size(), std::size_t{4},
                                  longestWait);
        QTRY_VERIFY_WITH_TIMEOUT(ide.placeOf(3) != QPoint(-1, -1), longestWait);
    }

    void errorsWhileTypingKeepTheLastGoodSceneDimmedWithABadge() {
        Ide ide;
        QLabel* badge = ide.viewport.findChild<QLabel*>(QStringLiteral("viewportBadge"));
        QVERIFY(!badge->isVisible());
        typeAtTheEnd(ide.editor, "spere { radius 1 }");
        QTRY_VERIFY_WITH_TIMEOUT(badge->isVisible(), longestWait);
        QVERIFY(badge->text().contains(QStringLiteral("1 error")));
        QCOMPARE(ide.bench.preview().shown()->scene().bodies.size(), std::size_t{3});
        while (ide.editor.isUndoAvailable()) ide.editor.undo();
        QTRY_VERIFY_WITH_TIMEOUT(!badge->isVisible(), longestWait);
    }

    void aFileOpenedWithErrorsShowsWhatCouldBeBuilt() {
        Ide ide(twoBalls + "spere { radius 1 }\n");
        QVERIFY(!ide.viewport.findChild<QLabel*>(QStringLiteral("viewportBadge"))->isVisible());
        QCOMPARE(ide.bench.preview().shown()->scene().bodies.size(), std::size_t{3});
    }

    void aClickOnABodyShowsItsDeclaration() {
        Ide ide;
        QTRY_VERIFY_WITH_TIMEOUT(ide.placeOf(2) != QPoint(-1, -1), longestWait);
        QTest::mouseClick(&ide.viewport, Qt::LeftButton, {}, ide.placeOf(2));
        QCOMPARE(ide.viewport.selectedBody(), BodyIndex{2});
        QCOMPARE(ide.editor.caret(), static_cast<std::uint32_t>(ide.editor.bytes().indexOf("sphere right")));
        QVERIFY(ide.editor.markersAtLine(3) & (1U << DeclarationMarker));
        QVERIFY(!(ide.editor.markersAtLine(2) & (1U << DeclarationMarker)));
    }

    void theCaretInADeclarationOutlinesItsBody() {
        Ide ide;
        const auto caretBehind = [&](const QByteArray& word) { placeCaretBehind(ide.editor, word); };
        caretBehind("sphere le");
        QTRY_COMPARE_WITH_TIMEOUT(ide.viewport.selectedBody(), BodyIndex{1}, longestWait);
        caretBehind("centre 1,1");
        QTRY_COMPARE_WITH_TIMEOUT(ide.viewport.selectedBody(), BodyIndex{2}, longestWait);
        caretBehind("camera {");
        QTRY_COMPARE_WITH_TIMEOUT(ide.viewport.selectedBody(), noBody, longestWait);
    }

    void theBroadphaseIsSwitchedWhileRunning() {
        Ide ide;
        QComboBox* box = ide.bench.window().broadphase().findChild<QComboBox*>(QStringLiteral("algorithm"));
        QCOMPARE(box->count(), static_cast<int>(broadphases().size()) + 1);
        ide.trigger(ActionId::Play);
        for (int i = 1; i < box->count(); ++i) {
            box->setCurrentIndex(i);
            const std::int64_t before = ide.frame;
            QTRY_VERIFY_WITH_TIMEOUT(ide.frame > before + 2, longestWait);
        }
        ide.trigger(ActionId::Play);
        QTRY_VERIFY_WITH_TIMEOUT(!ide.simulation.isRunning(), longestWait);
        QCOMPARE(ide.simulation.status().state, RunState::Paused);
    }

    void theUnsavedQuestionSavesDiscardsOrStays() {
        Ide ide;
        const auto answer = [](QMessageBox::StandardButton button) {
            answerNextDialog([button](QWidget& dialog) {
                QTest::mouseClick(static_cast<QMessageBox&>(dialog).button(button), Qt::LeftButton);
            });
        };
        typeAtTheEnd(ide.editor, "// mine");
        QVERIFY(ide.bench.window().isWindowModified());
        answer(QMessageBox::Cancel);
        QVERIFY(!ide.bench.window().close());
        QVERIFY(ide.bench.window().isVisible());
        QCOMPARE(readFile(ide.path), twoBalls);
        answer(QMessageBox::Save);
        QVERIFY(ide.bench.window().close());
        QCOMPARE(readFile(ide.path), twoBalls + "// mine");
        QVERIFY(!ide.bench.window().isWindowModified());

        ide.bench.window().show(); // one that is hidden is closed without a question
        typeAtTheEnd(ide.editor, "// theirs");
        answer(QMessageBox::Discard);
        QVERIFY(ide.bench.window().close());
        QCOMPARE(readFile(ide.path), twoBalls + "// mine");
    }

    void savingAndOpeningFillTheRecentMenu() {
        Ide ide;
        QVERIFY(ide.bench.files().open(ide.path));
        const QMenu* recent = ide.bench.window().actions()[ActionId::Recent].menu();
        QCOMPARE(recent->actions().size(), 1);
        QVERIFY(recent->actions().first()->text().endsWith(QStringLiteral("balls.sdl")));
        typeAtTheEnd(ide.editor, "// more");
        QTest::keyClick(&ide.bench.window(), Qt::Key_S, Qt::ControlModifier);
        QCOMPARE(readFile(ide.path), twoBalls + "// more");
        ide.trigger(ActionId::New);
        QVERIFY(ide.editor.bytes().isEmpty());
        recent->actions().first()->trigger();
        QCOMPARE(ide.editor.bytes(), twoBalls + "// more");
    }

    void bothThemesReachTheTextAndThePicture() {
        Ide ide;
        QAction& dark = ide.bench.window().actions()[ActionId::DarkTheme];
        QVERIFY(dark.isChecked());
        const QColor darkSky = ide.pixel(0.5, 0.05);
        dark.trigger();
        QCOMPARE(QApplication::palette().color(QPalette::Window), loadTheme(false).window);
        QVERIFY(ide.pixel(0.5, 0.05).lightness() > darkSky.lightness());
        QCOMPARE(ide.editor.grab().toImage().pixelColor(ide.editor.width() - 40, ide.editor.height() - 40),
                 loadTheme(false).editor);
    }

    void everyPanelIsReachedByKeyAndEscapeReturnsToTheText() {
        Ide ide;
        QDockWidget& broadphase = ide.bench.window().broadphase();
        QSignalSpy inFront(&broadphase, &QDockWidget::visibilityChanged);
        QTest::keyClick(&ide.bench.window(), Qt::Key_3, Qt::AltModifier);
        QTRY_VERIFY_WITH_TIMEOUT(!inFront.isEmpty() && inFront.last().first().toBool(), longestWait);
        QVERIFY(broadphase.findChild<QComboBox*>()->hasFocus());
        QTest::keyClick(&ide.bench.window(), Qt::Key_Escape);
        QTRY_VERIFY_WITH_TIMEOUT(ide.editor.hasFocus(), longestWait);
    }

    void findOpensWithItsKeyAndEscapeClosesIt() {
        Ide ide;
        FindBar& bar = ide.bench.window().findBar();
        QTest::keyClick(&ide.bench.window(), Qt::Key_F, Qt::ControlModifier);
        QVERIFY(bar.isVisible());
        QTest::keyClicks(QApplication::focusWidget(), QStringLiteral("right"));
        QCOMPARE(ide.editor.selectedText(), QStringLiteral("right"));
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_Escape);
        QVERIFY(!bar.isVisible());
        QVERIFY(ide.editor.hasFocus());
    }

    void aLongTextIsBuiltWhileOneTypes() {
        QByteArray text = twoBalls;
        while (text.size() < 400'000) text += "sphere { radius .1 mass 1 centre 0,9,0 fixed yes }\n";
        Ide ide(text);
        QTRY_VERIFY_WITH_TIMEOUT(ide.current(), longestWait);
        placeCaretBehind(ide.editor, "colour red");
        QTest::keyClicks(&ide.editor, QStringLiteral(" friction .5"));
        QVERIFY(!ide.current()); // typed, not yet built
        QTRY_VERIFY_WITH_TIMEOUT(ide.current(), longestWait);
        QCOMPARE(ide.bench.builds().latest()->scene().bodies[1].friction, 0.5);
    }
};

CAROM_TEST_WITH(IdeApplication, workbench_test, WorkbenchTest)
#include "workbench_test.moc"
