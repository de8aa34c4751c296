// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/failing_files.h"
#include "tests/support/faults.h"
#include "tests/support/whole_ide.h"

#include "ui/base/file_output.h"
#include "ui/viewport/video.h"
#include "ui/widgets/plot.h"
#include "ui/window/recovery.h"

#include <QDir>
#include <QMessageBox>
#include <QPushButton>
#include <QSignalSpy>

#include <cerrno>
#include <system_error>

// Everything that writes a file × every call that can fail: the file before it stays whole, nothing is left
// beside it, and the reason is said.

using namespace carom;
using namespace carom::test;

namespace {

struct Writer {
    const char* name;
    const char* file;
    std::function<QString(const QString&)> write; ///< what it says went wrong
};

QString saveText(const QString& path) {
    SceneEditor editor(loadTheme(true));
    Document document(editor);
    editor.insert(QStringLiteral("sphere;"));
    const QString problem = document.saveAs(path).value_or(QString());
    return document.isModified() == problem.isEmpty() ? QStringLiteral("the text counts wrongly") : problem;
}

QString saveChart(const QString& path) {
    ChartSeries series;
    series.name = QStringLiteral("a");
    series.x = {1, 2};
    series.y = {3, 4};
    ChartSpec chart;
    chart.series = {series};
    return writeChart(chart, path);
}

/// As the viewport shows it, without smooth edges and shadows: what they take to compile is most of a short
/// video's time.
VideoPlan planOf(const Ide& ide, double duration, const QString& path) {
    VideoPlan plan{
        .look = ide.viewport.view({64, 48}), .to = duration, .rate = 20, .size = {64, 48}, .path = path};
    plan.look.options.smooth = plan.look.options.shadows = false;
    return plan;
}

QString video(const Ide& ide, const QString& path) {
    Video video(planOf(ide, 0.1, path));
    QSignalSpy ends(&video, &Video::finished);
    video.start();
    return QTest::qWaitFor([&] { return ends.count() == 1; }, longestWait)
               ? ends.first().first().toString()
               : QStringLiteral("the video does not end");
}

} // namespace

class WritersTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void initTestCase();
    void init() { m_folder = std::make_unique<QTemporaryDir>(); }
    void cleanupTestCase();

    void aWriterThatFailsKeepsTheFileAndSaysWhy_data();
    void aWriterThatFailsKeepsTheFileAndSaysWhy();
    void aSaveOnAFullDiskKeepsFileAndTextAndTheWindowStays();
    void aFullDiskIsNoticedWhenAVideoIsWritten();

  private:
    std::vector<Writer> writers() const;

    std::unique_ptr<QTemporaryDir> m_folder, m_tools;
    std::unique_ptr<Ide> m_ide;
    QByteArray m_path = qgetenv("PATH");
};

void WritersTest::initTestCase() {
    m_ide = std::make_unique<Ide>();
    m_tools = std::make_unique<QTemporaryDir>();
    // Stands in for the encoder, so that an MP4 needs no program.
    const QString encoder = m_tools->filePath(QStringLiteral("ffmpeg"));
    writeFile(encoder, "#!/bin/sh\nfor last; do :; done\necho video > \"$last\"\n");
    QVERIFY(QFile::setPermissions(encoder, QFile::ReadOwner | QFile::ExeOwner));
    qputenv("PATH", m_tools->path().toLocal8Bit() + ":" + m_path);
    QTRY_COMPARE_WITH_TIMEOUT(m_ide->frame, 0, longestWait);
}

void WritersTest::cleanupTestCase() {
    m_ide.reset();
    qputenv("PATH", m_path);
}

std::vector<Writer> WritersTest::writers() const {
    const QImage image(4, 4, QImage::Format_RGB32);
    return {
        {"the scene's text", "a.sdl", saveText},
        {"figures", "a.csv", [](const QString& path) { return saveFile(path, QByteArray("a,b\n")); }},
        {"a chart as PNG", "a.png", saveChart},
        {"a chart as SVG", "a.svg", saveChart},
        {"a chart as PDF", "a.pdf", saveChart},
        {"a picture", "a.png", [image](const QString& path) { return saveImage(path, image); }},
        {"an animation", "a.gif", [this](const QString& path) { return video(*m_ide, path); }},
        {"single pictures", "a.png", [this](const QString& path) { return video(*m_ide, path); }},
        {"a video", "a.mp4", [this](const QString& path) { return video(*m_ide, path); }},
    };
}

