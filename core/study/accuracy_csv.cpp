// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/accuracy_csv.h"

#include "core/base/catalogue.h"
#include "core/base/csv.h"
#include "core/base/hash.h"
#include "core/base/text.h"
#include "core/integrators/integrator.h"
#include "core/study/convergence.h"
#include "core/study/measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace carom {
namespace {

constexpr std::string_view columns =
    "method,integrator,substeps,tolerance,preset,engine,default,status,reason,measure,error,position,"
    "position_rms,attitude,energy_drift,energy_swing,energy_worst,energy_gain,energy_off,momentum,"
    "penetration,"
    "residual_m_s,residual,cone_violation,end_height,end_centre,end_rest_time,end_work,"
    "impacts_true,impacts,impacts_matched,impact_time_s,copies,speeds_lower,speeds,speeds_upper,"
    "pressure_lower,pressure,pressure_upper,free_time_lower,free_time,free_time_upper,cost_ms,"
    "cost_min_ms,cost_max_ms,instructions,runs_ms,pareto,reference,reference_error,horizon_s,"
    "studied_s,duration_s,scene,command,version,machine";

/// An empty cell.
constexpr double none = std::numeric_limits<double>::quiet_NaN();

double finiteOr(double value, double otherwise) { return std::isfinite(value) ? value : otherwise; }

constexpr std::array statuses = {PointStatus::Timed, PointStatus::Measured, PointStatus::Broken,
                                 PointStatus::Failed, PointStatus::TimedOut};

/// What was not looked at is empty in the file.
struct Extras {
    Extras(const AccuracyPoint& point, const AccuracyStudy& study) {
        if (point.status != PointStatus::Timed)
            errors = {point.errors.position, point.errors.positionRms, point.errors.attitude};
        if (study.reference) {
            reference = nameOf(study.reference->kind);
            referenceError = study.reference->error;
            horizon = study.reference->horizon;
        }
        if (point.impacts)
            impacts = {static_cast<double>(point.impacts->expected), static_cast<double>(point.impacts->seen),
                       static_cast<double>(point.impacts->matched), point.impacts->time};
        if (point.outcome)
            end = {point.outcome->height, point.outcome->centre, point.outcome->restTime,
                   point.outcome->work};
        if (point.instructions > 0) instructions = point.instructions;
        if (!point.crowd) return;
        copies = static_cast<double>(point.crowd->copies);
        speeds = point.crowd->speeds;
        pressure = point.crowd->pressure;
        freeTime = point.crowd->freeTime;
    }

    std::array<double, 4> impacts{none, none, none, none};
    std::array<double, 4> end{none, none, none, none};
    std::array<double, 3> errors{none, none, none};
    std::string_view reference{};
    double referenceError = none, horizon = none;
    double copies = none, instructions = none;
    Quartiles speeds{none, none, none}, pressure{none, none, none}, freeTime{none, none, none};
};

/// One line of the file, its cells by the names of the columns.
class Cells {
  public:
    Cells(const std::vector<std::string_view>& names, const std::vector<std::string_view>& values) {
        for (std::size_t k = 0; k < std::min(names.size(), values.size()); ++k) m_cells[names[k]] = values[k];
    }

    std::string_view text(std::string_view column) const {
        const auto cell = m_cells.find(column);
        return cell == m_cells.end() ? std::string_view() : cell->second;
    }
    double number(std::string_view column) const { return numberIn(text(column)).value_or(0); }
    std::size_t count(std::string_view column) const { return static_cast<std::size_t>(number(column)); }
    Quartiles quartiles(const std::string& column) const {
        return {number(column + "_lower"), number(column), number(column + "_upper")};
    }

