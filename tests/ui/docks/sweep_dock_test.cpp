// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/files.h"
#include "tests/support/program.h"
#include "tests/support/test_class.h"

#include "core/simulation/build.h"
#include "ui/docks/sweep_dock.h"
#include "ui/docks/sweep_form.h"
#include "ui/widgets/plot.h"

#include <QApplication>
#include <QCheckBox>
#include <QClipboard>
#include <QComboBox>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QImage>
#include <QLabel>
#include <QMenu>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>
#include <QToolTip>
#include <QTranslator>

#include <cmath>
#include <memory>

// The Sweep panel: its form, the points as they come, what a click chooses, and what is written.

namespace carom {
namespace {

using test::longestWait;

SharedBuild built(const std::string& text, bool fresh = true) {
    auto result = std::make_shared<BuildResult>();
    result->build = build(text);
    result->fresh = fresh;
    return result;
}

// Without gravity: after six frames of a tenth of a second the ball is at 0.6 s × its speed.
const std::string gliding = "gravity { accel 0, 0, 0 }\n"
                            "sphere ball { radius 0.1 mass 1 centre 0, 1, 0 vel 2, 0, 0 }\n"
                            "simulation { step 0.1 }\n";

/// Another language: every text is another one.
class Foreign : public QTranslator {
  public:
    bool isEmpty() const override { return false; }
    QString translate(const char*, const char* text, const char*, int) const override {
        return QStringLiteral("\u00AB") + QString::fromUtf8(text) + QStringLiteral("\u00BB");
    }
};

/// A file of a sweep without what may differ: the seconds of the table, and the report, which is of them.
QByteArray comparable(const QString& path) {
    const QByteArray bytes = test::readFile(path);
    if (path.endsWith(QLatin1StringView("summary.txt"))) return bytes.left(bytes.indexOf(':'));
    if (!path.endsWith(QLatin1StringView("/sweep.csv"))) return bytes;
    QByteArray rows;
    for (const QByteArray& row : bytes.split('\n')) rows += row.left(row.lastIndexOf(',')) + '\n';
    return rows;
}

} // namespace

class SweepDockTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void init() {
        m_dock = std::make_unique<SweepDock>();
        m_dock->resize(1200, 420);
        m_dock->show();
        m_start = child<QPushButton>("sweepStart");
        m_dock->setScene(built(gliding), QStringLiteral("ball.sdl"), QStringLiteral("/tmp/a b/ball.sdl"));
    }

    void whatIsAskedForIsSaidFirst() {
        QVERIFY(!m_start->isEnabled());
        ask("ball.vel.x=1:4:4", "");
        QVERIFY(!m_start->isEnabled());
        ask("ball.vel.x=1:4:4", "final x of ball");
        QVERIFY(m_start->isEnabled());
        QVERIFY(m_dock->exportTo(m_folder.filePath(QStringLiteral("none.csv")))
                    .contains(QStringLiteral("nothing was swept yet")));
    }

    void theFormIsFilledForANumber() {
        m_dock->form().propose(QStringLiteral("ball.vel.x"), false);
        QCOMPARE(vary(), QStringLiteral("ball.vel.x=1:3:9"));
        QCOMPARE(measures(), QStringLiteral("final x of ball"));
        m_dock->form().propose(QStringLiteral("simulation.substeps"), false);
        QCOMPARE(vary(), QStringLiteral("simulation.substeps=1,2,4,8,16"));
        QCOMPARE(measures(), QStringLiteral("max penetration")); // what was proposed gives way
        ask("ball.mass=1,2", "max speed of ball");
        QCOMPARE(m_dock->form().onlyPath(), QStringLiteral("ball.mass"));
        m_dock->form().propose(QStringLiteral("ball.vel.x"), true);
        QCOMPARE(vary(), QStringLiteral("ball.mass=1,2\nball.vel.x=1:3:9"));
        QCOMPARE(measures(), QStringLiteral("max speed of ball")); // what was written stays
    }

    void aDeclarationFillsTheForm() {
        const std::string declared =
            gliding + "sweep { vary \"ball.vel.x=1:4:4\" measure \"final x of ball\" frames 6 }\n";
        m_dock->setScene(built(declared), QStringLiteral("ball.sdl"), {});
        QCOMPARE(m_dock->form().definition().vary, (std::vector<std::string>{"ball.vel.x=1:4:4"}));
        QCOMPARE(m_dock->form().definition().frames, std::optional<std::int64_t>(6));
        ask("ball.vel.x=5,6", "final x of ball"); // an edit elsewhere leaves what was written
        m_dock->setScene(built(declared + "// more", false), QStringLiteral("ball.sdl"), {});
        QCOMPARE(vary(), QStringLiteral("ball.vel.x=5,6"));
    }

