// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/statistics.h"
#include "ui/docks/timing_dock.h"
#include "ui/widgets/value_table.h"

#include <QFile>
#include <QImage>
#include <QLabel>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QXmlStreamReader>

#include <vector>

namespace carom {
namespace {

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

QByteArray contentOf(const QString& path) {
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

} // namespace

class TimingDockTest : public QObject {
    Q_OBJECT

    QTemporaryDir m_folder;

  private Q_SLOTS:
    void theTableHoldsTheStatisticsWithoutTheFirstFrame() {
        TimingDock dock;
        dock.addSamples(countingSamples(100));
        const ValueTable* table = dock.findChild<ValueTable*>();
        constexpr int respond = 3;                                       // row
        QTRY_COMPARE(table->text(respond, 1), QStringLiteral("50.500")); // mean
        QCOMPARE(table->text(respond, 0), QStringLiteral("100.000"));    // now
        QCOMPARE(table->text(respond, 2), QStringLiteral("50.500"));     // median
        QCOMPARE(table->text(respond, 3), QStringLiteral("95.000"));     // p95
        QCOMPARE(table->text(respond, 4), QStringLiteral("99.000"));     // p99
        QCOMPARE(table->text(respond, 5), QStringLiteral("100.000"));    // max
        QCOMPARE(table->text(table->rowCount() - 1, 5), QStringLiteral("100.250"));
        bool apart = false;
        for (const QLabel* label : dock.findChildren<QLabel*>())
            apart = apart || label->text().contains(QStringLiteral("500.250"));
        QVERIFY(apart);
        QVERIFY(table->asText().contains(QStringLiteral("respond\t100.000\t50.500")));
    }

    void renderingIsCountedOverTheFramesThatWereShown() {
        TimingDock dock;
        std::vector<FrameSample> samples = countingSamples(30);
        for (std::size_t i = 0; i < samples.size(); ++i) samples[i].render = i % 3 == 0 ? 12 : 0;
        dock.addSamples(samples);
        const ValueTable* table = dock.findChild<ValueTable*>();
        constexpr int render = 5;
        QTRY_COMPARE(table->text(render, 1), QStringLiteral("12.000"));
        QCOMPARE(table->text(render, 2), QStringLiteral("12.000"));
    }

    void clearingLeavesDashes() {
        TimingDock dock;
        dock.addSamples(countingSamples(5));
        dock.clear();
        const ValueTable* table = dock.findChild<ValueTable*>();
        QCOMPARE(table->text(0, 1), QStringLiteral("–"));
        QVERIFY(!dock.exportTo(m_folder.filePath(QStringLiteral("none.csv"))).isEmpty());
    }

    void aPickedFrameIsNamedByItsNumberInTheRun() {
        TimingDock dock;
        dock.resize(900, 300);
        dock.show();
        QVERIFY(QTest::qWaitForWindowExposed(&dock));
        dock.addSamples(countingSamples(10));
        QSignalSpy picked(&dock, &TimingDock::framePicked);
        TimingStrip* strip = dock.findChild<TimingStrip*>();
        QTest::mouseClick(strip, Qt::LeftButton, {}, {strip->width() - 1, 20});
        QCOMPARE(picked.size(), 1);
        QCOMPARE(picked.front().at(0).value<std::int64_t>(), std::int64_t{11});
        const ValueTable* table = dock.findChild<ValueTable*>();
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
        const QList<QByteArray> lines = contentOf(path).split('\n');
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
        QXmlStreamReader xml(contentOf(svg));
        bool legend = false;
        while (!xml.atEnd())
            if (xml.readNext() == QXmlStreamReader::Characters)
                legend = legend || xml.text() == QStringLiteral("narrow-phase");
        QVERIFY2(!xml.hasError(), qPrintable(xml.errorString()));
        QVERIFY(legend);
        const QString pdf = m_folder.filePath(QStringLiteral("timing.pdf"));
        QCOMPARE(dock.exportTo(pdf), QString());
        QVERIFY(contentOf(pdf).startsWith("%PDF-"));
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

QTEST_MAIN(carom::TimingDockTest)
#include "timing_dock_test.moc"
