// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/files.h"
#include "tests/support/test_class.h"

#include "ui/widgets/plot.h"

#include <QFile>
#include <QImage>
#include <QTemporaryDir>
#include <QTest>
#include <QXmlStreamReader>

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
namespace {

using test::longestWait;
using test::readFile;

ChartSpec example(SeriesStyle style) {
    ChartSpec spec;
    spec.title = QStringLiteral("Growth");
    spec.x = {QStringLiteral("bodies"), {}, false};
    spec.y = {QStringLiteral("time"), QStringLiteral("ms"), false};
    spec.series = {{QStringLiteral("first"), {1, 2, 3, 4}, {1, 4, 9, 16}, style, {}},
                   {QStringLiteral("second"), {1, 2, 3, 4}, {2, 3, 4, 5}, style, {}}};
    spec.levels = {{16.7, QStringLiteral("1/60 s")}};
    return spec;
}

int pixelsOf(const QImage& image, const QColor& colour) {
    const QImage colours = image.convertToFormat(QImage::Format_RGB32);
    const QRgb wanted = colour.rgb();
    int count = 0;
    for (int y = 0; y < colours.height(); ++y) {
        const QRgb* row = reinterpret_cast<const QRgb*>(colours.constScanLine(y));
        for (int x = 0; x < colours.width(); ++x) count += row[x] == wanted ? 1 : 0;
    }
    return count;
}

/// All text of a well-formed XML file; nothing where it is not well formed.
QString textOfXml(const QString& path) {
    QXmlStreamReader xml(readFile(path));
    QString text;
    while (!xml.atEnd())
        if (xml.readNext() == QXmlStreamReader::Characters) text += xml.text();
    return xml.hasError() ? QString() : text;
}

} // namespace

class PlotTest : public QObject {
    Q_OBJECT

    QTemporaryDir m_folder;

  private Q_SLOTS:
    void aShortAxisKeepsItsUnitAndASmallChartItsCurves() {
        ChartSpec spec;
        spec.x = {.label = QStringLiteral("error"), .unit = {}};
        spec.y = {.label = QStringLiteral("time that one simulated second takes"),
                  .unit = QStringLiteral("ms")};
        for (const char* name : {"contacts, symplectic", "contacts, midpoint"}) {
            ChartSeries& series = spec.series.emplace_back();
            series.name = QString::fromLatin1(name);
            series.x = {1, 2};
            series.y = {1, 2};
        }
        spec.legendBeside = true;
        spec.leastForBelow = 260;
        PlotWidget plot;
        plot.resize(700, 400);
        plot.show();
        plot.setChart(spec);
        QTRY_COMPARE_WITH_TIMEOUT(plot.labelOfY(),
                                  QStringLiteral("time that one simulated second takes [ms]"), longestWait);
        QVERIFY(plot.showsLegend()); // beside
        plot.resize(700, 150);
        QTRY_VERIFY2_WITH_TIMEOUT(plot.labelOfY().endsWith(QString::fromUtf8("… [ms]")),
                                  qPrintable(plot.labelOfY()), longestWait);
        QVERIFY(plot.showsLegend());
        plot.resize(300, 150); // neither beside nor below is room for it
        QTRY_VERIFY_WITH_TIMEOUT(!plot.showsLegend(), longestWait);
        plot.resize(300, 400);
        QTRY_VERIFY_WITH_TIMEOUT(plot.showsLegend(), longestWait); // below
        QTRY_COMPARE_WITH_TIMEOUT(plot.labelOfY(),
                                  QStringLiteral("time that one simulated second takes [ms]"), longestWait);
    }

    void aPngHoldsEverySeriesInItsColour() {
        for (const SeriesStyle style :
             {SeriesStyle::Line, SeriesStyle::LineAndMarks, SeriesStyle::Marks, SeriesStyle::Stacked}) {
            const QString path = m_folder.filePath(QStringLiteral("chart.png"));
            QCOMPARE(writeChart(example(style), path, {640, 400}), QString());
            const QImage image(path);
            QCOMPARE(image.size(), QSize(1280, 800));
            QVERIFY(pixelsOf(image, seriesColour(0)) > 50);
            QVERIFY(pixelsOf(image, seriesColour(1)) > 50);
        }
    }

    void aLevelFarFromTheSeriesIsAnArrowAtTheEdge() {
        ChartSpec spec = example(SeriesStyle::LineAndMarks);
        spec.x.logarithmic = spec.y.logarithmic = true;
        const QString path = m_folder.filePath(QStringLiteral("levels.svg"));
        for (const auto& [level, arrow] :
             {std::pair{1e6, QStringLiteral("\u2191 ")}, std::pair{1e-6, QStringLiteral("\u2193 ")},
              std::pair{20.0, QString()}, std::pair{10.0, QString()}}) {
            spec.levels = {{level, QStringLiteral("real time"), true}};
            QCOMPARE(writeChart(spec, path), QString());
            const QString text = textOfXml(path);
            QVERIFY2(text.contains(arrow + QStringLiteral("real time")), qPrintable(text));
            QCOMPARE(text.contains(QChar(0x2191)) || text.contains(QChar(0x2193)), !arrow.isEmpty());
        }
    }

