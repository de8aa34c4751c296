// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/plot_drawing.h"

#include "ui/widgets/qcustomplot_header.h"

#include <QFontMetrics>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace carom {
namespace {

QString titleOf(const ChartAxis& axis) {
    return axis.unit.isEmpty() ? axis.label : QStringLiteral("%1 [%2]").arg(axis.label, axis.unit);
}

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
    // Decades up to which numbers between have labels, too, and the range of numbers without an exponent:
    // longer labels would overlap.
    static constexpr double fewDecades = 3, leastPlain = 1e-4, mostPlain = 1e6;
    bool m_plain = false;
};

/// Names at whole numbers; of many every second, fifth, ...
QSharedPointer<QCPAxisTicker> tickerOf(const std::vector<QString>& names) {
    constexpr std::size_t most = 12;
    const QSharedPointer<QCPAxisTickerText> ticker = QSharedPointer<QCPAxisTickerText>::create();
    std::size_t stride = 1;
    for (const std::size_t wider : {2U, 5U, 10U, 20U, 50U, 100U, 1000U, 10000U})
        if (names.size() / stride > most) stride = wider;
    for (std::size_t i = 0; i < names.size(); i += stride) ticker->addTick(static_cast<double>(i), names[i]);
    return ticker;
}

void dress(QCPAxis& axis, const ChartAxis& spec, const ChartColours& colours) {
    axis.setLabel(titleOf(spec));
    axis.setLabelColor(colours.text);
    axis.setTickLabelColor(colours.text);
    axis.setLabelFont(axis.parentPlot()->font()); // those of its making are the application's
    axis.setTickLabelFont(axis.parentPlot()->font());
    for (void (QCPAxis::*set)(const QPen&) :
         {&QCPAxis::setBasePen, &QCPAxis::setTickPen, &QCPAxis::setSubTickPen})
        (axis.*set)(QPen(colours.text, 1));
    axis.grid()->setPen(QPen(colours.grid, 1));
    axis.grid()->setZeroLinePen(QPen(colours.grid, 1));
    axis.setNumberFormat(spec.logarithmic ? QStringLiteral("eb") : QStringLiteral("g"));
    axis.setNumberPrecision(spec.logarithmic ? 0 : 6); // powers of ten alone
    axis.setScaleType(spec.logarithmic ? QCPAxis::stLogarithmic : QCPAxis::stLinear);
    if (!spec.names.empty())
        axis.setTicker(tickerOf(spec.names));
    else if (spec.logarithmic)
        axis.setTicker(QSharedPointer<LogTicker>::create());
    else
        axis.setTicker(QSharedPointer<QCPAxisTicker>::create());
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

/// The area between two graphs that are not seen themselves.
void addBand(QCustomPlot& plot, const ChartSpec& spec, std::size_t i) {
    const ChartSeries& series = spec.series[i];
    constexpr int pale = 45; // of 255
    QColor colour = series.colour.value_or(seriesColour(i));
    colour.setAlpha(pale);
    QVector<double> x, low, high;
    for (std::size_t k = 0; k < std::min({series.x.size(), series.low.size(), series.high.size()}); ++k) {
        if (!shows(spec.x, series.x[k]) || !shows(spec.y, series.low[k]) || !shows(spec.y, series.high[k]))
            continue;
        x.append(series.x[k]);
        low.append(series.low[k]);
        high.append(series.high[k]);
    }
    QCPGraph *below = plot.addGraph(), *above = plot.addGraph();
    below->setData(x, low);
    above->setData(x, high);
    for (QCPGraph* graph : {below, above}) {
        graph->setAdaptiveSampling(false); // both must share their corners
        graph->setPen(Qt::NoPen);
        graph->removeFromLegend();
    }
    above->setBrush(colour);
    above->setChannelFillGraph(below);
}

/// From dark to light without a step, and told apart with every kind of colour vision: five of the colours of
/// viridis (S. van der Walt, N. Smith, 2015).
QCPColorGradient mapColours() {
    QCPColorGradient gradient;
    gradient.setColorStops({{0, rgb(0x440154)},
                            {0.25, rgb(0x3B528B)},
                            {0.5, rgb(0x21918C)},
                            {0.75, rgb(0x5EC962)},
                            {1, rgb(0xFDE725)}});
    gradient.setNanHandling(QCPColorGradient::nhTransparent);
    return gradient;
}

void addMap(QCustomPlot& plot, const ChartMap& map, const ChartColours& colours) {
    const int columns = static_cast<int>(map.columns), rows = static_cast<int>(map.rows);
    QCPColorMap* cells = new QCPColorMap(plot.xAxis, plot.yAxis);
    cells->removeFromLegend();
    cells->data()->setSize(columns, rows);
    cells->data()->setRange({0, std::max(1.0, columns - 1.0)}, {0, std::max(1.0, rows - 1.0)});
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const double value = map.values[static_cast<std::size_t>(row * columns + column)];
            cells->data()->setCell(column, row, value);
            if (!std::isfinite(value)) continue;
            least = std::min(least, value);
            most = std::max(most, value);
        }
    if (map.range) std::tie(least, most) = *map.range;
    cells->setInterpolate(false);
    cells->setGradient(mapColours());
    if (!(least <= most)) return; // a scale would say values that there are not
    QCPColorScale* scale = new QCPColorScale(&plot);
    int row = 0; // of the axes, below the headings
    while (row < plot.plotLayout()->rowCount() && plot.plotLayout()->element(row, 0) != plot.axisRect())
        ++row;
    plot.plotLayout()->addElement(row, 1, scale);
    plot.plotLayout()->setColumnStretchFactor(1, 0.001);
    scale->setType(QCPAxis::atRight);
    QCPMarginGroup* sameHeight = new QCPMarginGroup(&plot);
    for (QCPLayoutElement* element :
         {static_cast<QCPLayoutElement*>(plot.axisRect()), static_cast<QCPLayoutElement*>(scale)})
        element->setMarginGroup(QCP::msTop | QCP::msBottom, sameHeight);
    dress(*scale->axis(), map.scale, colours);
    cells->setColorScale(scale);
    cells->setGradient(mapColours()); // this time of the scale, too

    const double half = most > least ? 0 : std::max(0.05 * std::abs(most), 1e-9); // about the only value
    cells->setDataRange({least - half, most + half});
}

