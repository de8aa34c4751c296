// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/charts.h"
#include "app/command.h"
#include "app/engines.h"
#include "app/errors.h"
#include "app/files.h"
#include "app/instructions.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/shard_files.h"
#include "app/scene_options.h"
#include "app/study_origin.h"
#include "core/base/csv.h"
#include "core/base/figures.h"
#include "core/base/text.h"
#include "core/integrators/integrator.h"
#include "core/scene/schema.h"
#include "core/study/accuracy_csv.h"
#include "core/study/accuracy_report.h"
#include "core/study/measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <exception>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>

namespace carom {

CommandRow studyAccuracyCommand();

namespace {

constexpr std::string_view command = "study accuracy";
constexpr const char* figuresFile = "accuracy.csv";
constexpr const char* comparisonFile = "scenes.csv";

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
AccuracyPlan planFrom(const Arguments& arguments, const std::string& path, const Scene& scene) {
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
    if (const std::optional<std::string> engines = arguments.text("engines")) {
        if (path == "-")
            throw UsageError("`--engines` starts programs that read the scene; give a file in place of `-`");
        for (const std::string& engine : wordsOf(*engines)) engineProgram(engine);
        addEngines(plan, wordsOf(*engines));
        plan.runEngine = [path](const EngineRequest& request) { return runEngineProgram(path, request); };
    }
    plan.duration = arguments.positiveNumber("duration").value_or(plan.duration);
    plan.budget = arguments.positiveNumber("budget").value_or(plan.budget);
    std::vector<std::string_view> names;
    for (const MeasureRow& row : measures()) names.push_back(row.name);
    if (const std::optional<std::string> name = arguments.word("measure", names))
        plan.measure = findMeasure(*name);
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
        // Ended before there was a reference solution to measure against, a study has no result; existing
        // files stay.
        if (!study.reference && std::filesystem::exists(path(figuresFile))) return;
        writeFile(m_folder, figuresFile, pointsAsCsv(study, m_hash, m_origin));
    }
    void writeTexts(const AccuracyStudy& study) const {
        writeFigures(study);
        writeFile(m_folder, "summary.txt", summaryOf(study));
    }
    void writeAll(const AccuracyStudy& study, const std::string& title) const {
        writeTexts(study);
        if (chartDrawer().accuracy == nullptr) return;
        for (const char* name : {"accuracy.svg", "accuracy.png", "accuracy.pdf"})
            chartDrawer().accuracy(study, title, path(name));
    }

