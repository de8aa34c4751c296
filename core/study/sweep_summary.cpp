// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/sweep_summary.h"

#include "core/base/csv.h"
#include "core/base/figures.h"
#include "core/math/distributions.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
namespace {

constexpr double noFigure = std::numeric_limits<double>::quiet_NaN();

/// The smallest value that at least that share of the ascending series does not exceed.
double nearestRank(const std::vector<double>& sorted, double share) {
    const double rank = std::ceil(share * static_cast<double>(sorted.size()));
    return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

/// "0.8 s", "12 min", "3.1 h", "40 days": without exponents.
std::string duration(double seconds) {
    constexpr double minute = 60, hour = 3600, day = 86400;
    const auto in = [&](double unit, const char* name) {
        const double value = seconds / unit;
        return (value < 10 ? figure(std::round(value * 10) / 10, 2) : std::to_string(std::llround(value))) +
               " " + name;
    };
    if (seconds < 2 * minute) return in(1, "s");
    if (seconds < 2 * hour) return in(minute, "min");
    return seconds < 2 * day ? in(hour, "h") : in(day, "days");
}

std::string rightAligned(const std::string& text, std::size_t width) {
    return std::string(width - std::min(width, text.size()), ' ') + text;
}

} // namespace

FigureSpread spreadOf(std::vector<double> figures) {
    std::erase_if(figures, [](double figure) { return std::isnan(figure); });
    std::ranges::sort(figures);
    FigureSpread spread;
    spread.runs = figures.size();
    if (figures.empty()) {
        for (double FigureSpread::*figure :
             {&FigureSpread::mean, &FigureSpread::deviation, &FigureSpread::least, &FigureSpread::q05,
              &FigureSpread::q25, &FigureSpread::median, &FigureSpread::q75, &FigureSpread::q95,
              &FigureSpread::most})
            spread.*figure = noFigure;
        spread.meanAt95 = {noFigure, noFigure};
        return spread;
    }
    const auto count = static_cast<double>(figures.size());
    double sum = 0, squares = 0;
    for (const double figure : figures) sum += figure;
    spread.mean = sum / count;
    for (const double figure : figures) squares += (figure - spread.mean) * (figure - spread.mean);
    const bool several = figures.size() > 1;
    spread.deviation = several ? std::sqrt(squares / (count - 1)) : noFigure;
    const double half = several ? studentFactor(count - 1) * spread.deviation / std::sqrt(count) : noFigure;
    spread.meanAt95 = {spread.mean - half, spread.mean + half};
    spread.least = figures.front();
    spread.most = figures.back();
    spread.q05 = nearestRank(figures, 0.05);
    spread.q25 = nearestRank(figures, 0.25);
    spread.q75 = nearestRank(figures, 0.75);
    spread.q95 = nearestRank(figures, 0.95);
    const std::size_t middle = figures.size() / 2;
    spread.median = figures.size() % 2 == 1 ? figures[middle] : 0.5 * (figures[middle - 1] + figures[middle]);
    return spread;
}

SweepSummary::SweepSummary(const Sweep& sweep, Sink sink)
    : m_runsOfPoint(sweep.runsOfPoint()), m_sink(std::move(sink)), m_figures(sweep.measures().size()) {}

void SweepSummary::add(const SweepResult& result) {
    const std::size_t first = result.run - result.run % m_runsOfPoint;
    if (m_point.runs > 0 && first != m_point.firstRun) finish();
    m_point.firstRun = first;
    const bool lost = result.outcome == SweepOutcome::Lost, faulty = result.outcome == SweepOutcome::Faulty;
    for (auto* total : {&m_point.runs, &m_totals.runs}) ++*total;
    for (auto* total : {&m_point.lost, &m_totals.lost}) *total += lost ? 1 : 0;
    for (auto* total : {&m_point.faulty, &m_totals.faulty}) *total += faulty ? 1 : 0;
    m_totals.seconds += result.seconds;
    m_totals.longest = std::max(m_totals.longest, result.seconds);
    if (result.outcome != SweepOutcome::Done) return; // the figures of half a run are not those of a whole
    for (std::size_t k = 0; k < m_figures.size(); ++k) m_figures[k].push_back(result.figures[k]);
}

void SweepSummary::finish() {
    if (m_point.runs == 0) return;
    for (std::vector<double>& figures : m_figures) {
        m_point.spreads.push_back(spreadOf(std::move(figures)));
        figures.clear();
    }
    m_sink(m_point);
    m_point = {};
}

std::vector<std::size_t> pointParameters(const Sweep& sweep) {
    std::vector<std::size_t> parameters;
    for (const SweepAxis& axis : sweep.axes())
        if (!axis.isReplication)
            parameters.insert(parameters.end(), axis.parameters.begin(), axis.parameters.end());
    return parameters;
}

std::string summaryColumns(const Sweep& sweep) {
    std::string line;
    for (const std::size_t parameter : pointParameters(sweep))
        line += csvField(sweep.parameters()[parameter].name) + ",";
    return line +
           "measure,runs,lost,faulty,mean,deviation,mean_low,mean_high,least,q05,q25,median,q75,q95,most\n";
}

std::string summaryRows(const Sweep& sweep, const SweepPoint& point) {
    CsvTable table;
    const std::vector<std::string> values = sweep.valuesOf(point.firstRun);
    const std::vector<std::size_t> parameters = pointParameters(sweep);
    for (std::size_t k = 0; k < point.spreads.size(); ++k) {
        const FigureSpread& spread = point.spreads[k];
        for (const std::size_t parameter : parameters) table.add(std::string_view(values[parameter]));
        table.add(std::string_view(sweep.measures()[k].text));
        for (const std::size_t count : {spread.runs, point.lost, point.faulty}) table.add(count);
        table.add(spread.mean);
        for (const double figure :
             {spread.deviation, spread.meanAt95.low, spread.meanAt95.high, spread.least, spread.q05,
              spread.q25, spread.median, spread.q75, spread.q95, spread.most})
            table.add(sweep.runsOfPoint() > 1 ? figure : noFigure);
        table.endRow();
    }
    return table.take();
}

std::string summaryOf(const SweepTotals& totals, std::size_t allRuns) {
    std::string text = counted(totals.runs, "run", "runs");
    if (totals.runs < allRuns) text += " of " + std::to_string(allRuns);
    if (totals.lost > 0) text += ", " + std::to_string(totals.lost) + " lost their state";
    if (totals.faulty > 0) text += ", " + std::to_string(totals.faulty) + " have a faulty text";
    if (totals.runs == 0) return text + ".\n";
    const double each = totals.seconds / static_cast<double>(totals.runs);
    text += ": " + duration(totals.seconds) + " of processor time; " + figure(each) + " s a run, " +
            figure(totals.longest) + " s the longest.\n\ncores    runs an hour    time for all\n";
    for (const int cores : {1, 8, 64, 512}) {
        const double anHour = 3600 * cores / std::max(each, 1e-9);
        text += rightAligned(std::to_string(cores), 5) +
                rightAligned(std::to_string(std::llround(anHour)), 16) +
                rightAligned(duration(3600 * static_cast<double>(allRuns) / anHour), 16) + "\n";
    }
    return text;
}

} // namespace carom