    // "real time" stood over the points of pool_break.
    void theNameOfALevelCoversNoPoint() {
        ChartSpec spec = example(SeriesStyle::Marks);
        spec.series.resize(1); // rises to the upper right corner
        spec.x.logarithmic = spec.y.logarithmic = true;
        const QString path = m_folder.filePath(QStringLiteral("covered.png"));
        const auto seen = [&] {
            if (!writeChart(spec, path, {640, 400}).isEmpty()) return -1;
            return pixelsOf(QImage(path), seriesColour(0));
        };
        for (const std::vector<double>& y : {std::vector<double>{1, 4, 9, 16}, {16, 9, 4, 1}}) {
            spec.series[0].y = y;
            spec.levels.clear();
            const int all = seen();
            QVERIFY(all > 100);
            for (const double level : {1e6, 1e-6}) {
                spec.levels = {{level, QStringLiteral("real time"), true}};
                QCOMPARE(seen(), all);
            }
        }
    }

    // In a narrow panel a name at the right was cut, because the axes were supposed to be wider than they
    // are.
    void theNameOfALevelIsWholeInANarrowChart() {
        ChartSpec spec = example(SeriesStyle::Marks);
        spec.series.resize(1);
        spec.series[0].y = {16, 9, 4, 1}; // leaves the upper right corner free
        spec.y.logarithmic = true;
        const QString path = m_folder.filePath(QStringLiteral("narrow.png"));
        const auto darkness = [&](const QString& name, const QSize& size) -> double { // of all pixels
            spec.levels = {{1e6, name, true}};
            if (!writeChart(spec, path, size).isEmpty()) return NAN;
            const QImage image = QImage(path).convertToFormat(QImage::Format_Grayscale8);
            double sum = 0;
            for (int y = 0; y < image.height(); ++y) {
                const uchar* row = image.constScanLine(y);
                for (int x = 0; x < image.width(); ++x) sum += 255 - row[x];
            }
            return sum;
        };
        const auto darknessOfName = [&](const QSize& size) {
            return darkness(QStringLiteral("MMMMM"), size) - darkness(QString(), size);
        };
        const double whole = darknessOfName({800, 400});
        constexpr double smooth = 0.1; // edges of letters fall between pixels
        for (const int width : {220, 260, 300})
            QVERIFY2(std::abs(darknessOfName({width, 200}) / whole - 1) < smooth,
                     qPrintable(QString::number(darknessOfName({width, 200}) / whole)));
    }

    // The width of the name was taken for a smaller part of the axes than it is where names stand beside
    // them: it ended over the points on its right.
    void theNameOfALevelCoversNoPointWhereSeriesAreNamedBesideTheAxes() {
        ChartSpec spec = example(SeriesStyle::Marks);
        spec.x.logarithmic = spec.y.logarithmic = true;
        spec.legendBeside = true;
        spec.series[1].name = QString(26, QLatin1Char('m'));
        spec.series[1].x = spec.series[1].y = {1};
        spec.series[0].y = {1, 16, 1};
        const QString path = m_folder.filePath(QStringLiteral("beside.png"));
        const auto seen = [&](double level) {
            spec.levels = {{level, QStringLiteral("a level far away"), true}};
            if (!writeChart(spec, path, {800, 400}).isEmpty()) return -1;
            return pixelsOf(QImage(path), seriesColour(0));
        };
        for (const double at : {4.0, 5.0, 6.0, 7.0, 8.0, 10.0, 12.0}) {
            spec.series[0].x = {1, at, 16}; // its point at the top
            const int all = seen(4);        // a line across, without a name there
            QVERIFY(all > 100);
            QCOMPARE(seen(1e6), all);
        }
    }

    void namesStandBesideTheAxesWhereThereIsRoom() {
        ChartSpec spec = example(SeriesStyle::Line);
        spec.legendBeside = true;
        const auto lowest = [&] { // row of the first series' colour, 0 above to 1 below
            const QString path = m_folder.filePath(QStringLiteral("names.png"));
            if (!writeChart(spec, path).isEmpty()) return -1.0;
            const QImage image(path);
            for (int y = image.height() - 1; y > 0; --y)
                for (int x = 0; x < image.width(); ++x)
                    if (image.pixel(x, y) == seriesColour(0).rgb()) return double(y) / image.height();
            return 0.0;
        };
        const double axes = 0.93; // labels and numbers below them
        QVERIFY(lowest() < axes);
        spec.series[1].name = QString(200, QLatin1Char('m')); // too long to stand beside
        QVERIFY(lowest() > axes);
    }

