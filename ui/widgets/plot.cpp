// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/plot.h"

#include "ui/base/file_output.h"

#include <QBuffer>
#include <QCoreApplication>
#include <QEvent>
#include <QFileInfo>
#include <QFontMetrics>
#include <QPdfWriter>
#include <QSvgGenerator>
#include <QToolTip>
#include <QVBoxLayout>

// The library's header is written with Qt's keywords, which our own code does without.
#define signals Q_SIGNALS
#define slots Q_SLOTS
#define foreach Q_FOREACH
#include <qcustomplot.h>
#undef signals
#undef slots
#undef foreach

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace carom {

namespace {

constexpr double pointReach = 12;                      ///< [px] from a point at which the mouse is over it
constexpr double clickSlack = 4;                       ///< [px] a click may move
const QString cursorLayer = QStringLiteral("overlay"); // of QCustomPlot
constexpr int pngScale = 2; ///< pixels of a PNG along a unit of the chart: crisp on paper

struct PlotTexts {
    Q_DECLARE_TR_FUNCTIONS(Plot)
};

QString titleOf(const ChartAxis& axis) {
    return axis.unit.isEmpty() ? axis.label : QStringLiteral("%1 [%2]").arg(axis.label, axis.unit);
}

/// The same, cut to so many pixels; the unit stays.
QString titleWithin(const ChartAxis& axis, const QFontMetrics& metrics, int length) {
    const QString whole = titleOf(axis);
    if (metrics.horizontalAdvance(whole) <= length) return whole;
    const QString unit = axis.unit.isEmpty() ? QString() : QStringLiteral(" [%1]").arg(axis.unit);
    const int room = std::max(0, length - metrics.horizontalAdvance(unit));
    return metrics.elidedText(axis.label, Qt::ElideRight, room) + unit;
}

/// What a chart is drawn with besides its series.
struct ChartColours {
    QColor ground, text, grid;
};

QColor rgb(QRgb value) { return QColor::fromRgb(value); }

/// Ticks of a logarithmic axis. Over a few decades its powers of ten alone say too little: there 1, 2 and 5
/// of each are named, as plain numbers.
class LogTicker : public QCPAxisTickerLog {
  protected:
    QVector<double> createTickVector(double step, const QCPRange& range) override {
        m_plain = std::log10(range.upper / range.lower) < fewDecades && range.lower > leastPlain &&
                  range.upper < mostPlain;
        if (!m_plain) return QCPAxisTickerLog::createTickVector(step, range);
        QVector<double> ticks;
        for (double power = std::pow(10, std::floor(std::log10(range.lower))); power <= range.upper;
             power *= 10)
            for (const double factor : {1.0, 2.0, 5.0}) ticks.append(factor * power);
        return ticks;
    }
    QString getTickLabel(double tick, const QLocale& locale, QChar format, int precision) override {
        return m_plain ? QString::number(tick, 'g', 6)
                       : QCPAxisTickerLog::getTickLabel(tick, locale, format, precision);
    }

  private:
    static constexpr double fewDecades = 3, leastPlain = 1e-4, mostPlain = 1e6;
    bool m_plain = false;
};

void dress(QCPAxis& axis, const ChartAxis& spec, const ChartColours& colours) {
    axis.setLabel(titleOf(spec));
    axis.setLabelColor(colours.text);
    axis.setTickLabelColor(colours.text);
    for (void (QCPAxis::*set)(const QPen&) :
         {&QCPAxis::setBasePen, &QCPAxis::setTickPen, &QCPAxis::setSubTickPen})
        (axis.*set)(QPen(colours.text, 1));
    axis.grid()->setPen(QPen(colours.grid, 1));
    axis.grid()->setZeroLinePen(QPen(colours.grid, 1));
    axis.setNumberFormat(spec.logarithmic ? QStringLiteral("eb") : QStringLiteral("g"));
    axis.setNumberPrecision(spec.logarithmic ? 0 : 6); // powers of ten alone
    axis.setScaleType(spec.logarithmic ? QCPAxis::stLogarithmic : QCPAxis::stLinear);
    if (spec.logarithmic)
        axis.setTicker(QSharedPointer<LogTicker>::create());
    else
        axis.setTicker(QSharedPointer<QCPAxisTicker>::create());
}

bool shows(const ChartAxis& axis, double value) {
    return std::isfinite(value) && (!axis.logarithmic || value > 0);
}

QCPScatterStyle scatterOf(const ChartSeries& series, std::size_t i, const QColor& colour,
                          const ChartColours& colours) {
    constexpr std::array shapes = {QCPScatterStyle::ssDisc, QCPScatterStyle::ssSquare,
                                   QCPScatterStyle::ssTriangle, QCPScatterStyle::ssDiamond,
                                   QCPScatterStyle::ssCross};
    const QPen thick(colour, 1.8);
    switch (series.mark) {
    case SeriesMark::Disc:
        return {QCPScatterStyle::ssDisc, colour, colour, 7};
    case SeriesMark::Square:
        return {QCPScatterStyle::ssSquare, colour, colour, 7};
    case SeriesMark::Triangle:
        return {QCPScatterStyle::ssTriangle, colour, colour, 8};
    case SeriesMark::Ring:
        return {QCPScatterStyle::ssCircle, thick, colours.ground, 7};
    case SeriesMark::Cross:
        return {QCPScatterStyle::ssCross, thick, Qt::NoBrush, 9};
    case SeriesMark::Halo:
        return {QCPScatterStyle::ssCircle, thick, Qt::NoBrush, 14};
    case SeriesMark::ByColour:
        break;
    }
    return {shapes[i % shapes.size()], colour, colour, 7};
}

/// Points in their own order, with whiskers: a curve, where addSeries draws graphs, which go from left to
/// right.
void addCurve(QCustomPlot& plot, const ChartSpec& spec, std::size_t i, const ChartColours& colours) {
    const ChartSeries& series = spec.series[i];
    const QColor colour = series.colour.value_or(seriesColour(i));
    QCPCurve* curve = new QCPCurve(plot.xAxis, plot.yAxis);
    curve->setName(series.name);
    QVector<double> x, y, below, above;
    for (std::size_t k = 0; k < std::min(series.x.size(), series.y.size()); ++k) {
        if (!shows(spec.x, series.x[k]) || !shows(spec.y, series.y[k])) continue;
        x.append(series.x[k]);
        y.append(series.y[k]);
        if (series.low.size() <= k || series.high.size() <= k) continue;
        below.append(series.y[k] - series.low[k]);
        above.append(series.high[k] - series.y[k]);
    }
    curve->setData(x, y);
    curve->setPen(QPen(colour, 1.8, series.dashed ? Qt::DashLine : Qt::SolidLine));
    if (series.style != SeriesStyle::Line) curve->setScatterStyle(scatterOf(series, i, colour, colours));
    if (series.style == SeriesStyle::Marks) curve->setLineStyle(QCPCurve::lsNone);
    if (!series.inLegend) curve->removeFromLegend();
    if (below.isEmpty() || below.size() != x.size()) return;
    QCPErrorBars* whiskers = new QCPErrorBars(plot.xAxis, plot.yAxis);
    whiskers->setDataPlottable(curve);
    whiskers->setData(below, above);
    whiskers->setPen(QPen(colour, 1));
    whiskers->setSymbolGap(0);
    whiskers->setWhiskerWidth(5);
    whiskers->removeFromLegend();
}

void addSeries(QCustomPlot& plot, const ChartSpec& spec, const ChartColours& colours) {
    std::vector<double> stack; // heights of the areas so far
    QCPGraph* below = nullptr;
    for (std::size_t i = 0; i < spec.series.size(); ++i) {
        const ChartSeries& series = spec.series[i];
        if (series.inOrder) {
            addCurve(plot, spec, i, colours);
            continue;
        }
        const QColor colour = series.colour.value_or(seriesColour(i));
        QCPGraph* graph = plot.addGraph();
        graph->setName(series.name);
        graph->setAdaptiveSampling(series.style != SeriesStyle::Stacked); // areas must share their corners
        const bool stacked = series.style == SeriesStyle::Stacked;
        if (stacked) stack.resize(std::max(stack.size(), series.y.size()), 0);
        QVector<double> x, y;
        for (std::size_t k = 0; k < std::min(series.x.size(), series.y.size()); ++k) {
            if (stacked && std::isfinite(series.y[k])) stack[k] += series.y[k];
            const double height = stacked ? stack[k] : series.y[k];
            if (!shows(spec.x, series.x[k]) || !shows(spec.y, height)) continue;
            x.append(series.x[k]);
            y.append(height);
        }
        graph->setData(x, y);
        if (stacked) {
            graph->setPen(Qt::NoPen);
            graph->setBrush(colour);
            if (below) graph->setChannelFillGraph(below);
            below = graph;
            continue;
        }
        graph->setPen(QPen(colour, 1.8));
        if (series.style != SeriesStyle::Line) graph->setScatterStyle(scatterOf(series, i, colour, colours));
        if (series.style == SeriesStyle::Marks) graph->setLineStyle(QCPGraph::lsNone);
    }
}

/// How far up the axis a value is, 0 to 1.
double shareOfAxis(const QCPAxis& axis, double value) {
    const QCPRange range = axis.range();
    if (axis.scaleType() == QCPAxis::stLogarithmic)
        return std::log(value / range.lower) / std::log(range.upper / range.lower);
    return (value - range.lower) / range.size();
}

/// Once the axes are fitted: a level at the very top has its name below it.
void addLevels(QCustomPlot& plot, const ChartSpec& spec, const ChartColours& colours) {
    constexpr double top = 0.92;
    for (const ChartLevel& level : spec.levels) {
        QCPItemStraightLine* line = new QCPItemStraightLine(&plot);
        line->point1->setCoords(0, level.y);
        line->point2->setCoords(1, level.y);
        line->setPen(QPen(colours.text, 1, Qt::DashLine));
        QCPItemText* label = new QCPItemText(&plot);
        label->setText(level.label);
        label->setColor(colours.text);
        QColor ground = colours.ground;
        ground.setAlpha(190);
        label->setBrush(ground);
        label->setPadding(QMargins(3, 0, 3, 0));
        const double share = shareOfAxis(*plot.yAxis, level.y);
        const bool below = share > top;
        label->setPositionAlignment(Qt::AlignLeft | (below ? Qt::AlignTop : Qt::AlignBottom));
        if (level.alwaysShown && (share > 1 || share < 0)) { // far away: an arrow shows where
            label->setText((share > 1 ? QStringLiteral("\u2191 ") : QStringLiteral("\u2193 ")) + level.label);
            label->position->setType(QCPItemPosition::ptAxisRectRatio);
            label->position->setCoords(0.01, share > 1 ? 0.01 : 0.99);
            continue;
        }
        label->position->setTypeX(QCPItemPosition::ptAxisRectRatio);
        label->position->setTypeY(QCPItemPosition::ptPlotCoords);
        label->position->setCoords(0.01, level.y);
    }
}

/// Room for the marks at both ends of a logarithmic axis.
void widen(QCPAxis& axis) {
    constexpr double room = 0.03, leastRoom = 0.1; // of its length, in powers of e
    const double length = std::log(axis.range().upper / axis.range().lower);
    const double factor = std::exp(std::max(room * length, leastRoom));
    axis.setRange(axis.range().lower / factor, axis.range().upper * factor);
}

/// As many columns of the legend as the longest name leaves room for.
int legendColumns(const QCustomPlot& plot, const ChartSpec& spec) {
    constexpr int mark = 50, most = 6; // [px] of a mark with its margins
    int longest = 1;
    const QFontMetrics metrics(plot.legend->font());
    for (const ChartSeries& series : spec.series)
        if (series.inLegend) longest = std::max(longest, metrics.horizontalAdvance(series.name));
    return std::clamp(plot.width() / (longest + mark), 1, most);
}

/// Whether an axis that reaches to the value as well still has most of its length for what it showed before.
bool isNear(const QCPAxis& axis, double value) {
    constexpr double extra = 0.25; // of its length
    const double share = shareOfAxis(axis, value);
    return share >= -extra && share <= 1 + extra;
}

void fit(QCustomPlot& plot, const ChartSpec& spec) {
    plot.rescaleAxes();
    const bool stacked = std::any_of(spec.series.begin(), spec.series.end(), [](const ChartSeries& series) {
        return series.style == SeriesStyle::Stacked;
    });
    for (const ChartLevel& level : spec.levels)
        if (level.alwaysShown && shows(spec.y, level.y) && isNear(*plot.yAxis, level.y)) {
            QCPRange range = plot.yAxis->range();
            range.expand(level.y);
            plot.yAxis->setRange(range);
        }
    if (spec.y.logarithmic) {
        widen(*plot.yAxis);
    } else {
        double highest = plot.yAxis->range().upper;
        for (const ChartLevel& level : spec.levels) highest = std::max(highest, level.y);
        const double lowest = std::min(0.0, plot.yAxis->range().lower);
        const double room = 0.06 * (highest - lowest);
        plot.yAxis->setRange(lowest < 0 ? lowest - room : lowest, highest + room);
    }
    if (!spec.x.logarithmic && !stacked) plot.xAxis->scaleRange(1.04);
    if (spec.x.logarithmic) widen(*plot.xAxis);
}

/// The sentence in lines that fit the width [px].
QString broken(const QCustomPlot& plot, const QString& sentence, int width) {
    constexpr double part = 0.9; // of the width
    const QFontMetrics metrics(plot.font());
    QString lines, line;
    for (const QString& word : sentence.split(QLatin1Char(' '))) {
        if (!line.isEmpty() && metrics.horizontalAdvance(line + QLatin1Char(' ') + word) > part * width) {
            lines += line + QLatin1Char('\n');
            line.clear();
        }
        line += (line.isEmpty() ? QString() : QStringLiteral(" ")) + word;
    }
    return lines + line;
}

/// A text above everything that is there.
void addHeading(QCustomPlot& plot, const QString& text, const QFont& font, const ChartColours& colours) {
    QCPTextElement* heading = new QCPTextElement(&plot, text);
    heading->setTextColor(colours.text);
    heading->setFont(font);
    plot.plotLayout()->insertRow(0);
    plot.plotLayout()->addElement(0, 0, heading);
}

/// Of a column with all names [px].
int widthOfNames(const QCustomPlot& plot, const ChartSpec& spec) {
    constexpr int mark = 60; // with its margins
    const QFontMetrics metrics(plot.legend->font());
    int longest = 0;
    for (const ChartSeries& series : spec.series)
        if (series.inLegend) longest = std::max(longest, metrics.horizontalAdvance(series.name));
    return longest + mark;
}

/// For the names in a column beside the axes.
bool hasRoomBeside(const QCustomPlot& plot, const ChartSpec& spec) {
    constexpr double most = 0.4; // of the width
    const auto rows = static_cast<int>(
        std::ranges::count_if(spec.series, [](const ChartSeries& series) { return series.inLegend; }));
    return widthOfNames(plot, spec) < most * plot.width() &&
           rows * QFontMetrics(plot.legend->font()).lineSpacing() < plot.height();
}

enum class LegendPlace { None, Beside, Below };

LegendPlace legendPlaceOf(const QCustomPlot& plot, const ChartSpec& spec) {
    if (!spec.legend || spec.series.size() < 2) return LegendPlace::None;
    if (spec.legendBeside && hasRoomBeside(plot, spec)) return LegendPlace::Beside;
    return plot.height() >= spec.leastForBelow ? LegendPlace::Below : LegendPlace::None;
}

/// Beside or below the axes instead of over the curves; one that is not shown would keep its place there.
void placeLegend(QCustomPlot& plot, bool named, bool beside) {
    QCPLayoutGrid& grid = *plot.plotLayout();
    if (plot.legend->layout() == &grid)
        grid.take(plot.legend);
    else
        plot.axisRect()->insetLayout()->take(plot.legend);
    grid.simplify();
    if (!named) {
        plot.axisRect()->insetLayout()->addElement(plot.legend, Qt::AlignTop);
        return;
    }
    int row = 0; // of the axes, below the headings
    while (row < grid.rowCount() && grid.element(row, 0) != plot.axisRect()) ++row;
    grid.addElement(beside ? row : grid.rowCount(), beside ? 1 : 0, plot.legend);
}

void draw(QCustomPlot& plot, const ChartSpec& spec, const ChartColours& colours) {
    plot.clearItems();
    plot.clearPlottables();
    QCPLayoutGrid& grid = *plot.plotLayout();
    while (qobject_cast<QCPTextElement*>(grid.element(0, 0))) { // title and note of the chart before
        grid.removeAt(0);
        grid.simplify();
    }
    plot.setBackground(colours.ground);
    dress(*plot.xAxis, spec.x, colours);
    dress(*plot.yAxis, spec.y, colours);
    addSeries(plot, spec, colours);
    QFont bold = plot.font();
    bold.setBold(true);
    const LegendPlace legend = legendPlaceOf(plot, spec);
    const bool named = legend != LegendPlace::None, beside = legend == LegendPlace::Beside;
    const int names = beside ? widthOfNames(plot, spec) : 0;
    if (!spec.note.isEmpty())
        addHeading(plot, broken(plot, spec.note, plot.width() - names), plot.font(), colours);
    if (!spec.title.isEmpty()) addHeading(plot, spec.title, bold, colours);
    placeLegend(plot, named, beside);
    plot.legend->setBrush(Qt::NoBrush);
    plot.legend->setBorderPen(Qt::NoPen);
    plot.legend->setTextColor(colours.text);
    plot.legend->setWrap(beside ? 1 : legendColumns(plot, spec));
    plot.legend->setFillOrder(QCPLegend::foColumnsFirst); // places the entries anew
    plot.legend->setRowSpacing(0);
    plot.legend->setMinimumSize(names, 0);
    if (beside)
        grid.setColumnStretchFactor(1, 0.001);
    else if (named)
        grid.setRowStretchFactor(grid.rowCount() - 1, 0.001);
    plot.legend->setVisible(named);
    fit(plot, spec);
    addLevels(plot, spec, colours);
}

QByteArray encoded(QCustomPlot& plot, const QString& ending, const QSize& size) {
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    if (ending == QLatin1StringView("png")) {
        plot.toPixmap(size.width(), size.height(), pngScale).save(&buffer, "PNG");
    } else if (ending == QLatin1StringView("svg")) {
        QSvgGenerator svg;
        svg.setOutputDevice(&buffer);
        svg.setSize(size);
        svg.setViewBox(QRect(QPoint(0, 0), size));
        QCPPainter painter;
        painter.begin(&svg);
        painter.setMode(QCPPainter::pmVectorized);
        painter.setMode(QCPPainter::pmNoCaching);
        plot.toPainter(&painter, size.width(), size.height());
        painter.end();
    } else {
        QPdfWriter pdf(&buffer);
        constexpr double pointsPerUnit = 0.75; // a unit is 1/96 inch
        pdf.setPageSize(QPageSize(QSizeF(size) * pointsPerUnit, QPageSize::Point));
        pdf.setPageMargins(QMarginsF());
        pdf.setResolution(96);
        QCPPainter painter;
        painter.begin(&pdf);
        painter.setMode(QCPPainter::pmVectorized);
        painter.setMode(QCPPainter::pmNoCaching);
        plot.toPainter(&painter, size.width(), size.height());
        painter.end();
    }
    return bytes;
}

} // namespace

QColor seriesColour(std::size_t i) {
    // M. Okabe, K. Ito, "Color Universal Design" (2008), without black and its palest yellow.
    static const std::array colours = {rgb(0x0072B2), rgb(0xE69F00), rgb(0x009E73), rgb(0xCC79A7),
                                       rgb(0x56B4E9), rgb(0xD55E00), rgb(0x8C8C8C)};
    return colours[i % colours.size()];
}

QString writeChart(const ChartSpec& spec, const QString& path, const QSize& size) {
    const QString ending = QFileInfo(path).suffix().toLower();
    if (ending != QLatin1StringView("png") && ending != QLatin1StringView("svg") &&
        ending != QLatin1StringView("pdf"))
        return PlotTexts::tr("`%1` has no ending of a chart; name it .png, .svg or .pdf").arg(path);
    QCustomPlot plot;
    plot.resize(size);
    draw(plot, spec, {Qt::white, rgb(0x202428), rgb(0xDADDE2)});
    const QByteArray bytes = encoded(plot, ending, size);
    return saveFile(path, bytes);
}

PlotWidget::PlotWidget(QWidget* parent) : QWidget(parent), m_plot(new QCustomPlot(this)) {
    QVBoxLayout* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(m_plot);
    m_plot->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
    m_plot->setMinimumSize(160, 100);
    connect(m_plot, &QCustomPlot::mouseDoubleClick, this, [this] {
        fit(*m_plot, m_spec);
        m_plot->replot();
    });
    m_plot->setMouseTracking(true);
    connect(m_plot, &QCustomPlot::mouseMove, this, [this](const QMouseEvent* event) {
        const Hit hit = pointNear(event->position());
        if (hit.series < 0) {
            QToolTip::hideText();
            return;
        }
        const ChartSeries& series = m_spec.series[static_cast<std::size_t>(hit.series)];
        QToolTip::showText(event->globalPosition().toPoint(),
                           series.notes[static_cast<std::size_t>(hit.point)], m_plot);
    });
    connect(m_plot, &QCustomPlot::mousePress, this,
            [this](const QMouseEvent* event) { m_pressed = event->position(); });
    connect(m_plot, &QCustomPlot::mouseRelease, this, [this](const QMouseEvent* event) {
        if ((event->position() - m_pressed).manhattanLength() > clickSlack) return; // dragged
        const Hit hit = pointNear(event->position());
        if (hit.series >= 0)
            Q_EMIT pointClicked(hit.series, hit.point);
        else if (event->button() == Qt::LeftButton && m_plot->axisRect()->rect().contains(event->pos()))
            Q_EMIT placeClicked(m_plot->xAxis->pixelToCoord(event->position().x()));
    });
    connect(m_plot, &QCustomPlot::afterLayout, this, [this] {
        const QRect axes = m_plot->axisRect()->rect();
        for (const auto& [axis, spec, length] : {std::tuple(m_plot->xAxis, &m_spec.x, axes.width()),
                                                 std::tuple(m_plot->yAxis, &m_spec.y, axes.height())})
            axis->setLabel(titleWithin(*spec, QFontMetrics(axis->labelFont()), length));
    });
    setChart({});
}

PlotWidget::Hit PlotWidget::pointNear(const QPointF& place) const {
    Hit nearest;
    double least = pointReach;
    for (std::size_t s = 0; s < m_spec.series.size(); ++s) {
        const ChartSeries& series = m_spec.series[s];
        for (std::size_t k = 0; k < std::min(series.notes.size(), series.x.size()); ++k) {
            if (!shows(m_spec.x, series.x[k]) || !shows(m_spec.y, series.y[k])) continue;
            const QPointF point(m_plot->xAxis->coordToPixel(series.x[k]),
                                m_plot->yAxis->coordToPixel(series.y[k]));
            const double away = std::hypot(point.x() - place.x(), point.y() - place.y());
            if (away >= least) continue;
            least = away;
            nearest = {static_cast<int>(s), static_cast<int>(k)};
        }
    }
    return nearest;
}

void PlotWidget::setChart(const ChartSpec& spec) {
    m_spec = spec;
    const QColor ground = palette().color(QPalette::Base);
    const QColor text = palette().color(QPalette::Text);
    QColor grid = text;
    grid.setAlpha(40);
    draw(*m_plot, m_spec, {ground, text, grid});
    m_cursorLine = nullptr;
    showCursor();
    m_plot->replot(QCustomPlot::rpQueuedReplot);
}

void PlotWidget::setCursor(std::optional<double> x) {
    if (x == m_cursor) return;
    m_cursor = x;
    showCursor();
    if (isVisible()) m_plot->layer(cursorLayer)->replot(); // one that is hidden would be drawn as a whole
}

void PlotWidget::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    m_plot->replot(QCustomPlot::rpQueuedReplot); // the cursor may have moved
}