void addSeries(QCustomPlot& plot, const ChartSpec& spec, const ChartColours& colours) {
    std::vector<double> stack; // heights of the areas so far
    QCPGraph* below = nullptr;
    for (std::size_t i = 0; i < spec.series.size(); ++i) {
        const ChartSeries& series = spec.series[i];
        if (series.style == SeriesStyle::Band) {
            addBand(plot, spec, i);
            continue;
        }
        if (series.inOrder) {
            addCurve(plot, spec, i, colours);
            continue;
        }
        const QColor colour = series.colour.value_or(seriesColour(i));
        QCPGraph* graph = plot.addGraph();
        graph->setName(series.name);
        if (spec.map) graph->setLayer(QStringLiteral("axes"));            // above the cells
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

/// A part of the axes' rectangle, from 0 to 1 from its lower left corner.
struct Part {
    double left, width, bottom, height;
};

/// How many points of the series lie in a part, or so near that their marks do.
int pointsIn(const QCustomPlot& plot, const ChartSpec& spec, const Part& part, const QSizeF& axes) {
    constexpr double mark = 6; // [px]
    const double aside = mark / axes.width(), above = mark / axes.height();
    int count = 0;
    for (const ChartSeries& series : spec.series)
        for (std::size_t k = 0; k < std::min(series.x.size(), series.y.size()); ++k) {
            if (!shows(spec.x, series.x[k]) || !shows(spec.y, series.y[k])) continue;
            const double x = shareOfAxis(*plot.xAxis, series.x[k]) - part.left;
            const double y = shareOfAxis(*plot.yAxis, series.y[k]) - part.bottom;
            if (x > -aside && x < part.width + aside && y > -above && y < part.height + above) ++count;
        }
    return count;
}

/// Where along the axis of x a part covers the fewest points, from one end to the other: its left edge.
double freePlace(const QCustomPlot& plot, const ChartSpec& spec, Part part, const QSizeF& axes,
                 bool fromTheRight) {
    constexpr double edge = 0.01;
    constexpr int places = 20;
    const double last = std::max(edge, 1 - edge - part.width);
    double best = edge;
    int fewest = std::numeric_limits<int>::max();
    for (int i = 0; i <= places && fewest > 0; ++i) {
        const double way = static_cast<double>(fromTheRight ? places - i : i) / places;
        part.left = edge + way * (last - edge);
        const int covered = pointsIn(plot, spec, part, axes);
        if (covered >= fewest) continue;
        fewest = covered;
        best = part.left;
    }
    return best;
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

/// Of the title and the note above the axes, where the names beside them have a width of `names` [px].
int heightOfHeadings(const QCustomPlot& plot, const ChartSpec& spec, int names) {
    constexpr int margins = 9; // [px] of each: what its text element and the layout leave free
    const int line = QFontMetrics(plot.font()).lineSpacing();
    int height = spec.title.isEmpty() ? 0 : line + margins;
    if (!spec.note.isEmpty())
        height +=
            static_cast<int>(1 + broken(plot, spec.note, plot.width() - names).count(u'\n')) * line + margins;
    return height;
}

/// For the names in a column beside the axes, a row each, below the headings.
bool hasRoomBeside(const QCustomPlot& plot, const ChartSpec& spec) {
    constexpr double most = 0.45; // of the width
    const auto rows = static_cast<int>(
        std::ranges::count_if(spec.series, [](const ChartSeries& series) { return series.inLegend; }));
    const int row =
        std::max(QFontMetrics(plot.legend->font()).lineSpacing(), plot.legend->iconSize().height());
    const QMargins margins = plot.legend->margins();
    const int names = widthOfNames(plot, spec);
    return names < most * plot.width() &&
           heightOfHeadings(plot, spec, names) + rows * row + margins.top() + margins.bottom() <=
               plot.height();
}

/// The axes have their places when the plot is drawn: about so much of it is theirs [px].
QSizeF sizeOfAxes(const QCustomPlot& plot, const ChartSpec& spec) {
    constexpr double part = 0.8; // of what the names leave
    const int names = spec.legendBeside && hasRoomBeside(plot, spec) ? widthOfNames(plot, spec) : 0;
    return {part * std::max(1, plot.width() - names), part * std::max(1, plot.height())};
}

/// Once the axes are fitted: a level at the very top has its name below it, and one that is far away an arrow
/// that shows where; both beside the points.
void addLevels(QCustomPlot& plot, const ChartSpec& spec, const ChartColours& colours) {
    constexpr double top = 0.92, edge = 0.01;
    const QSizeF axes = sizeOfAxes(plot, spec);
    for (const ChartLevel& level : spec.levels) {
        QCPItemStraightLine* line = new QCPItemStraightLine(&plot);
        line->point1->setCoords(0, level.y);
        line->point2->setCoords(1, level.y);
        line->setPen(QPen(colours.text, 1, Qt::DashLine));
        QCPItemText* label = new QCPItemText(&plot);
        label->setText(level.label);
        label->setFont(plot.font());
        label->setColor(colours.text);
        QColor ground = colours.ground;
        ground.setAlpha(190);
        label->setBrush(ground);
        constexpr int padding = 3; // [px]
        label->setPadding(QMargins(padding, 0, padding, 0));
        const double share = shareOfAxis(*plot.yAxis, level.y);
        const bool below = share > top;
        const bool isFar = level.alwaysShown && (share > 1 || share < 0);
        if (isFar)
            label->setText((share > 1 ? QStringLiteral("\u2191 ") : QStringLiteral("\u2193 ")) + level.label);
        const QFontMetrics metrics(label->font());
        const double height = metrics.height() / axes.height();
        const double at = isFar ? (share > 1 ? 1 - edge : edge) : share;
        const Part part{.left = 0,
                        .width = (metrics.horizontalAdvance(label->text()) + 2 * padding) / axes.width(),
                        .bottom = below ? at - height : at,
                        .height = height};
        // From the right where it is far, since the dearest settings are on the left.
        const double left = freePlace(plot, spec, part, axes, isFar);
        label->position->setTypeX(QCPItemPosition::ptAxisRectRatio);
        label->position->setTypeY(isFar ? QCPItemPosition::ptAxisRectRatio : QCPItemPosition::ptPlotCoords);
        // Held by its end nearer to the edge: it is whole even where the axes are narrower than supposed.
        const bool onTheRight = left + 0.5 * part.width > 0.5;
        label->setPositionAlignment((onTheRight ? Qt::AlignRight : Qt::AlignLeft) |
                                    (below ? Qt::AlignTop : Qt::AlignBottom));
        label->position->setCoords(onTheRight ? left + part.width : left, isFar ? 1 - at : level.y);
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

/// A text above everything that is there.
void addHeading(QCustomPlot& plot, const QString& text, const QFont& font, const ChartColours& colours) {
    QCPTextElement* heading = new QCPTextElement(&plot, text);
    heading->setTextColor(colours.text);
    heading->setFont(font);
    plot.plotLayout()->insertRow(0);
    plot.plotLayout()->addElement(0, 0, heading);
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

} // namespace

QColor seriesColour(std::size_t i) {
    // M. Okabe, K. Ito, "Color Universal Design" (2008), without black and its palest yellow.
    static const std::array colours = {rgb(0x0072B2), rgb(0xE69F00), rgb(0x009E73), rgb(0xCC79A7),
                                       rgb(0x56B4E9), rgb(0xD55E00), rgb(0x8C8C8C)};
    return colours[i % colours.size()];
}

QString titleWithin(const ChartAxis& axis, const QFontMetrics& metrics, int length) {
    const QString whole = titleOf(axis);
    if (metrics.horizontalAdvance(whole) <= length) return whole;
    const QString unit = axis.unit.isEmpty() ? QString() : QStringLiteral(" [%1]").arg(axis.unit);
    const int room = std::max(0, length - metrics.horizontalAdvance(unit));
    return metrics.elidedText(axis.label, Qt::ElideRight, room) + unit;
}

LegendPlace legendPlaceOf(const QCustomPlot& plot, const ChartSpec& spec) {
    if (!spec.legend || spec.series.size() < 2) return LegendPlace::None;
    if (spec.legendBeside && hasRoomBeside(plot, spec)) return LegendPlace::Beside;
    return plot.height() >= spec.leastForBelow ? LegendPlace::Below : LegendPlace::None;
}

bool shows(const ChartAxis& axis, double value) {
    return std::isfinite(value) && (!axis.logarithmic || value > 0);
}

void fitAxes(QCustomPlot& plot, const ChartSpec& spec) {
    if (spec.map) {
        plot.xAxis->setRange(-0.5, static_cast<double>(spec.map->columns) - 0.5);
        plot.yAxis->setRange(-0.5, static_cast<double>(spec.map->rows) - 0.5);
        return;
    }
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

void drawChart(QCustomPlot& plot, const ChartSpec& spec, const ChartColours& colours) {
    plot.clearItems();
    plot.clearPlottables();
    QCPLayoutGrid& grid = *plot.plotLayout();
    for (int row = 0; row < grid.rowCount(); ++row) // the scale of a map before
        if (grid.hasElement(row, 1) && qobject_cast<QCPColorScale*>(grid.element(row, 1)))
            grid.remove(grid.element(row, 1));
    plot.axisRect()->setMarginGroup(QCP::msTop | QCP::msBottom, nullptr);
    grid.simplify();
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
    plot.legend->setFont(plot.font());
    const LegendPlace legend = legendPlaceOf(plot, spec);
    const bool named = legend != LegendPlace::None, beside = legend == LegendPlace::Beside;
    const int names = beside ? widthOfNames(plot, spec) : 0;
    if (!spec.note.isEmpty())
        addHeading(plot, broken(plot, spec.note, plot.width() - names), plot.font(), colours);
    if (!spec.title.isEmpty()) addHeading(plot, spec.title, bold, colours);
    placeLegend(plot, named, beside);
    if (spec.map) addMap(plot, *spec.map, colours);
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
    fitAxes(plot, spec);
    addLevels(plot, spec, colours);
}

} // namespace carom
