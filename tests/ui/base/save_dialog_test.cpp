// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "ui/base/save_dialog.h"

#include <QApplication>
#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>

using namespace carom;

namespace {

constexpr int opens = 10; // [ms] between looks whether the dialog is there

/// What the dialog shows when it opens, and what comes back once `name` has been typed and Return pressed.
/// Whoever may not replace a file changes their mind.
struct Asked {
    QString folder, proposed, path, question;

    explicit Asked(const QString& name, bool mayReplace = true, const Replaced& replaced = {}) {
        QTimer user;
        QObject::connect(&user, &QTimer::timeout, [this, &name, mayReplace] {
            if (QMessageBox* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget())) {
                question = box->text();
                box->button(mayReplace ? QMessageBox::Yes : QMessageBox::No)->click();
                return;
            }
            QFileDialog* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
            if (dialog == nullptr) return;
            QLineEdit* line = dialog->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"));
            folder = dialog->directory().canonicalPath();
            proposed = line->text();
            if (name.isNull() || (!question.isEmpty() && !mayReplace)) {
                QTest::keyClick(dialog, Qt::Key_Escape);
                return;
            }
            line->setText(name);
            QTest::keyClick(line, Qt::Key_Return);
        });
        user.start(opens);
        path = askWhereToSave(nullptr, QStringLiteral("Record"), QStringLiteral("run.gif"),
                              QStringLiteral("Animated (*.gif);;Videos (*.mp4)"), replaced);
    }
};

} // namespace

class SaveDialogTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void itBeginsBesideTheFileUsedLastAndAddsTheEnding() {
        const QTemporaryDir scenes, videos;
        const QString folder = QDir(scenes.path()).canonicalPath(),
                      other = QDir(videos.path()).canonicalPath();
        rememberFolderOf(folder + QStringLiteral("/wall.sdl"));
        const Asked first(QStringLiteral("clip"));
        QCOMPARE(first.folder, folder);
        QCOMPARE(first.proposed, QStringLiteral("run.gif"));
        QCOMPARE(first.path, folder + QStringLiteral("/clip.gif"));

        const Asked second(other + QStringLiteral("/clip.png")); // an ending of one's own stays
        QCOMPARE(second.path, other + QStringLiteral("/clip.png"));
        QCOMPARE(Asked(QString()).folder, other);
    }

    void theFileThatWillBeWrittenIsNotReplacedWithoutAQuestion() {
        const QTemporaryDir folder;
        rememberFolderOf(folder.filePath(QStringLiteral("wall.sdl")));
        QFile old(folder.filePath(QStringLiteral("clip.gif")));
        QVERIFY(old.open(QIODevice::WriteOnly));
        // Typed without its ending, so that the dialog itself sees no such file.
        const Asked kept(QStringLiteral("clip"), false);
        QVERIFY2(kept.question.contains(QStringLiteral("clip.gif")), qPrintable(kept.question));
        QVERIFY(kept.path.isEmpty());
        QCOMPARE(Asked(QStringLiteral("clip")).path, folder.filePath(QStringLiteral("clip.gif")));
        QVERIFY(Asked(QStringLiteral("other")).question.isEmpty());
        // Where other files are written than the one of that name, those count.
        QVERIFY(
            Asked(QStringLiteral("clip"), true, [](const QString&) { return QString(); }).question.isEmpty());
        const auto third = [](const QString& path) { return path + QStringLiteral("-3"); };
        QVERIFY(Asked(QStringLiteral("new"), true, third).question.contains(QStringLiteral("new.gif-3")));
    }

    void whoeverChangesTheirMindGetsNoPath() { QVERIFY(Asked(QString()).path.isEmpty()); }
};

CAROM_TEST_WITH(QApplication, save_dialog_test, SaveDialogTest)
#include "save_dialog_test.moc"
