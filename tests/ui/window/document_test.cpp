// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/ide.h"
#include "tests/support/outside_changes.h"
#include "tests/support/test_class.h"

#include <QDir>
#include <QSignalSpy>
#include <QTimer>

#include <sys/stat.h>

#include <cstdio>

using namespace carom;
using namespace carom::test;

namespace {

/// A document that was read from a file in a folder of its own.
struct OpenDocument {
    QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("a.sdl"));
    PlainBuffer buffer;
    Document document{buffer};

    explicit OpenDocument(const QByteArray& text) {
        writeFile(path, text);
        QVERIFY(!document.open(path));
    }
};

/// Everything an editor could spoil: a byte order mark, mixed line ends, a zero, bytes that are not UTF-8, no
/// line end at the end.
const QByteArray awkward("\xEF\xBB\xBF// a\r\nsphere\n\rx\0y\xFF\xC3(\t ", 24);

} // namespace

class DocumentTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void everyByteSurvivesOpeningAndSaving() {
        QTemporaryDir folder;
        const QString path = folder.filePath(QStringLiteral("a.sdl")),
                      copy = folder.filePath(QStringLiteral("b.sdl"));
        writeFile(path, awkward);
        SceneEditor editor(loadTheme(true));
        Document document(editor);
        QVERIFY(!document.open(path));
        QCOMPARE(document.text(), awkward);
        QVERIFY(!document.isModified());
        QVERIFY(!document.saveAs(copy));
        QCOMPARE(readFile(copy), awkward);
        QCOMPARE(document.name(), QStringLiteral("b.sdl"));
    }

    void aFailedSaveLeavesTheOldFileAndTheUnsavedState() {
        OpenDocument opened("old");
        auto& [folder, path, buffer, document] = opened;
        buffer.content = "new";
        const std::optional<QString> problem =
            document.saveAs(folder.filePath(QStringLiteral("no/such/folder.sdl")));
        QVERIFY(problem.has_value());
        QVERIFY(problem->contains(QStringLiteral("folder.sdl")));
        QVERIFY(document.isModified());
        QCOMPARE(readFile(path), QByteArray("old"));
        QVERIFY(!document.save());
        QCOMPARE(readFile(path), QByteArray("new"));
        QCOMPARE(QDir(folder.path()).entryList(QDir::Files), QStringList{QStringLiteral("a.sdl")});
    }

    void aFileThatCannotBeReadChangesNothing() {
        PlainBuffer buffer;
        Document document(buffer);
        document.startNew("kept");
        QVERIFY(document.open(QStringLiteral("/no/such/file.sdl")).has_value());
        QVERIFY(document.open(QDir::tempPath()).has_value());
        QCOMPARE(buffer.content, QByteArray("kept"));
        QVERIFY(document.path().isEmpty());
    }

    void aTextWithoutAFileAsksForAName() {
        PlainBuffer buffer;
        Document document(buffer);
        QVERIFY(document.save().has_value());
    }

    void openingIsOneChangeAndRaisesTheRevision() {
        QTemporaryDir folder;
        const QString path = folder.filePath(QStringLiteral("a.sdl"));
        writeFile(path, "sphere;");
        SceneEditor editor(loadTheme(true));
        Document document(editor);
        connect(&editor, &SceneEditor::textChanged, &document, &Document::noteEdit);
        QSignalSpy edits(&document, &Document::edited), replacements(&document, &Document::replaced);
        const std::int64_t before = document.revision();
        QVERIFY(!document.open(path));
        QCOMPARE(edits.count(), 0);
        QCOMPARE(replacements.count(), 1);
        QVERIFY(document.revision() > before);
    }

    void aChangeByAnotherProgramIsNoticedAndOurOwnIsNot() {
        OpenDocument opened("one");
        auto& [folder, path, buffer, document] = opened;
        QSignalSpy outside(&document, &Document::changedOutside);
        buffer.content = "two";
        QVERIFY(!document.save());
        QVERIFY(allHaveLooked());
        QCOMPARE(outside.count(), 0);
        writeFile(path, "three");
        QTRY_COMPARE_WITH_TIMEOUT(outside.count(), 1, longestWait);
        writeFile(path, "four");
        QTRY_VERIFY_WITH_TIMEOUT(outside.count() > 1, longestWait);
        QCOMPARE(outside.count(), 2); // once for each text
        QCOMPARE(document.onDisk(), OnDisk::Changed);
        QVERIFY(!document.reload());
        QCOMPARE(buffer.content, QByteArray("four"));
        QCOMPARE(document.onDisk(), OnDisk::AsKnown);
    }

    void aFileWrittenInPiecesIsToldOfWhenItIsWhole() {
        OpenDocument opened("one");
        Document& document = opened.document; // clang++ 14 captures no name of a structured binding
        QByteArray found, whole;
        connect(&document, &Document::changedOutside, &document, [&] { found = document.seeTextOnDisk(); });
        QSignalSpy told(&document, &Document::changedOutside);
        // The pause is as long as an hour until the file is whole, and every piece begins it.
        constexpr int hour = 3'600'000; // [ms]
        QTimer* const quiet = document.findChild<QTimer*>();
        quiet->setInterval(hour);
        QFile slow(opened.path);
        QVERIFY(slow.open(QIODevice::WriteOnly | QIODevice::Unbuffered)); // now it is empty
        for (int piece = 0; piece < 8; ++piece) {
            quiet->stop();
            slow.write("piece ");
            whole += "piece ";
            QTRY_VERIFY_WITH_TIMEOUT(quiet->isActive(), longestWait);
        }
        slow.close();
        QCOMPARE(told.count(), 0);
        quiet->setInterval(1);
        QTRY_COMPARE_WITH_TIMEOUT(found, whole, longestWait);
        QVERIFY(allHaveLooked());
        QCOMPARE(told.count(), 1);
    }

    void aFileDeletedOutsideLeavesItsTextUnsaved_data() {
        QTest::addColumn<bool>("moved");
        QTest::newRow("deleted") << false;
        QTest::newRow("moved away") << true;
    }
    void aFileDeletedOutsideLeavesItsTextUnsaved() {
        QFETCH(bool, moved);
        OpenDocument opened("one");
        auto& [folder, path, buffer, document] = opened;
        QSignalSpy removals(&document, &Document::removedOutside);
        QVERIFY(moved ? QFile::rename(path, folder.filePath(QStringLiteral("b.sdl"))) : QFile::remove(path));
        QTRY_COMPARE_WITH_TIMEOUT(removals.count(), 1, longestWait);
        QVERIFY(document.isModified());
        QCOMPARE(document.onDisk(), OnDisk::Missing);
        // Back as it was, as version control does it, it counts as saved again.
        writeFile(path, "one");
        QTRY_VERIFY_WITH_TIMEOUT(!document.isModified(), longestWait);
    }

    void aFileDeletedAndWrittenAnewIsWatchedOn() {
        OpenDocument opened("one");
        auto& [folder, path, buffer, document] = opened;
        QSignalSpy outside(&document, &Document::changedOutside),
            removals(&document, &Document::removedOutside);
        QVERIFY(QFile::remove(path));
        QTRY_COMPARE_WITH_TIMEOUT(removals.count(), 1, longestWait);
        writeFile(path, "two");
        QTRY_COMPARE_WITH_TIMEOUT(outside.count(), 1, longestWait);
        QCOMPARE(document.onDisk(), OnDisk::Changed);
        writeFile(path, "three"); // the new file is watched, too
        QTRY_COMPARE_WITH_TIMEOUT(outside.count(), 2, longestWait);
        // Replaced by a rename, as most editors do.
        const QString other = folder.filePath(QStringLiteral("b.sdl"));
        writeFile(other, "four");
        QVERIFY(std::rename(qPrintable(other), qPrintable(path)) == 0);
        QTRY_COMPARE_WITH_TIMEOUT(outside.count(), 3, longestWait);
    }

    void aPipeOrADeviceIsRefusedAtOnce() {
        QTemporaryDir folder;
        const QString pipe = folder.filePath(QStringLiteral("pipe"));
        QCOMPARE(::mkfifo(qPrintable(pipe), 0600), 0);
        PlainBuffer buffer;
        Document document(buffer);
        for (const QString& path : {pipe, QStringLiteral("/dev/zero")})
            QVERIFY(document.open(path).value_or(QString()).contains(QStringLiteral("device or a pipe")));
    }
};

CAROM_TEST_WITH(IdeApplication, document_test, DocumentTest)
#include "document_test.moc"