void WritersTest::aWriterThatFailsKeepsTheFileAndSaysWhy_data() {
    QTest::addColumn<int>("writer");
    QTest::addColumn<QByteArray>("call");
    QTest::addColumn<int>("cause");
    int number = 0;
    for (const Writer& writer : writers()) {
        for (const Fault& fault : faultsToTry(static_cast<std::size_t>(number)))
            QTest::addRow("%s: %s %s", writer.name, fault.call, fault.name)
                << number << QByteArray(fault.call) << fault.cause;
        ++number;
    }
}

void WritersTest::aWriterThatFailsKeepsTheFileAndSaysWhy() {
    QFETCH(int, writer);
    QFETCH(QByteArray, call);
    QFETCH(int, cause);
    const Writer row = writers()[static_cast<std::size_t>(writer)];
    const bool numbered = QByteArray(row.name) == "single pictures";
    const QString path = m_folder->filePath(QLatin1StringView(row.file));
    const QString written = numbered ? m_folder->filePath(QStringLiteral("a-00000.png")) : path;
    writeFile(written, "old");
    QString problem;
    {
        const FailingFiles failing(call, 1, cause, qPrintable(m_folder->path()));
        problem = row.write(path);
        QVERIFY(failing.failures() > 0);
    }
    const QString reason = QString::fromStdString(std::generic_category().message(cause));
    QVERIFY2(problem.contains(reason), qPrintable(problem));
    QCOMPARE(readFile(written), QByteArray("old"));
    QCOMPARE(QDir(m_folder->path()).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot),
             QStringList{QFileInfo(written).fileName()});
    if (cause == ENOSPC) QCOMPARE(row.write(path), QString()); // once there is room, it works
}

void WritersTest::aSaveOnAFullDiskKeepsFileAndTextAndTheWindowStays() {
    // A scene under 16 KiB waits in QSaveFile's buffer; Qt 6.4's commit() says true when writing it fails.
    // The window said "saved", emptied the file and closed without asking.
    Ide ide;
    QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
    typeAtTheEnd(ide.editor, "// mine");
    QString said;
    answerNextDialog([&said](QWidget& box) {
        said = static_cast<QMessageBox&>(box).text();
        box.close();
    });
    {
        const FailingFiles full("write", 1, ENOSPC, qPrintable(ide.folder.path()));
        ide.trigger(ActionId::Save);
    }
    QVERIFY2(said.contains(QStringLiteral("No space left on device")), qPrintable(said));
    QCOMPARE(readFile(ide.path), twoBalls);
    QVERIFY(ide.bench.document().isModified());
    QVERIFY(ide.bench.window().isWindowModified());
    bool asked = false;
    answerNextDialog([&asked](QWidget& box) {
        asked = true;
        static_cast<QMessageBox&>(box).button(QMessageBox::Cancel)->click();
    });
    ide.bench.window().close();
    QVERIFY(asked && ide.bench.window().isVisible());
    ide.trigger(ActionId::Save);
    QCOMPARE(readFile(ide.path), ide.bench.document().text());
}

void WritersTest::aFullDiskIsNoticedWhenAVideoIsWritten() {
    // Not at its end, hours later.
    const QString path = m_folder->filePath(QStringLiteral("long.gif"));
    Video video(planOf(*m_ide, 1000, path));
    QSignalSpy ends(&video, &Video::finished);
    const FailingFiles full("write", 8, ENOSPC, qPrintable(m_folder->path()));
    video.start();
    QTRY_COMPARE_WITH_TIMEOUT(ends.count(), 1, longestWait);
    QVERIFY(ends.first().first().toString().contains(QStringLiteral("No space left on device")));
}

CAROM_TEST_WITH(IdeApplication, writers_test, WritersTest)
#include "writers_test.moc"
