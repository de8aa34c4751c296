// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/failing_files.h"
#include "tests/support/ide.h"
#include "ui/window/recovery.h"

#include <QDir>
#include <QLabel>
#include <QProcess>
#include <QSettings>
#include <QSignalSpy>
#include <QStandardPaths>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>

using namespace carom;
using namespace carom::test;

namespace {

/// A document in an editor, as the window has it.
struct EditedDocument {
    SceneEditor editor{loadTheme(true)};
    Document document{editor};

    EditedDocument() { QObject::connect(&editor, &SceneEditor::textChanged, &document, &Document::noteEdit); }
};

} // namespace

class RecoveryTest : public QObject {
    Q_OBJECT

    /// A session that had this text of that file unsaved when it was killed.
    static void killedWith(const QString& swaps, const QString& path, const QByteArray& text) {
        QProcess victim;
        victim.start(QCoreApplication::applicationFilePath(),
                     {QStringLiteral("recovery_test"), QStringLiteral("victim"), swaps, path,
                      QString::fromUtf8(text)});
        if (!victim.waitForReadyRead(longestWait)) qFatal("the victim has not kept its text");
        victim.kill();
        victim.waitForFinished(longestWait);
    }

  private Q_SLOTS:
    void unsavedTextIsKeptUntilItIsSaved() {
        QTemporaryDir folder;
        EditedDocument edited;
        auto& [editor, document] = edited;
        Recovery recovery(document, folder.path());
        const auto swapFiles = [&] {
            return QDir(folder.path()).entryList({QStringLiteral("*.swap")}).size();
        };
        recovery.keep();
        QCOMPARE(swapFiles(), 0);
        editor.insert(QStringLiteral("sphere;"));
        recovery.keep();
        QCOMPARE(swapFiles(), 1);
        QVERIFY(Recovery::lostTexts(folder.path()).texts.empty()); // not lost: this session lives
        // At once: killed a second after the save, a session was said to have lost what it said before it.
        QVERIFY(!document.saveAs(folder.filePath(QStringLiteral("a.sdl"))));
        QCOMPARE(swapFiles(), 0);
    }

    void aKilledProgramLeavesWhatWasTyped() {
        // A second process types and is killed, as by a crash; the text must be there byte for byte.
        QTemporaryDir folder;
        QProcess victim;
        victim.start(QCoreApplication::applicationFilePath(),
                     {QStringLiteral("recovery_test"), QStringLiteral("victim"), folder.path(), QString(),
                      QString::fromUtf8("// größer\nsphere;")});
        QVERIFY(victim.waitForReadyRead(longestWait));
        QVERIFY(Recovery::lostTexts(folder.path()).texts.empty());
        victim.kill();
        QVERIFY(victim.waitForFinished(longestWait));
        std::vector<LostText> lost = Recovery::lostTexts(folder.path()).texts;
        QCOMPARE(lost.size(), std::size_t{1});
        QCOMPARE(lost[0].text, QByteArray("// gr\xC3\xB6\xC3\x9F"
                                          "er\nsphere;"));
        QVERIFY(lost[0].path.isEmpty());
        // While one window offers it, no other does; nor does one see a lock as unsaved text.
        QVERIFY(Recovery::lostTexts(folder.path()).texts.empty());
        Recovery::discard(lost[0]);
        lost.clear();
        QVERIFY(QDir(folder.path()).isEmpty()); // no lock stays
        QVERIFY(Recovery::lostTexts(folder.path()).texts.empty());
    }