    void thePointsAreThoseOfTheCommandLine() {
        QSignalSpy reported(m_dock.get(), &SweepDock::reported);
        ask("ball.vel.x=1:4:4", "final x of ball");
        child<QSpinBox>("sweepFrames")->setValue(6);
        sweep();
        const ChartSpec& chart = plot().chart();
        QCOMPARE(chart.series.size(), std::size_t(1));
        QCOMPARE(chart.series[0].x, (std::vector<double>{1, 2, 3, 4}));
        for (std::size_t i = 0; i < 4; ++i)
            QVERIFY(std::abs(chart.series[0].y[i] - 0.6 * chart.series[0].x[i]) < 1e-12);
        QVERIFY(reported.back()[0].toString().startsWith(QStringLiteral("sweep of ball.sdl: 4 runs, ")));
        QCOMPARE(m_start->text(), QStringLiteral("Sweep"));
        const QString folder = m_folder.filePath(QStringLiteral("whole"));
        QCOMPARE(m_dock->exportFolder(folder), QString());
        QStringList files = QDir(folder).entryList(QDir::Files, QDir::Name);
        QCOMPARE(files, (QStringList{QStringLiteral("scene.sdl"), QStringLiteral("summary.csv"),
                                     QStringLiteral("summary.txt"), QStringLiteral("sweep-1.png"),
                                     QStringLiteral("sweep-1.svg"), QStringLiteral("sweep.csv"),
                                     QStringLiteral("sweep.txt")}));
        // A folder takes one sweep only.
        ask("ball.vel.x=1:4:5", "final x of ball");
        sweep();
        QVERIFY(m_dock->exportFolder(folder).contains(QStringLiteral("another sweep")));
        const QString csv = m_folder.filePath(QStringLiteral("rows.csv"));
        QCOMPARE(m_dock->exportTo(csv), QString());
        QCOMPARE(test::readFile(csv).count('\n'), 6);
        const QString png = m_folder.filePath(QStringLiteral("chart.png"));
        QCOMPARE(m_dock->exportTo(png), QString());
        QVERIFY(!QImage(png).isNull());
    }

    // Lines, lines with bands, maps, and several maps; under another font and language than the command
    // line's.
    void theFolderIsThatOfTheCommandLine_data() {
        QTest::addColumn<QString>("vary");
        QTest::addColumn<QString>("words");
        QTest::newRow("lines") << "ball.vel.x=1:4:4\nball.vel.y=log 1:8:3"
                               << "";
        QTest::newRow("together") << "ball.vel.x=1:4:4\nball.vel.y=1,2,5,7"
                                  << "zip";
        QTest::newRow("words") << "simulation.method=contacts,events"
                               << "";
        QTest::newRow("draws") << "ball.vel.x=1:4:4\nball.vel.y=normal 0:1"
                               << "random 8";
        QTest::newRow("seeds") << "simulation.substeps=1,2"
                               << "seeds 3";
        QTest::newRow("maps") << "ball.vel.x=1:4:4\nball.vel.y=0:2:3\nball.vel.z=1,2"
                              << "";
    }
    void theFolderIsThatOfTheCommandLine() {
        QFETCH(QString, vary);
        QFETCH(QString, words);
        const QString scene = m_folder.filePath(
            QStringLiteral("scene %1.sdl").arg(QString::fromLatin1(QTest::currentDataTag())));
        const bool isGenerated = words.startsWith(QLatin1StringView("seeds"));
        const std::string text =
            "\xEF\xBB\xBF// \xC3\xA4\r\n" +
            (isGenerated ? std::string("generate { scene pile n 3 }\nsimulation { step 0.1 }\n") : gliding);
        test::writeFile(scene, QByteArray::fromStdString(text));
        m_dock->setScene(built(text), QFileInfo(scene).fileName(), scene);
        ask(vary.toLatin1(), isGenerated ? "final centre_of_mass_y" : "final x of ball\nmax speed of ball");
        child<QSpinBox>("sweepFrames")->setValue(6);
        child<QCheckBox>("sweepZip")->setChecked(words == QLatin1StringView("zip"));
        child<QSpinBox>("sweepRandom")->setValue(words == QLatin1StringView("random 8") ? 8 : 0);
        child<QSpinBox>("sweepSeeds")->setValue(isGenerated ? 3 : 0);
        sweep();
        QApplication::setApplicationVersion(
            test::carom({QStringLiteral("--version")}).out.section(u' ', 1, 1).trimmed());
        const QFont usual = QApplication::font();
        QFont large = usual;
        large.setPointSize(17);
        large.setItalic(true);
        Foreign foreign;
        QApplication::setFont(large);
        QApplication::installTranslator(&foreign);
        const QString ours = scene + QStringLiteral(".window"), theirs = scene + QStringLiteral(".shell");
        const QString problem = m_dock->exportFolder(ours);
        QApplication::removeTranslator(&foreign);
        QApplication::setFont(usual);
        QCOMPARE(problem, QString());
        const QString command =
            m_dock->command().replace(QLatin1StringView("carom "), QLatin1StringView("$carom "));
        const test::Ended ended = test::shell(command.left(command.lastIndexOf(QLatin1StringView(" -o "))) +
                                              QStringLiteral(" -o '%1'").arg(theirs));
        QVERIFY2(ended.exitCode == 0, qPrintable(ended.err));
        const QStringList files = QDir(theirs).entryList(QDir::Files, QDir::Name);
        QCOMPARE(QDir(ours).entryList(QDir::Files, QDir::Name), files);
        QVERIFY2(files.size() >= 7, qPrintable(files.join(u' ')));
        for (const QString& file : files)
            QVERIFY2(comparable(ours + u'/' + file) == comparable(theirs + u'/' + file), qPrintable(file));
    }