  private:
    std::map<std::string_view, std::string_view> m_cells;
};

std::optional<AccuracyPoint> pointFrom(const Cells& cells) {
    AccuracyPoint point;
    point.setting = {findSolver(cells.text("method")), findIntegrator(cells.text("integrator")),
                     static_cast<int>(cells.number("substeps")), cells.number("tolerance"),
                     findByName(presets(), cells.text("preset"))};
    const std::string_view engine = cells.text("engine");
    point.setting.engine = engine.substr(0, engine.find(' '));
    point.setting.isTuned = engine.ends_with(" tuned");
    if (point.setting.method == nullptr || point.setting.substeps < 1) return std::nullopt;
    const auto* status = std::find_if(statuses.begin(), statuses.end(),
                                      [&](PointStatus s) { return nameOf(s) == cells.text("status"); });
    if (status == statuses.end()) return std::nullopt;
    point.status = *status;
    point.isDefault = cells.text("default") == "yes";
    point.reason = verbatim(csvValue(cells.text("reason")));
    point.errors = {cells.number("position"), cells.number("position_rms"), cells.number("attitude")};
    point.energy = {cells.number("energy_drift"), cells.number("energy_swing"), cells.number("energy_worst"),
                    cells.number("energy_gain")};
    if (!cells.text("energy_off").empty()) point.energyOff = cells.number("energy_off");
    point.momentumChange = cells.number("momentum");
    point.penetration = cells.number("penetration");
    point.residual = cells.number("residual_m_s");
    point.relativeResidual = cells.number("residual");
    point.coneViolation = cells.number("cone_violation");
    if (!cells.text("impacts").empty())
        point.impacts = ImpactErrors{cells.count("impacts_true"), cells.count("impacts"),
                                     cells.count("impacts_matched"), cells.number("impact_time_s")};
    if (!cells.text("end_height").empty())
        point.outcome = OutcomeErrors{cells.number("end_height"), cells.number("end_centre"),
                                      cells.number("end_rest_time"), cells.number("end_work")};
    if (!cells.text("copies").empty())
        point.crowd = CrowdFigures{cells.count("copies"), cells.quartiles("speeds"),
                                   cells.quartiles("pressure"), cells.quartiles("free_time")};
    point.instructions = cells.number("instructions");
    for (const std::string_view run : csvSplit(cells.text("runs_ms"), ';'))
        if (const std::optional<double> time = numberIn(run)) point.times.push_back(*time);
    return point;
}

} // namespace

std::string pointsAsCsv(const AccuracyStudy& study, std::string_view sceneHash, const StudyOrigin& origin) {
    CsvTable table(columns);
    const std::vector<const AccuracyPoint*> front = paretoFront(study);
    for (const AccuracyPoint& p : study.points) {
        if (p.status == PointStatus::Waiting) continue;
        std::string runs;
        for (const double time : p.times) runs.append(runs.empty() ? "" : ";").append(shortest(time));
        const bool onFront = std::find(front.begin(), front.end(), &p) != front.end();
        const Extras x(p, study);
        table.row(p.setting.method->name, p.setting.integrator ? p.setting.integrator->name : "",
                  p.setting.substeps, p.setting.tolerance, p.setting.preset ? p.setting.preset->name : "",
                  p.setting.engine + (p.setting.isTuned ? " tuned" : ""), p.isDefault ? "yes" : "no",
                  nameOf(p.status), p.reason.text(), study.measure->name, finiteOr(study.errorOf(p), none),
                  x.errors[0], x.errors[1], x.errors[2], p.energy.drift, p.energy.oscillation, p.energy.worst,
                  p.energy.gain, p.energyOff.value_or(none), p.momentumChange, p.penetration, p.residual,
                  p.relativeResidual, p.coneViolation, x.end[0], x.end[1], x.end[2], x.end[3], x.impacts[0],
                  x.impacts[1], x.impacts[2], x.impacts[3], x.copies, x.speeds.lower, x.speeds.median,
                  x.speeds.upper, x.pressure.lower, x.pressure.median, x.pressure.upper, x.freeTime.lower,
                  x.freeTime.median, x.freeTime.upper, p.cost(), p.leastCost(), p.mostCost(), x.instructions,
                  runs, onFront ? "yes" : "no", x.reference, x.referenceError, x.horizon, study.duration,
                  study.plan.duration, sceneHash, origin.command, origin.version, origin.machine);
    }
    return table.take();
}

ReadPoints pointsFromCsv(std::string_view csv, const AccuracyOrigin& origin) {
    ReadPoints read;
    std::vector<std::string_view> lines = csvSplit(csv, '\n');
    if (lines.back().empty()) lines.pop_back();
    if (lines.empty() || lines.front() != columns)
        return {{}, "its columns are not those that this version of the study writes"};
    const std::vector<std::string_view> names = csvSplit(columns, ',');
    for (std::size_t line = 1; line < lines.size(); ++line) {
        const std::vector<std::string_view> values = csvSplit(lines[line], ',');
        const Cells cells(names, values);
        std::optional<AccuracyPoint> point =
            values.size() == names.size() ? pointFrom(cells) : std::optional<AccuracyPoint>();
        if (!point) return {{}, "line " + std::to_string(line + 1) + " cannot be read"};
        if (cells.text("scene") != origin.scene)
            return {{}, "it is of another scene, or of another text of it"};
        if (numberIn(cells.text("duration_s")) != origin.duration)
            return {{},
                    "it is of " + std::string(cells.text("duration_s")) + " s, not of " +
                        shortest(origin.duration) + " s"};
        if (csvValue(cells.text("version")) != origin.version)
            return {{},
                    "it was measured by version " + csvValue(cells.text("version")) + ", and this is " +
                        origin.version};
        read.known.duration = cells.number("studied_s");
        read.known.points.push_back(std::move(*point));
    }
    return read;
}

std::string hashOfScene(std::string_view text) {
    Hash64 hash;
    for (const char c : text) hash.add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
    return std::to_string(hash.value());
}

} // namespace carom
