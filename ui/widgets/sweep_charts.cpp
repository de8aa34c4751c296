// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/sweep_charts.h"

#include "core/base/text.h"
#include "core/simulation/quantities.h"
#include "ui/widgets/text_of.h"

#include <QCoreApplication>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace carom {
namespace {

/// Lines of a chart and maps at most: as many as there are colours to tell apart, and as fit one above the
/// other.
constexpr std::size_t mostLines = 6, mostMaps = 12;
/// Of a cell whose run is not made yet.
constexpr std::size_t noRun = std::numeric_limits<std::size_t>::max();

constexpr const char* runsOfPointText = QT_TRANSLATE_NOOP("SweepCharts", "%1 runs a point");
constexpr const char* bandsText =
    QT_TRANSLATE_NOOP("SweepCharts", "line: median, bands: half of the runs, and nine of ten");
constexpr const char* nothingText = QT_TRANSLATE_NOOP("SweepCharts", "no run gave a value");
constexpr const char* medianText = QT_TRANSLATE_NOOP("SweepCharts", "%1, median");

/// One axis of the points, by the first of its parameters.
struct PointAxis {
    const SweptParameter* parameter = nullptr;
    std::size_t count = 1;
    std::size_t stride = 1; ///< points from one of its values to the next

    std::size_t indexOf(std::size_t point) const { return point / stride % count; }
    bool isNumeric() const {
        return std::ranges::all_of(parameter->values,
                                   [](const std::string& value) { return numberIn(value).has_value(); });
    }
    bool isLogarithmic(const SweepDefinition& definition) const {
        return std::ranges::any_of(definition.vary, [this](const std::string& vary) {
            return vary.starts_with(parameter->name + "=log ");
        });
    }
};

std::vector<PointAxis> axesOf(const Sweep& sweep) {
    std::vector<PointAxis> axes;
    for (const SweepAxis& axis : sweep.axes())
        if (!axis.isReplication)
            axes.push_back({&sweep.parameters()[axis.parameters.front()], axis.count, 1});
    std::size_t stride = 1;
    for (auto axis = axes.rbegin(); axis != axes.rend(); ++axis) {
        axis->stride = stride;
        stride *= axis->count;
    }
    return axes;
}

/// An axis of numbers, or of the values as they are written.
ChartAxis chartAxisOf(const PointAxis& axis, const SweepDefinition& definition, bool byName) {
    ChartAxis chart{.label = textOf(axis.parameter->name),
                    .unit = {},
                    .logarithmic = !byName && axis.isLogarithmic(definition)};
    if (byName)
        for (const std::string& value : axis.parameter->values) chart.names.push_back(textOf(value));
    return chart;
}

QString unitOf(const SweepMeasure& measure) {
    if (measure.kind == MeasureKind::First) return QStringLiteral("s");
    for (const bool ofBody : {!measure.of.empty(), measure.of.empty()})
        if (const QuantityRow* row = quantityNamed(measure.quantity, ofBody)) return textOf(row->unit);
    return measure.quantity == "distance" ? QStringLiteral("m") : QString();
}

class Charts {
  public:
    Charts(const Sweep& sweep, const std::vector<SweepPoint>& points, ChartWords words)
        : m_sweep(sweep), m_points(points), m_axes(axesOf(sweep)), m_several(sweep.runsOfPoint() > 1),
          m_words(words) {
        for (std::size_t k = 1; k < m_axes.size(); ++k)
            if (m_axes[k].count > m_axes[m_along].count) m_along = k;
        for (std::size_t k = 0; k < m_axes.size(); ++k)
            if (k != m_along) m_lines *= m_axes[k].count;
        // Of a map: the two longest, the one given first upwards.
        std::size_t next = m_along == 0 ? 1 : 0;
        for (std::size_t k = 0; k < m_axes.size(); ++k)
            if (k != m_along && m_axes[k].count > m_axes[next].count) next = k;
        m_rows = std::min(m_along, next);
        m_columns = std::max(m_along, next);
    }

