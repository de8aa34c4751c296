// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/charts.h"
#include "app/command.h"
#include "app/errors.h"
#include "app/files.h"
#include "app/instructions.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/scene_options.h"
#include "app/study_origin.h"
#include "core/base/text.h"
#include "core/integrators/integrator.h"
#include "core/scene/schema.h"
#include "core/study/accuracy_csv.h"
#include "core/study/accuracy_report.h"

#include <algorithm>
#include <cmath>
#include <exception>
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
    std::vector<std::string_view> known; // all but `auto`, which is one of them
    for (const SolverRow& row : solvers()) known.push_back(row.name);
    const auto methods = wordsGiven(arguments, "methods", known);
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
    plan.timeLimit = arguments.positiveNumber("time-limit").value_or(plan.timeLimit);
    plan.target = arguments.positiveNumber("target").value_or(plan.target);
    plan.copies = static_cast<int>(arguments.wholeNumber("copies", 0, 1000).value_or(plan.copies));
    plan.runs = static_cast<int>(arguments.wholeNumber("runs", 1, 1000).value_or(plan.runs));
    return plan;
}

/// The file of `--chart`, which must be one that can be drawn.
std::optional<std::string> chartPath(const Arguments& arguments) {
    std::optional<std::string> path = arguments.text("chart");
    if (!path) return path;
    const std::string ending = std::filesystem::path(*path).extension().string();
    if (ending != ".svg" && ending != ".png" && ending != ".pdf")
        throw UsageError("`--chart` has `" + *path + "`; its ending must be .svg, .png or .pdf");
    if (chartDrawer().accuracy == nullptr)
        throw UsageError("`--chart` needs a build with the IDE, which draws the charts");
    return path;
}

/// The folder of `--output`, whose figures are brought up to date after every run.
class Results {
  public:
    Results(std::string folder, std::string sceneHash, StudyOrigin origin)
        : m_folder(std::move(folder)), m_hash(std::move(sceneHash)), m_origin(std::move(origin)) {
        makeFolder(m_folder);
    }

    std::string path(const char* name) const { return (std::filesystem::path(m_folder) / name).string(); }

    void writeFigures(const AccuracyStudy& study) const {
        // Ended before there was a reference solution to measure against, a study has nothing to say; what
        // was there stays.
        if (!study.reference && std::filesystem::exists(path(figuresFile))) return;
        writeFile(m_folder, figuresFile, pointsAsCsv(study, m_hash, m_origin));
    }
    void writeAll(const AccuracyStudy& study, const std::string& title) const {
        writeFigures(study);
        writeFile(m_folder, "summary.txt", summaryOf(study));
        if (chartDrawer().accuracy == nullptr) return;
        for (const char* name : {"accuracy.svg", "accuracy.png", "accuracy.pdf"})
            chartDrawer().accuracy(study, title, path(name));
    }

    /// What an interrupted study has measured. Throws UsageError where it is no study to go on from: its file
    /// would be overwritten.
    std::vector<AccuracyPoint> known(const AccuracyPlan& plan) const {
        const std::string file = path(figuresFile);
        KnownPoints known = pointsFromCsv(readText(file), {m_hash, plan.duration, m_origin.version});
        for (const AccuracyPoint& point : known.points)
            if (known.objection.empty() && !point.isDefault &&
                std::ranges::count(plan.settings, point.setting) == 0)
                known.objection = "it has `" + point.setting.name() + "`, which these options leave out";
        if (!known.objection.empty())
            throw UsageError("`--resume` cannot go on from `" + file + "`: " + known.objection +
                             "; another folder would be right");
        return known.points;
    }

  private:
    std::string m_folder, m_hash;
    StudyOrigin m_origin;
};

/// Counts instructions, too; what went wrong, or nothing. What was measured stays in any case.
std::exception_ptr count(AccuracyStudy& study, const std::string& path,
                         const std::optional<Results>& results) {
    Progress counting(std::ssize(study.points), "settings under callgrind");
    try {
        countInstructions(study, path, [&](std::size_t done) {
            counting.update(static_cast<std::int64_t>(done));
            if (results) results->writeFigures(study);
            study.complete = !interrupted();
            return study.complete;
        });
    } catch (const FileError&) {
        return std::current_exception();
    }
    return nullptr;
}

