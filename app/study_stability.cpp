// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/command.h"
#include "app/errors.h"
#include "app/files.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/shard_files.h"
#include "app/study_origin.h"
#include "core/base/catalogue.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

namespace carom {

CommandRow studyStabilityCommand();

namespace {

constexpr std::string_view command = "study stability";
constexpr const char* figuresFile = "stability.csv";

const HardCase* caseNamed(const std::string& name) {
    if (const HardCase* row = findHardCase(name)) return row;
    const std::optional<std::string_view> near = nearestRow(name, hardCases());
    throw UsageError("there is no hard case `" + name + "`; " +
                     (near ? "did you mean `" + std::string(*near) + "`?" : "`--list` names them"));
}

StabilityPlan planFrom(const Arguments& arguments) {
    StabilityPlan plan;
    for (const std::string& name : arguments.operands) plan.cases.push_back(caseNamed(name));
    if (plan.cases.empty())
        for (const HardCase& row : hardCases()) plan.cases.push_back(&row);
    std::vector<std::string_view> names;
    for (const StudyColumn column : studyColumns) names.push_back(nameOf(column));
    if (const std::optional<std::string> wanted = arguments.word("column", names))
        std::erase_if(plan.columns, [&](StudyColumn column) { return nameOf(column) != *wanted; });
    if (arguments.has("long")) plan.length = StudyLength::Long;
    plan.shard = shardFrom(arguments);
    return plan;
}

std::string listOfCases() {
    std::string list;
    for (const HardCase& row : hardCases()) {
        const std::string number = std::to_string(row.number);
        const std::string name = spokenName(row);
        list.append(number.size() < 2 ? " " : "").append(number).append(" ").append(name);
        list.append(std::string(26 - name.size(), ' ')).append(row.title).append("\n");
        list.append(29, ' ').append("right: ").append(row.answer).append("\n");
    }
    return list;
}

int runStudy(const Arguments& arguments) {
    if (arguments.has("list")) {
        printOut(listOfCases());
        return exitcode::done;
    }
    if (const std::optional<std::string> parts = arguments.text("merge")) {
        mergeParts(*parts, std::array<std::string_view, 1>{figuresFile});
        return exitcode::done;
    }
    const StabilityPlan plan = planFrom(arguments);
    if (const std::optional<std::string> name = arguments.text("scene")) {
        printOut(sceneOf(*caseNamed(*name), plan.columns.front()));
        return exitcode::done;
    }
    const std::optional<std::string> folder = arguments.text("output");
    if (folder) makeFolder(*folder);
    catchInterrupts();

    const auto total = static_cast<std::int64_t>(plan.trials().size());
    auto progress = std::make_unique<Progress>(total, "trials");
    std::int64_t done = 0;
    std::string report;
    StabilityStudy study{.plan = plan, .results = {}, .complete = false}; // as far as it is
    InterimResults interim("carom " + std::string(command));
    const auto conclusion = [&] { return "\n" + summaryOf(study); };
    const auto writeFigures = [&] {
        if (!folder) return;
        writeFile(*folder, nameOfPart(figuresFile, plan.shard),
                  figuresAsCsv(study, studyOrigin(command, arguments)));
        writeFile(*folder, nameOfPart("summary.txt", plan.shard), report + conclusion());
    };
    {
        InterruptibleWork work([&] { printOut(conclusion()); });
        StabilityListener listener;
        listener.goOn = [&] {
            progress->update(done);
            return !interrupted();
        };
        listener.ends = [&](const TrialResult& result) {
            const std::string lines = describe(result);
            progress->pause();
            work.change([&] {
                printOut(lines);
                report += lines;
                study.results.push_back(result);
                interim.write(writeFigures);
            });
            progress->update(++done);
        };
        StabilityStudy whole = work.step([&] { return runStability(plan, listener); });
        study = std::move(whole);
    }
    progress.reset();

    printOut(conclusion());
    writeFigures();
    if (!study.complete) return exitcode::interrupted;
    return study.allHold() ? exitcode::done : exitcode::stabilityFailed;
}

} // namespace

CommandRow studyStabilityCommand() {
    return {
        .name = command,
        .summary = "Run the hard cases: each with its figures and its verdict",
        .operands = "[CASE]...",
        .example = "carom study stability -o results\n"
                   "carom study stability sliding_cube 17 --column=accurate --long",
        .options =
            {
                {"long", 0, "", "the cases as published, which take hours; without it, their short forms"},
                {"column", 0, "COLUMN",
                 "only one of `default`, `accurate` (its preset) and `exact` (method events)"},
                {"list", 0, "", "list the cases by number and name, with the right answer of each"},
                {"scene", 0, "CASE", "print a scene of the case, for `--column`, and run nothing"},
                shardOption(),
                mergeOption(),
                {"output", 'o', "DIR",
                 "write stability.csv and summary.txt there; with `--shard` stability-I-of-N.csv"},
            },
        .details =
            "A case is given by number or name, with spaces or underscores; without any, all of them run. "
            "Each has a closed-form answer "
            "or a "
            "quantity that must be kept, and a limit for every column. The exit code is 0 if everything "
            "holds and 5 if a case fails. Ctrl-C ends the study: what was measured is written, and the exit "
            "code is 130. stability.csv has the columns case, name, column, figure, value, unit, limit, "
            "verdict, "
            "wall_s, command, version, machine, a row a figure.",
        .leastOperands = 0,
        .mostOperands = std::numeric_limits<std::size_t>::max(),
        .run = runStudy};
}

} // namespace carom
