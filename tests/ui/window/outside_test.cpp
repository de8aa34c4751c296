// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/outside_changes.h"
#include "tests/support/whole_ide.h"

#include "ui/window/file_commands.h"
#include "ui/window/outside_dialog.h"
#include "ui/window/recovery_dialog.h"
#include "ui/base/settings.h"
#include "ui/base/theme.h"
#include "ui/window/welcome.h"

#include <QDir>
#include <QLabel>
#include <QListWidget>
#include <QMenu>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSettings>
#include <QSignalSpy>
#include <QTextDocumentFragment>

// Other programs change the scene's file while it is open here.

using namespace carom;
using namespace carom::test;

namespace {

const QByteArray theirs = twoBalls + "// by somebody else\n";

void press(QWidget& dialog, const char* button) {
    QPushButton* found = dialog.findChild<QPushButton*>(QLatin1StringView(button));
    QVERIFY(found != nullptr);
    found->click();
}

/// What a tool tip shows.
QString seen(const QString& tip) {
    return Qt::mightBeRichText(tip) ? QTextDocumentFragment::fromHtml(tip).toPlainText() : tip;
}

/// What a menu or a button shows: `&` marks a letter, `&&` is one.
QString seenOn(QString title) {
    constexpr QChar mark(0xFFFC); // which no name has
    return title.replace(QStringLiteral("&&"), mark).remove(u'&').replace(mark, u'&');
}

} // namespace

class OutsideTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void init() { QSettings().clear(); }

    void aReloadIsOneStepThatCanBeUndone() {
        Ide ide;
        writeFile(ide.path, theirs);
        QTRY_COMPARE_WITH_TIMEOUT(ide.editor.bytes(), theirs, longestWait);
        QVERIFY(!ide.bench.document().isModified());
        ide.editor.undo();
        QCOMPARE(ide.editor.bytes(), twoBalls);
        QVERIFY(ide.bench.document().isModified());
        ide.editor.redo();
        QCOMPARE(ide.editor.bytes(), theirs);
        QVERIFY(!ide.bench.document().isModified());
    }

    void aSaveOverAFileChangedOutsideAsksAndShowsWhatDiffers() {
        Ide ide;
        typeAtTheEnd(ide.editor, "// mine");
        const QByteArray mine = ide.editor.bytes();
        // The save comes before the window has noticed by itself.
        writeFile(ide.path, theirs);
        QString shown;
        answerNextDialog([&shown](QWidget& dialog) {
            shown = dialog.findChild<QPlainTextEdit*>()->toPlainText();
            press(dialog, "keep");
        });
        ide.trigger(ActionId::Save);
        QVERIFY2(shown.contains(QStringLiteral("// by somebody else")) &&
                     shown.contains(QStringLiteral("+ // mine")),
                 qPrintable(shown));
        QCOMPARE(readFile(ide.path), theirs);
        QVERIFY(ide.bench.document().isModified());

        answerNextDialog([](QWidget& dialog) { press(dialog, "save"); });
        ide.trigger(ActionId::Save);
        QCOMPARE(readFile(ide.path), mine);
        QVERIFY(!ide.bench.document().isModified());
    }

    void theFilesTextCanBeTakenAndWhatWasTypedComesBackByUndo() {
        Ide ide;
        typeAtTheEnd(ide.editor, "// mine");
        const QByteArray mine = ide.editor.bytes();
        bool asked = false;
        answerNextDialog([&asked](QWidget& dialog) {
            asked = true;
            press(dialog, "take");
        });
        writeFile(ide.path, theirs);
        QTRY_VERIFY_WITH_TIMEOUT(asked, longestWait);
        QCOMPARE(ide.editor.bytes(), theirs);
        ide.editor.undo();
        QCOMPARE(ide.editor.bytes(), mine);
    }

    void oneQuestionAtATime() {
        Ide ide;
        typeAtTheEnd(ide.editor, "// mine");
        int questions = 0;
        bool second = false;
        answerNextDialog([&](QWidget& dialog) {
            ++questions;
            // While it stands there the file changes again: no second question over the first.
            QSignalSpy noticed(&ide.bench.document(), &Document::changedOutside);
            writeFile(ide.path, theirs + "// again\n");
            QTRY_COMPARE_WITH_TIMEOUT(noticed.count(), 1, longestWait);
            QCOMPARE(QApplication::activeModalWidget(), &dialog);
            answerNextDialog([&](QWidget& next) {
                second = next.findChild<QPlainTextEdit*>()->toPlainText().contains(QStringLiteral("again"));
                press(next, "keep");
            });
            press(dialog, "keep");
        });
        writeFile(ide.path, theirs);
        QTRY_VERIFY_WITH_TIMEOUT(second, longestWait);
        QCOMPARE(questions, 1);
    }

    void whatASaveHasAskedAboutIsNotAskedAgain() {
        // The save came before the window had noticed by itself; it noticed while the question stood there,
        // and asked the same once more.
        Ide ide;
        typeAtTheEnd(ide.editor, "// mine");
        writeFile(ide.path, theirs);
        bool looked = false, noticed = true;
        answerNextDialog([&](QWidget& dialog) {
            QSignalSpy again(&ide.bench.document(), &Document::changedOutside);
            looked = allHaveLooked();
            noticed = again.count() > 0;
            press(dialog, "keep");
        });
        ide.trigger(ActionId::Save);
        QVERIFY(looked);
        QVERIFY(!noticed);
        QCOMPARE(readFile(ide.path), theirs);
        // It asks before the next save all the same, and a later change is told of.
        bool asked = false;
        answerNextDialog([&](QWidget& dialog) {
            asked = true;
            press(dialog, "keep");
        });
        ide.trigger(ActionId::Save);
        QVERIFY(asked);
        asked = false;
        answerNextDialog([&](QWidget& dialog) {
            asked = true;
            press(dialog, "keep");
        });
        writeFile(ide.path, theirs + "// later\n");
        QTRY_VERIFY_WITH_TIMEOUT(asked, longestWait);
    }

    void theTextOfADeletedFileIsSaidToBeUnsavedAndClosingAsks() {
        Ide ide;
        QSignalSpy reports(&ide.bench.files(), &FileCommands::reported);
        QVERIFY(QFile::remove(ide.path));
        QTRY_VERIFY_WITH_TIMEOUT(ide.bench.window().isWindowModified(), longestWait);
        QVERIFY(reports.last().first().toString().contains(QStringLiteral("deleted or moved")));
        bool asked = false;
        answerNextDialog([&asked](QWidget& box) {
            asked = true;
            static_cast<QMessageBox&>(box).button(QMessageBox::Save)->click();
        });
        ide.bench.window().close();
        QVERIFY(asked);
        QCOMPARE(readFile(ide.path), twoBalls);
    }

    void aFileThatNobodyMayWriteIsNotReplacedAndThatIsSaid() {
        Ide ide;
        const QFile::Permissions readOnly =
            QFile::ReadOwner | QFile::ReadUser | QFile::ReadGroup | QFile::ReadOther;
        const QFile::Permissions anyWriter = QFile::WriteOwner | QFile::WriteGroup | QFile::WriteOther;
        QVERIFY(QFile::setPermissions(ide.path, readOnly));
        typeAtTheEnd(ide.editor, "// mine");
        const QByteArray mine = ide.editor.bytes();
        QString said;
        answerNextDialog([&said](QWidget& box) {
            said = static_cast<QMessageBox&>(box).text();
            static_cast<QMessageBox&>(box).button(QMessageBox::Ok)->click();
        });
        ide.trigger(ActionId::Save);
        QVERIFY2(said.contains(ide.path) && said.contains(QStringLiteral("read-only")), qPrintable(said));
        QCOMPARE(readFile(ide.path), twoBalls);
        QCOMPARE(QFile::permissions(ide.path) & anyWriter, QFile::Permissions());
        QVERIFY(ide.bench.document().isModified());
        QCOMPARE(ide.editor.bytes(), mine);
    }

    void aNameIsShownAsItIs() {
        // Qt takes a text that looks like HTML for HTML.
        Ide ide;
        const QString path =
            ide.folder.filePath(QStringLiteral("<b>bold<")); // no `/`: a name may not hold one
        writeFile(path, twoBalls);
        QVERIFY(!ide.bench.document().open(path));
        typeAtTheEnd(ide.editor, "x");
        Qt::TextFormat format = Qt::AutoText;
        answerNextDialog([&format](QWidget& box) {
            format = static_cast<QMessageBox&>(box).textFormat();
            static_cast<QMessageBox&>(box).button(QMessageBox::Cancel)->click();
        });
        ide.bench.window().close();
        QCOMPARE(format, Qt::PlainText);
    }

    void menusButtonsAndTipsShowANameAsItIs() {
        const QString name = QStringLiteral("<b>this & that<b> &amp; more.sdl");
        Ide ide;
        const QString path = ide.folder.filePath(name);
        QVERIFY(Qt::mightBeRichText(path)); // or nothing is shown here
        writeFile(path, twoBalls);
        QVERIFY(ide.bench.files().open(path));
        MainWindow& window = ide.bench.window();
        QCOMPARE(seenOn(window.actions()[ActionId::Recent].menu()->actions().first()->text()), path);

        Settings settings;
        Welcome welcome(settings, nullptr);
        bool offered = false;
        for (const QPushButton* button : welcome.findChildren<QPushButton*>())
            offered |= seenOn(button->text()) == name && seen(button->toolTip()) == path;
        QVERIFY(offered);

        RecoveryDialog dialog({{QString(), path, "sphere", QDateTime::currentDateTime(), {}}},
                              loadTheme(true), nullptr);
        const QListWidgetItem* lost = dialog.findChild<QListWidget*>()->item(0);
        QVERIFY(lost->text().startsWith(name));
        QCOMPARE(seen(lost->toolTip()), path);

        window.warn(path);
        const QLabel* warning = window.findChild<QLabel*>(QStringLiteral("warning"));
        QCOMPARE(warning->textFormat(), Qt::PlainText);
        QCOMPARE(seen(warning->toolTip()), path);
        window.warn({});
    }

    void aPanelShowsANameAsItIs() {
        Ide ide;
        for (const char* name : {"accuracyState", "comparisonState", "raceState", "stabilityState",
                                 "sweepState", "timingReport"}) {
            const QLabel* label = ide.bench.window().findChild<QLabel*>(QLatin1StringView(name));
            QVERIFY2(label != nullptr, name);
            QVERIFY2(label->textFormat() == Qt::PlainText, name);
        }
    }
};

CAROM_TEST_WITH(IdeApplication, outside_test, OutsideTest)
#include "outside_test.moc"
