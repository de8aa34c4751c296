// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/files.h"
#include "tests/support/test_class.h"

#include "core/math/statistics.h"
#include "ui/base/pauses.h"
#include "ui/docks/run_comparison.h"
#include "ui/docks/timing_dock.h"
#include "ui/widgets/value_table.h"

#include <QComboBox>
#include <QFile>
#include <QImage>
#include <QLabel>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>
#include <QXmlStreamReader>

#include <vector>

namespace carom {
namespace {

using test::longestWait;
using test::readFile;

/// Frames whose respond takes 1, 2, … ms; the first, apart, 500 ms.
std::vector<FrameSample> countingSamples(int count) {
    std::vector<FrameSample> samples;
    for (int i = 0; i <= count; ++i) {
        FrameSample sample;
        sample.statistics.frame = i + 1;
        sample.statistics.time = (i + 1) / 60.0;
        sample.statistics.respond = sample.statistics.simulate = i == 0 ? 500 : i;
        sample.statistics.contacts = static_cast<std::uint64_t>(3 * i);
        sample.render = 0.25;
        samples.push_back(sample);
    }
    return samples;
}

} // namespace

class TimingDockTest : public QObject {
    Q_OBJECT

    QTemporaryDir m_folder;

  private Q_SLOTS:
    void initTestCase() { shortenPauses(10); }

    void theTableHoldsTheStatisticsWithoutTheFirstFrame() {
        TimingDock dock;
        dock.addSamples(countingSamples(100));
        const ValueTable* table = dock.findChild<ValueTable*>(QStringLiteral("frameTimes"));
        constexpr int respond = 3;                                                                 // row
        QTRY_COMPARE_WITH_TIMEOUT(table->text(respond, 1), QStringLiteral("50.500"), longestWait); // mean
        QCOMPARE(table->text(respond, 0), QStringLiteral("100.000"));                              // now
        QCOMPARE(table->text(respond, 2), QStringLiteral("50.500"));                               // median
        QCOMPARE(table->text(respond, 3), QStringLiteral("95.000"));                               // p95
        QCOMPARE(table->text(respond, 4), QStringLiteral("99.000"));                               // p99
        QCOMPARE(table->text(respond, 5), QStringLiteral("100.000"));                              // max
        QCOMPARE(table->text(table->rowCount() - 1, 5), QStringLiteral("100.250"));
        bool apart = false;
        for (const QLabel* label : dock.findChildren<QLabel*>())
            apart = apart || label->text().contains(QStringLiteral("500.250"));
        QVERIFY(apart);
        QVERIFY(table->asText().contains(QStringLiteral("respond\t100.000\t50.500")));
    }

    void theSumsAreOfTheSameFramesAsTheirParts() {
        // Every second frame is drawn, in 20 ms; a step takes 1 ms in each.
        std::vector<FrameSample> samples = countingSamples(100);
        for (FrameSample& sample : samples) {
            sample.statistics.respond = sample.statistics.simulate = 1;
            sample.render = sample.statistics.frame % 2 == 0 ? 20 : 0;
        }
        TimingDock dock;
        dock.addSamples(samples);
        const ValueTable* table = dock.findChild<ValueTable*>(QStringLiteral("frameTimes"));
        constexpr int render = 5, step = 6, total = 7; // rows
        QTRY_COMPARE_WITH_TIMEOUT(table->text(render, 1), QStringLiteral("20.000"), longestWait);
        QCOMPARE(table->text(step, 1), QStringLiteral("1.000"));
        QCOMPARE(table->text(total, 1), QStringLiteral("21.000"));
    }

    void renderingIsCountedOverTheFramesThatWereShown() {
        TimingDock dock;
        std::vector<FrameSample> samples = countingSamples(30);
        for (std::size_t i = 0; i < samples.size(); ++i) samples[i].render = i % 3 == 0 ? 12 : 0;
        dock.addSamples(samples);
        const ValueTable* table = dock.findChild<ValueTable*>(QStringLiteral("frameTimes"));
        constexpr int render = 5;
        QTRY_COMPARE_WITH_TIMEOUT(table->text(render, 1), QStringLiteral("12.000"), longestWait);
        QCOMPARE(table->text(render, 2), QStringLiteral("12.000"));
    }

    void clearingLeavesDashes() {
        TimingDock dock;
        dock.addSamples(countingSamples(5));
        dock.clear();
        const ValueTable* table = dock.findChild<ValueTable*>(QStringLiteral("frameTimes"));
        QCOMPARE(table->text(0, 1), QStringLiteral("–"));
        QVERIFY(!dock.exportTo(m_folder.filePath(QStringLiteral("none.csv"))).isEmpty());
    }

