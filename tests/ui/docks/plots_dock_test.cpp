// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/files.h"
#include "tests/support/test_class.h"

#include "ui/base/pauses.h"
#include "ui/docks/plots_dock.h"

#include "core/simulation/build.h"

#include <QApplication>
#include <QComboBox>
#include <QFile>
#include <QImage>
#include <QLabel>
#include <QListWidget>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>

#include <cmath>
#include <optional>

using namespace carom;

namespace {

using carom::test::longestWait;

const std::string falling = "gravity { accel 0,-10,0 }\n"
                            "sphere ball { radius .25 mass 2 centre 1,5,0 vel 3,0,0 }\n"
                            "sphere { radius .25 mass 1 centre 9,5,0 }\n";

struct Shown {
    PlotsDock dock;

    Shown() {
        dock.resize(900, 300);
        dock.show();
        if (!QTest::qWaitForWindowExposed(&dock, longestWait)) qFatal("the panel is not on screen");
        dock.showPipeline(build(falling).pipeline);
    }
    template<class Widget>
    Widget* named(const char* name) {
        return dock.findChild<Widget*>(QLatin1StringView(name));
    }
    void add(const char* body, const char* quantity) {
        QComboBox* bodies = named<QComboBox>("plotBody");
        bodies->setCurrentIndex(bodies->findText(QLatin1StringView(body)));
        QComboBox* quantities = named<QComboBox>("plotQuantity");
        quantities->setCurrentIndex(quantities->findText(QLatin1StringView(quantity)));
        QTest::mouseClick(named<QToolButton>("plotAdd"), Qt::LeftButton);
    }
    bool has(std::size_t curves, std::size_t points) const {
        const std::vector<ChartSeries>& series = dock.chart().series;
        return series.size() == curves && !series.empty() && series.back().y.size() == points;
    }
};

QByteArray contents(const QString& path) {
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

} // namespace

class PlotsDockTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void initTestCase() { shortenPauses(10); }

    void aCurveHasTheFigureOfEveryFrameFromTheStartAlsoWhenItIsAddedLate() {
        Shown shown;
        shown.dock.reach(30);
        shown.add("ball", "position x");
        QTRY_VERIFY_WITH_TIMEOUT(shown.has(1, 31), longestWait);
        const ChartSeries& series = shown.dock.chart().series.front();
        for (std::size_t frame = 0; frame <= 30; ++frame) {
            QCOMPARE(series.x[frame], static_cast<double>(frame) / 60);
            QVERIFY(std::abs(series.y[frame] - (1 + 3 * series.x[frame])) < 1e-12);
        }
        QCOMPARE(shown.dock.chart().y.unit, QStringLiteral("m"));
        shown.dock.reach(45); // the run goes on
        QTRY_VERIFY_WITH_TIMEOUT(shown.has(1, 46), longestWait);
    }

    void curvesOfDifferentUnitsNameThemAndTheWholeCanBePlotted() {
        Shown shown;
        shown.dock.reach(5);
        shown.add("ball", "speed");
        shown.add("the whole scene", "energy");
        QTRY_VERIFY_WITH_TIMEOUT(shown.has(2, 6), longestWait);
        QCOMPARE(shown.dock.chart().series[1].name, QStringLiteral("whole: energy [J]"));
        QCOMPARE(shown.dock.chart().series[1].y.front(), 9.0 + 100 + 50);
        QVERIFY(shown.dock.chart().y.unit.isEmpty());
        shown.named<QListWidget>("")->setCurrentRow(0);
        QTest::mouseClick(shown.named<QToolButton>("plotRemove"), Qt::LeftButton);
        QTRY_VERIFY_WITH_TIMEOUT(shown.has(1, 6), longestWait);
        QCOMPARE(shown.dock.chart().y.unit, QStringLiteral("J"));
    }

    void anEditKeepsTheCurveOfTheBodyWithThatName() {
        Shown shown;
        shown.dock.reach(5);
        shown.add("ball", "position x");
        QTRY_VERIFY_WITH_TIMEOUT(shown.has(1, 6), longestWait);
        shown.dock.showPipeline(build("sphere { radius 1 mass 1 centre 7,7,7 }\n" + falling).pipeline);
        shown.dock.reach(3);
        QTRY_VERIFY_WITH_TIMEOUT(shown.has(1, 4), longestWait);
        QCOMPARE(shown.dock.chart().series.front().y.front(), 1.0);
        shown.dock.showPipeline(build("sphere other { radius 1 mass 1 centre 7,7,7 }\n").pipeline);
        shown.dock.reach(3);
        QTRY_VERIFY_WITH_TIMEOUT(shown.has(1, 4) && std::isnan(shown.dock.chart().series.front().y.front()),
                                 longestWait);
    }

