// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/accuracy_report.h"

#include "core/base/figures.h"
#include "core/study/measures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace carom {
namespace {

std::string padded(std::string text, std::size_t width) {
    if (text.size() < width) text.append(width - text.size(), ' ');
    return text;
}

/// Lines of cells, columns one under the other.
std::string aligned(const std::vector<std::vector<std::string>>& lines) {
    std::vector<std::size_t> widths;
    for (const std::vector<std::string>& line : lines) {
        widths.resize(std::max(widths.size(), line.size()), 0);
        for (std::size_t k = 0; k + 1 < line.size(); ++k) widths[k] = std::max(widths[k], line[k].size() + 2);
    }
    std::string text;
    for (const std::vector<std::string>& line : lines) {
        text += "  ";
        for (std::size_t k = 0; k < line.size(); ++k) text += padded(line[k], widths[k]);
        text.erase(text.find_last_not_of(' ') + 1);
        text += "\n";
    }
    return text;
}

/// What has not been measured is no figure.
std::string known(double value) { return std::isfinite(value) ? figure(value) : "-"; }

// From the start where nothing takes energy out, else from the reference solution.
std::string energyOffOf(const AccuracyPoint& point, const AccuracyStudy& study) {
    if (study.conservative) return figure(point.energy.worst);
    return point.energyOff ? figure(*point.energyOff) : "-";
}

std::string tableOf(const AccuracyStudy& study, const AccuracyFamily& family) {
    const auto any = [&](const auto& has) {
        return std::any_of(study.points.begin(), study.points.end(), has);
    };
    const bool impacts = any([](const AccuracyPoint& p) { return p.impacts && p.impacts->expected > 0; });
    const bool solves = any([](const AccuracyPoint& p) { return p.residual > 0 || p.coneViolation > 0; });
    const bool counted = any([](const AccuracyPoint& p) { return p.instructions > 0; });
    std::vector<std::vector<std::string>> lines(1);
    lines[0] = {"substeps", std::string(study.measure->name), "ms per simulated s"};
    if (study.measure->name != "trajectory") lines[0].push_back("error");
    if (counted) lines[0].push_back("instructions");
    lines[0].insert(lines[0].end(), {"energy off", "energy up", "overlap"});
    if (solves) lines[0].insert(lines[0].end(), {"residual [m/s]", "outside cone"});
    if (impacts) lines[0].insert(lines[0].end(), {"impacts", "off by [s]"});
    lines[0].push_back("");
    for (const AccuracyPoint* point : family.points) {
        std::vector<std::string>& line = lines.emplace_back();
        line = {std::to_string(point->setting.substeps), known(study.errorOf(*point)),
                point->times.empty() ? "-" : figure(point->cost())};
        if (study.measure->name != "trajectory")
            line.push_back(known(point->status == PointStatus::Timed ? HUGE_VAL : point->errors.worst()));
        if (counted) line.push_back(point->instructions > 0 ? figure(point->instructions, 4) : "-");
        line.push_back(energyOffOf(*point, study));
        line.push_back(figure(point->energy.gain));
        const bool isOurs = point->setting.engine.empty(); // another engine does not tell these
        line.push_back(isOurs ? figure(point->penetration) : "-");
        if (solves)
            line.insert(line.end(), {isOurs ? figure(point->residual) : "-",
                                     isOurs ? figure(point->coneViolation) : "-"});
        if (impacts) {
            const ImpactErrors seen = point->impacts.value_or(ImpactErrors{});
            line.push_back(std::to_string(seen.seen) + " of " + std::to_string(seen.expected));
            line.push_back(figure(seen.time) + (seen.matched < seen.expected
                                                    ? " to number " + std::to_string(seen.matched)
                                                    : ""));
        }
        std::string remark = point->isDefault ? "the scene's own" : "";
        if (!point->reason.empty())
            remark += (remark.empty() ? "" : "; ") + std::string(nameOf(point->status)) + ": " +
                      point->reason.text();
        line.push_back(remark);
    }
    return aligned(lines);
}

std::string inPercent(const Quartiles& value) {
    return figure(100 * value.median, 2) + " (" + figure(100 * value.lower, 2) + " to " +
           figure(100 * value.upper, 2) + ")";
}

/// What many balls did beyond the horizon, if there were many and it went so far.
std::string crowdOf(const AccuracyStudy& study) {
    if (!study.reference || !study.reference->crowd) return {};
    std::vector<std::vector<std::string>> lines = {
        {"setting", "copies", "speeds [%]", "pressure at the walls [%]", "time between impacts [%]"}};
    const auto add = [&lines](const std::string& name, const CrowdFigures& crowd) {
        lines.push_back({name, std::to_string(crowd.copies), inPercent(crowd.speeds),
                         inPercent(crowd.pressure), inPercent(crowd.freeTime)});
    };
    add("exact copies among themselves", study.reference->crowd->scatter);
    for (const AccuracyPoint& point : study.points)
        if (point.crowd) add(point.setting.name(), *point.crowd);
    return "\nBeyond the horizon, where paths mean nothing: how far copies of the scene are from exact ones "
           "as a "
           "crowd.\nKolmogorov's distance of the speeds, and relative deviations; medians, and quartiles in "
           "brackets.\n" +
           aligned(lines);
}

} // namespace

std::string summaryOf(const AccuracyStudy& study) {
    std::string text = yardstickOf(study).text() + "\n";
    if (study.conservative) text += "Nothing takes energy out of the scene: it must stay.\n";
    for (const AccuracyFamily& family : familiesOf(study)) {
        text += "\n" + family.name;
        if (const std::optional<double> order = orderOf(family, study))
            text += "   (order " + figure(*order) + ")";
        text += "\n" + tableOf(study, family);
    }
    text += crowdOf(study);
    if (const Reason engines = enginesIn(study); !engines.empty()) text += "\n" + engines.text() + "\n";
    if (const Reason omissions = omissionsOf(study); !omissions.empty())
        text += "\n" + omissions.text() + "\n";
    if (!study.complete) text += "\nThe study was interrupted; what was measured is shown.\n";
    return text + "\n" + recommendation(study).text() + "\n";
}

namespace {

std::string referenceOf(const AccuracyStudy& study) {
    return std::string(study.reference ? nameOf(study.reference->kind) : "none");
}

} // namespace

std::string comparisonHeading(std::size_t width) {
    return padded("scene", width + 2) + padded("seconds", 9) + padded("measure", 12) +
           padded("reference", 16) + padded("off the front", 15) + "sentence\n";
}

std::string comparisonLine(const std::string& scene, std::size_t width, const AccuracyStudy& study) {
    const std::optional<double> distance = distanceFromFront(study);
    return padded(scene, width + 2) + padded(figure(study.seconds, 3), 9) +
           padded(std::string(study.measure->name), 12) + padded(referenceOf(study), 16) +
           padded(distance ? figure(*distance, 2) : "-", 15) + recommendation(study).text() + "\n";
}

std::string_view comparisonColumns() {
    return "scene,seconds,measure,reference,distance_from_front,settings,left_out,studied_s,duration_s,"
           "sentence";
}

void addComparison(const std::string& scene, const AccuracyStudy& study, CsvTable& table) {
    table.row(scene, study.seconds, study.measure->name, referenceOf(study),
              distanceFromFront(study).value_or(std::numeric_limits<double>::quiet_NaN()),
              study.points.size(), study.leftOut.size(), study.duration, study.plan.duration,
              recommendation(study).text());
}

} // namespace carom
