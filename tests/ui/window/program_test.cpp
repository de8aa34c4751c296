// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/program.h"
#include "tests/support/test_class.h"

#include <QImage>
#include <QTest>

using namespace carom::test;

namespace {

const QString program = QStringLiteral(CAROM_PROGRAM);
const QString scenes = QStringLiteral(CAROM_SOURCE_DIR "/scenes");

} // namespace

class ProgramTest : public QObject {
    Q_OBJECT

    QTemporaryDir m_home;

  private Q_SLOTS:
    void initTestCase() {
        qputenv("XDG_CONFIG_HOME", m_home.path().toLocal8Bit());
        qputenv("XDG_DATA_HOME", m_home.path().toLocal8Bit());
    }

    void itLeavesAfterTheFramesAskedForWithTheirTimes() {
        const Ended ended = runCommand(program, {scenes + QStringLiteral("/pool_break.sdl"),
                                                 QStringLiteral("-n"), QStringLiteral("12")});
        QVERIFY2(ended.exitCode == 0, qPrintable(ended.err));
        const QStringList lines = ended.out.split(u'\n', Qt::SkipEmptyParts);
        QCOMPARE(lines.size(), 3);
        const QStringList columns = lines[0].simplified().split(u' ');
        QCOMPARE(columns.mid(1), QStringLiteral("frames first mean median p95 p99 max").split(u' '));
        const QStringList render = lines[2].simplified().split(u' ');
        QCOMPARE(render[0], QStringLiteral("render"));
        QCOMPARE(render[1], QStringLiteral("12"));
        for (int i = 2; i < render.size(); ++i) QVERIFY2(render[i].toDouble() > 0, qPrintable(lines[2]));
    }

    void timesThatCannotBeWrittenEndItWithASentence() {
        const Ended ended =
            shell(QStringLiteral("exec \"$carom\" '%1/table.sdl' -n 2 > /dev/full").arg(scenes));
        QCOMPARE(ended.exitCode, 3);
        QVERIFY2(ended.err.contains(QStringLiteral("cannot write standard output: No space left on device")),
                 qPrintable(ended.err));
    }

    void theScreenshotIsAPictureOfTheWindow() {
        const QString path = m_home.filePath(QStringLiteral("window.png"));
        const Ended ended =
            runCommand(program, {scenes + QStringLiteral("/pool_break.sdl"), QStringLiteral("-n"),
                                 QStringLiteral("2"), QStringLiteral("--screenshot"), path});
        QVERIFY2(ended.exitCode == 0, qPrintable(ended.err));
        const QImage picture(path);
        QVERIFY(picture.width() > 800 && picture.height() > 500);
        // The table is green, and a good part of the picture.
        int green = 0, looked = 0;
        for (int y = 0; y < picture.height(); y += 10)
            for (int x = 0; x < picture.width(); x += 10, ++looked) {
                const QColor colour = picture.pixelColor(x, y);
                if (colour.green() > 40 && colour.green() > 2 * colour.red() &&
                    colour.green() > 2 * colour.blue())
                    ++green;
            }
        QVERIFY2(green * 10 > looked, qPrintable(QStringLiteral("%1 of %2").arg(green).arg(looked)));
    }

    void aSceneThatCannotBeReadEndsWithThree() {
        const Ended ended = runCommand(program, {QStringLiteral("/no/such/scene.sdl")});
        QCOMPARE(ended.exitCode, 3);
        QVERIFY(ended.err.contains(QStringLiteral("/no/such/scene.sdl")));
    }

    void aPictureThatCannotBeWrittenEndsWithThree() {
        const Ended ended = runCommand(
            program, {scenes + QStringLiteral("/pool_break.sdl"), QStringLiteral("-n"), QStringLiteral("1"),
                      QStringLiteral("--screenshot"), QStringLiteral("/no/such/folder/a.png")});
        QCOMPARE(ended.exitCode, 3);
    }

    void aDisplayThatCannotBeReachedEndsWithASentence() {
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        environment.insert(QStringLiteral("DISPLAY"), QStringLiteral(":987"));
        environment.remove(QStringLiteral("QT_LOGGING_RULES"));
        const Ended ended =
            runCommand(program, {scenes + QStringLiteral("/pool_break.sdl")}, {}, environment);
        QCOMPARE(ended.exitCode, 3);
        QCOMPARE(ended.err,
                 QStringLiteral("carom: the display cannot be reached; `carom run SCENE` simulates "
                                "without one\n"));
    }

    void aPictureWithoutOpenGLNamesIt() {
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        environment.insert(QStringLiteral("QT_QPA_PLATFORM"), QStringLiteral("offscreen"));
        environment.remove(QStringLiteral("DISPLAY")); // whose OpenGL it would take
        const Ended ended =
            runCommand(program,
                       {scenes + QStringLiteral("/pool_break.sdl"), QStringLiteral("--picture"),
                        m_home.filePath(QStringLiteral("a.png"))},
                       {}, environment);
        QCOMPARE(ended.exitCode, 3);
        QVERIFY2(ended.err.contains(QStringLiteral("OpenGL")), qPrintable(ended.err));
        QVERIFY(!QFile::exists(m_home.filePath(QStringLiteral("a.png"))));
    }

    void chartsAreDrawnWithoutAWordOfQt() {
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        for (const char* variable : {"DISPLAY", "XDG_RUNTIME_DIR", "QT_QPA_PLATFORM", "QT_LOGGING_RULES"})
            environment.remove(QLatin1StringView(variable));
        const Ended ended =
            runCommand(program,
                       {QStringLiteral("bench"), QStringLiteral("--scene=pyramid"), QStringLiteral("-n"),
                        QStringLiteral("10"), QStringLiteral("--frames=4"), QStringLiteral("-o"),
                        m_home.filePath(QStringLiteral("charts"))},
                       {}, environment);
        QCOMPARE(ended.exitCode, 0);
        QCOMPARE(ended.err, QString());
    }
};

CAROM_TEST_WITH(QCoreApplication, program_test, ProgramTest)
#include "program_test.moc"
