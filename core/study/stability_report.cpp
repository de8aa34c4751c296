// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/stability_report.h"

#include "core/base/csv.h"
#include "core/base/figures.h"
#include "core/base/text.h"

#include <algorithm>

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
    text.append(hardCase.name).append(", ").append(nameOf(result.column)).append(": ");
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
    std::string csv = "case,name,column,figure,value,unit,limit,verdict,wall_s,command,version,machine\n";
    const std::string tail = "," + csvField(origin.command) + "," + csvField(origin.version) + "," +
                             csvField(origin.machine) + "\n";
    for (const TrialResult& result : study.results) {
        std::string head = std::to_string(result.hardCase->number);
        head.append(",").append(result.hardCase->name).append(",").append(nameOf(result.column)).append(",");
        const std::string time = shortest(result.seconds);
        if (result.figures.empty())
            csv.append(head)
                .append(",,,,")
                .append(nameOf(result.verdict))
                .append(",")
                .append(time)
                .append(tail);
        for (const Figure& figure : result.figures) {
            const Verdict verdict = figure.holds() ? Verdict::Holds : Verdict::Fails;
            csv.append(head).append(csvField(figure.name)).append(",").append(shortest(figure.value));
            csv.append(",").append(figure.unit).append(",").append(shortest(figure.limit)).append(",");
            csv.append(nameOf(verdict)).append(",").append(time).append(tail);
        }
    }
    return csv;
}

} // namespace carom
