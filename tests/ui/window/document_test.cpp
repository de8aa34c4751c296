// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/ide.h"
#include "tests/support/test_class.h"

#include <QDir>
#include <QFileSystemWatcher>
#include <QSignalSpy>

using namespace carom;
using namespace carom::test;

namespace {

class PlainBuffer : public TextBuffer {
  public:
    QByteArray content, saved;

    QByteArray bytes() const override { return content; }
    void setBytes(const QByteArray& bytes) override { content = saved = bytes; }
    bool differsFromSaved() const override { return content != saved; }
    void markSaved() override { saved = content; }
    void markUnsaved() override { saved = content + '?'; }
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
        QTemporaryDir folder;
        const QString path = folder.filePath(QStringLiteral("a.sdl"));
        writeFile(path, "old");
        PlainBuffer buffer;
        Document document(buffer);
        QVERIFY(!document.open(path));
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
        QTemporaryDir folder;
        const QString path = folder.filePath(QStringLiteral("a.sdl"));
        writeFile(path, "one");
        PlainBuffer buffer;
        Document document(buffer);
        QVERIFY(!document.open(path));
        QSignalSpy outside(&document, &Document::changedOutside);
        buffer.content = "two";
        QVERIFY(!document.save());
        // The system tells of changes in their order: when it has told of a later one, it has of this.
        const QString later = folder.filePath(QStringLiteral("later"));
        writeFile(later, "one");
        QFileSystemWatcher watcher({later});
        QSignalSpy told(&watcher, &QFileSystemWatcher::fileChanged);
        writeFile(later, "two");
        QTRY_VERIFY_WITH_TIMEOUT(told.count() > 0, patience);
        QCoreApplication::processEvents();
        QCOMPARE(outside.count(), 0);
        writeFile(path, "three");
        QTRY_VERIFY_WITH_TIMEOUT(outside.count() > 0, patience);
    }
};

CAROM_TEST_WITH(IdeApplication, document_test, DocumentTest)
#include "document_test.moc"
