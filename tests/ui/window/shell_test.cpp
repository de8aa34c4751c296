// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/whole_ide.h"

#include "core/study/hard_scenes.h"
#include "ui/docks/broadphase_dock.h"
#include "ui/docks/outline_dock.h"
#include "ui/docks/timing_dock.h"
#include "ui/viewport/navigation.h"
#include "ui/widgets/text_of.h"
#include "ui/window/command_finder.h"
#include "ui/window/file_commands.h"
#include "ui/window/help_commands.h"
#include "ui/window/live_preview.h"
#include "ui/window/manual_window.h"
#include "ui/window/new_scene_dialog.h"
#include "ui/window/preferences.h"
#include "ui/window/recovery_dialog.h"
#include "ui/base/settings.h"
#include "ui/window/welcome.h"

#include <QComboBox>
#include <QKeySequenceEdit>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QMenuBar>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QScrollBar>
#include <QSettings>
#include <QSignalSpy>
#include <QSpinBox>
#include <QStatusBar>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextTable>
#include <QTreeWidget>

#include <utility>
#include <vector>

using namespace carom;
using namespace carom::test;
using Sci = QsciScintillaBase;

// What stands around the text and the picture: command finder, workspaces, dialogs, manual.

namespace {

template<class Dialog>
Dialog* openDialog(Ide& ide) {
    return ide.bench.window().findChild<Dialog*>();
}

} // namespace

class ShellTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void init() { QSettings().clear(); }

    void everyActionOfTheMenusIsInTheCommandFinder() {
        Ide ide;
        QTest::keyClick(&ide.bench.window(), Qt::Key_P, Qt::ControlModifier | Qt::ShiftModifier);
        const CommandFinder* finder = ide.bench.window().findChild<CommandFinder*>();
        QVERIFY(finder->isVisible());
        const QTreeWidget* list = finder->findChild<QTreeWidget*>();
        QStringList found;
        for (int i = 0; i < list->topLevelItemCount(); ++i) found.append(list->topLevelItem(i)->text(0));
        for (const ActionRow& row : actionRows()) {
            if (row.text == nullptr || row.id == ActionId::Recent) continue;
            const QString name = QString::fromUtf8(row.text).remove(u'&').remove(u'…');
            QVERIFY2(!found.filter(name).isEmpty(), row.text);
        }
    }

    void everyActionOfTheMenusHasAKeyOfItsOwnAnIconAndATip() {
        Ide ide;
        QSet<QKeySequence> taken;
        for (const ActionRow& row : actionRows()) {
            if (row.text == nullptr) continue;
            const QAction& action = ide.bench.window().actions()[row.id];
            QVERIFY2(!action.shortcuts().isEmpty(), row.text);
            for (const QKeySequence& key : action.shortcuts()) {
                QVERIFY2(!key.isEmpty() && !taken.contains(key), row.text);
                taken.insert(key);
            }
            QVERIFY2(!action.icon().isNull(), row.text);
            QVERIFY2(!action.statusTip().isEmpty(), row.text);
        }
    }

    void aFewLettersAndEnterRunACommand() {
        Ide ide;
        ide.trigger(ActionId::FindCommand);
        const CommandFinder* finder = ide.bench.window().findChild<CommandFinder*>();
        QLineEdit* words = finder->findChild<QLineEdit*>();
        QTRY_VERIFY_WITH_TIMEOUT(words->hasFocus(), longestWait);
        QTest::keyClicks(words, QStringLiteral("toggle comm"));
        QTest::keyClick(words, Qt::Key_Return);
        QVERIFY(!finder->isVisible());
        QVERIFY(ide.editor.bytes().startsWith("// camera"));
        ide.trigger(ActionId::FindCommand);
        QTest::keyClick(words, Qt::Key_Escape);
        QVERIFY(!finder->isVisible());
        QVERIFY(ide.editor.hasFocus());
    }

    void whatBeginsAWordFitsBest() {
        QVERIFY(fitOf(QStringLiteral("Boxes View"), QStringLiteral("box")) <
                fitOf(QStringLiteral("Show inbox"), QStringLiteral("box")));
        QCOMPARE(fitOf(QStringLiteral("Boxes"), QStringLiteral("boxes grid")), -1);
        QCOMPARE(fitOf(QStringLiteral("Boxes"), QString()), 0);
    }

    void aWorkspaceGivesTheTextItsShareOfTheWidth() {
        const std::vector<std::pair<ActionId, int>> rows = {{ActionId::WorkspaceWatch, 24},
                                                            {ActionId::WorkspaceMeasure, 30},
                                                            {ActionId::WorkspaceStudy, 26},
                                                            {ActionId::WorkspaceWrite, 60}};
        Ide ide;
        ide.bench.window().resize(1600, 950);
        for (const auto& [action, share] : rows) {
            ide.trigger(action);
            QCoreApplication::processEvents();
            const QWidget& viewport = ide.viewport;
            const double width = ide.editor.width() + viewport.width();
            constexpr double rounding = 2; // [%]
            QVERIFY2(std::abs(100 * ide.editor.width() / width - share) < rounding,
                     qPrintable(QStringLiteral("%1 of %2 px").arg(ide.editor.width()).arg(width)));
        }
    }

    void everyMenuFitsASmallScreen() {
        constexpr int laptop = 768; // [px]
        Ide ide;
        for (const QMenu* menu : ide.bench.window().menuBar()->findChildren<QMenu*>()) {
            QVERIFY2(menu->sizeHint().height() < laptop, qPrintable(menu->title()));
            for (const QAction* action : menu->actions())
                QVERIFY2(action->isSeparator() || action->menu() != nullptr || !action->icon().isNull(),
                         qPrintable(action->text()));
        }
    }

    void aLongMessageEndsBeforeThePlaceOfTheCaret() {
        Ide ide;
        placeCaretBehind(ide.editor, "sphere");
        const QStatusBar& bar = *ide.bench.window().statusBar();
        const QLabel* place = bar.findChild<QLabel*>(QStringLiteral("caret"));
        QTRY_VERIFY_WITH_TIMEOUT(place->text().contains(u'3'), longestWait);
        ide.bench.window().tell(QString(500, u'm'));
        QVERIFY(bar.currentMessage().endsWith(u'…'));
        QTRY_VERIFY_WITH_TIMEOUT(bar.fontMetrics().horizontalAdvance(bar.currentMessage()) < place->x(),
                                 longestWait);
    }

    void aWorkspaceIsFoundAsItWasLeft() {
        Ide ide;
        QDockWidget& timing = ide.bench.window().timing();
        QDockWidget& outline = ide.bench.window().outline();
        QVERIFY(!timing.isVisible());
        QTest::keyClick(&ide.bench.window(), Qt::Key_3, Qt::ControlModifier | Qt::AltModifier);
        QTRY_VERIFY_WITH_TIMEOUT(timing.isVisible(), longestWait);
        timing.hide();
        ide.trigger(ActionId::WorkspaceWrite);
        QTRY_VERIFY_WITH_TIMEOUT(outline.isVisible(), longestWait);
        ide.trigger(ActionId::WorkspaceMeasure);
        QVERIFY(!timing.isVisible()); // as it was left
        ide.trigger(ActionId::ResetWorkspace);
        QTRY_VERIFY_WITH_TIMEOUT(timing.isVisible(), longestWait);
    }

    void theWorkspaceOfTheLastSessionIsTakenUp() {
        {
            NewIde ide;
            ide.trigger(ActionId::WorkspaceWatch);
        }
        const NewIde next;
        QVERIFY(next.bench.window().actions()[ActionId::WorkspaceWatch].isChecked());
        QVERIFY(!next.bench.window().problems().isVisible());
    }

    void theSessionGoesOnWhereItWasLeft() {
        QTemporaryDir folder;
        const QString path = folder.filePath(QStringLiteral("long.sdl"));
        writeFile(path, QByteArray("// line\n").repeated(400));
        {
            Workbench bench;
            bench.window().show();
            QVERIFY(bench.files().open(path));
            bench.window().editor().goTo(1600, 190);
        }
        Workbench next;
        next.window().show();
        QVERIFY(next.openLastOrFirst());
        QCOMPARE(next.document().path(), path);
        QCOMPARE(next.window().editor().caret(), 1600U);
        QCOMPARE(next.window().editor().send(Sci::SCI_GETFIRSTVISIBLELINE), 190L);
    }

    void aFileChangedOutsideIsReloadedWithTheCaretInPlace() {
        Ide ide;
        placeCaretBehind(ide.editor, "sphere left");
        const std::uint32_t caret = ide.editor.caret();
        writeFile(ide.path, twoBalls + "// by somebody else\n");
        QTRY_VERIFY_WITH_TIMEOUT(ide.editor.bytes().endsWith("else\n"), longestWait);
        QCOMPARE(ide.editor.caret(), caret);
    }

    void aGeneratorsOptionsChangeThePreviewAndTheScene() {
        Ide ide;
        answerNextDialog([](QWidget& widget) {
            NewSceneDialog& dialog = static_cast<NewSceneDialog&>(widget);
            QSignalSpy previews(&dialog, &NewSceneDialog::previewed);
            QListWidget* list = dialog.findChild<QListWidget*>();
            for (int i = 0; i < list->count(); ++i)
                if (list->item(i)->data(Qt::UserRole) == QStringLiteral("brownian")) list->setCurrentRow(i);
            QTRY_VERIFY_WITH_TIMEOUT(!previews.isEmpty(), longestWait);
            const qulonglong before = previews.last().first().toULongLong();
            dialog.findChild<QSpinBox*>(QStringLiteral("count"))->setValue(50);
            previews.clear();
            QTRY_VERIFY_WITH_TIMEOUT(!previews.isEmpty(), longestWait);
            QVERIFY(previews.last().first().toULongLong() < before);
            QTest::mouseClick(dialog.findChild<QPushButton*>(QStringLiteral("create")), Qt::LeftButton);
        });
        QTest::keyClick(&ide.bench.window(), Qt::Key_N, Qt::ControlModifier | Qt::ShiftModifier);
        QVERIFY(ide.editor.bytes().contains("generate brownian --n 50"));
        QVERIFY(ide.bench.document().path().isEmpty());
    }

    void everyTemplateAndGeneratorOfTheDialogBuildsWithoutErrors() {
        NewSceneDialog dialog(true, nullptr);
        QSignalSpy previews(&dialog, &NewSceneDialog::previewed);
        QListWidget* list = dialog.findChild<QListWidget*>();
        int offered = 0;
        for (int i = 0; i < list->count(); ++i) {
            if (!(list->item(i)->flags() & Qt::ItemIsSelectable)) continue;
            if (list->currentRow() != i) previews.clear(); // the first is chosen already
            list->setCurrentRow(i);
            QTRY_VERIFY_WITH_TIMEOUT(!previews.isEmpty(), longestWait);
            const Build built = build(dialog.text().toStdString());
            QVERIFY2(!built.hasErrors(), qPrintable(dialog.name()));
            QVERIFY2(!built.analysis.scene.bodies.empty(), qPrintable(dialog.name()));
            ++offered;
        }
        QCOMPARE(offered, static_cast<int>(generators().size()) + 5); // templates
    }

    void theRecoveryDialogMarksWhatDiffersFromTheFile() {
        QTemporaryDir folder;
        const QString path = folder.filePath(QStringLiteral("a.sdl"));
        writeFile(path, "one\ntwo\nthree\n");
        const LostText lost{QString(), path, "one\n2\nthree\nfour\n", QDateTime::currentDateTime(), {}};
        RecoveryDialog dialog({lost}, loadTheme(true), nullptr);
        QCOMPARE(dialog.findChild<QPlainTextEdit*>()->toPlainText(),
                 QString::fromUtf8("  one\n− two\n+ 2\n  three\n+ four"));
        answerNextDialog([](QWidget& shown) {
            QTest::mouseClick(shown.findChild<QPushButton*>(QStringLiteral("discard")), Qt::LeftButton);
        });
        QCOMPARE(dialog.exec(), int(RecoveryDialog::Discard));
    }

    void f1OpensTheManualAtTheWord() {
        Ide ide;
        placeCaretBehind(ide.editor, "colo");
        QTest::keyClick(&ide.editor, Qt::Key_F1);
        const QTextBrowser* text = ide.bench.help().manual().findChild<QTextBrowser*>();
        QVERIFY(ide.bench.help().manual().isVisible());
        QVERIFY(text->textCursor().selectedText().startsWith(QStringLiteral("colour")));
        ide.bench.window().activateWindow();
        placeCaretBehind(ide.editor, "wal");
        ide.trigger(ActionId::Manual);
        QCOMPARE(text->textCursor().selectedText(), QStringLiteral("wall"));
        QTRY_COMPARE_WITH_TIMEOUT(text->horizontalScrollBar()->maximum(), 0, longestWait); // the page fits
        int tables = 0;
        for (const QTextFrame* frame : text->document()->rootFrame()->childFrames())
            if (const QTextTable* table = qobject_cast<const QTextTable*>(frame);
                table != nullptr && ++tables)
                QVERIFY(!table->cellAt(0, 0).firstCursorPosition().block().text().isEmpty());
        QVERIFY(tables > 5);
    }

    void theManualNamesEveryActionAndItsKeys() {
        QObject owner;
        QMenuBar bar;
        Actions actions(&owner);
        actions.fill(bar);
        const QString page = keysPage(actions);
        for (const ActionRow& row : actionRows())
            if (row.text != nullptr) QVERIFY2(page.contains(actions[row.id].statusTip()), row.text);
        QVERIFY(page.contains(QStringLiteral("| Ctrl+Shift+P |")));
    }

    void theManualSaysWhatIsRightInEveryHardCase() {
        const Ide ide;
        ManualWindow& manual = ide.bench.help().manual();
        manual.open(QStringLiteral("hardCases"));
        const QString page = manual.findChild<QTextBrowser*>()->toPlainText();
        QVERIFY(sceneCases().size() >= 35);
        for (const HardCase& row : sceneCases()) {
            QVERIFY2(page.contains(textOf(row.title)), row.name.data());
            QVERIFY2(page.contains(textOf(row.answer)), row.name.data());
        }
    }

    void everyPictureOfTheManualIsThereAndFitsThePage() {
        const Ide ide;
        ManualWindow& manual = ide.bench.help().manual();
        const QTextBrowser* shown = manual.findChild<QTextBrowser*>();
        int pictures = 0;
        for (const char* page : {"tutorial", "diagrams"}) {
            manual.open(QString::fromLatin1(page));
            const QTextDocument& document = *shown->document();
            for (QTextBlock block = document.begin(); block.isValid(); block = block.next())
                for (QTextBlock::iterator part = block.begin(); !part.atEnd(); ++part) {
                    const QTextImageFormat format = part.fragment().charFormat().toImageFormat();
                    if (!format.isValid()) continue;
                    const QImage image =
                        document.resource(QTextDocument::ImageResource, QUrl(format.name())).value<QImage>();
                    QVERIFY2(!image.isNull(), qPrintable(format.name()));
                    QVERIFY2(image.deviceIndependentSize().width() <= document.textWidth(),
                             qPrintable(format.name()));
                    ++pictures;
                }
        }
        QCOMPARE(pictures, 4);
        manual.close();
    }

    void everySceneOfTheGalleryHasItsPictureAndBuilds() {
        const std::vector<GalleryScene> scenes = galleryScenes();
        QVERIFY(scenes.size() >= 12);
        for (const GalleryScene& scene : scenes) {
            const QImage picture(scene.picture);
            QVERIFY2(picture.width() >= 200, qPrintable(scene.name));
            QFile text(QStringLiteral(":/") + scene.text);
            QVERIFY2(text.open(QIODevice::ReadOnly), qPrintable(scene.name));
            QVERIFY2(!build(text.readAll().toStdString()).hasErrors(), qPrintable(scene.name));
        }
    }

    void theGalleryShowsTheHardCasesByTheirNumbers() {
        Ide ide;
        ide.bench.help().showWelcome();
        const QListWidget* gallery = openDialog<Welcome>(ide)->findChild<QListWidget*>();
        for (const HardScene& scene : hardScenes()) {
            const int number = textOf(scene.name).section(u'_', 0, 0).toInt();
            constexpr int first = 50; // cases; those of the second list are for measuring
            if (number > first) continue;
            const QString head = QStringLiteral("%1: ").arg(number);
            const QList<QListWidgetItem*> found = gallery->findItems(head, Qt::MatchStartsWith);
            QCOMPARE(found.size(), 1);
            QVERIFY(found.first()->toolTip().startsWith(QStringLiteral("Hard case %1: ").arg(number)));
        }
    }

    void aClickInTheGalleryOpensTheScene() {
        Ide ide;
        ide.bench.help().showWelcome();
        const Welcome* welcome = openDialog<Welcome>(ide);
        QListWidget* gallery = welcome->findChild<QListWidget*>();
        QTRY_VERIFY_WITH_TIMEOUT(gallery->isVisible(), longestWait);
        QTest::mouseClick(gallery->viewport(), Qt::LeftButton, {},
                          gallery->visualItemRect(gallery->item(0)).center());
        QVERIFY(ide.editor.bytes().contains("cue"));
        QVERIFY(ide.bench.document().path().isEmpty()); // the shipped file stays as it is
    }

    void preferencesHoldAtOnce() {
        Ide ide;
        QTest::keyClick(&ide.bench.window(), Qt::Key_Comma, Qt::ControlModifier);
        Preferences* dialog = openDialog<Preferences>(ide);
        QVERIFY(dialog != nullptr);
        dialog->findChild<QComboBox*>(QStringLiteral("theme"))->setCurrentIndex(1);
        QCOMPARE(QApplication::palette().color(QPalette::Window), loadTheme(false).window);
        const long height = ide.editor.send(Sci::SCI_TEXTHEIGHT, 0);
        dialog->findChild<QSpinBox*>(QStringLiteral("fontSize"))->setValue(20);
        QVERIFY(ide.editor.send(Sci::SCI_TEXTHEIGHT, 0) > height);
        dialog->findChild<QSpinBox*>(QStringLiteral("memory"))->setValue(64);
        dialog->findChild<QSpinBox*>(QStringLiteral("threads"))->setValue(1);
        QComboBox* navigation = dialog->findChild<QComboBox*>(QStringLiteral("navigation"));
        navigation->setCurrentIndex(2);
        dialog->findChild<QComboBox*>(QStringLiteral("drawingPlace"))->setCurrentIndex(1);
        const Settings settings;
        QCOMPARE(settings.drawingPlace(), QStringLiteral("window"));
        QCOMPARE(settings.memoryBudget(), 64);
        QCOMPARE(settings.threads(), 1);
        QCOMPARE(settings.navigation(), QStringLiteral("middle"));
        dialog->close();
        // The left button turns no longer.
        const Camera before = ide.viewport.camera();
        QTest::mousePress(&ide.viewport, Qt::LeftButton, {}, {60, 60});
        QTest::mouseMove(&ide.viewport, {160, 90});
        QTest::mouseRelease(&ide.viewport, Qt::LeftButton, {}, {160, 90});
        QCOMPARE(ide.viewport.camera().yaw, before.yaw);
    }

    void picturesAreDrawnWhereThePreferencesSay() {
        Settings().setDrawingPlace(QStringLiteral("window"));
        {
            Ide ide;
            QVERIFY(ide.viewport.drawsInWindow());
            QTRY_VERIFY_WITH_TIMEOUT(ide.viewport.framesRendered() > 0, longestWait);
            const QPoint blue = ide.placeOf(2);
            const auto shown = [&ide, blue] {
                const QImage window = ide.bench.window().grab().toImage();
                return window.pixelColor(ide.viewport.mapTo(&ide.bench.window(), blue));
            };
            QTRY_VERIFY_WITH_TIMEOUT(shown().blue() > 1.5 * shown().red(), longestWait);
        }
        Settings().setDrawingPlace(QStringLiteral("thread"));
        Ide ide;
        QVERIFY(!ide.viewport.drawsInWindow());
        QTRY_VERIFY_WITH_TIMEOUT(ide.viewport.framesRendered() > 0, longestWait);
        QCOMPARE(drawingPlace(QStringLiteral("no such")).place, DrawingPlace::Automatic);
    }

    void aKeyThatIsGivenAwayIsTakenFromItsOwner() {
        Ide ide;
        ide.trigger(ActionId::Preferences);
        Preferences* dialog = openDialog<Preferences>(ide);
        QKeySequenceEdit* edit = dialog->findChild<QKeySequenceEdit*>(QStringLiteral("Comment"));
        edit->setKeySequence(QKeySequence(Qt::Key_F12)); // the definition's
        Q_EMIT edit->editingFinished();
        const Actions& actions = ide.bench.window().actions();
        QCOMPARE(actions[ActionId::Comment].shortcut(), QKeySequence(Qt::Key_F12));
        QVERIFY(actions[ActionId::Definition].shortcuts().isEmpty());
        edit->setKeySequence(QKeySequence(QStringLiteral("Alt+3"))); // a panel's, which is in no table
        Q_EMIT edit->editingFinished();
        QCOMPARE(actions[ActionId::Comment].shortcut(), QKeySequence(Qt::Key_F12));
        QCOMPARE(edit->keySequence(), QKeySequence(Qt::Key_F12));
        dialog->close();
        ide.bench.window().activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(&ide.bench.window(), longestWait));
        placeCaretBehind(ide.editor, "camera");
        QTest::keyClick(&ide.editor, Qt::Key_F12);
        QVERIFY(ide.editor.bytes().startsWith("// camera"));
    }

    void everyNavigationPresetTurnsMovesAndHasATitle() {
        for (const NavigationRow& row : navigationPresets()) {
            QSet<Gesture> reached;
            for (const Qt::MouseButton button : {Qt::LeftButton, Qt::MiddleButton, Qt::RightButton})
                for (const Qt::KeyboardModifiers keys :
                     {Qt::KeyboardModifiers(), Qt::KeyboardModifiers(Qt::ShiftModifier)})
                    reached.insert(row.gesture(button, keys));
            QVERIFY2(reached.contains(Gesture::Orbit) && reached.contains(Gesture::Pan), row.name);
            QVERIFY(QByteArray(row.title).size() > 5);
        }
        QCOMPARE(navigationPreset(QStringLiteral("no such")).name, navigationPresets().front().name);
    }

    void everyWidgetThatTakesTheKeyboardHasAName() {
        Ide ide;
        QStringList nameless;
        for (const QWidget* widget : ide.bench.window().findChildren<QWidget*>()) {
            const bool takesKeys = widget->focusPolicy() & Qt::TabFocus;
            const bool says = !widget->accessibleName().isEmpty() || !widget->toolTip().isEmpty() ||
                              widget->property("text").toString().size() > 1 ||
                              !widget->property("title").toString().isEmpty();
            const QString kind = QString::fromLatin1(widget->metaObject()->className());
            // Parts of a widget that is named itself.
            const bool part =
                widget->objectName().startsWith(QStringLiteral("qt_")) ||
                (widget->parentWidget() != nullptr && !widget->parentWidget()->accessibleName().isEmpty());
            if (takesKeys && !says && !part && kind != QStringLiteral("QTabBar") &&
                kind != QStringLiteral("QComboBoxListView"))
                nameless.append(kind + u' ' + widget->objectName());
        }
        QVERIFY2(nameless.isEmpty(), qPrintable(nameless.join(QStringLiteral(", "))));
    }
};

CAROM_TEST_WITH(IdeApplication, shell_test, ShellTest)
#include "shell_test.moc"