    void aSweepThatIsPausedGoesOn() {
        ask("ball.vel.x=1:4:4000", "final x of ball");
        child<QSpinBox>("sweepFrames")->setValue(60);
        m_start->click();
        QCOMPARE(m_start->text(), QStringLiteral("Pause"));
        QVERIFY(!child<QPlainTextEdit>("sweepVary")->isEnabled());
        QTRY_VERIFY_WITH_TIMEOUT(!m_dock->results().empty(), longestWait);
        m_start->click();
        QTRY_COMPARE_WITH_TIMEOUT(m_start->text(), QStringLiteral("Go on"), longestWait);
        const std::size_t before = m_dock->results().size();
        QVERIFY(before < 4000);
        const double seconds = m_dock->results().front().seconds;
        // What is there of it is a folder that `--resume` goes on with.
        const QString folder = m_folder.filePath(QStringLiteral("part"));
        QCOMPARE(m_dock->exportFolder(folder), QString());
        QCOMPARE(test::readFile(folder + QStringLiteral("/sweep.csv.part")).count('\n'),
                 static_cast<qsizetype>(before + 1));
        QVERIFY(!QFile::exists(folder + QStringLiteral("/sweep.csv")));
        ask("ball.vel.x=1:4:4001", "final x of ball"); // another sweep
        QCOMPARE(m_start->text(), QStringLiteral("Sweep"));
        ask("ball.vel.x=1:4:4000", "final x of ball");
        QCOMPARE(m_start->text(), QStringLiteral("Go on"));
        sweep();
        QCOMPARE(m_dock->results().size(), std::size_t(4000));
        QCOMPARE(m_dock->results().front().seconds, seconds); // was not made again
        for (std::size_t run = 0; run < 4000; ++run) QCOMPARE(m_dock->results()[run].run, run);
    }

    void aClickOnAPointShowsItsRunAndWritesItsValues() {
        ask("ball.vel.x=1:4:4", "final x of ball");
        child<QSpinBox>("sweepFrames")->setValue(6);
        sweep();
        QSignalSpy ghosts(m_dock.get(), &SweepDock::ghostWanted);
        QSignalSpy values(m_dock.get(), &SweepDock::valuesWanted);
        QVERIFY(!child<QPushButton>("sweepUse")->isEnabled());
        Q_EMIT plot().pointClicked(0, 2);
        const QString told = child<QLabel>("sweepPoint")->text();
        QVERIFY2(told.startsWith(QStringLiteral("run 2\nball.vel.x 3\n")), qPrintable(told));
        QCOMPARE(plot().chart().series.back().mark, SeriesMark::Halo);
        QCOMPARE(plot().chart().series.back().x, (std::vector<double>{3}));
        QTRY_COMPARE_WITH_TIMEOUT(ghosts.size(), 1, longestWait);
        const auto pipeline = ghosts[0][0].value<std::shared_ptr<const Pipeline>>();
        QCOMPARE(pipeline->scene().bodies[0].velocity.x(), 3.0);
        child<QPushButton>("sweepUse")->click();
        const auto wanted = values[0][0].value<std::vector<ParameterValue>>();
        QCOMPARE(wanted.size(), std::size_t(1));
        QCOMPARE(withValues(analyse(gliding), wanted).substr(gliding.find("vel"), 11),
                 std::string("vel 3, 0, 0"));
        child<QPushButton>("sweepHide")->click();
        QCOMPARE(ghosts.size(), 2);
        QVERIFY(ghosts[1][0].value<std::shared_ptr<const Pipeline>>() == nullptr);
    }

