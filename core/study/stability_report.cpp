// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/stability_report.h"

#include "core/base/csv.h"
#include "core/base/figures.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

std::string withUnit(double value, std::string_view unit) {
    std::string result = figure(value, 2);
    if (!unit.empty()) result.append(" ").append(unit);
    return result;
}

} // namespace

std::string describe(const Figure& figure) {
    return figure.name + " " + withUnit(figure.value, figure.unit) + ", limit " +
           withUnit(figure.limit, figure.unit);
}

std::string tallyOf(const StabilityStudy& study, StudyColumn column) {
    const std::size_t holding = study.count(column, Verdict::Holds);
    const std::size_t all = holding + study.count(column, Verdict::Fails);
    return std::string(nameOf(column)) + ": " + std::to_string(holding) + " of " + std::to_string(all) +
           " hold";
}

std::string describe(const TrialResult& result) {
    if (result.verdict == Verdict::NotApplicable) return {};
    const HardCase& hardCase = *result.hardCase;
    std::string text = std::to_string(hardCase.number) + " ";
    text.append(spokenName(hardCase)).append(", ").append(nameOf(result.column)).append(": ");
    text.append(nameOf(result.verdict)).append(" (").append(figure(result.seconds, 2)).append(" s)\n");
    for (const Figure& figure : result.figures)
        text.append(figure.holds() ? "      " : "    ! ").append(describe(figure)).append("\n");
    return text;
}

std::string summaryOf(const StabilityStudy& study) {
    std::string summary;
    for (const StudyColumn column : study.plan.columns) summary += tallyOf(study, column) + "\n";
    return summary;
}

std::string figuresAsCsv(const StabilityStudy& study, const StudyOrigin& origin) {
    CsvTable table("case,name,column,figure,value,unit,limit,verdict,wall_s,command,version,machine");
    for (const TrialResult& result : study.results) {
        const auto row = [&](std::string_view figure, double value, std::string_view unit, double limit,
                             Verdict verdict) {
            table.row(result.hardCase->number, result.hardCase->name, nameOf(result.column), figure, value,
                      unit, limit, nameOf(verdict), result.seconds, origin.command, origin.version,
                      origin.machine);
        };
        if (result.figures.empty()) row("", NAN, "", NAN, result.verdict);
        for (const Figure& figure : result.figures)
            row(figure.name, figure.value, figure.unit, figure.limit,
                figure.holds() ? Verdict::Holds : Verdict::Fails);
    }
    return table.take();
}

} // namespace carom