    void ofProgramsThatLookAtTheSameTimeOneFindsTheText() {
        constexpr int programs = 5, rounds = 8;
        QTemporaryDir folder;
        std::vector<std::unique_ptr<QProcess>> lookers;
        for (int i = 0; i < programs; ++i) {
            lookers.push_back(std::make_unique<QProcess>());
            lookers.back()->start(QCoreApplication::applicationFilePath(),
                                  {QStringLiteral("recovery_test"), QStringLiteral("looker"), folder.path()});
        }
        const auto answer = [](QProcess& looker) {
            return looker.canReadLine() || looker.waitForReadyRead(longestWait) ? looker.readLine()
                                                                                : QByteArray();
        };
        for (int round = 0; round < rounds; ++round) {
            killedWith(folder.path(), {}, "sphere;");
            for (const auto& looker : lookers) QCOMPARE(answer(*looker), QByteArray("ready\n"));
            for (const auto& looker : lookers) looker->write("look\n");
            int found = 0;
            for (const auto& looker : lookers) found += answer(*looker).trimmed().toInt();
            QCOMPARE(found, 1);
            for (const auto& looker : lookers) looker->write("let go\n"); // until then it holds what it found
            for (const auto& looker : lookers) QCOMPARE(answer(*looker), QByteArray("let go\n"));
            std::vector<LostText> lost = Recovery::lostTexts(folder.path()).texts;
            QCOMPARE(lost.size(), std::size_t{1});
            Recovery::discard(lost[0]);
        }
        for (const auto& looker : lookers) looker->closeWriteChannel();
        for (const auto& looker : lookers) QVERIFY(looker->waitForFinished(longestWait));
    }

    void aSwapFileThatSaysWhatTheFileSaysIsNoLoss() {
        // Killed between a save and the next look at whether anything is unsaved.
        QTemporaryDir folder;
        const QString path = folder.filePath(QStringLiteral("a.sdl"));
        const QString swaps = folder.filePath(QStringLiteral("swaps"));
        killedWith(swaps, path, "sphere;");
        writeFile(path, "other");
        QCOMPARE(Recovery::lostTexts(swaps).texts.size(), std::size_t{1});
        writeFile(path, "sphere;");
        QVERIFY(Recovery::lostTexts(swaps).texts.empty());
        QVERIFY(QDir(swaps).isEmpty());
    }

    void onlyTheOwnerMayReadIt() {
        QTemporaryDir folder;
        const QString swaps = folder.filePath(QStringLiteral("swaps"));
        EditedDocument edited;
        auto& [editor, document] = edited;
        Recovery recovery(document, swaps);
        editor.insert(QStringLiteral("secret;"));
        QVERIFY(recovery.keep());
        const QFileDevice::Permissions others = QFile::ReadGroup | QFile::ReadOther | QFile::ExeGroup |
                                                QFile::ExeOther | QFile::WriteGroup | QFile::WriteOther;
        QCOMPARE(QFile::permissions(swaps) & others, QFileDevice::Permissions());
        for (const QFileInfo& file : QDir(swaps).entryInfoList({QStringLiteral("*.swap")}))
            QCOMPARE(file.permissions() & others, QFileDevice::Permissions());
    }

    void whatCannotBeKeptIsSaidUntilItCan_data() {
        QTest::addColumn<QByteArray>("call");
        QTest::addColumn<int>("cause");
        for (const char* call : {"open", "write", "fsync", "close", "rename"})
            for (const auto& [name, cause] : {std::pair{"ENOSPC", ENOSPC}, {"EIO", EIO}, {"EACCES", EACCES}})
                QTest::addRow("%s: %s", call, name) << QByteArray(call) << cause;
    }
    void whatCannotBeKeptIsSaidUntilItCan() {
        QFETCH(QByteArray, call);
        QFETCH(int, cause);
        QTemporaryDir folder;
        EditedDocument edited;
        auto& [editor, document] = edited;
        Recovery recovery(document, folder.path());
        QSignalSpy changes(&recovery, &Recovery::keepingChanged);
        const auto kept = [&] {
            const QDir swaps(folder.path(), QStringLiteral("*.swap"));
            return swaps.count() == 1 ? readFile(swaps.filePath(swaps[0])) : QByteArray();
        };
        editor.insert(QStringLiteral("one"));
        QVERIFY(recovery.keep());
        const QByteArray before = kept();
        QVERIFY(before.contains("one"));
        editor.insert(QStringLiteral("two"));
        {
            const FailingFiles failing(call, 1, cause, qPrintable(folder.path()));
            QVERIFY(!recovery.keep());
            QVERIFY(!recovery.keep());
        }
        QCOMPARE(kept(), before); // what was kept is there still
        QCOMPARE(changes.count(), 1);
        QCOMPARE(changes.takeFirst().first().toString(),
                 QString::fromStdString(std::generic_category().message(cause)));
        QVERIFY(recovery.keep());
        QCOMPARE(changes.count(), 1);
        QCOMPARE(changes.takeFirst().first().toString(), QString());
        QVERIFY(kept().contains("two"));
    }

