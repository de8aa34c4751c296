// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/files.h"
#include "tests/support/test_class.h"

#include "ui/docks/broadphase_comparison.h"
#include "ui/docks/broadphase_dock.h"
#include "ui/docks/comparison_charts.h"
#include "ui/widgets/plot.h"
#include "ui/widgets/value_table.h"

#include "core/generators/generator.h"
#include "core/simulation/build.h"

#include <QComboBox>
#include <QFile>
#include <QImage>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

namespace carom {
namespace {

using test::longestWait;
using test::readFile;

// By a method that searches in every frame.
std::shared_ptr<const Pipeline> gasOf(std::int64_t n) {
    const GeneratorRow& brownian = *findGenerator("brownian");
    SimulationSettings options;
    options.method = "microcollisions";
    return build(generate(brownian, requestFor(brownian, n)), options).pipeline;
}

} // namespace

class BroadphaseComparisonTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void init() {
        m_comparison = std::make_unique<BroadphaseComparison>();
        m_button = m_comparison->findChild<QPushButton*>(QStringLiteral("compare"));
        m_state = m_comparison->findChild<QLabel*>(QStringLiteral("comparisonState"));
        m_progress = m_comparison->findChild<QProgressBar*>(QStringLiteral("comparisonProgress"));
        m_comparison->resize(1100, 300);
        m_comparison->show();
    }

    void algorithmsThatCannotBeToldApartAreBothNamed() {
        const auto traced = [](std::size_t algorithm, double base) {
            BenchmarkTrace trace{.algorithm = &broadphases()[algorithm], .frames = {}};
            for (int frame = 1; frame <= 120; ++frame) {
                FrameStatistics statistics;
                statistics.frame = frame;
                statistics.broadphase = base + 0.01 * (frame * 37 % 17);
                trace.frames.push_back(statistics);
            }
            return trace;
        };
        Benchmark measured;
        measured.traces = {traced(0, 1.0), traced(1, 0.5), traced(2, 0.501)};
        const std::vector<const BroadphaseRow*> fastest = fastestBroadphases(measured);
        QCOMPARE(fastest.size(), std::size_t{2});
        QCOMPARE(fastest[0], &broadphases()[1]);
        QCOMPARE(fastest[1], &broadphases()[2]);
        measured.traces.pop_back();
        QCOMPARE(fastestBroadphases(measured).size(), std::size_t{1});
        QVERIFY(fastestBroadphases({}).empty());
    }

    void withoutASceneThereIsNothingToCompareAndThePanelSaysWhatToDo() {
        QVERIFY(!m_button->isEnabled());
        bool said = false;
        for (const QLabel* label : m_comparison->findChildren<QLabel*>())
            said = said || (label->isVisible() && label->text().startsWith(QLatin1StringView("Compare all")));
        QVERIFY(said);
        QVERIFY(!m_comparison->exportTo(m_folder.filePath(QStringLiteral("none.csv"))).isEmpty());
        QVERIFY(!m_comparison->exportFramesTo(m_folder.filePath(QStringLiteral("none.csv"))).isEmpty());
        QVERIFY(!QFile::exists(m_folder.filePath(QStringLiteral("none.csv"))));
    }

    void everyAlgorithmGetsItsRowOfFiguresAndItsCurve() {
        compare(gasOf(60));
        QTRY_VERIFY_WITH_TIMEOUT(table()->isVisible(), longestWait); // Qt shows it with the next event
        QCOMPARE(table()->rowCount(), static_cast<int>(broadphases().size()));
        for (int row = 0; row < table()->rowCount(); ++row) {
            QVERIFY(table()->text(row, 0).toDouble() > 0);
            QCOMPARE(table()->text(row, 4), table()->text(0, 4)); // all find the same pairs
        }
        QVERIFY(m_state->text().contains(QLatin1StringView("fastest")));
        const ChartSpec& chart = m_comparison->findChild<PlotWidget*>()->chart();
        QCOMPARE(chart.series.size(), broadphases().size());
        const std::size_t frames = static_cast<std::size_t>(m_comparison->result()->plan.frames);
        for (const ChartSeries& series : chart.series) QCOMPARE(series.x.size(), frames);
    }

    void tableAndChartFitBesideTheFiguresOfTheFrame() {
        // In a window of 1500 px the chart was beyond the right edge.
        for (const int width : {1500, 1000}) {
            BroadphaseDock dock;
            dock.resize(width, 300);
            dock.show();
            dock.showPipeline(gasOf(20));
            dock.findChild<QPushButton*>(QStringLiteral("compare"))->click();
            const auto isWithin = [&](const QWidget* part) {
                return part != nullptr && part->isVisible() &&
                       part->width() >= part->minimumSizeHint().width() &&
                       part->mapTo(&dock, QPoint(part->width(), 0)).x() <= width;
            };
            QTRY_VERIFY_WITH_TIMEOUT(isWithin(dock.findChild<ValueTable*>()), longestWait);
            QTRY_VERIFY_WITH_TIMEOUT(isWithin(dock.findChild<PlotWidget*>()), longestWait);
            QTRY_COMPARE_WITH_TIMEOUT(dock.findChild<QScrollArea*>()->horizontalScrollBar()->maximum(), 0,
                                      longestWait);
        }
    }

    void anotherChartCanBeChosen() {
        compare(gasOf(30));
        QComboBox* charts = m_comparison->findChild<QComboBox*>(QStringLiteral("comparisonChart"));
        QCOMPARE(charts->count(), 3);
        charts->setCurrentIndex(2);
        const ChartSpec& chart = m_comparison->findChild<PlotWidget*>()->chart();
        QCOMPARE(chart.y.label, QStringLiteral("pairs tested"));
        // All pairs of 30 balls, which no frame changes.
        for (const double tested : chart.series.front().y) QCOMPARE(tested, chart.series.front().y.front());
        QVERIFY(chart.series.front().y.front() >= 30 * 29 / 2);
    }