    std::vector<SweepChart> make() const {
        std::vector<SweepChart> charts;
        if (m_axes.empty()) return charts;
        const bool isMap = m_lines > mostLines;
        const std::size_t ofMap = isMap ? m_axes[m_rows].count * m_axes[m_columns].count : 1;
        const std::size_t maps = isMap ? m_axes[m_along].count * m_lines / ofMap : 1;
        if (maps > mostMaps) return charts;
        for (std::size_t measure = 0; measure < m_sweep.measures().size(); ++measure)
            if (isMap)
                addMaps(measure, charts);
            else
                charts.push_back(lines(measure));
        return charts;
    }

  private:
    QString inWords(const char* text) const {
        return m_words == ChartWords::OfWindow ? QCoreApplication::translate("SweepCharts", text)
                                               : QString::fromLatin1(text);
    }
    std::size_t numberOf(const SweepPoint& point) const { return point.firstRun / m_sweep.runsOfPoint(); }
    ChartAxis measureAxis(std::size_t measure) const {
        const SweepMeasure& asked = m_sweep.measures()[measure];
        return {.label = textOf(asked.text), .unit = unitOf(asked), .logarithmic = false};
    }
    QStringList notes(std::size_t measure, const std::vector<const SweepPoint*>& points) const {
        QStringList notes;
        if (m_several) notes += inWords(runsOfPointText).arg(m_sweep.runsOfPoint());
        if (std::ranges::none_of(points, [measure](const SweepPoint* point) {
                return std::isfinite(point->spreads[measure].median);
            }))
            notes += inWords(nothingText);
        return notes;
    }

    SweepChart chartOf(std::size_t measure, ChartSpec chart,
                       std::vector<std::vector<std::size_t>> runs) const {
        return {{QStringLiteral("sweep-%1").arg(measure + 1), std::move(chart)}, measure, std::move(runs)};
    }

    SweepChart lines(std::size_t measure) const {
        const PointAxis& along = m_axes[m_along];
        const bool byName = !along.isNumeric();
        std::map<std::size_t, std::vector<const SweepPoint*>> byLine;
        std::vector<const SweepPoint*> all;
        for (const SweepPoint& point : m_points) {
            byLine[lineOf(numberOf(point))].push_back(&point);
            all.push_back(&point);
        }
        QStringList words = notes(measure, all);
        if (m_several) words += inWords(bandsText);
        ChartSpec chart{.title = textOf(m_sweep.measures()[measure].text),
                        .note = words.join(QStringLiteral("; ")),
                        .x = chartAxisOf(along, m_sweep.definition(), byName),
                        .y = measureAxis(measure),
                        .series = {},
                        .levels = {}};
        std::vector<std::vector<std::size_t>> runs;
        std::size_t colour = 0;
        for (const auto& [line, points] : byLine) {
            ChartSeries middle{.name = nameWithout(line, {m_along}),
                               .x = {},
                               .y = {},
                               .style = SeriesStyle::LineAndMarks,
                               .colour = seriesColour(colour++)};
            ChartSeries quartiles = middle, most = middle;
            for (ChartSeries* band : {&quartiles, &most}) {
                band->style = SeriesStyle::Band;
                band->inLegend = false;
            }
            std::vector<std::size_t> runsOfLine;
            for (const SweepPoint* point : points) {
                runsOfLine.push_back(point->firstRun);
                const FigureSpread& spread = point->spreads[measure];
                const std::size_t index = along.indexOf(numberOf(*point));
                const double x = byName ? static_cast<double>(index)
                                        : numberIn(along.parameter->values[index]).value_or(0);
                for (ChartSeries* series : {&middle, &quartiles, &most}) {
                    series->x.push_back(x);
                    series->y.push_back(spread.median);
                }
                quartiles.low.push_back(spread.q25);
                quartiles.high.push_back(spread.q75);
                most.low.push_back(spread.q05);
                most.high.push_back(spread.q95);
                middle.notes.push_back(noteOf(*point, measure));
            }
            if (m_several) {
                chart.series.insert(chart.series.end(), {most, quartiles});
                runs.resize(runs.size() + 2);
            }
            chart.series.push_back(std::move(middle));
            runs.push_back(std::move(runsOfLine));
        }
        chart.legend = byLine.size() > 1;
        return chartOf(measure, std::move(chart), std::move(runs));
    }