    void twoNumbersGiveAMapWhoseCellsAreRuns() {
        ask("ball.vel.x=1:9:9\nball.vel.y=0:7:8", "final x of ball\nfinal y of ball");
        child<QSpinBox>("sweepFrames")->setValue(2);
        sweep();
        QVERIFY(plot().chart().map);
        QCOMPARE(plot().chart().map->columns, std::size_t(8));
        QComboBox* shown = child<QComboBox>("sweepShown");
        QVERIFY(shown->isVisible());
        shown->setCurrentIndex(1);
        QCOMPARE(plot().chart().map->scale.label, QStringLiteral("final y of ball"));
        Q_EMIT plot().cellClicked(5, 3);
        const QString told = child<QLabel>("sweepPoint")->text();
        QVERIFY2(told.startsWith(QStringLiteral("run 29\nball.vel.x 4\nball.vel.y 5\n")), qPrintable(told));
    }

    // Where the ball never came was nothing to click at: the runs that one wants to look at.
    void aCellWithoutAValueIsARunToo() {
        ask("ball.vel.x=1:9:9\nball.vel.y=0:7:8", "first x of ball above 1");
        child<QSpinBox>("sweepFrames")->setValue(2);
        sweep();
        const std::vector<double>& values = plot().chart().map.value().values;
        QVERIFY(std::isnan(values.front()) && !std::isnan(values.back()));
        QCOMPARE(child<QLabel>("sweepPoint")->text(), QStringLiteral("Click a cell to see its run."));
        QVERIFY(plot().chart().series.empty());
        // On the left, below the middle, by the mouse.
        QWidget* axes = plot().findChildren<QWidget*>(Qt::FindDirectChildrenOnly).front();
        const QPoint low(static_cast<int>(plot().xOf(0)), axes->height() * 2 / 3);
        QTest::mouseMove(axes, low + QPoint(1, 0));
        QTest::mouseMove(axes, low);
        QTRY_VERIFY_WITH_TIMEOUT(QToolTip::text().endsWith(QStringLiteral("no value")), longestWait);
        QTest::mouseClick(axes, Qt::LeftButton, {}, low);
        const QString told = child<QLabel>("sweepPoint")->text();
        QVERIFY2(told.startsWith(QStringLiteral("run ")) && told.endsWith(QStringLiteral("above 1 –")),
                 qPrintable(told));
        QCOMPARE(plot().chart().series.size(), std::size_t(1)); // a ring around the cell
        QCOMPARE(plot().chart().series[0].x, std::vector<double>{0});
    }

