// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/gas_charts.h"

#include "core/math/distributions.h"

#include <QCoreApplication>

#include <cmath>

namespace carom {
namespace {

struct GasChartsTexts {
    Q_DECLARE_TR_FUNCTIONS(GasCharts)
};

ChartSeries seriesOf(const QString& name, SeriesStyle style) {
    return {.name = name, .x = {}, .y = {}, .style = style, .colour = {}};
}

ChartSpec speedChart(const GasStudy& study) {
    ChartSeries measured = seriesOf(GasChartsTexts::tr("measured"), SeriesStyle::Marks);
    ChartSeries theory = seriesOf(GasChartsTexts::tr("Maxwell"), SeriesStyle::Line);
    for (const SpeedBin& bin : study.speeds) {
        measured.x.push_back(0.5 * (bin.from + bin.to));
        measured.y.push_back(bin.density);
    }
    constexpr int segments = 200;
    for (int k = 0; k <= segments; ++k) {
        const double speed = study.speeds.back().to * k / segments;
        theory.x.push_back(speed);
        theory.y.push_back(maxwellDensity(speed));
    }
    return {.title = GasChartsTexts::tr("Speeds of %1 balls").arg(study.balls),
            .x = {GasChartsTexts::tr("speed in units of √(kT/m)"), {}, false},
            .y = {GasChartsTexts::tr("share a unit"), {}, false},
            .series = {std::move(measured), std::move(theory)},
            .levels = {}};
}

ChartSpec compressibilityChart(const GasStudy& study) {
    ChartSeries batches = seriesOf(GasChartsTexts::tr("of each batch"), SeriesStyle::Marks);
    ChartSeries mean = seriesOf(GasChartsTexts::tr("mean of all so far"), SeriesStyle::Line);
    double sum = 0;
    for (std::size_t k = 0; k < study.compressibilityOfBatches.size(); ++k) {
        const double batch = static_cast<double>(k + 1);
        sum += study.compressibilityOfBatches[k];
        batches.x.push_back(batch);
        batches.y.push_back(study.compressibilityOfBatches[k]);
        mean.x.push_back(batch);
        mean.y.push_back(sum / batch);
    }
    ChartSpec chart{.title =
                        GasChartsTexts::tr("Compressibility at packing %1").arg(study.packing, 0, 'g', 4),
                    .x = {GasChartsTexts::tr("batch"), {}, false},
                    .y = {GasChartsTexts::tr("Z = p/(n kT)"), {}, false},
                    .series = {std::move(batches), std::move(mean)},
                    .levels = {}};
    if (!std::isnan(study.compressibility->theory))
        chart.levels.push_back({study.compressibility->theory, GasChartsTexts::tr("Carnahan and Starling")});
    return chart;
}

// The highest layer has no upper end without a lid, so no density.
ChartSpec heightChart(const GasStudy& study) {
    ChartSeries measured = seriesOf(GasChartsTexts::tr("measured"), SeriesStyle::Marks);
    ChartSeries theory = seriesOf(GasChartsTexts::tr("barometric formula"), SeriesStyle::LineAndMarks);
    for (const HeightBin& layer : study.heights) {
        const double thickness = layer.to - layer.from;
        if (!std::isfinite(thickness)) continue;
        const double middle = 0.5 * (layer.from + layer.to);
        measured.x.push_back(middle);
        measured.y.push_back(layer.balls / thickness);
        theory.x.push_back(middle);
        theory.y.push_back(layer.theory / thickness);
    }
    return {.title = GasChartsTexts::tr("Heights of %1 balls").arg(study.balls),
            .x = {GasChartsTexts::tr("height"), QStringLiteral("m"), false},
            .y = {GasChartsTexts::tr("balls a metre"), QStringLiteral("1/m"), true},
            .series = {std::move(measured), std::move(theory)},
            .levels = {}};
}

} // namespace

std::vector<NamedChart> chartsOf(const GasStudy& study) {
    std::vector<NamedChart> charts;
    if (!study.speeds.empty()) charts.push_back({QStringLiteral("speeds"), speedChart(study)});
    if (study.compressibility)
        charts.push_back({QStringLiteral("compressibility"), compressibilityChart(study)});
    if (!study.heights.empty() && study.batches > 0)
        charts.push_back({QStringLiteral("heights"), heightChart(study)});
    return charts;
}

} // namespace carom
