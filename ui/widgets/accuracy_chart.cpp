// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/accuracy_chart.h"

#include "core/base/figures.h"
#include "core/integrators/integrator.h"
#include "core/study/measures.h"
#include "ui/widgets/text_of.h"

#include <QCoreApplication>

#include <algorithm>
#include <limits>
#include <optional>

namespace carom {
namespace {

/// Range of errors of the diagram: rounding of one operation, and ten times the size of the scene. At twice
/// either end it has empty space.
constexpr double leastShown = 1e-16, mostShown = 10;
/// Points without an error are drawn at this multiple of the largest error, at most.
constexpr double beyond = 2;
constexpr double realTime = 1000; ///< [ms] a simulated second

struct AccuracyChartTexts {
    Q_DECLARE_TR_FUNCTIONS(AccuracyChart)
};
QString text(const std::string& utf8) { return QString::fromStdString(utf8); }

double shownError(const AccuracyStudy& study, const AccuracyPoint& point) {
    return std::clamp(study.errorOf(point), leastShown, mostShown);
}

ChartSpec emptyChart(const QString& title, const AccuracyStudy& study) {
    return {.title = title,
            .note = {},
            .x = {sentence(Sentence{study.measure->axis}), {}, true},
            .y = {AccuracyChartTexts::tr("time per simulated second"), QStringLiteral("ms"), true},
            .series = {},
            .levels = {{realTime, AccuracyChartTexts::tr("real time"), true}},
            .legendBeside = true};
}

/// What the points that finished span.
struct Extent {
    double leastX = std::numeric_limits<double>::infinity(), mostX = 0;
    double leastY = std::numeric_limits<double>::infinity(), mostY = 0;
};

Extent extentOf(const AccuracyStudy& study) {
    Extent extent;
    for (const AccuracyPoint& point : study.points) {
        if (!point.finished() || point.times.empty()) continue;
        const double x = shownError(study, point);
        extent.leastX = std::min(extent.leastX, x);
        extent.mostX = std::max(extent.mostX, x);
        extent.leastY = std::min(extent.leastY, point.cost());
        extent.mostY = std::max(extent.mostY, point.cost());
    }
    return extent;
}

/// Where a point stands. One that did not finish has no error to be read off: axes are not stretched for it,
/// it stands just beyond the others on the side where it is.
QPointF placeOf(const AccuracyStudy& study, const AccuracyPoint& point) {
    const double x = shownError(study, point), y = point.cost();
    if (point.finished()) return {x, y};
    const Extent all = extentOf(study);
    if (!(all.mostX > 0)) return {x, y};
    return {std::clamp(x, all.leastX / beyond, all.mostX * beyond),
            std::clamp(y, all.leastY / beyond, all.mostY * beyond)};
}

void append(const AccuracyStudy& study, const AccuracyPoint& point, ChartSeries& series) {
    const QPointF place = placeOf(study, point);
    series.x.push_back(place.x());
    series.y.push_back(place.y());
    series.low.push_back(point.leastCost());
    series.high.push_back(point.mostCost());
    series.notes.push_back(describe(study, point));
}

ChartSeries marksOnly(const QString& name, SeriesMark mark, const QColor& colour) {
    return {.name = name,
            .x = {},
            .y = {},
            .style = SeriesStyle::Marks,
            .colour = colour,
            .mark = mark,
            .inOrder = true};
}

/// The same colour for an integrator in every chart; exact events have their own, and other engines by name.
/// Theirs can be seen on light and dark ground.
QColor colourOf(const AccuracySetting& setting) {
    if (setting.engine == "bullet") return QColor(0xA0, 0x70, 0x3A);
    if (setting.engine == "ode") return QColor(0x7C, 0x6F, 0xD6);
    if (!setting.engine.empty()) return QColor(0x6F, 0x8A, 0x1E);
    if (setting.integrator == nullptr) return seriesColour(integrators().size());
    return seriesColour(static_cast<std::size_t>(setting.integrator - integrators().data()));
}

/// Presets differ by the shape of their points.
SeriesMark markOf(const AccuracySetting& setting) {
    if (!setting.engine.empty()) return setting.isTuned ? SeriesMark::Square : SeriesMark::Triangle;
    if (setting.preset == nullptr || setting.preset->name == "default") return SeriesMark::Disc;
    return setting.preset->name == "fast" ? SeriesMark::Triangle : SeriesMark::Square;
}

/// A line a family, dashed for the method that counts collisions, or as told; `points` gets the place of each
/// in the study.
void addFamilies(const AccuracyStudy& study, const QString& prefix, std::optional<bool> dashed,
                 ChartSpec& chart, std::vector<std::vector<std::size_t>>& points) {
    for (const AccuracyFamily& family : familiesOf(study)) {
        QString name = prefix + text(family.name);
        if (const std::optional<double> order = orderOf(family, study))
            name += AccuracyChartTexts::tr(" (order %1)").arg(*order, 0, 'f', 1);
        const bool counting = family.points.front()->setting.method->name == "microcollisions";
        ChartSeries series{.name = name,
                           .x = {},
                           .y = {},
                           .style = SeriesStyle::LineAndMarks,
                           .colour = colourOf(family.points.front()->setting),
                           .mark = markOf(family.points.front()->setting),
                           .dashed = dashed.value_or(counting),
                           .inOrder = true};
        std::vector<std::size_t> places;
        for (const AccuracyPoint* point : family.points) {
            if (!point->finished() || point->times.empty()) continue;
            append(study, *point, series);
            places.push_back(static_cast<std::size_t>(point - study.points.data()));
        }
        if (series.x.empty()) continue;
        chart.series.push_back(std::move(series));
        points.push_back(std::move(places));
    }
}

/// Marks over the points that are not what they seem, in the colours of their families.
void addVerdicts(const AccuracyStudy& study, ChartSpec& chart) {
    const QColor grey(0x90, 0x90, 0x90), red(0xC0, 0x30, 0x20);
    ChartSeries doubtful =
        marksOnly(AccuracyChartTexts::tr("deviation from the finest run"), SeriesMark::Disc, grey);
    ChartSeries broken = marksOnly(AccuracyChartTexts::tr("an invariant broke"), SeriesMark::Ring, grey);
    ChartSeries failed = marksOnly(AccuracyChartTexts::tr("failed"), SeriesMark::Cross, red);
    ChartSeries own = marksOnly(AccuracyChartTexts::tr("the scene's own"), SeriesMark::Halo, grey);
    ChartSeries best =
        marksOnly(AccuracyChartTexts::tr("recommended"), SeriesMark::Halo, QColor(0xC0, 0x20, 0x80));
    const bool converged = study.reference && study.reference->kind == ReferenceKind::ConvergedRun;
    for (const AccuracyPoint& point : study.points) {
        if (point.times.empty() || point.status == PointStatus::Timed) continue;
        const bool lost = !point.finished();
        if (converged && !lost && study.errorOf(point) < study.resolution()) append(study, point, doubtful);
        if (point.status == PointStatus::Broken) append(study, point, broken);
        if (lost) append(study, point, failed);
        if (point.isDefault) append(study, point, own);
    }
    if (const AccuracyPoint* point = recommended(study)) append(study, *point, best);
    for (ChartSeries* series : {&doubtful, &broken, &failed, &own, &best}) {
        if (series->x.empty()) continue;
        series->low.clear();
        series->high.clear();
        chart.series.push_back(std::move(*series));
    }
}

void addFront(const AccuracyStudy& study, ChartSpec& chart) {
    ChartSeries front{.name = AccuracyChartTexts::tr("Pareto front"),
                      .x = {},
                      .y = {},
                      .style = SeriesStyle::Line,
                      .colour = QColor(0x60, 0x60, 0x60),
                      .dashed = true,
                      .inOrder = true};
    for (const AccuracyPoint* point : paretoFront(study)) {
        front.x.push_back(shownError(study, *point));
        front.y.push_back(point->cost());
    }
    if (front.x.size() > 1) chart.series.push_back(std::move(front));
}

} // namespace

QString describe(const AccuracyStudy& study, const AccuracyPoint& point) {
    QString words = AccuracyChartTexts::tr("%1\nerror %2 (distance %3, angle %4 rad)")
                        .arg(sentences(saidOf(point.setting)), text(figure(point.errors.worst())),
                             text(figure(point.errors.position)), text(figure(point.errors.attitude)));
    if (study.measure != &measures().front())
        words += AccuracyChartTexts::tr("\n%1 %2", "a measure and its value")
                     .arg(sentence(Sentence{study.measure->noun}), text(figure(study.errorOf(point))));
    words +=
        AccuracyChartTexts::tr("\n%1 ms per simulated second (%2 to %3)")
            .arg(text(figure(point.cost())), text(figure(point.leastCost())), text(figure(point.mostCost())));
    words += AccuracyChartTexts::tr("\nenergy off by %1, drift %2 /s; overlap %3")
                 .arg(text(figure(point.energy.worst)), text(figure(point.energy.drift)),
                      text(figure(point.penetration)));
    if (point.impacts && point.impacts->expected > 0)
        words += AccuracyChartTexts::tr("\n%1 of %2 impacts; up to number %3 off by %4 s at most")
                     .arg(point.impacts->seen)
                     .arg(point.impacts->expected)
                     .arg(point.impacts->matched)
                     .arg(text(figure(point.impacts->time)));
    if (point.crowd)
        words += AccuracyChartTexts::tr(
                     "\nbeyond the horizon, medians of %1 copies: speeds off by %2 %, pressure by %3 %, time "
                     "between impacts by %4 %")
                     .arg(point.crowd->copies)
                     .arg(text(figure(100 * point.crowd->speeds.median, 2)),
                          text(figure(100 * point.crowd->pressure.median, 2)),
                          text(figure(100 * point.crowd->freeTime.median, 2)));
    if (!point.reason.empty()) words += QLatin1Char('\n') + sentence(point.reason);
    return words;
}

void markChosen(const AccuracyStudy& study, const AccuracyPoint& point, ChartSpec& chart) {
    ChartSeries chosen =
        marksOnly(AccuracyChartTexts::tr("chosen"), SeriesMark::Halo, QColor(0x10, 0x80, 0xE0));
    append(study, point, chosen);
    chosen.low.clear();
    chosen.high.clear();
    chosen.notes.clear(); // the point below has them
    chart.series.push_back(std::move(chosen));
}

AccuracyChart accuracyChart(const AccuracyStudy& study, const QString& title) {
    AccuracyChart chart{.spec = emptyChart(title, study), .points = {}};
    chart.spec.note = sentences(recommendation(study));
    addFamilies(study, {}, std::nullopt, chart.spec, chart.points);
    addFront(study, chart.spec);
    addVerdicts(study, chart.spec);
    return chart;
}

AccuracyChart comparedAccuracy(const AccuracyStudy& first, const QString& firstName,
                               const AccuracyStudy& second, const QString& secondName) {
    AccuracyChart chart{
        .spec = emptyChart(AccuracyChartTexts::tr("%1 and %2").arg(firstName, secondName), second),
        .points = {}};
    addFamilies(first, firstName + QStringLiteral(": "), true, chart.spec, chart.points);
    for (std::vector<std::size_t>& places : chart.points) places.clear();
    addFamilies(second, secondName + QStringLiteral(": "), false, chart.spec, chart.points);
    return chart;
}

} // namespace carom