    void aCellOfNoRunYetIsNone() {
        ask("ball.vel.x=1:9:9\nball.vel.y=0:7:8", "final x of ball");
        child<QSpinBox>("sweepFrames")->setValue(200'000);
        m_start->click();
        QTRY_VERIFY_WITH_TIMEOUT(plot().chart().map.has_value(), longestWait);
        Q_EMIT plot().cellClicked(7, 8);
        QVERIFY2(child<QLabel>("sweepPoint")->text().isEmpty(),
                 qPrintable(child<QLabel>("sweepPoint")->text()));
        m_start->click();
        QTRY_VERIFY_WITH_TIMEOUT(m_start->text() != QStringLiteral("Pause"), longestWait);
    }

    void aKeptChartStandsBesideTheNext() {
        ask("ball.vel.x=1:4:4", "final x of ball");
        child<QSpinBox>("sweepFrames")->setValue(6);
        sweep();
        child<QToolButton>("sweepKeep")->setChecked(true);
        child<QSpinBox>("sweepFrames")->setValue(12);
        sweep();
        const std::vector<ChartSeries>& series = plot().chart().series;
        QCOMPARE(series.size(), std::size_t(2));
        QVERIFY(series[1].dashed);
        QVERIFY(std::abs(series[0].y[3] - 2 * series[1].y[3]) < 1e-12);
    }

    void whatCannotBeSweptIsSaid() {
        ask("bal.vel.x=1:4:4", "final x of ball");
        sweep();
        QVERIFY(state().contains(QStringLiteral("did you mean `ball`?")));
        ask("ball.vel.x=1:4:100001", "final x of ball");
        sweep();
        QVERIFY2(state().contains(QStringLiteral("copy it as a command")), qPrintable(state()));
        QVERIFY(m_dock->results().empty());
    }

    void theCommandIsTheSameSweep() {
        ask("ball.vel.x=1:4:4\nball.vel.y=log 1:2:3", "final x of ball");
        child<QSpinBox>("sweepFrames")->setValue(6);
        child<QToolButton>("sweepCopy")->click();
        QCOMPARE(QApplication::clipboard()->text(),
                 QStringLiteral("carom sweep '/tmp/a b/ball.sdl' --vary 'ball.vel.x=1:4:4' --vary "
                                "'ball.vel.y=log 1:2:3' --frames 6 --measure 'final x of ball' -o "
                                "'ball-sweep'"));
    }

    // The command of a text that was never saved swept another one, and nobody was told.
    void whatTheCommandReadsIsSaved() {
        QSignalSpy reported(m_dock.get(), &SweepDock::reported);
        const QString path = m_folder.filePath(QStringLiteral("ball.sdl"));
        const auto said = [&] {
            child<QToolButton>("sweepCopy")->click();
            return reported.takeLast()[0].toString();
        };
        ask("ball.vel.x=1:4:4", "final x of ball");
        QVERIFY2(said().endsWith(QStringLiteral("save the scene first, the command reads its file")),
                 "no file");
        test::writeFile(path, QByteArray::fromStdString(gliding));
        m_dock->setScene(built(gliding), QStringLiteral("ball.sdl"), path);
        ask("ball.vel.x=1:4:4", "final x of ball");
        QCOMPARE(said(), QStringLiteral("copied: ") + m_dock->command());
        m_dock->setScene(built(gliding + "// more"), QStringLiteral("ball.sdl"), path);
        ask("ball.vel.x=1:4:4", "final x of ball");
        QVERIFY2(said().contains(QStringLiteral("save the scene")), "another text");
    }

    // Three million frames became one million, and what a declaration switches on could not be switched off.
    void theCommandSwitchesOffWhatADeclarationSwitchesOn() {
        const std::string declared = gliding + "sweep { vary \"ball.vel.x=1:4:4\" vary \"ball.vel.y=1:4:4\" "
                                               "measure \"final x of ball\" zip yes frames 3000000 }\n";
        m_dock->setScene(built(declared), QStringLiteral("ball.sdl"), {});
        QCOMPARE(m_dock->form().definition().frames, std::optional<std::int64_t>(3'000'000));
        const QString option = QStringLiteral("--no-declaration");
        QVERIFY2(!m_dock->command().contains(option), qPrintable(m_dock->command()));
        child<QSpinBox>("sweepFrames")->setValue(7);
        QVERIFY(!m_dock->command().contains(option));
        child<QCheckBox>("sweepZip")->setChecked(false);
        QVERIFY(m_dock->command().contains(option));
        child<QCheckBox>("sweepZip")->setChecked(true);
        child<QSpinBox>("sweepFrames")->setValue(0);
        QVERIFY(m_dock->command().contains(option));
    }

  private:
    template<class Widget>
    Widget* child(const char* name) {
        return m_dock->findChild<Widget*>(QString::fromLatin1(name));
    }
    PlotWidget& plot() { return *m_dock->findChild<PlotWidget*>(); }
    QString vary() { return child<QPlainTextEdit>("sweepVary")->toPlainText(); }
    QString measures() { return child<QPlainTextEdit>("sweepMeasures")->toPlainText(); }
    QString state() { return child<QLabel>("sweepState")->text(); }
    void ask(const QByteArray& vary, const char* measure) {
        child<QPlainTextEdit>("sweepVary")->setPlainText(QString::fromLatin1(vary));
        child<QPlainTextEdit>("sweepMeasures")->setPlainText(QString::fromLatin1(measure));
    }
    void sweep() {
        m_start->click();
        QTRY_VERIFY_WITH_TIMEOUT(m_start->text() != QStringLiteral("Pause"), longestWait);
    }

    QTemporaryDir m_folder;
    std::unique_ptr<SweepDock> m_dock;
    QPushButton* m_start = nullptr;
};

} // namespace carom

CAROM_TEST_WITH(QApplication, sweep_dock_test, carom::SweepDockTest)
#include "sweep_dock_test.moc"