/// On a layer with a picture of its own: a run moves it sixty times a second.
void PlotWidget::showCursor() {
    if (m_cursorLine == nullptr) {
        m_cursorLine = new QCPItemStraightLine(m_plot);
        m_cursorLine->setLayer(cursorLayer);
        m_cursorLine->setSelectable(false);
    }
    m_cursorLine->setVisible(m_cursor.has_value());
    if (!m_cursor) return;
    m_cursorLine->setPen(QPen(palette().color(QPalette::Highlight), 1.5));
    m_cursorLine->point1->setCoords(*m_cursor, 0);
    m_cursorLine->point2->setCoords(*m_cursor, 1);
}

/// Another size may have room for the names of the series, or none.
void PlotWidget::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    const bool named = legendPlaceOf(*m_plot, m_spec) != LegendPlace::None;
    if (named != showsLegend()) setChart(ChartSpec(m_spec));
}

bool PlotWidget::showsLegend() const { return m_plot->legend->visible(); }

QString PlotWidget::labelOfY() const { return m_plot->yAxis->label(); }

double PlotWidget::xOf(double x) const { return m_plot->xAxis->coordToPixel(x); }

void PlotWidget::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) setChart(ChartSpec(m_spec));
}

} // namespace carom

#include "moc_plot.cpp"
