// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/gas_report.h"

#include "core/base/csv.h"
#include "core/base/figures.h"

#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

namespace carom {
namespace {

/// A measured figure by name; without an interval or a theory those are not numbers.
struct Row {
    std::string_view name, unit;
    GasEstimate estimate;
};

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::vector<Row> rowsOf(const GasStudy& study) {
    std::vector<Row> rows;
    const auto plain = [&rows](std::string_view name, std::string_view unit, double value,
                               double theory = none) {
        rows.push_back({name, unit, {value, none, theory}});
    };
    plain("balls", "", static_cast<double>(study.balls));
    plain("diameter", "m", study.diameter);
    plain("mass", "kg", study.mass);
    plain("temperature", "J", study.temperature);
    plain("packing", "", study.packing);
    plain("simulated", "s", study.simulated);
    plain("collisions", "", static_cast<double>(study.collisions));
    plain("events", "", static_cast<double>(study.events));
    plain("energy drift", "", study.energyDrift, 0);
    plain("speeds: largest distance", "", study.speedDistance);
    plain("speeds: probability", "", study.speedProbability);
    if (study.compressibility) rows.push_back({"compressibility", "", *study.compressibility});
    if (study.wallCompressibility)
        rows.push_back({"compressibility at the walls", "", *study.wallCompressibility});
    if (study.freeTime) rows.push_back({"mean free time", "s", *study.freeTime});
    if (study.heightDegrees > 0) {
        plain("heights: chi square", "", study.heightChiSquare, study.heightDegrees);
        plain("heights: probability", "", study.heightProbability);
    }
    return rows;
}

} // namespace

std::string summaryOf(const GasStudy& study) {
    std::string text;
    for (const Row& row : rowsOf(study)) {
        text.append(row.name)
            .append(std::string(30 - row.name.size(), ' '))
            .append(figure(row.estimate.value, 6));
        if (!std::isnan(row.estimate.uncertainty))
            text.append(" ± ").append(figure(row.estimate.uncertainty, 2));
        if (!row.unit.empty()) text.append(" ").append(row.unit);
        if (!std::isnan(row.estimate.theory)) {
            text.append(", theory ").append(figure(row.estimate.theory, 6));
            if (!std::isnan(row.estimate.uncertainty))
                text.append(" (").append(figure(100 * row.estimate.deviation(), 2)).append(" %)");
        }
        text.append("\n");
    }
    for (const HeightBin& layer : study.heights)
        text.append("height from ")
            .append(figure(layer.from))
            .append(" m: ")
            .append(figure(layer.balls, 4))
            .append(" balls, theory ")
            .append(figure(layer.theory, 4))
            .append("; temperature ")
            .append(figure(layer.temperature.value, 4))
            .append(" ± ")
            .append(figure(layer.temperature.uncertainty, 2))
            .append(" of the mean\n");
    for (const std::string& remark : study.remarks) text.append(remark).append("\n");
    if (!study.complete)
        text.append("stopped early: ")
            .append(counted(static_cast<std::size_t>(study.batches), "batch", "batches"))
            .append(" measured\n");
    return text;
}

std::string figuresAsCsv(const GasStudy& study, const StudyOrigin& origin) {
    CsvTable table("figure,value,uncertainty,theory,unit,command,version,machine");
    for (const Row& row : rowsOf(study))
        table.row(row.name, row.estimate.value, row.estimate.uncertainty, row.estimate.theory, row.unit,
                  origin.command, origin.version, origin.machine);
    return table.take();
}

std::string gasesColumns() {
    return CsvTable("scene,figure,value,uncertainty,theory,unit,command,version,machine").take();
}

std::string gasesRows(const std::string& scene, const GasStudy& study, const StudyOrigin& origin) {
    CsvTable table;
    for (const Row& row : rowsOf(study))
        table.row(scene, row.name, row.estimate.value, row.estimate.uncertainty, row.estimate.theory,
                  row.unit, origin.command, origin.version, origin.machine);
    return table.take();
}

std::string speedsAsCsv(const GasStudy& study) {
    CsvTable table("from,to,density,theory");
    for (const SpeedBin& bin : study.speeds) table.row(bin.from, bin.to, bin.density, bin.theory);
    return table.take();
}

std::string heightsAsCsv(const GasStudy& study) {
    CsvTable table("from,to,balls,theory,temperature,temperature_uncertainty");
    for (const HeightBin& layer : study.heights)
        table.row(layer.from, layer.to, layer.balls, layer.theory, layer.temperature.value,
                  layer.temperature.uncertainty);
    return table.take();
}

} // namespace carom
