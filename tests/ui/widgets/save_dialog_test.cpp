// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "ui/widgets/save_dialog.h"

#include <QApplication>
#include <QDir>
#include <QFileDialog>
#include <QLineEdit>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>

using namespace carom;

namespace {

constexpr int opens = 300; // [ms] until the dialog is there; it is asked for again if it is not

/// What the dialog shows when it opens, and what comes back once `name` has been typed and Return pressed.
struct Asked {
    QString folder, proposed, path;

    explicit Asked(const QString& name) {
        QTimer user;
        QObject::connect(&user, &QTimer::timeout, [this, &name] {
            QFileDialog* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
            if (dialog == nullptr) return;
            QLineEdit* line = dialog->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"));
            folder = dialog->directory().canonicalPath();
            proposed = line->text();
            if (name.isNull()) {
                QTest::keyClick(dialog, Qt::Key_Escape);
                return;
            }
            line->setText(name);
            QTest::keyClick(line, Qt::Key_Return);
        });
        user.start(opens);
        path = askWhereToSave(nullptr, QStringLiteral("Record"), QStringLiteral("run.gif"),
                              QStringLiteral("Animated (*.gif);;Films (*.mp4)"));
    }
};

} // namespace

class SaveDialogTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void itBeginsBesideTheFileUsedLastAndAddsTheEnding() {
        const QTemporaryDir scenes, films;
        const QString folder = QDir(scenes.path()).canonicalPath(),
                      other = QDir(films.path()).canonicalPath();
        rememberFolderOf(folder + QStringLiteral("/wall.sdl"));
        const Asked first(QStringLiteral("clip"));
        QCOMPARE(first.folder, folder);
        QCOMPARE(first.proposed, QStringLiteral("run.gif"));
        QCOMPARE(first.path, folder + QStringLiteral("/clip.gif"));

        const Asked second(other + QStringLiteral("/clip.png")); // an ending of one's own stays
        QCOMPARE(second.path, other + QStringLiteral("/clip.png"));
        QCOMPARE(Asked(QString()).folder, other);
    }

    void whoeverChangesTheirMindGetsNoPath() { QVERIFY(Asked(QString()).path.isEmpty()); }
};

CAROM_TEST_WITH(QApplication, save_dialog_test, SaveDialogTest)
#include "save_dialog_test.moc"
