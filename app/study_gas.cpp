// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/charts.h"
#include "app/command.h"
#include "app/errors.h"
#include "app/files.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/scene_options.h"
#include "app/shard_files.h"
#include "app/study_origin.h"
#include "core/study/gas_report.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <memory>
#include <vector>

namespace carom {

CommandRow studyGasCommand();

namespace {

constexpr std::string_view command = "study gas";
constexpr const char* gasesFile = "gases.csv";

GasPlan planFrom(const Arguments& arguments) {
    GasPlan plan;
    plan.settling = arguments.positiveNumber("settle").value_or(plan.settling);
    plan.measuring = arguments.positiveNumber("collisions").value_or(plan.measuring);
    plan.batches = static_cast<int>(arguments.wholeNumber("batches", 2, 10'000).value_or(plan.batches));
    return plan;
}

std::string describe(const GasObjection& objection, const std::string& path, const Build& built) {
    std::string where = displayName(path);
    if (objection.place.length > 0)
        where += ":" + std::to_string(built.analysis.positionOf(objection.place.offset).line);
    return "carom " + std::string(command) + ": " + where + ": not a gas: " + objection.reason + "\n";
}

/// A scene, read and judged before anything runs.
struct PlannedGas {
    std::string path;
    Build built;
    std::optional<std::string> folder; ///< of its figures
};

/// Whether it is a gas; said if not.
bool isGas(const PlannedGas& gas) {
    if (gas.built.hasErrors()) return false;
    const std::optional<GasObjection> objection = gasObjection(*gas.built.pipeline);
    if (objection) printError(describe(*objection, gas.path, gas.built));
    return !objection;
}

void writeFigures(const GasStudy& study, const std::string& folder, const StudyOrigin& origin) {
    writeFile(folder, "gas.csv", figuresAsCsv(study, origin));
    writeFile(folder, "speeds.csv", speedsAsCsv(study));
    if (!study.heights.empty()) writeFile(folder, "heights.csv", heightsAsCsv(study));
    writeFile(folder, "summary.txt", summaryOf(study));
}

/// Runs one study until it ends or is interrupted, and writes what it has.
GasStudy run(const PlannedGas& gas, const GasPlan& plan, const StudyOrigin& origin) {
    if (gas.folder) makeFolder(*gas.folder);
    const auto write = [&](const GasStudy& study) {
        if (gas.folder) writeFigures(study, *gas.folder, origin);
    };
    std::unique_ptr<Progress> progress;
    GasStudy study; // as far as it is
    InterimResults interim("carom " + std::string(command));
    {
        InterruptibleWork work([&] { printOut(summaryOf(study)); });
        const auto goOn = [&progress](std::int64_t done, std::int64_t total) {
            if (!progress) progress = std::make_unique<Progress>(total, "collisions");
            progress->update(done);
            return !interrupted();
        };
        const auto measured = [&](const GasStudy& soFar) {
            work.change([&] {
                study = soFar;
                interim.write([&] { write(study); });
            });
        };
        GasStudy whole = work.step([&] { return studyGas(*gas.built.pipeline, plan, goOn, measured); });
        study = std::move(whole);
    }
    progress.reset();
    write(study);
    if (gas.folder && chartDrawer().gas) chartDrawer().gas(study, *gas.folder);
    return study;
}

PlannedGas planned(const std::string& path, std::optional<std::string> folder) {
    return {.path = path, .built = loadScene(path), .folder = std::move(folder)};
}

int studyOne(const Arguments& arguments) {
    const std::string& path = arguments.operands.front();
    const std::optional<std::string> folder = arguments.text("output");
    std::vector<NamedFile> files = {{"the scene", path}};
    if (folder)
        for (const char* name : {"gas.csv", "speeds.csv", "heights.csv", "summary.txt"})
            files.push_back({"`--output`", (std::filesystem::path(*folder) / name).string()});
    refuseSharedFiles(files);
    const PlannedGas gas = planned(path, folder);
    if (!isGas(gas)) return exitcode::sceneHasErrors;
    catchInterrupts();
    printOut(summaryOf(run(gas, planFrom(arguments), studyOrigin(command, arguments))));
    return interrupted() ? exitcode::interrupted : exitcode::done;
}

/// Several scenes, such as copies of a gas with other seeds: each into a folder of its name, and one table.
int studyMany(const Arguments& arguments) {
    const Shard shard = shardFrom(arguments);
    const std::optional<std::string> output = arguments.text("output");
    std::vector<std::string> titles;
    for (const std::string& path : arguments.operands) titles.push_back(titleOf(path));
    std::ranges::sort(titles);
    if (const auto twice = std::ranges::adjacent_find(titles); output && twice != titles.end())
        throw UsageError("two scenes are called `" + *twice + "`, and each gets a folder of its name");
    catchInterrupts();
    std::string table = gasesColumns();
    for (const std::string& path : partOf(shard, arguments.operands)) {
        std::optional<std::string> folder;
        if (output) folder = (std::filesystem::path(*output) / titleOf(path)).string();
        const PlannedGas gas = planned(path, folder);
        if (!isGas(gas)) return exitcode::sceneHasErrors;
        const StudyOrigin origin = studyOrigin(command, arguments);
        const GasStudy study = run(gas, planFrom(arguments), origin);
        printOut(displayName(path) + ":\n" + summaryOf(study));
        if (interrupted()) return exitcode::interrupted;
        table += gasesRows(titleOf(path), study, origin);
        if (output) writeFile(*output, nameOfPart(gasesFile, shard), table);
    }
    return exitcode::done;
}

int runStudy(const Arguments& arguments) {
    planFrom(arguments); // what is wrong with it is said first
    if (const std::optional<std::string> parts = arguments.text("merge")) {
        mergeParts(*parts, std::array<std::string_view, 1>{gasesFile});
        return exitcode::done;
    }
    if (arguments.operands.empty()) throw UsageError("missing SCENE...");
    if (arguments.operands.size() == 1 && arguments.has("shard"))
        throw UsageError("`--shard` shares scenes, and there is one");
    return arguments.operands.size() == 1 ? studyOne(arguments) : studyMany(arguments);
}

} // namespace

CommandRow studyGasCommand() {
    return {
        .name = command,
        .summary = "Compare a scene of elastic balls with the kinetic theory of gases",
        .operands = "SCENE...",
        .example = "carom study gas gas.sdl -o results\n"
                   "carom study gas copies/*.sdl --shard 2/4 -o results\n"
                   "carom study gas --merge results",
        .options =
            {
                {"settle", 0, "C", "collisions a ball before anything is measured (default 50)"},
                {"collisions", 0, "C", "collisions a ball to measure over (default 200)"},
                {"batches", 0, "B", "parts of the run whose means give the intervals (default 20)"},
                {"shard", 0, "I/N", "of several scenes only the I-th of N parts (the first is 1)"},
                mergeOption(),
                {"output", 'o', "DIR",
                 "write gas.csv, speeds.csv, heights.csv, summary.txt and the charts (SVG and PNG) there; of "
                 "several scenes each into a folder of its name, and gases.csv"},
            },
        .details =
            "The balls move by the exact method, whatever the scene asks for. Measured are: the distribution "
            "of speeds against Maxwell's; without gravity in a closed box the compressibility Z = p/(n kT), "
            "by "
            "the collisions inside and by the momentum given to the middle of the walls, against Carnahan "
            "and "
            "Starling's, and the time between collisions against Enskog's; under gravity above a level floor "
            "the numbers and temperatures of layers against the barometric formula. Intervals are of 95 %. "
            "Ctrl-C ends the study: what was measured is written, and the exit code is 130. gas.csv has the "
            "columns figure, value, uncertainty, theory, unit, command, version, machine. Of several scenes, "
            "such "
            "as copies with other seeds, gases.csv has the same rows behind the name of each; with `--shard` "
            "each part writes its own, gases-2-of-4.csv, and `--merge` makes gases.csv of them.",
        .leastOperands = 0,
        .mostOperands = std::numeric_limits<std::size_t>::max(),
        .run = runStudy,
        .drawsCharts = true};
}

} // namespace carom