    /// What an earlier study has measured. Throws UsageError where it is no study to go on from: its file
    /// would be overwritten.
    KnownPoints known(const AccuracyPlan& plan) const {
        const std::string file = path(figuresFile);
        ReadPoints read = pointsFromCsv(readText(file), {m_hash, plan.duration, m_origin.version});
        for (const AccuracyPoint& point : read.known.points)
            if (read.objection.empty() && !point.isDefault &&
                std::ranges::count(plan.settings, point.setting) == 0)
                read.objection = "it has `" + point.setting.name() + "`, which these options leave out";
        if (!read.objection.empty())
            throw UsageError("`--resume` cannot go on from `" + file + "`: " + read.objection +
                             "; another folder would be right");
        return std::move(read.known);
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

/// One scene of the command line, read and planned.
struct PlannedStudy {
    std::string path;
    Build built;
    AccuracyPlan plan;
    std::optional<Results> results;

    const Scene& scene() const { return built.pipeline->scene(); }
};

PlannedStudy planned(const Arguments& arguments, const std::string& path) {
    PlannedStudy study{.path = path, .built = loadScene(path), .plan = {}, .results = {}};
    if (study.built.pipeline->bodies().mobileBodies.empty())
        throw UsageError("nothing in `" + displayName(path) + "` can move; there is no error to study");
    study.plan = planFrom(arguments, path, study.scene());
    return study;
}

/// Where the figures of a scene go: into the folder itself, or, where there are several scenes, into one of
/// its own there.
void openResults(const Arguments& arguments, PlannedStudy& study) {
    const std::optional<std::string> folder = arguments.text("output");
    if (!folder) return;
    const bool alone = arguments.operands.size() == 1;
    study.results.emplace(alone ? *folder : (std::filesystem::path(*folder) / titleOf(study.path)).string(),
                          hashOfScene(study.built.analysis.text), studyOrigin(command, arguments));
}

/// Runs a study until its budget ends or it is interrupted.
AccuracyStudy run(const PlannedStudy& planned, const KnownPoints& known) {
    auto progress = std::make_unique<Progress>(static_cast<std::int64_t>(std::ceil(planned.plan.budget)),
                                               "s of the budget");
    AccuracyStudy study; // as far as it is
    InterimResults interim("carom " + std::string(command));
    InterruptibleWork work([&] {
        printOut(summaryOf(study));
        if (planned.results) planned.results->writeTexts(study);
    });
    AccuracyListener listener;
    listener.goOn = [&](double seconds) {
        progress->update(static_cast<std::int64_t>(seconds));
        return !interrupted();
    };
    listener.changed = [&](const AccuracyStudy& soFar) {
        work.change([&] {
            study = soFar;
            if (planned.results) interim.write([&] { planned.results->writeFigures(study); });
        });
    };
    return work.step([&] { return runAccuracy(planned.scene(), planned.plan, listener, known); });
}

int studyOne(const Arguments& arguments) {
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
    PlannedStudy one = planned(arguments, path);
    catchInterrupts(); // once the folder is there, an interrupted study is written into it
    openResults(arguments, one);
    AccuracyStudy study = run(one, arguments.has("resume") ? one.results->known(one.plan) : KnownPoints());
    const std::exception_ptr problem =
        counts && study.complete ? count(study, path, one.results) : std::exception_ptr();

    printOut(summaryOf(study));
    if (one.results) one.results->writeAll(study, titleOf(path));
    if (chart) chartDrawer().accuracy(study, titleOf(path), *chart);
    if (problem) std::rethrow_exception(problem);
    return study.complete ? exitcode::done : exitcode::interrupted;
}

/// Several scenes: a line each, as soon as it is known, and the same as a file.
int studyMany(const Arguments& arguments) {
    const Shard shard = shardFrom(arguments);
    for (const char* option : {"chart", "instructions", "resume"})
        if (arguments.has(option))
            throw UsageError("`--" + std::string(option) + "` is for one scene; there are " +
                             std::to_string(arguments.operands.size()));
    std::size_t width = std::string_view("scene").size();
    std::map<std::string, std::string> titles;
    for (const std::string& path : arguments.operands) {
        width = std::max(width, titleOf(path).size());
        const auto [first, isNew] = titles.try_emplace(titleOf(path), path);
        if (!isNew && arguments.has("output"))
            throw UsageError("`" + first->second + "` and `" + path + "` have one name, `" + first->first +
                             "`, and would write into one folder");
    }
    // What is wrong with the last scene is said before the first has taken a minute.
    std::deque<PlannedStudy> waiting; // each is read once, and so are its warnings
    for (const std::string& path : partOf(shard, arguments.operands))
        waiting.push_back(planned(arguments, path));
    catchInterrupts();
    CsvTable table(comparisonColumns());
    printOut(comparisonHeading(width));
    for (; !waiting.empty(); waiting.pop_front()) {
        PlannedStudy& one = waiting.front();
        const std::string title = titleOf(one.path);
        openResults(arguments, one);
        const AccuracyStudy study = run(one, {});
        printOut(comparisonLine(title, width, study));
        if (one.results) one.results->writeAll(study, title);
        addComparison(title, study, table);
        if (const std::optional<std::string> folder = arguments.text("output"))
            writeFile(*folder, nameOfPart(comparisonFile, shard), CsvTable(table).take());
        if (!study.complete) return exitcode::interrupted;
    }
    return exitcode::done;
}

int runStudy(const Arguments& arguments) {
    if (const std::optional<std::string> parts = arguments.text("merge")) {
        mergeParts(*parts, std::array<std::string_view, 1>{comparisonFile});
        return exitcode::done;
    }
    if (arguments.operands.empty()) throw UsageError("missing SCENE...");
    if (arguments.operands.size() == 1 && arguments.has("shard"))
        throw UsageError("`--shard` shares scenes, and there is one");
    return arguments.operands.size() == 1 ? studyOne(arguments) : studyMany(arguments);
}

} // namespace

CommandRow studyAccuracyCommand() {
    return {
        .name = command,
        .summary = "What accuracy costs in time: errors and times of every setting of a scene",
        .operands = "SCENE...",
        .example = "carom study accuracy scenes/pool_break.sdl -o results\n"
                   "carom study accuracy scenes/*.sdl --budget 20\n"
                   "carom study accuracy swing.sdl --methods contacts --substeps 1,2,4,8 --target 1e-4\n"
                   "carom study accuracy scenes/pile.sdl --engines bullet,ode\n"
                   "carom study accuracy scenes/brownian.sdl --instructions --chart gas.svg",
        .options =
            {
                {"methods", 0, "LIST", "methods of motion, separated by commas (default all that can)"},
                {"integrators", 0, "LIST", "integrators (default all that differ on the scene)"},
                {"substeps", 0, "LIST", "substeps of a frame (default 1,2,4,8,16,32,64)"},
                {"tolerances", 0, "LIST", "tolerances of method contacts (default those of the presets)"},
                {"duration", 0, "S", "seconds to simulate (default the scene's, at most 10, or 2)"},
                {"budget", 0, "S", "seconds that the study may take (default 60)"},
                {"measure", 0, "WORD",
                 "what the diagram has across: trajectory, impacts, energy, overlap, residual or rest "
                 "(default "
                 "the first that says something)"},
                {"engines", 0, "LIST",
                 "other engines beside ours, separated by commas: programs carom-engine-NAME, such as bullet "
                 "and ode"},
                {"runs", 0, "N", "timed runs of a setting at most: until they agree (default 9)"},
                {"target", 0, "E", "the error that is accurate enough (default 1e-3)"},
                {"copies", 0, "N",
                 "runs of a scene of many balls beyond the chaos horizon, at most; 0: none (default 20)"},
                {"instructions", 0, "", "count the instructions of every setting, too; needs valgrind"},
                {"resume", 0, "", "go on with the study in the folder of `--output`, with a new budget"},
                {"shard", 0, "I/N", "of several scenes only the I-th of N parts (the first is 1)"},
                mergeOption(),
                {"output", 'o', "DIR",
                 "write accuracy.csv, summary.txt and the chart (SVG, PNG and PDF) there; of several scenes "
                 "each into a folder of its name, and scenes.csv"},
                {"chart", 0, "FILE", "write the chart there, by the ending as SVG, PNG or PDF"},
            },
        .details =
            "Every setting is run against the reference solution: a closed form where the scene has one, "
            "else exact events, else a run with more and more substeps, with a bound of its own error. "
            "Settings go from coarse to fine, the scene's own and the presets' first, as long as the budget "
            "lasts; what does not fit is named. Where the scene's own setting alone takes more than a "
            "twentieth of the budget, less of the scene is studied. Ctrl-C ends the study: what was measured "
            "is written, and the exit code is 130; at the end of the budget it is 0.\n\n"
            "Measures: `trajectory`, the greater of the largest distance, relative to the scene's size, and "
            "the largest angle, of each body as long as it can be followed: until copies that start next to "
            "each other have diverged, or until the finest runs do not agree. `impacts`: how many are "
            "missed, and by how much each "
            "body's k-th one comes too early or late. `energy`: how far it is off, up or down, relative to "
            "the "
            "largest exchanged in the run. `overlap`: the deepest, relative to half the thinnest body. "
            "`residual`: "
            "of the contact forces. `rest`: height and centre of mass at the end, time to rest, energy "
            "lost. Times are processor times per simulated second, the median of the runs. A setting that "
            "lost its state or took too long stays in the figures, and so does one that changed its energy "
            "by 1 %.\n\n"
            "Of fifty balls and more that are followed far beyond the horizon, copies a millionth apart are "
            "compared with exact ones as a crowd: distribution of the speeds, pressure at the walls, time "
            "between impacts; medians and quartiles of up to `--copies` runs. Instructions are those of "
            "`carom run` under valgrind's callgrind, some fifty times slower and beyond the budget, and do "
            "not depend on what else the machine does.\n\n"
            "Of several scenes a line each is printed: seconds taken, measure, reference solution, how many "
            "times the cheapest setting that is no worse is cheaper than the scene's own, the sentence.",
        .leastOperands = 0,
        .mostOperands = std::numeric_limits<std::size_t>::max(),
        .run = runStudy,
        .drawsCharts = true};
}

} // namespace carom
