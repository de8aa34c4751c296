// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/stability.h"

#include "core/study/hard_scenes.h"
#include "core/study/trial.h"

#include "core/base/catalogue.h"
#include "core/base/clock.h"
#include "core/base/text.h"
#include "core/language/formatter.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

namespace carom {

#define CAROM_HARD_CASE(row) extern const HardCase row;
#include "core/study/cases/cases.def"
#undef CAROM_HARD_CASE

std::span<const HardCase> hardCases() {
    static const std::vector<HardCase> all = [] {
        std::vector<HardCase> rows = {
#define CAROM_HARD_CASE(row) row,
#include "core/study/cases/cases.def"
#undef CAROM_HARD_CASE
        };
        const std::span<const HardCase> scenes = sceneCases();
        rows.insert(rows.end(), scenes.begin(), scenes.end());
        std::ranges::sort(rows, {}, &HardCase::number);
        return rows;
    }();
    return all;
}

namespace {

/// Names with a possessive; file names have no apostrophe.
constexpr std::string_view possessive = "eulers", apostrophised = "Euler's";

} // namespace

std::string spokenName(const HardCase& hardCase) {
    std::string words(hardCase.name);
    std::ranges::replace(words, '_', ' ');
    if (words.starts_with(possessive)) return words.replace(0, possessive.size(), apostrophised);
    words.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(words.front())));
    return words;
}

const HardCase* findHardCase(std::string_view nameOrNumber) {
    if (const HardCase* row = findByName(hardCases(), nameOrNumber)) return row;
    for (const HardCase& row : hardCases())
        if (spokenName(row) == nameOrNumber) return &row;
    const std::optional<long long> number = wholeNumberIn(nameOrNumber);
    for (const HardCase& row : hardCases())
        if (number && row.number == *number) return &row;
    return nullptr;
}

std::string_view nameOf(StudyColumn column) {
    static constexpr std::array<std::string_view, 3> names = {"default", "accurate", "exact"};
    return names[static_cast<std::size_t>(column)];
}

std::string_view nameOf(Verdict verdict) {
    static constexpr std::array<std::string_view, 3> names = {"holds", "fails", "not applicable"};
    return names[static_cast<std::size_t>(verdict)];
}

std::string sceneOf(const HardCase& hardCase, StudyColumn column) {
    if (!hardCase.scene.empty()) return sceneTextOf(hardCase, column);
    std::string text = "# Hard case " + std::to_string(hardCase.number) + ": ";
    text.append(hardCase.title).append(".\n# Right: ").append(hardCase.answer).append(".\n\n");
    text.append(hardCase.declarations()).append(simulationOf(column, hardCase.simulation));
    return formatText(analyse(std::move(text)));
}

namespace {

/// How far a figure is beyond its limit, for sorting: 1 is at the limit.
double excessOf(const Figure& figure) {
    if (std::isnan(figure.value)) return std::numeric_limits<double>::infinity();
    if (figure.limit > 0) return figure.value / figure.limit;
    return figure.value > 0 ? std::numeric_limits<double>::max() : figure.value;
}

} // namespace

const Figure* TrialResult::decisive() const {
    const Figure* worst = nullptr;
    for (const Figure& figure : figures)
        if (worst == nullptr || excessOf(figure) > excessOf(*worst)) worst = &figure;
    return worst;
}

std::size_t StabilityStudy::count(StudyColumn column, Verdict verdict) const {
    return static_cast<std::size_t>(std::ranges::count_if(results, [&](const TrialResult& result) {
        return result.column == column && result.verdict == verdict;
    }));
}

bool StabilityStudy::allHold() const {
    return std::ranges::none_of(results,
                                [](const TrialResult& result) { return result.verdict == Verdict::Fails; });
}

std::optional<TrialResult> runTrial(const HardCase& hardCase, StudyColumn column, StudyLength length,
                                    const StabilityListener& listener) {
    TrialResult result{.hardCase = &hardCase, .column = column, .figures = {}};
    if (!hardCase.has(column)) return result;
    if (listener.starts) listener.starts(hardCase, column);
    const Stopwatch watch;
    Trial trial(hardCase, column, length, listener.goOn);
    hardCase.run(trial);
    if (trial.stopped()) return std::nullopt;
    result.figures = trial.takeFigures();
    const bool holds = !result.figures.empty() && std::ranges::all_of(result.figures, &Figure::holds);
    result.verdict = holds ? Verdict::Holds : Verdict::Fails;
    result.seconds = watch.elapsed() / 1000;
    return result;
}

std::vector<std::pair<const HardCase*, StudyColumn>> StabilityPlan::trials() const {
    std::vector<std::pair<const HardCase*, StudyColumn>> all;
    for (const HardCase* hardCase : cases)
        for (const StudyColumn column : columns) all.emplace_back(hardCase, column);
    return partOf(shard, all);
}

StabilityStudy runStability(const StabilityPlan& plan, const StabilityListener& listener) {
    StabilityStudy study{.plan = plan, .results = {}};
    for (const auto& [hardCase, column] : plan.trials()) {
        std::optional<TrialResult> result = runTrial(*hardCase, column, plan.length, listener);
        if (!result) return study;
        if (listener.ends) listener.ends(*result);
        study.results.push_back(std::move(*result));
    }
    study.complete = true;
    return study;
}

} // namespace carom