int runStudy(const Arguments& arguments) {
    const std::string& path = arguments.operands.front();
    const std::optional<std::string> chart = chartPath(arguments);
    const bool counts = arguments.has("instructions");
    if (counts) needValgrind();
    if (counts && path == "-")
        throw UsageError("`--instructions` reads the scene again and again; give a file in place of `-`");
    const std::optional<std::string> folder = arguments.text("output");
    if (arguments.has("resume") && !folder)
        throw UsageError("`--resume` needs `--output`: the folder of the interrupted study");
    std::vector<NamedFile> files = {{"the scene", path}, {"`--chart`", chart.value_or("")}};
    if (folder)
        for (const char* name : {figuresFile, "summary.txt", "accuracy.svg", "accuracy.png", "accuracy.pdf"})
            files.push_back({"`--output`", (std::filesystem::path(*folder) / name).string()});
    refuseSharedFiles(files);
    const Build built = loadScene(path);
    const Scene& scene = built.pipeline->scene();
    if (built.pipeline->bodies().mobileBodies.empty())
        throw UsageError("nothing in the scene can move; there is no error to study");
    const AccuracyPlan plan = planFrom(arguments, scene);
    catchInterrupts(); // once the folder is there, an interrupted study is written into it
    std::optional<Results> results;
    if (folder) results.emplace(*folder, hashOfScene(built.analysis.text), studyOrigin(command, arguments));
    const std::vector<AccuracyPoint> known =
        arguments.has("resume") ? results->known(plan) : std::vector<AccuracyPoint>();

    auto progress = std::make_unique<Progress>(progressParts, "parts in a thousand");
    AccuracyStudy study; // as far as it is
    InterimResults interim("carom " + std::string(command));
    {
        InterruptibleWork work([&] { printOut(summaryOf(study)); });
        AccuracyListener listener;
        listener.goOn = [&](double done) {
            progress->update(static_cast<std::int64_t>(done * progressParts));
            return !interrupted();
        };
        listener.changed = [&](const AccuracyStudy& soFar) {
            work.change([&] {
                study = soFar;
                if (results) interim.write([&] { results->writeFigures(study); });
            });
        };
        AccuracyStudy whole = work.step([&] { return runAccuracy(scene, plan, listener, known); });
        study = std::move(whole);
    }
    progress.reset();
    const std::exception_ptr problem =
        counts && study.complete ? count(study, path, results) : std::exception_ptr();

    const std::string title = std::filesystem::path(path).stem().string();
    printOut(summaryOf(study));
    if (results) results->writeAll(study, title);
    if (chart) chartDrawer().accuracy(study, title, *chart);
    if (problem) std::rethrow_exception(problem);
    return study.complete ? exitcode::done : exitcode::interrupted;
}

} // namespace

CommandRow studyAccuracyCommand() {
    return {
        .name = command,
        .summary = "What accuracy costs in time: errors and times of every setting of a scene",
        .operands = "SCENE",
        .example = "carom study accuracy scenes/pool_break.sdl -o results\n"
                   "carom study accuracy swing.sdl --methods contacts --substeps 1,2,4,8 --target 1e-4\n"
                   "carom study accuracy scenes/brownian.sdl --instructions --chart gas.svg",
        .options =
            {
                {"methods", 0, "LIST", "methods of motion, separated by commas (default all that can)"},
                {"integrators", 0, "LIST", "integrators (default all that differ on the scene)"},
                {"substeps", 0, "LIST", "substeps of a frame (default 1,2,4,8,16,32,64)"},
                {"tolerances", 0, "LIST", "tolerances of method contacts (default 1e-6,1e-10)"},
                {"duration", 0, "S", "seconds to simulate (default the scene's, at most 10, or 2)"},
                {"runs", 0, "N", "timed runs of a setting, which take turns (default 5)"},
                {"time-limit", 0, "S", "seconds a run may take (default 5)"},
                {"target", 0, "E", "the error that is accurate enough (default 1e-3)"},
                {"copies", 0, "N",
                 "runs of a scene of many balls beyond the chaos horizon, at most; 0: none (default 20)"},
                {"instructions", 0, "", "count the instructions of every setting, too; needs valgrind"},
                {"resume", 0, "", "go on with the interrupted study in the folder of `--output`"},
                {"output", 'o', "DIR",
                 "write accuracy.csv, summary.txt and the chart (SVG, PNG and PDF) there"},
                {"chart", 0, "FILE", "write the chart there, by the ending as SVG, PNG or PDF"},
            },
        .details =
            "Every setting is run against the reference solution: a closed form where the scene has one, "
            "else exact "
            "events, else a run with more and more substeps, with a bound of its own error. An error is the "
            "greater of the largest distance, relative to the scene's size, and the largest angle, at eight "
            "looks a frame, within the time for which two copies 1e-12 apart stay together. Times are "
            "processor times per simulated second, the median of the runs. A setting that lost its state or "
            "took too long stays in the figures, and so does one that changed its energy by 1 %. Ctrl-C ends "
            "the study: what was measured is written, and the exit code is 130.\n\n"
            "Impacts are seen from frame to frame: how many there are, and by how much each body's k-th one "
            "comes too early or late. Of fifty balls and more that are followed far beyond the horizon, "
            "copies "
            "a millionth apart are compared with exact ones as a crowd: distribution of the speeds, pressure "
            "at the walls, time between impacts; medians and quartiles of up to `--copies` runs, as many as "
            "the time limit allows. Instructions are those of `carom run` under valgrind's callgrind, some "
            "fifty times slower, and do not depend on what else the machine does.",
        .leastOperands = 1,
        .mostOperands = 1,
        .run = runStudy};
}

} // namespace carom