    // Rows of a legend are as high as their marks, 18 pixels, and stand below the headings: of nineteen names
    // beside the axes the last was cut.
    void namesThatStandBesideTheAxesAreAllThere() {
        ChartSpec spec = example(SeriesStyle::Line);
        spec.note = QStringLiteral("A sentence on what the chart says.");
        spec.legendBeside = true;
        constexpr std::size_t names = 19;
        while (spec.series.size() < names) {
            spec.series.push_back(spec.series[1]);
            spec.series.back().name = QStringLiteral("series %1").arg(spec.series.size());
        }
        ChartSeries& last = spec.series.back();
        last.colour = QColor(0x12, 0x34, 0x56);
        last.x = last.y = {}; // it is in the legend alone
        const QString path = m_folder.filePath(QStringLiteral("many.png"));
        int fewest = std::numeric_limits<int>::max(), most = 0;
        for (int height = 300; height <= 480; height += 12) {
            QCOMPARE(writeChart(spec, path, {900, height}), QString());
            const int pixels = pixelsOf(QImage(path), *last.colour);
            fewest = std::min(fewest, pixels);
            most = std::max(most, pixels);
        }
        QVERIFY2(fewest > 0.9 * most, qPrintable(QStringLiteral("%1 of %2").arg(fewest).arg(most)));
    }

    void stackedAreasAreAsLargeAsTheirFigures() {
        ChartSpec spec = example(SeriesStyle::Stacked);
        spec.series[0].y = {3, 3, 3, 3};
        spec.series[1].y = {6, 6, 6, 6};
        spec.levels.clear();
        const QString path = m_folder.filePath(QStringLiteral("stack.png"));
        QCOMPARE(writeChart(spec, path), QString());
        const QImage image(path);
        const double ratio =
            static_cast<double>(pixelsOf(image, seriesColour(1))) / pixelsOf(image, seriesColour(0));
        QVERIFY2(std::abs(ratio - 2) < 0.05,
                 qPrintable(QString::number(ratio))); // the legend's squares count too
    }

    void anSvgIsWellFormedAndHoldsItsWords() {
        const QString path = m_folder.filePath(QStringLiteral("chart.svg"));
        QCOMPARE(writeChart(example(SeriesStyle::Line), path), QString());
        const QString text = textOfXml(path);
        for (const char* word : {"Growth", "bodies", "time [ms]", "first", "second", "1/60 s"})
            QVERIFY2(text.contains(QLatin1StringView(word)), word);
    }

    void aPdfHasItsHeadAndItsEnd() {
        const QString path = m_folder.filePath(QStringLiteral("chart.pdf"));
        QCOMPARE(writeChart(example(SeriesStyle::LineAndMarks), path), QString());
        const QByteArray content = readFile(path);
        QVERIFY(content.startsWith("%PDF-"));
        QVERIFY(content.trimmed().endsWith("%%EOF"));
    }

    void figuresAnAxisCannotShowAreLeftOut() {
        ChartSpec spec = example(SeriesStyle::LineAndMarks);
        spec.x.logarithmic = spec.y.logarithmic = true;
        spec.series[0].x = {0, 10, 100, 1000, 10000};
        spec.series[0].y = {5, -1, std::nan(""), 0.1, std::numeric_limits<double>::infinity()};
        QCOMPARE(writeChart(spec, m_folder.filePath(QStringLiteral("log.svg"))), QString());
        QVERIFY(!readFile(m_folder.filePath(QStringLiteral("log.svg"))).contains("nan"));
    }

    void anEmptyChartIsStillAFile() {
        QCOMPARE(writeChart({}, m_folder.filePath(QStringLiteral("empty.png"))), QString());
        QVERIFY(!QImage(m_folder.filePath(QStringLiteral("empty.png"))).isNull());
    }

    void anUnknownEndingIsRefusedWithTheEndingsThereAre() {
        const QString problem =
            writeChart(example(SeriesStyle::Line), m_folder.filePath(QStringLiteral("chart.gif")));
        QVERIFY(problem.contains(QStringLiteral(".png, .svg or .pdf")));
    }

    void aFolderThatDoesNotExistIsReported() {
        const QString path = m_folder.filePath(QStringLiteral("nowhere/chart.png"));
        const QString problem = writeChart(example(SeriesStyle::Line), path);
        QVERIFY(problem.contains(path));
        QVERIFY(!QFile::exists(path));
    }

    void aPlotOnScreenIsReplacedByTheNextChart() {
        PlotWidget plot;
        plot.resize(500, 300);
        plot.show();
        QVERIFY(QTest::qWaitForWindowExposed(&plot, longestWait));
        ChartSpec other = example(SeriesStyle::Stacked);
        other.title.clear();
        other.series.resize(1);
        for (const ChartSpec& spec : {example(SeriesStyle::Stacked), other, example(SeriesStyle::Stacked)}) {
            plot.setChart(spec);
            QTRY_VERIFY_WITH_TIMEOUT(pixelsOf(plot.grab().toImage(), seriesColour(0)) > 500, longestWait);
            QTRY_COMPARE_WITH_TIMEOUT(pixelsOf(plot.grab().toImage(), seriesColour(1)) > 500,
                                      spec.series.size() > 1, longestWait);
        }
    }
};

} // namespace carom

CAROM_TEST_WITH(QApplication, plot_test, carom::PlotTest)
#include "plot_test.moc"
