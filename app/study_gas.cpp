// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/charts.h"
#include "app/command.h"
#include "app/errors.h"
#include "app/files.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/scene_options.h"
#include "app/study_origin.h"
#include "core/study/gas_report.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace carom {

CommandRow studyGasCommand();

namespace {

constexpr std::string_view command = "study gas";

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

int runStudy(const Arguments& arguments) {
    const GasPlan plan = planFrom(arguments);
    const std::string& path = arguments.operands.front();
    const std::optional<std::string> folder = arguments.text("output");
    std::vector<NamedFile> files = {{"the scene", path}};
    if (folder)
        for (const char* name : {"gas.csv", "speeds.csv", "heights.csv", "summary.txt"})
            files.push_back({"`--output`", (std::filesystem::path(*folder) / name).string()});
    refuseSharedFiles(files);
    const Build built = loadScene(path);
    if (built.hasErrors()) return exitcode::sceneHasErrors;
    if (const std::optional<GasObjection> objection = gasObjection(*built.pipeline)) {
        printError(describe(*objection, path, built));
        return exitcode::sceneHasErrors;
    }
    if (folder) makeFolder(*folder);
    const auto writeFigures = [&](const GasStudy& study) {
        if (!folder) return;
        writeFile(*folder, "gas.csv", figuresAsCsv(study, studyOrigin(command, arguments)));
        writeFile(*folder, "speeds.csv", speedsAsCsv(study));
        if (!study.heights.empty()) writeFile(*folder, "heights.csv", heightsAsCsv(study));
        writeFile(*folder, "summary.txt", summaryOf(study));
    };
    catchInterrupts();
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
                interim.write([&] { writeFigures(study); });
            });
        };
        GasStudy whole = work.step([&] { return studyGas(*built.pipeline, plan, goOn, measured); });
        study = std::move(whole);
    }
    progress.reset();

    printOut(summaryOf(study));
    writeFigures(study);
    if (folder && chartDrawer().gas) chartDrawer().gas(study, *folder);
    return interrupted() ? exitcode::interrupted : exitcode::done;
}

} // namespace

CommandRow studyGasCommand() {
    return {
        .name = command,
        .summary = "Compare a scene of elastic balls with the kinetic theory of gases",
        .operands = "SCENE",
        .example = "carom study gas gas.sdl -o results",
        .options =
            {
                {"settle", 0, "C", "collisions a ball before anything is measured (default 50)"},
                {"collisions", 0, "C", "collisions a ball to measure over (default 200)"},
                {"batches", 0, "B", "parts of the run whose means give the intervals (default 20)"},
                {"output", 'o', "DIR",
                 "write gas.csv, speeds.csv, heights.csv, summary.txt and the charts (SVG and PNG) there"},
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
            "columns figure, value, uncertainty, theory, unit, command, version, machine.",
        .leastOperands = 1,
        .mostOperands = 1,
        .run = runStudy};
}

} // namespace carom
