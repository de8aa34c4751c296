// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/ide.h"
#include "ui/window/recovery.h"

#include <QDir>
#include <QProcess>
#include <QSettings>
#include <QStandardPaths>

#include <csignal>

using namespace carom;
using namespace carom::test;

class RecoveryTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void unsavedTextIsKeptUntilItIsSaved() {
        QTemporaryDir folder;
        SceneEditor editor(loadTheme(true));
        Document document(editor);
        connect(&editor, &SceneEditor::textChanged, &document, &Document::noteEdit);
        Recovery recovery(document, folder.path());
        const auto swapFiles = [&] {
            return QDir(folder.path()).entryList({QStringLiteral("*.swap")}).size();
        };
        recovery.keep();
        QCOMPARE(swapFiles(), 0);
        editor.insert(QStringLiteral("sphere;"));
        recovery.keep();
        QCOMPARE(swapFiles(), 1);
        QVERIFY(Recovery::lostTexts(folder.path()).empty()); // not lost: this session lives
        QVERIFY(!document.saveAs(folder.filePath(QStringLiteral("a.sdl"))));
        recovery.keep();
        QCOMPARE(swapFiles(), 0);
    }

    void aKilledProgramLeavesWhatWasTyped() {
        // A second process types and is killed, as by a crash; the text must be there byte for byte.
        QTemporaryDir folder;
        QProcess victim;
        victim.start(QCoreApplication::applicationFilePath(),
                     {QStringLiteral("recovery_test"), QStringLiteral("victim"), folder.path()});
        QVERIFY(victim.waitForReadyRead(patience));
        QVERIFY(Recovery::lostTexts(folder.path()).empty());
        victim.kill();
        QVERIFY(victim.waitForFinished(patience));
        const std::vector<LostText> lost = Recovery::lostTexts(folder.path());
        QCOMPARE(lost.size(), std::size_t{1});
        QCOMPARE(lost[0].text, QByteArray("// gr\xC3\xB6\xC3\x9F"
                                          "er\nsphere;"));
        QVERIFY(lost[0].path.isEmpty());
        Recovery::discard(lost[0]);
        QVERIFY(Recovery::lostTexts(folder.path()).empty());
    }

    void filesThatAreNoSwapFilesAreLeftAlone() {
        QTemporaryDir folder;
        const QString path = folder.filePath(QStringLiteral("other.swap"));
        writeFile(path, "not ours");
        QVERIFY(Recovery::lostTexts(folder.path()).empty());
        QCOMPARE(readFile(path), QByteArray("not ours"));
    }

    void aRecoveredTextIsUnsavedAndBelongsToItsFile() {
        QTemporaryDir folder;
        const QString path = folder.filePath(QStringLiteral("a.sdl"));
        writeFile(path, "wall;");
        SceneEditor editor(loadTheme(true));
        Document document(editor);
        document.recover(path, "sphere;");
        QVERIFY(document.isModified());
        QCOMPARE(document.path(), path);
        QVERIFY(!document.save());
        QVERIFY(!document.isModified());
        QCOMPARE(readFile(path), QByteArray("sphere;"));
    }
};

namespace {

/// The process that is killed: types, keeps, says so and waits.
int beVictim(const QString& folder) {
    SceneEditor editor(loadTheme(true));
    Document document(editor);
    QObject::connect(&editor, &SceneEditor::textChanged, &document, &Document::noteEdit);
    Recovery recovery(document, folder);
    editor.insert(QString::fromUtf8("// größer\nsphere;"));
    recovery.keep();
    std::puts("kept");
    std::fflush(stdout);
    return QApplication::exec();
}

} // namespace

namespace carom::test {
int recovery_test(int argc, char** argv);
}

// The program's second instance is the one that is killed.
int carom::test::recovery_test(int argc, char** argv) {
    IdeApplication application(argc, argv);
    if (argc == 3 && QByteArray(argv[1]) == "victim") return beVictim(QString::fromLocal8Bit(argv[2]));
    RecoveryTest test;
    return QTest::qExec(&test, argc, argv);
}
#include "recovery_test.moc"
