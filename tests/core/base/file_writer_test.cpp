// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/file_writer.h"
#include "tests/support/failing_files.h"
#include "tests/support/program.h"
#include "tests/support/test_class.h"

#include <QDir>
#include <QTest>

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

using namespace carom;

namespace {

int permissionsOf(const QString& path) {
    struct stat found {};
    return ::stat(qPrintable(path), &found) == 0 ? static_cast<int>(found.st_mode & 07777U) : -1;
}

} // namespace

class FileWriterTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void init() { m_folder = std::make_unique<QTemporaryDir>(); }

    void aWholeFileTakesThePlaceOfTheOld() {
        test::writeFile(path("a"), "a longer old text");
        QCOMPARE(writeWholeFile(path("a").toStdString(), "new"), std::string());
        QCOMPARE(test::readFile(path("a")), QByteArray("new"));
        QCOMPARE(names(), QStringList{"a"});
    }

    void withoutACommitTheOldFileStays() {
        test::writeFile(path("a"), "old");
        {
            FileWriter file(path("a").toStdString());
            QVERIFY(file.write("half of the ne"));
            QCOMPARE(test::readFile(path("a")), QByteArray("old"));
        }
        QCOMPARE(test::readFile(path("a")), QByteArray("old"));
        QCOMPARE(names(), QStringList{"a"});
    }

    // SQLite's way of testing: each call fails once, with each error; the old file must be whole.
    void whateverFailsTheOldFileStaysAndNothingBesideIt_data() {
        QTest::addColumn<QByteArray>("call");
        QTest::addColumn<int>("cause");
        for (const char* call : {"open", "write", "fsync", "close", "rename", "fchmod"})
            for (const auto& [name, cause] : {std::pair{"ENOSPC", ENOSPC}, {"EIO", EIO}, {"EACCES", EACCES}})
                QTest::addRow("%s %s", call, name) << QByteArray(call) << cause;
    }
    void whateverFailsTheOldFileStaysAndNothingBesideIt() {
        QFETCH(QByteArray, call);
        QFETCH(int, cause);
        test::writeFile(path("a"), "old");
        const test::FailingFiles failing(call, 1, cause, qPrintable(m_folder->path()));
        QCOMPARE(writeWholeFile(path("a").toStdString(), "new"), std::generic_category().message(cause));
        QVERIFY(failing.failures() > 0);
        QCOMPARE(test::readFile(path("a")), QByteArray("old"));
        QCOMPARE(names(), QStringList{"a"});
    }

    void aFolderThatCannotBeSyncedIsAFailureToo() {
        // The first fsync is the file's, the second its folder's: the name may be lost with the power.
        const test::FailingFiles failing("fsync", 2, EIO, qPrintable(m_folder->path()));
        QCOMPARE(writeWholeFile(path("a").toStdString(), "new"), std::generic_category().message(EIO));
    }

    void aFileKeepsItsPermissionsAndANewOneHasTheUsualOnes() {
        test::writeFile(path("a"), "old");
        QCOMPARE(::chmod(qPrintable(path("a")), 0640), 0);
        QCOMPARE(writeWholeFile(path("a").toStdString(), "new"), std::string());
        QCOMPARE(permissionsOf(path("a")), 0640);
        const mode_t mask = ::umask(0027);
        const std::string usual = writeWholeFile(path("b").toStdString(), "new");
        ::umask(mask);
        QCOMPARE(usual, std::string());
        QCOMPARE(permissionsOf(path("b")), 0640);
        QCOMPARE(writeWholeFile(path("c").toStdString(), "new", FileReaders::OwnerOnly), std::string());
        QCOMPARE(permissionsOf(path("c")), 0600);
    }

    void aFileThatNobodyMayWriteIsLeftAlone() {
        test::writeFile(path("a"), "old");
        QCOMPARE(::chmod(qPrintable(path("a")), 0444), 0);
        QCOMPARE(writeWholeFile(path("a").toStdString(), "new"), std::string("the file is read-only"));
        QCOMPARE(test::readFile(path("a")), QByteArray("old"));
        QCOMPARE(permissionsOf(path("a")), 0444);
    }

    void linksAreFollowed() {
        test::writeFile(path("a"), "old");
        QCOMPARE(::symlink("a", qPrintable(path("link"))), 0);
        QCOMPARE(::symlink("link", qPrintable(path("link of link"))), 0);
        QCOMPARE(::symlink("not yet", qPrintable(path("dangling"))), 0);
        QCOMPARE(writeWholeFile(path("link of link").toStdString(), "new"), std::string());
        QCOMPARE(test::readFile(path("a")), QByteArray("new"));
        QCOMPARE(writeWholeFile(path("dangling").toStdString(), "newer"), std::string());
        QCOMPARE(test::readFile(path("not yet")), QByteArray("newer"));
        QCOMPARE(names(), QStringList({"a", "dangling", "link", "link of link", "not yet"}));
    }

    void whatIsNoFileIsWrittenAsItIs() {
        QCOMPARE(writeWholeFile("/dev/null", "new"), std::string());
        QCOMPARE(writeWholeFile("/dev/full", "new"), std::generic_category().message(ENOSPC));
        QCOMPARE(writeWholeFile(m_folder->path().toStdString(), "new"),
                 std::generic_category().message(EISDIR));
        QCOMPARE(writeWholeFile(path("no/such/file").toStdString(), "new"),
                 "there is no folder `" + path("no/such").toStdString() + "`");
    }

  private:
    QString path(const char* name) const { return m_folder->filePath(QString::fromLatin1(name)); }
    QStringList names() const {
        return QDir(m_folder->path()).entryList(QDir::Files | QDir::Hidden | QDir::System, QDir::Name);
    }

    std::unique_ptr<QTemporaryDir> m_folder;
};

CAROM_TEST(file_writer_test, FileWriterTest)
#include "file_writer_test.moc"
