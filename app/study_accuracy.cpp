// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/charts.h"
#include "app/command.h"
#include "app/errors.h"
#include "app/files.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/scene_options.h"
#include "app/study_origin.h"
#include "core/base/text.h"
#include "core/integrators/integrator.h"
#include "core/scene/schema.h"
#include "core/study/accuracy_report.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

namespace carom {

CommandRow studyAccuracyCommand();

namespace {

constexpr std::string_view command = "study accuracy";
constexpr const char* figuresFile = "accuracy.csv";
constexpr std::int64_t progressParts = 1000;

/// The words of a list option; each must be one of the known ones.
std::optional<std::vector<std::string>> wordsGiven(const Arguments& arguments, std::string_view option,
                                                   std::span<const std::string_view> known) {
    const std::optional<std::string> list = arguments.text(option);
    if (!list) return std::nullopt;
    std::vector<std::string> words = wordsOf(*list);
    for (const std::string& word : words)
        if (std::ranges::count(known, word) == 0)
            throw UsageError("`--" + std::string(option) + "` has `" + word + "`; it must be " +
                             listOf(known));
    return words;
}

std::vector<double> numbersFrom(const Arguments& arguments, std::string_view option, bool whole) {
    std::vector<double> numbers;
    const std::optional<std::string> list = arguments.text(option);
    if (!list) return numbers;
    for (const std::string& word : wordsOf(*list)) {
        const std::optional<double> number = numberIn(word);
        if (!number || *number <= 0 || (whole && (*number != std::floor(*number) || *number > 4096)))
            throw UsageError("`--" + std::string(option) + "` has `" + word + "`; it must be a list of " +
                             (whole ? "whole numbers from 1 to 4096" : "numbers above 0") +
                             ", separated by commas");
        numbers.push_back(*number);
    }
    return numbers;
}

/// The plan of the scene, narrowed to what the command line names.
AccuracyPlan planFrom(const Arguments& arguments, const Scene& scene) {
    AccuracyPlan plan = planFor(scene);
    const auto methods = wordsGiven(arguments, "methods", methodWords());
    const auto schemes = wordsGiven(arguments, "integrators", integratorWords());
    std::erase_if(plan.settings, [&](const AccuracySetting& setting) {
        const auto lacks = [](const auto& words, std::string_view name) {
            return words && std::ranges::count(*words, name) == 0;
        };
        return lacks(methods, setting.method->name) ||
               (setting.integrator != nullptr && lacks(schemes, setting.integrator->name));
    });
    vary(plan, numbersFrom(arguments, "substeps", true), numbersFrom(arguments, "tolerances", false));
    plan.duration = arguments.positiveNumber("duration").value_or(plan.duration);
    plan.patience = arguments.positiveNumber("patience").value_or(plan.patience);
    plan.target = arguments.positiveNumber("target").value_or(plan.target);
    plan.runs = static_cast<int>(arguments.wholeNumber("runs", 1, 1000).value_or(plan.runs));
    return plan;
}

int runStudy(const Arguments& arguments) {
    const std::string& path = arguments.operands.front();
    const Build built = loadScene(path);
    const Scene& scene = built.pipeline->scene();
    if (built.pipeline->bodies().mobileBodies.empty())
        throw UsageError("nothing in the scene can move; there is no error to study");
    const AccuracyPlan plan = planFrom(arguments, scene);
    const std::string hash = hashOfScene(built.analysis.text);
    const std::optional<std::string> folder = arguments.text("output");
    if (folder) makeFolder(*folder);
    std::vector<AccuracyPoint> known;
    if (arguments.has("resume")) {
        if (!folder) throw UsageError("`--resume` needs `--output`: the folder of the interrupted study");
        known = pointsFromCsv(readText((std::filesystem::path(*folder) / figuresFile).string()), hash,
                              plan.duration);
    }
    catchInterrupts();

    auto progress = std::make_unique<Progress>(progressParts, "parts in a thousand");
    AccuracyListener listener;
    listener.goOn = [&](double done) {
        progress->update(static_cast<std::int64_t>(done * progressParts));
        return !interrupted();
    };
    const AccuracyStudy study = runAccuracy(scene, plan, listener, known);
    progress.reset();

    const std::string summary = summaryOf(study);
    printOut(summary);
    if (folder) {
        writeFile(*folder, figuresFile, pointsAsCsv(study, hash, studyOrigin(command, arguments)));
        writeFile(*folder, "summary.txt", summary);
        if (chartDrawer().accuracy)
            chartDrawer().accuracy(study, std::filesystem::path(path).stem().string(), *folder);
    }
    return study.complete ? exitcode::done : exitcode::interrupted;
}

} // namespace

CommandRow studyAccuracyCommand() {
    return {
        .name = command,
        .summary = "What accuracy costs in time: errors and times of every setting of a scene",
        .operands = "SCENE",
        .example = "carom study accuracy scenes/pool_break.sdl -o results\n"
                   "carom study accuracy swing.sdl --methods contacts --substeps 1,2,4,8 --target 1e-4",
        .options =
            {
                {"methods", 0, "LIST", "methods of motion, separated by commas (default all that can)"},
                {"integrators", 0, "LIST", "integrators (default all that differ on the scene)"},
                {"substeps", 0, "LIST", "substeps of a frame (default 1,2,4,8,16,32,64)"},
                {"tolerances", 0, "LIST", "tolerances of method contacts (default 1e-6,1e-10)"},
                {"duration", 0, "S", "seconds to simulate (default the scene's, at most 10, or 2)"},
                {"runs", 0, "N", "timed runs of a setting, which take turns (default 5)"},
                {"patience", 0, "S", "seconds a run may take (default 5)"},
                {"target", 0, "E", "the error that is accurate enough (default 1e-3)"},
                {"resume", 0, "", "go on with the interrupted study in the folder of `--output`"},
                {"output", 'o', "DIR",
                 "write accuracy.csv, summary.txt and the chart (SVG, PNG and PDF) there"},
            },
        .details =
            "Every setting is run against the truth: a closed form where the scene has one, else exact "
            "events, else a run with more and more substeps, with a bound of its own error. An error is the "
            "greater of the largest distance, relative to the scene's size, and the largest angle, at eight "
            "looks a frame, within the time for which two copies 1e-12 apart stay together. Times are "
            "processor times per simulated second, the median of the runs. A setting that lost its state or "
            "took too long stays in the figures, and so does one that changed its energy by 1 %. Ctrl-C ends "
            "the study: what was measured is written, and the exit code is 130.",
        .leastOperands = 1,
        .mostOperands = 1,
        .run = runStudy};
}

} // namespace carom