    /// A map for each combination of the axes that it does not have, all with the same colours.
    void addMaps(std::size_t measure, std::vector<SweepChart>& charts) const {
        std::map<std::size_t, std::vector<const SweepPoint*>> byMap;
        double least = std::numeric_limits<double>::infinity(), most = -least;
        for (const SweepPoint& point : m_points) {
            byMap[mapOf(numberOf(point))].push_back(&point);
            const double value = point.spreads[measure].median;
            if (!std::isfinite(value)) continue;
            least = std::min(least, value);
            most = std::max(most, value);
        }
        int number = 0;
        for (const auto& [slice, points] : byMap) {
            SweepChart chart = map(measure, points);
            if (const QString name = nameWithout(slice, {m_rows, m_columns}); !name.isEmpty()) {
                chart.name += QStringLiteral("-%1").arg(++number);
                chart.chart.title += QStringLiteral(", ") + name;
                if (least <= most) chart.chart.map->range = {least, most};
            }
            charts.push_back(std::move(chart));
        }
    }

    SweepChart map(std::size_t measure, const std::vector<const SweepPoint*>& points) const {
        const PointAxis &across = m_axes[m_columns], &upwards = m_axes[m_rows];
        ChartMap cells{.columns = across.count, .rows = upwards.count, .scale = measureAxis(measure)};
        cells.values.assign(cells.columns * cells.rows, std::numeric_limits<double>::quiet_NaN());
        std::vector<std::vector<std::size_t>> runs(cells.rows,
                                                   std::vector<std::size_t>(cells.columns, noRun));
        for (const SweepPoint* point : points) {
            const std::size_t column = across.indexOf(numberOf(*point)),
                              row = upwards.indexOf(numberOf(*point));
            cells.values[row * cells.columns + column] = point->spreads[measure].median;
            runs[row][column] = point->firstRun;
        }
        if (m_several) cells.scale.label = inWords(medianText).arg(cells.scale.label);
        ChartSpec chart{.title = textOf(m_sweep.measures()[measure].text),
                        .note = notes(measure, points).join(QStringLiteral("; ")),
                        .x = chartAxisOf(across, m_sweep.definition(), true),
                        .y = chartAxisOf(upwards, m_sweep.definition(), true),
                        .series = {},
                        .levels = {},
                        .map = std::move(cells)};
        return chartOf(measure, std::move(chart), std::move(runs));
    }

    /// The point without its place in a map.
    std::size_t mapOf(std::size_t point) const {
        for (const std::size_t k : {m_rows, m_columns}) point -= m_axes[k].indexOf(point) * m_axes[k].stride;
        return point;
    }
    /// The point without its place along the chart.
    std::size_t lineOf(std::size_t point) const {
        return point - m_axes[m_along].indexOf(point) * m_axes[m_along].stride;
    }
    /// The values of a point but those on some axes.
    QString nameWithout(std::size_t point, const std::vector<std::size_t>& axes) const {
        QStringList parts;
        for (std::size_t k = 0; k < m_axes.size(); ++k)
            if (std::ranges::find(axes, k) == axes.end())
                parts.append(textOf(m_axes[k].parameter->name) + QLatin1Char(' ') +
                             textOf(m_axes[k].parameter->values[m_axes[k].indexOf(point)]));
        return parts.join(QStringLiteral(", "));
    }
    QString noteOf(const SweepPoint& point, std::size_t measure) const {
        QStringList lines;
        for (const PointAxis& axis : m_axes)
            lines.append(textOf(axis.parameter->name) + QLatin1Char(' ') +
                         textOf(axis.parameter->values[axis.indexOf(numberOf(point))]));
        lines.append(textOf(m_sweep.measures()[measure].text) + QLatin1Char(' ') +
                     textOf(shortest(point.spreads[measure].median)));
        return lines.join(QLatin1Char('\n'));
    }

    const Sweep& m_sweep;
    const std::vector<SweepPoint>& m_points;
    std::vector<PointAxis> m_axes;
    std::size_t m_along = 0; ///< the axis that lines go along: the longest
    std::size_t m_lines = 1;
    std::size_t m_rows = 0, m_columns = 0; ///< axes of a map
    bool m_several;                        ///< runs a point
    ChartWords m_words;
};

} // namespace

std::vector<SweepChart> chartsOf(const Sweep& sweep, const std::vector<SweepPoint>& points,
                                 ChartWords words) {
    return Charts(sweep, points, words).make();
}

} // namespace carom
