// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/accuracy_report.h"

#include "core/base/csv.h"
#include "core/base/figures.h"
#include "core/base/hash.h"
#include "core/base/text.h"
#include "core/integrators/integrator.h"

#include <algorithm>
#include <array>
#include <map>

namespace carom {
namespace {

constexpr std::string_view columns =
    "method,integrator,substeps,tolerance,default,status,reason,position,position_rms,attitude,energy_drift,"
    "energy_swing,energy_worst,momentum,penetration,cost_ms,cost_min_ms,cost_max_ms,runs_ms,pareto,reference,"
    "reference_error,horizon_s,duration_s,scene,command,version,machine";

std::string padded(std::string text, std::size_t width) {
    if (text.size() < width) text.append(width - text.size(), ' ');
    return text;
}

constexpr std::array statuses = {PointStatus::Measured, PointStatus::Broken, PointStatus::Failed,
                                 PointStatus::TimedOut};

/// One line of the file, its cells by the names of the columns.
std::optional<AccuracyPoint> pointFrom(const std::map<std::string_view, std::string_view>& cells) {
    const auto text = [&](std::string_view column) {
        const auto cell = cells.find(column);
        return cell == cells.end() ? std::string_view() : cell->second;
    };
    const auto number = [&](std::string_view column) { return numberIn(text(column)).value_or(0); };
    AccuracyPoint point;
    point.setting = {findSolver(text("method")), findIntegrator(text("integrator")),
                     static_cast<int>(number("substeps")), number("tolerance")};
    if (point.setting.method == nullptr || point.setting.substeps < 1) return std::nullopt;
    const auto* status = std::find_if(statuses.begin(), statuses.end(),
                                      [&](PointStatus s) { return nameOf(s) == text("status"); });
    if (status == statuses.end()) return std::nullopt;
    point.status = *status;
    point.reason = csvValue(text("reason"));
    point.errors = {number("position"), number("position_rms"), number("attitude")};
    point.energy = {number("energy_drift"), number("energy_swing"), number("energy_worst"), 0};
    point.momentumChange = number("momentum");
    point.penetration = number("penetration");
    for (const std::string_view run : csvSplit(text("runs_ms"), ';'))
        if (const std::optional<double> time = numberIn(run)) point.times.push_back(*time);
    return point;
}

} // namespace

std::string summaryOf(const AccuracyStudy& study) {
    std::string text = yardstickOf(study) + "\n";
    if (study.conservative) text += "Nothing takes energy out of the scene: it must stay.\n";
    for (const AccuracyFamily& family : familiesOf(study)) {
        text += "\n" + family.name;
        if (const std::optional<double> order = orderOf(family, study.resolution()))
            text += "   (order " + figure(*order) + ")";
        text += "\n  substeps  error       ms per simulated s   energy off   overlap\n";
        for (const AccuracyPoint* point : family.points) {
            text += "  " + padded(std::to_string(point->setting.substeps), 10) +
                    padded(figure(point->errors.worst()), 12) +
                    padded(point->times.empty() ? "-" : figure(point->cost()), 21) +
                    padded(figure(point->energy.worst), 13) + padded(figure(point->penetration), 9);
            if (point->isDefault) text += " the scene's own";
            if (!point->reason.empty())
                text += " " + std::string(nameOf(point->status)) + ": " + point->reason;
            text += "\n";
        }
    }
    if (!study.complete) text += "\nThe study was interrupted; what was measured is shown.\n";
    return text + "\n" + recommendation(study) + "\n";
}

std::string pointsAsCsv(const AccuracyStudy& study, std::string_view sceneHash, const StudyOrigin& origin) {
    CsvTable table(columns);
    if (!study.truth) return table.take();
    const std::vector<const AccuracyPoint*> front = paretoFront(study);
    for (const AccuracyPoint& p : study.points) {
        std::string runs;
        for (const double time : p.times) runs.append(runs.empty() ? "" : ";").append(shortest(time));
        const bool onFront = std::find(front.begin(), front.end(), &p) != front.end();
        table.row(p.setting.method->name, p.setting.integrator ? p.setting.integrator->name : "",
                  p.setting.substeps, p.setting.tolerance, p.isDefault ? "yes" : "no", nameOf(p.status),
                  p.reason, p.errors.position, p.errors.positionRms, p.errors.attitude, p.energy.drift,
                  p.energy.swing, p.energy.worst, p.momentumChange, p.penetration, p.cost(), p.leastCost(),
                  p.mostCost(), runs, onFront ? "yes" : "no", nameOf(study.truth->kind), study.truth->error,
                  study.truth->horizon, study.plan.duration, sceneHash, origin.command, origin.version,
                  origin.machine);
    }
    return table.take();
}

std::vector<AccuracyPoint> pointsFromCsv(std::string_view csv, std::string_view sceneHash, double duration) {
    std::vector<AccuracyPoint> points;
    const std::vector<std::string_view> lines = csvSplit(csv, '\n');
    const std::vector<std::string_view> names = csvSplit(lines.front(), ',');
    for (std::size_t line = 1; line < lines.size(); ++line) {
        const std::vector<std::string_view> values = csvSplit(lines[line], ',');
        if (values.size() != names.size()) continue;
        std::map<std::string_view, std::string_view> cells;
        for (std::size_t k = 0; k < names.size(); ++k) cells[names[k]] = values[k];
        if (cells["scene"] != sceneHash) continue;
        if (numberIn(cells["duration_s"]) != duration) continue;
        if (std::optional<AccuracyPoint> point = pointFrom(cells)) points.push_back(std::move(*point));
    }
    return points;
}

std::string hashOfScene(std::string_view text) {
    Hash64 hash;
    for (const char c : text) hash.add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
    return std::to_string(hash.value());
}

} // namespace carom