    void chartAndFiguresCanBeWrittenToFiles() {
        compare(gasOf(30));
        const QString png = m_folder.filePath(QStringLiteral("c.png"));
        const QString svg = m_folder.filePath(QStringLiteral("c.svg"));
        const QString csv = m_folder.filePath(QStringLiteral("c.csv"));
        const QString frames = m_folder.filePath(QStringLiteral("f.csv"));
        QCOMPARE(m_comparison->exportTo(png), QString());
        QCOMPARE(m_comparison->exportTo(svg), QString());
        QCOMPARE(m_comparison->exportTo(csv), QString());
        QCOMPARE(m_comparison->exportFramesTo(frames), QString());
        QVERIFY(QImage(png).width() > 500);
        QVERIFY(readFile(svg).contains("Sweep and sort"));
        const qsizetype algorithms = std::ssize(broadphases());
        QCOMPARE(readFile(csv).count('\n'), 1 + algorithms);
        // As many as it takes to tell the fastest, or five times 120.
        const std::int64_t measured = m_comparison->result()->plan.frames;
        QVERIFY(measured == 120 || measured == 600);
        QCOMPARE(readFile(frames).count('\n'), 1 + measured * algorithms);
        QVERIFY(m_comparison->exportTo(m_folder.filePath(QStringLiteral("no/such/c.csv")))
                    .contains(QLatin1StringView("cannot be written")));
    }

    void aSecondClickStopsItAndWhatWasComputedStays() {
        m_comparison->setPipeline(gasOf(3000));
        QTest::mouseClick(m_button, Qt::LeftButton);
        QCOMPARE(m_button->text(), QStringLiteral("Stop"));
        QVERIFY(m_progress->isVisible());
        // Every algorithm has had its first turn of ten frames.
        QTRY_VERIFY_WITH_TIMEOUT(m_progress->value() > 150, longestWait);
        QVERIFY(m_state->text().contains(QLatin1StringView("s left")));
        QTest::mouseClick(m_button, Qt::LeftButton);
        QTRY_COMPARE_WITH_TIMEOUT(m_button->text(), QStringLiteral("Compare all"), longestWait);
        QVERIFY(!m_comparison->result()->complete);
        QVERIFY(m_comparison->result()->plan.frames < 120);
        QTRY_VERIFY_WITH_TIMEOUT(table()->isVisible(), longestWait); // Qt shows it with the next event
        QVERIFY(m_state->text().startsWith(QLatin1StringView("Stopped.")));
    }

    void againstNStoppedItKeepsTheNumbersThatAreWhole() {
        QComboBox* subject = m_comparison->findChild<QComboBox*>(QStringLiteral("comparisonSubject"));
        subject->setCurrentIndex(subject->findData(QStringLiteral("brownian")));
        QVERIFY(m_button->isEnabled()); // needs no scene
        QTest::mouseClick(m_button, Qt::LeftButton);
        // Eight numbers: the first two are done at a quarter.
        QTRY_VERIFY_WITH_TIMEOUT(m_progress->value() > 260, longestWait);
        QTest::mouseClick(m_button, Qt::LeftButton);
        QTRY_COMPARE_WITH_TIMEOUT(m_button->text(), QStringLiteral("Compare all"), longestWait);
        QVERIFY(!m_comparison->result()->complete);
        QVERIFY(m_comparison->result()->points.size() >= 2 * broadphases().size());
        QVERIFY(table()->text(0, 1).toDouble() > 0);
        QCOMPARE(table()->text(0, table()->columnCount() - 2), QStringLiteral("–"));
        const ChartSpec& chart = m_comparison->findChild<PlotWidget*>()->chart();
        QCOMPARE(chart.series.size(), broadphases().size());
        QCOMPARE(chart.series.front().x.front(), 100.0);
    }

    void figuresOfTheSceneBeforeAreSaidToBeSo() {
        compare(gasOf(20));
        QVERIFY(!m_state->text().contains(QLatin1StringView("changed")));
        m_comparison->setPipeline(gasOf(21));
        QTRY_VERIFY_WITH_TIMEOUT(table()->isVisible(), longestWait); // Qt shows it with the next event
        QVERIFY(m_state->text().contains(QLatin1StringView("The scene has changed since")));
    }

    void itCanBeClosedWhileItWorks() {
        m_comparison->setPipeline(gasOf(2000));
        QTest::mouseClick(m_button, Qt::LeftButton);
        m_comparison.reset(); // joins its thread
        QVERIFY(!m_comparison);
    }

  private:
    ValueTable* table() const { return m_comparison->findChild<ValueTable*>(QStringLiteral("comparison")); }
    void compare(const std::shared_ptr<const Pipeline>& pipeline) {
        QSignalSpy reports(m_comparison.get(), &BroadphaseComparison::reported);
        m_comparison->setPipeline(pipeline);
        QTest::mouseClick(m_button, Qt::LeftButton);
        QTRY_COMPARE_WITH_TIMEOUT(reports.size(), 1, longestWait);
        QCOMPARE(m_button->text(), QStringLiteral("Compare all"));
        QVERIFY(m_comparison->result()->complete);
    }

    QTemporaryDir m_folder;
    std::unique_ptr<BroadphaseComparison> m_comparison;
    QPushButton* m_button = nullptr;
    QLabel* m_state = nullptr;
    QProgressBar* m_progress = nullptr;
};

} // namespace carom

CAROM_TEST_WITH(QApplication, broadphase_comparison_test, carom::BroadphaseComparisonTest)
#include "broadphase_comparison_test.moc"