    void aPickedFrameIsNamedByItsNumberInTheRun() {
        TimingDock dock;
        dock.resize(900, 300);
        dock.show();
        QVERIFY(QTest::qWaitForWindowExposed(&dock, longestWait));
        dock.addSamples(countingSamples(10));
        QSignalSpy picked(&dock, &TimingDock::framePicked);
        TimingStrip* strip = dock.findChild<TimingStrip*>();
        QTest::mouseClick(strip, Qt::LeftButton, {}, {strip->width() - 1, 20});
        QCOMPARE(picked.size(), 1);
        QCOMPARE(picked.front().at(0).value<std::int64_t>(), std::int64_t{11});
        const ValueTable* table = dock.findChild<ValueTable*>(QStringLiteral("frameTimes"));
        QCOMPARE(table->text(3, 0), QStringLiteral("10.000"));
        QTest::keyClick(strip, Qt::Key_Left);
        QCOMPARE(table->text(3, 0), QStringLiteral("9.000"));
        bool contacts = false;
        for (const QLabel* label : dock.findChildren<QLabel*>())
            contacts = contacts || label->text().contains(QStringLiteral("27 contacts"));
        QVERIFY(contacts);
    }

    void theCsvHasTheColumnsOfCoreAndARowAFrame() {
        TimingDock dock;
        dock.addSamples(countingSamples(20));
        const QString path = m_folder.filePath(QStringLiteral("timing.csv"));
        QCOMPARE(dock.exportTo(path), QString());
        const QList<QByteArray> lines = readFile(path).split('\n');
        QCOMPARE(lines.size(), 1 + 21 + 1); // the last is empty: every line ends
        QVERIFY(lines.back().isEmpty());
        const std::string_view columns = statisticsColumns();
        QCOMPARE(lines[0], QByteArray(columns.data(), static_cast<qsizetype>(columns.size())) + ",render_ms");
        const qsizetype width = lines[0].split(',').size();
        for (int i = 1; i <= 21; ++i) {
            const QList<QByteArray> cells = lines[i].split(',');
            QCOMPARE(cells.size(), width);
            QCOMPARE(cells.front().toInt(), i);
            QCOMPARE(cells.back().toDouble(), 0.25);
            QCOMPARE(cells[lines[0].split(',').indexOf("contacts")].toInt(), 3 * (i - 1));
        }
    }

    void thePngTheSvgAndThePdfAreValidFiles() {
        TimingDock dock;
        dock.addSamples(countingSamples(20));
        const QString png = m_folder.filePath(QStringLiteral("timing.png"));
        QCOMPARE(dock.exportTo(png), QString());
        QVERIFY(QImage(png).width() > 900);
        const QString svg = m_folder.filePath(QStringLiteral("timing.svg"));
        QCOMPARE(dock.exportTo(svg), QString());
        QXmlStreamReader xml(readFile(svg));
        bool legend = false;
        while (!xml.atEnd())
            if (xml.readNext() == QXmlStreamReader::Characters)
                legend = legend || xml.text() == QStringLiteral("narrow-phase");
        QVERIFY2(!xml.hasError(), qPrintable(xml.errorString()));
        QVERIFY(legend);
        const QString pdf = m_folder.filePath(QStringLiteral("timing.pdf"));
        QCOMPARE(dock.exportTo(pdf), QString());
        QVERIFY(readFile(pdf).startsWith("%PDF-"));
    }

    void twoRunsAreComparedInOneChart() {
        TimingDock dock;
        QToolButton* compare = dock.findChild<QToolButton*>(QStringLiteral("timingCompare"));
        QVERIFY(!compare->isEnabled());
        dock.describeRun(QStringLiteral("the slow one"));
        dock.addSamples(countingSamples(100));
        dock.findChild<QToolButton*>(QStringLiteral("timingKeep"))->click();
        QVERIFY(compare->isEnabled());
        dock.clear(); // another run begins
        std::vector<FrameSample> faster = countingSamples(50);
        for (FrameSample& sample : faster) sample.statistics.respond = sample.statistics.simulate = 4;
        dock.addSamples(faster);
        compare->click();

        const RunComparison* comparison = dock.findChild<RunComparison*>();
        const ChartSpec& chart = comparison->chart();
        QCOMPARE(chart.series.size(), std::size_t{2});
        QVERIFY(chart.series[0].name.contains(QStringLiteral("the slow one")));
        QCOMPARE(chart.series[0].x.size(), std::size_t{100}); // the first frame of each is apart
        QCOMPARE(chart.series[1].x.size(), std::size_t{50});
        QCOMPARE(chart.series[0].y.back(), 100.0); // without rendering
        QCOMPARE(chart.series[1].y.back(), 4.0);
        const ValueTable* medians = dock.findChild<ValueTable*>(QStringLiteral("comparedMedians"));
        constexpr int respond = 3; // row
        QCOMPARE(medians->text(respond, 0), QStringLiteral("50.500"));
        QCOMPARE(medians->text(respond, 1), QStringLiteral("4.000"));
        QCOMPARE(medians->text(respond, 2), QStringLiteral("0.08"));
        const QLabel* verdict = dock.findChild<QLabel*>(QStringLiteral("comparisonVerdict"));
        QVERIFY2(verdict->text().endsWith(QStringLiteral("the second takes 92 % less.")),
                 qPrintable(verdict->text()));
        dock.findChild<QComboBox*>(QStringLiteral("comparedPart"))->setCurrentIndex(respond);
        QCOMPARE(comparison->chart().series[0].y.back(), 100.0);
    }

