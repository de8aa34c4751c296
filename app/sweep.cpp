// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/charts.h"
#include "app/command.h"
#include "app/errors.h"
#include "app/files.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/sweep_folder.h"
#include "core/base/figures.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <thread>

namespace carom {

CommandRow sweepCommand();

namespace {

/// Largest value of options that count: as many as a sweep has runs (Sweep::mostRuns).
constexpr std::int64_t many = 100'000'000;

/// What the scene's `sweep` declaration says, if it counts, but where the command line says something else.
SweepDefinition definitionFrom(const Arguments& arguments, const std::string& text) {
    SweepDefinition definition;
    if (!arguments.has("no-declaration"))
        if (const std::optional<SweepRequest> declared = analyse(text).scene.sweep)
            definition = definitionOf(*declared);
    if (arguments.has("vary")) definition.vary = arguments.texts("vary");
    if (arguments.has("measure")) definition.measures = arguments.texts("measure");
    if (arguments.has("zip")) definition.zip = true;
    definition.random = arguments.wholeNumber("random", 1, many).value_or(definition.random);
    definition.randomSeed =
        static_cast<std::uint64_t>(arguments.wholeNumber("random-seed", 0, many).value_or(1));
    definition.seeds = arguments.wholeNumber("seeds", 1, many).value_or(definition.seeds);
    if (const auto frames = arguments.wholeNumber("frames", 1, std::numeric_limits<std::int64_t>::max()))
        definition.frames = *frames;
    definition.generate = arguments.text("generate").value_or("");
    return definition;
}

std::shared_ptr<const Sweep> sweepFrom(const Arguments& arguments) {
    const bool generates = arguments.has("generate");
    if (generates && !arguments.operands.empty())
        throw UsageError("`--generate` makes the scene; `" + arguments.operands.front() +
                         "` is one too many");
    if (!generates && arguments.operands.empty()) throw UsageError("missing SCENE (or `--generate`)");
    std::string text = generates ? std::string() : readText(arguments.operands.front());
    SweepDefinition definition = definitionFrom(arguments, text);
    ReadSweep read = readSweep(std::move(definition), std::move(text));
    if (!read.sweep) throw UsageError(read.objection);
    return read.sweep;
}

void writeAll(const SweepFolder& folder, const Sweep& sweep) {
    const SweepReport report = writeSweepSummary(folder, sweep);
    printOut(report.text);
    if (chartDrawer().sweep && !report.points.empty())
        chartDrawer().sweep(sweep, report.points, folder.path());
}

/// What the command line leaves undone, in a sentence.
std::string unfinished(const SweepJournal& journal, const ItemRange& part) {
    return "carom sweep: " + std::to_string(journal.count()) + " of " + counted(part.count(), "run", "runs") +
           " are kept; `--resume` goes on with the others\n";
}

/// Makes what is missing of a stretch; false where it was interrupted.
bool runPart(const Sweep& sweep, const ItemRange& part, int threads, SweepJournal& journal) {
    auto progress =
        std::make_unique<Progress>(static_cast<std::int64_t>(part.count() - journal.count()), "runs");
    std::int64_t done = 0;
    InterruptibleWork work([&] { printError(unfinished(journal, part)); });
    SweepListener listener;
    listener.goOn = [] { return !interrupted(); };
    listener.ended = [&](const SweepResult& result) {
        work.change([&] { journal.add(result); });
        progress->update(++done);
    };
    return work.step([&] {
        return runSweep(
            sweep, part, threads, [&](std::size_t run) { return journal.has(run); }, listener);
    });
}

int merge(const Arguments& arguments, const std::string& path) {
    for (const auto& [option, value] : arguments.values)
        if (option != "merge") throw UsageError("`--merge` takes no `--" + option + "`: the folder knows it");
    if (!arguments.operands.empty()) throw UsageError("`--merge` takes no scene: the folder knows it");
    const std::shared_ptr<const Sweep> sweep = SweepFolder::read(path);
    const SweepFolder folder(path, *sweep);
    const std::string missing = mergeShards(folder, *sweep);
    writeAll(folder, *sweep);
    if (missing.empty()) return exitcode::done;
    printError("carom sweep: these runs are missing: " + missing + "\n");
    return exitcode::fileError;
}

int runSweepCommand(const Arguments& arguments) {
    if (const std::optional<std::string> path = arguments.text("merge")) return merge(arguments, *path);
    const std::optional<std::string> output = arguments.text("output");
    if (!output) throw UsageError("missing `--output DIR`: where the table goes");
    const auto processors = static_cast<std::int64_t>(std::max(1U, std::thread::hardware_concurrency()));
    const auto threads = static_cast<int>(arguments.wholeNumber("threads", 1, 1024).value_or(processors));
    const Shard shard = shardFrom(arguments);
    std::vector<NamedFile> files = {
        {"the scene", arguments.operands.empty() ? std::string() : arguments.operands.front()}};
    for (const char* name :
         {sweepfile::scene, sweepfile::record, sweepfile::table, sweepfile::summary, sweepfile::report})
        files.push_back({"`--output`", (std::filesystem::path(*output) / name).string()});
    refuseSharedFiles(files);
    const std::shared_ptr<const Sweep> sweep = sweepFrom(arguments);
    const bool isShard = arguments.has("shard");
    const ItemRange part = isShard ? stretchOf(shard, sweep->weights()) : ItemRange{0, sweep->runs()};
    catchInterrupts();
    const SweepFolder folder(*output, *sweep);
    const std::string table = isShard ? "shard-" + std::to_string(shard.number) + ".csv" : sweepfile::table;
    SweepJournal journal(folder, *sweep, table, part, arguments.has("resume"));
    const bool complete = journal.isComplete() || runPart(*sweep, part, threads, journal);
    if (!complete) {
        printError(unfinished(journal, part));
        return exitcode::interrupted;
    }
    journal.close();
    if (!isShard) writeAll(folder, *sweep);
    return exitcode::done;
}

} // namespace

CommandRow sweepCommand() {
    return {
        .name = "sweep",
        .summary = "Run a scene over ranges of its numbers, on all cores or in shards",
        .operands = "[SCENE]",
        .example =
            "carom sweep scenes/pool_break.sdl --vary cue.vel.z=-12:-4:17 --vary bodies.friction=0,0.1,0.3 "
            "\\\n"
            "    --measure 'max speed of black' --measure 'first impact of cue' --frames 120 -o breaks\n"
            "carom sweep --generate 'pile --n 100' --vary generate.height=0.5:2:4 --seeds 20 \\\n"
            "    --measure 'final centre_of_mass_y' -o piles\n"
            "carom sweep scenes/pool_break.sdl --vary 'cue.vel.x=normal 0:0.05' --random 1000 \\\n"
            "    --measure 'x of black at 2' --shard 3/8 -o spread\n"
            "carom sweep --merge spread",
        .options =
            {
                {"vary", 0, "PATH=VALUES",
                 "a number or word of the text and what it becomes; given again, another (see below)"},
                {"measure", 0, "MEASURE", "a figure to take from each run; given again, another (see below)"},
                {"zip", 0, "", "varied values go together, first with first, instead of each with each"},
                {"random", 0, "N", "N draws from the laws (`uniform 4:12`, `normal 8:0.5`)"},
                {"random-seed", 0, "S", "of the draws (default 1)"},
                {"seeds", 0, "N", "N runs of each point, each with the next seed of the generated scene"},
                {"frames", 'n', "F", "frames of each run (default its `duration`, else 600)"},
                {"generate", 0, "GENERATOR",
                 "make the scene, 'pile --n 400'; `generate.n=...` then varies an option of the generator"},
                {"no-declaration", 0, "", "take nothing from the scene's `sweep` declaration"},
                {"threads", 0, "T", "runs to make side by side (default all cores); the rows are the same"},
                shardOption(),
                {"resume", 0, "", "go on with the runs in the folder of `--output`"},
                {"merge", 0, "DIR",
                 "make the final files of the shards in DIR; names the runs that are missing"},
                {"output", 'o', "DIR",
                 "write sweep.csv, summary.csv, summary.txt and the charts (SVG and PNG) there; with "
                 "`--shard` shard-I.csv"},
            },
        .details =
            "What the command line leaves open is that of the scene's `sweep` declaration, if it has one; "
            "`--no-declaration` leaves it aside, so that its `zip`, `random`, `seeds` and `frames` are "
            "off.\n\n"
            "A path names a label (`cue`), `body 7`, a family (`log` for log1, log2, ...), `bodies` (each "
            "that "
            "has it), `spring 2`, `simulation`, `gravity`, `air` or `generate`; then a parameter, and of a "
            "vector the component: `cue.vel.x`, `simulation.substeps`. Values are first:last:count, `log "
            "1e-3:1:7`, or a list of numbers or words; several ranges form the product, the last given "
            "fastest.\n\n"
            "A measure is `final`, `max`, `min` or `mean` and a quantity of `expect`, with `of` and a body "
            "where it has one (`final y of ball`, `min distance of a and b`); or a quantity at a time "
            "(`speed "
            "of ball at 1.5`); or a time: `first impact of a and b`, `first y of ball below 0.5`. Of several "
            "bodies `max` and `min` take the largest and smallest, `first` the earliest, others the mean.\n\n"
            "sweep.csv has a row a run, in order: run, the varied parameters, seed, the measures, outcome "
            "(`done`, `lost` where the state was not finite any more, `faulty` where the text has errors), "
            "frames, state_hash, work (counted, not timed), seconds. All but the seconds is the same "
            "whatever "
            "the threads, shards and interruptions. summary.csv has a row a point and measure, over its "
            "draws "
            "and seeds. Rows are written as runs end; Ctrl-C keeps them, and the exit code is 130. A folder "
            "takes one sweep only. With `--merge` the exit code is 3 where runs are missing.",
        .leastOperands = 0,
        .mostOperands = 1,
        .run = runSweepCommand,
        .drawsCharts = true};
}

} // namespace carom
