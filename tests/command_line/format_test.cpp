// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/program.h"
#include "tests/support/test_class.h"

#include <QTest>

#include <sys/stat.h>

using namespace carom;

class FormatTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void theLayoutGoesToStandardOutput();
    void formattingTwiceChangesNothing();
    void inPlaceReplacesTheFileAndKeepsItsPermissions();
    void inPlaceFollowsALinkAndLeavesItALink();
    void inPlaceLeavesAFormattedFileUntouched();
    void aFileThatMayNotBeWrittenIsLeftAlone();
    void noTemporaryFileStaysBehind();
    void standardInputHasNoPlace();
    void whatCannotBeReadEndsWithThree();

  private:
    const QByteArray m_loose = "sphere ball{radius 1 mass 2\n centre 0,0,0} // here\r\n";
    const QByteArray m_tidy = "sphere ball { radius 1  mass 2  centre 0, 0, 0 }  // here\n";
    QTemporaryDir m_folder;
    QString path(const char* name) const { return m_folder.filePath(QString::fromLatin1(name)); }
};

void FormatTest::theLayoutGoesToStandardOutput() {
    const test::Ended ended = test::carom({"format", "-"}, QByteArray(m_loose).replace("\r\n", "\n"));
    QCOMPARE(ended.exitCode, 0);
    QCOMPARE(ended.out, QString::fromUtf8(m_tidy));
    QCOMPARE(ended.err, QString());
}

void FormatTest::formattingTwiceChangesNothing() {
    const QString once = test::carom({"format", test::source("scenes/tour.sdl")}).out;
    QVERIFY(!once.isEmpty());
    QCOMPARE(test::carom({"format", "-"}, once.toUtf8()).out, once);
}

void FormatTest::inPlaceReplacesTheFileAndKeepsItsPermissions() {
    const QString file = path("scene.sdl");
    test::writeFile(file, "wall{normal 0,1,0 toOrig 0}");
    QCOMPARE(::chmod(file.toUtf8().constData(), 0640), 0);
    const test::Ended ended = test::carom({"format", "--in-place", file});
    QCOMPARE(ended.exitCode, 0);
    QCOMPARE(ended.out, QString());
    QCOMPARE(test::readFile(file), QByteArray("wall { normal 0, 1, 0  toOrig 0 }\n"));
    struct stat status {};
    QCOMPARE(::stat(file.toUtf8().constData(), &status), 0);
    QCOMPARE(status.st_mode & 07777U, 0640U);
}

void FormatTest::inPlaceFollowsALinkAndLeavesItALink() {
    test::writeFile(path("target.sdl"), "wall{normal 0,1,0 toOrig 0}");
    QVERIFY(QFile::link("target.sdl", path("link.sdl")));
    QCOMPARE(test::carom({"format", "-i", path("link.sdl")}).exitCode, 0);
    QVERIFY(QFileInfo(path("link.sdl")).isSymLink());
    QCOMPARE(test::readFile(path("target.sdl")), QByteArray("wall { normal 0, 1, 0  toOrig 0 }\n"));
}

void FormatTest::inPlaceLeavesAFormattedFileUntouched() {
    const QString file = path("tidy.sdl");
    test::writeFile(file, m_tidy);
    struct stat before {
    }, after{};
    QCOMPARE(::stat(file.toUtf8().constData(), &before), 0);
    QCOMPARE(test::carom({"format", "-i", file}).exitCode, 0);
    QCOMPARE(::stat(file.toUtf8().constData(), &after), 0);
    QCOMPARE(after.st_ino, before.st_ino);
}

void FormatTest::aFileThatMayNotBeWrittenIsLeftAlone() {
    // Root may write everything, so the file is one that nobody may: a missing one, and a folder.
    for (const char* name : {"missing.sdl", "."}) {
        const test::Ended ended = test::carom({"format", "-i", path(name)});
        QCOMPARE(ended.exitCode, 3);
        QVERIFY2(ended.err.startsWith("carom format: cannot read `"), qPrintable(ended.err));
    }
}

void FormatTest::noTemporaryFileStaysBehind() {
    QTemporaryDir folder;
    test::writeFile(folder.filePath("a.sdl"), "wall{normal 0,1,0 toOrig 0}");
    QCOMPARE(test::carom({"format", "-i", folder.filePath("a.sdl")}).exitCode, 0);
    QCOMPARE(QDir(folder.path()).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot),
             QStringList{"a.sdl"});
}

void FormatTest::standardInputHasNoPlace() {
    const test::Ended ended = test::carom({"format", "--in-place", "-"}, m_loose);
    QCOMPARE(ended.exitCode, 2);
    QVERIFY(ended.err.contains("standard input has no place"));
}

void FormatTest::whatCannotBeReadEndsWithThree() {
    QCOMPARE(test::carom({"format", path("nowhere.sdl")}).exitCode, 3);
    QCOMPARE(test::shell("$carom format " + test::source("scenes/tour.sdl") + " > /dev/full").exitCode, 3);
}

CAROM_TEST(format_test, FormatTest)
#include "format_test.moc"