    void runsThatCannotBeToldApartAreNotSaidToDiffer() {
        // Two runs of the same times in another order: a difference of their medians would be chance.
        const auto scattered = [](int offset) {
            std::vector<FrameSample> samples = countingSamples(120);
            for (FrameSample& sample : samples) {
                const int place = static_cast<int>(sample.statistics.frame) * 37 + offset;
                sample.statistics.respond = sample.statistics.simulate = 1 + 0.01 * (place % 17);
            }
            return samples;
        };
        TimingDock dock;
        dock.addSamples(scattered(0));
        dock.findChild<QToolButton*>(QStringLiteral("timingKeep"))->click();
        dock.clear();
        dock.addSamples(scattered(5));
        dock.findChild<QToolButton*>(QStringLiteral("timingCompare"))->click();
        const QLabel* verdict = dock.findChild<QLabel*>(QStringLiteral("comparisonVerdict"));
        QVERIFY2(verdict->text().endsWith(QStringLiteral("no clear difference.")),
                 qPrintable(verdict->text()));
        dock.clear();
        dock.addSamples(countingSamples(5));
        dock.findChild<RunComparison*>()->refresh();
        QVERIFY2(verdict->text().contains(QStringLiteral("not enough frames")), qPrintable(verdict->text()));
    }

    void aPartThatIsUncheckedLeavesTheGraph() {
        TimingDock dock;
        dock.addSamples(countingSamples(30)); // respond up to 30 ms, drawing 0.25 ms
        ValueTable* table = dock.findChild<ValueTable*>(QStringLiteral("frameTimes"));
        dock.findChild<QToolButton*>(QStringLiteral("timingFit"))->click();
        QVERIFY(dock.strip().fullScale() > 30);
        constexpr int respond = 3, render = 5; // rows
        table->setChecked(respond, false);
        QVERIFY(dock.strip().fullScale() < 1);
        table->setChecked(respond, true);
        dock.findChild<QToolButton*>(QStringLiteral("timingSimulationOnly"))->click();
        QVERIFY(!table->isChecked(render));
        QVERIFY(table->isChecked(respond));
    }

    void aComparisonIsExportedAndARunForgotten() {
        TimingDock dock;
        dock.describeRun(QStringLiteral("5 \"big\" bodies"));
        dock.addSamples(countingSamples(20));
        dock.findChild<QToolButton*>(QStringLiteral("timingKeep"))->click();
        QToolButton* compare = dock.findChild<QToolButton*>(QStringLiteral("timingCompare"));
        compare->click();
        const QString csv = m_folder.filePath(QStringLiteral("two.csv"));
        QCOMPARE(dock.exportTo(csv), QString());
        const QList<QByteArray> lines = readFile(csv).split('\n');
        QCOMPARE(lines[0],
                 QByteArray("run,frame,integrate_ms,broadphase_ms,narrowphase_ms,respond_ms,other_ms,"
                            "render_ms,step_ms"));
        QCOMPARE(lines.size(), 1 + 2 * 20 + 1);
        QVERIFY(lines[1].startsWith("\"run 1: 5 \"\"big\"\" bodies\",2,0,0,0,1,0,0.25,1"));
        QVERIFY(lines[21].startsWith("the run on screen,2,"));
        const QString png = m_folder.filePath(QStringLiteral("two.png"));
        QCOMPARE(dock.exportTo(png), QString());
        QVERIFY(QImage(png).width() > 900);
        dock.findChild<QToolButton*>(QStringLiteral("forgetRun"))->click();
        QVERIFY(!compare->isChecked());
        QVERIFY(!compare->isEnabled());
    }

    void aFileThatCannotBeWrittenIsReportedByName() {
        TimingDock dock;
        dock.addSamples(countingSamples(3));
        for (const char* ending : {"csv", "png"}) {
            const QString path =
                m_folder.filePath(QStringLiteral("nowhere/timing.") + QLatin1StringView(ending));
            QVERIFY(dock.exportTo(path).contains(path));
        }
    }
};

} // namespace carom

CAROM_TEST_WITH(QApplication, timing_dock_test, carom::TimingDockTest)
#include "timing_dock_test.moc"