    void aLongRunKeepsItsExtremesInBoundedMemory() {
        Shown shown;
        shown.dock.showPipeline(build("sphere ball { radius .1 mass 1 centre 0,0,0 vel 3,0,0 }").pipeline);
        shown.add("ball", "position x");
        shown.dock.reach(40'000);
        QVERIFY(shown.named<QLabel>("plotProgress")->isVisible()); // it is behind, and says so
        const auto arrived = [&] {
            const std::vector<ChartSeries>& series = shown.dock.chart().series;
            return !series.empty() && !series.front().x.empty() &&
                   std::abs(series.front().x.back() - 40'000.0 / 60) < 1e-6;
        };
        QTRY_VERIFY_WITH_TIMEOUT(arrived(), longestWait);
        QVERIFY(!shown.named<QLabel>("plotProgress")->isVisible());
        const ChartSeries& series = shown.dock.chart().series.front();
        QVERIFY(series.x.size() <= 2 * BoundedSeries::mostStretches + 2);
        for (std::size_t k = 0; k < series.x.size(); ++k)
            QVERIFY(std::abs(series.y[k] - 3 * series.x[k]) < 1e-6);
        QVERIFY(shown.dock.bytes() < std::size_t{1} << 20);
        const QTemporaryDir folder;
        const QString csv = folder.filePath(QStringLiteral("plot.csv"));
        QCOMPARE(shown.dock.exportTo(csv), QString());
        const QList<QByteArray> lines = contents(csv).split('\n');
        QCOMPARE(lines[0],
                 QByteArray("time_s,\"least ball: position x [m]\",\"greatest ball: position x [m]\""));
        QVERIFY(lines[1].startsWith("0,0,0.35")); // of frames 0 to 7, and 7 · 3 / 60 = 0.35
    }

    void anotherSceneIsNotBehind() {
        // "filling in: frame 0 of 3582" of the scene before stayed beside the curves of one at frame 0.
        Shown shown;
        const auto ball = [] { return build("sphere ball { radius .1 mass 1 centre 0,0,0 }").pipeline; };
        shown.dock.showPipeline(ball());
        shown.add("ball", "position x");
        shown.dock.reach(1'000'000);
        QVERIFY(shown.named<QLabel>("plotProgress")->isVisible());
        shown.dock.showPipeline(ball());
        QVERIFY(!shown.named<QLabel>("plotProgress")->isVisible());
    }

    void aClickInTheChartPicksTheFrameUnderIt() {
        Shown shown;
        shown.dock.reach(30);
        shown.add("ball", "position x");
        QTRY_VERIFY_WITH_TIMEOUT(shown.has(1, 31), longestWait);
        PlotWidget* plot = shown.dock.findChild<PlotWidget*>();
        QSignalSpy picked(&shown.dock, &PlotsDock::framePicked);
        QWidget* canvas = plot->findChild<QWidget*>();
        const QPoint place(static_cast<int>(std::lround(plot->xOf(12.0 / 60))), canvas->height() / 3);
        QTest::mouseClick(canvas, Qt::LeftButton, {}, place);
        QCOMPARE(picked.count(), 1);
        QCOMPARE(picked.first().first().toLongLong(), 12);
        shown.dock.showFrame(12);
        QCOMPARE(plot->cursor(), std::optional(12.0 / 60));
    }

    void exportsAreFilesOfTheirKind() {
        Shown shown;
        QVERIFY(
            shown.dock.exportTo(QStringLiteral("/nowhere/plot.csv")).contains(QStringLiteral("no curves")));
        shown.dock.reach(5);
        shown.add("ball", "position x");
        QTRY_VERIFY_WITH_TIMEOUT(shown.has(1, 6), longestWait);
        const QTemporaryDir folder;
        const QString csv = folder.filePath(QStringLiteral("plot.csv"));
        QCOMPARE(shown.dock.exportTo(csv), QString());
        const QList<QByteArray> lines = contents(csv).split('\n');
        QCOMPARE(lines[0], QByteArray("time_s,\"ball: position x [m]\""));
        QCOMPARE(lines[1], QByteArray("0,1"));
        QCOMPARE(lines.size(), 8);
        QCOMPARE(shown.dock.exportTo(folder.filePath(QStringLiteral("plot.png"))), QString());
        QVERIFY(!QImage(folder.filePath(QStringLiteral("plot.png"))).isNull());
        QCOMPARE(shown.dock.exportTo(folder.filePath(QStringLiteral("plot.svg"))), QString());
        QVERIFY(contents(folder.filePath(QStringLiteral("plot.svg"))).contains("<svg"));
        QCOMPARE(shown.dock.exportTo(folder.filePath(QStringLiteral("plot.pdf"))), QString());
        QVERIFY(contents(folder.filePath(QStringLiteral("plot.pdf"))).startsWith("%PDF"));
    }
};

CAROM_TEST_WITH(QApplication, plots_dock_test, PlotsDockTest)
#include "plots_dock_test.moc"