    void withoutAFolderForItOneIsToldAsWell() {
        QTemporaryDir folder;
        const QString file = folder.filePath(QStringLiteral("file"));
        writeFile(file, "in the way");
        EditedDocument edited;
        auto& [editor, document] = edited;
        Recovery recovery(document, file + QStringLiteral("/recovery"));
        QSignalSpy changes(&recovery, &Recovery::keepingChanged);
        editor.insert(QStringLiteral("one"));
        QVERIFY(!recovery.keep());
        QCOMPARE(changes.first().first().toString(), QStringLiteral("Not a directory"));
    }

    void filesThatAreNoSwapFilesAreLeftAlone() {
        QTemporaryDir folder;
        const QString path = folder.filePath(QStringLiteral("other.swap"));
        writeFile(path, "not ours");
        const LostTexts found = Recovery::lostTexts(folder.path());
        QVERIFY(found.texts.empty());
        QCOMPARE(found.unreadable, QStringList{path}); // it may be a swap file that the disk has spoilt
        QCOMPARE(readFile(path), QByteArray("not ours"));
    }

    void aWindowSaysInItsStatusBarThatTextIsNotKept() {
        const QString swaps = Recovery::standardFolder();
        QSettings().setValue(QStringLiteral("recovery/interval"), 100); // [ms]
        Workbench bench;
        bench.window().show();
        bench.keepUnsavedText();
        const QLabel* warning = bench.window().findChild<QLabel*>(QStringLiteral("warning"));
        QVERIFY(!warning->isVisible());
        {
            const FailingFiles full("write", 1, ENOSPC, qPrintable(swaps));
            bench.window().editor().insert(QStringLiteral("one"));
            QTRY_VERIFY_WITH_TIMEOUT(warning->isVisible(), longestWait);
            QVERIFY(warning->text().contains(QStringLiteral("No space left on device")));
        }
        QTRY_VERIFY_WITH_TIMEOUT(!warning->isVisible(), longestWait);
        bench.window().editor().markSaved();
    }

    void itIsTwoSecondsBehindUnlessTheSettingsSayOtherwise() {
        QSettings().clear();
        QCOMPARE(Settings().recoveryInterval(), 2000);
        const QString key = QStringLiteral("recovery/interval");
        for (const auto& [written, taken] : {std::pair{300, 300}, {100, 100}, {0, 100}, {-5, 100}}) {
            QSettings().setValue(key, written);
            QCOMPARE(Settings().recoveryInterval(), taken);
        }
        QSettings().clear();
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
int beVictim(const QString& folder, const QString& path, const QByteArray& text) {
    EditedDocument edited;
    auto& [editor, document] = edited;
    Recovery recovery(document, folder);
    document.recover(path, text);
    recovery.keep();
    std::puts("kept");
    std::fflush(stdout);
    return QApplication::exec();
}

/// A process that looks when it is told to, says how much it has found, and holds it until it is told to let
/// go; so until its input ends.
int beLooker(const QString& folder) {
    const auto say = [](const std::string& word) {
        std::puts(word.c_str());
        std::fflush(stdout);
    };
    say("ready");
    std::string line;
    while (std::getline(std::cin, line)) {
        {
            const LostTexts found = Recovery::lostTexts(folder);
            say(std::to_string(found.texts.size()));
            std::getline(std::cin, line);
        }
        say("let go");
        say("ready");
    }
    return 0;
}

} // namespace

namespace carom::test {
int recovery_test(int argc, char** argv);
}

// The program's second instance is the one that is killed.
int carom::test::recovery_test(int argc, char** argv) {
    if (argc == 3 && QByteArray(argv[1]) == "looker") return beLooker(QString::fromLocal8Bit(argv[2]));
    IdeApplication application(argc, argv);
    if (argc == 5 && QByteArray(argv[1]) == "victim")
        return beVictim(QString::fromLocal8Bit(argv[2]), QString::fromLocal8Bit(argv[3]), argv[4]);
    RecoveryTest test;
    return QTest::qExec(&test, argc, argv);
}
#include "recovery_test.moc"
