// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/charts.h"
#include "app/command.h"
#include "app/errors.h"
#include "app/files.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/readable_scene.h"
#include "app/shard_files.h"
#include "core/base/catalogue.h"
#include "core/base/text.h"
#include "core/scene/schema.h"
#include "core/study/benchmark_report.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

namespace carom {

CommandRow benchCommand();

ChartDrawer& chartDrawer() {
    static ChartDrawer drawer;
    return drawer;
}

namespace {

template<class Row>
const Row* rowNamed(const std::string& name, std::span<const Row> rows, const char* kind) {
    if (const Row* row = findByName(rows, name)) return row;
    std::vector<std::string_view> names;
    for (const Row& row : rows) names.push_back(row.name);
    const std::optional<std::string_view> near = nearestRow(name, rows);
    throw UsageError("there is no " + std::string(kind) + " `" + name + "`; " +
                     (near ? "did you mean `" + std::string(*near) + "`?" : "it must be " + listOf(names)));
}

std::vector<std::int64_t> countsFrom(const std::string& list) {
    std::vector<std::int64_t> counts;
    for (const std::string& word : wordsOf(list)) {
        const std::optional<long long> count = wholeNumberIn(word);
        if (!count || *count < 1)
            throw UsageError("`-n` has `" + word +
                             "`; it must be a list of whole numbers from 1 on, like 100,1000");
        counts.push_back(*count);
    }
    std::sort(counts.begin(), counts.end());
    counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
    return counts;
}

/// What the command line asks for; what it leaves open is the standard benchmark's.
BenchmarkPlan planFrom(const Arguments& arguments, const Shard& shard) {
    BenchmarkPlan plan = standardBenchmark();
    std::vector<std::string> scenes = arguments.operands;
    if (const std::optional<std::string> list = arguments.text("scene")) {
        const std::vector<std::string> listed = wordsOf(*list);
        scenes.insert(scenes.begin(), listed.begin(), listed.end());
    } else if (!scenes.empty()) {
        throw UsageError("`" + scenes.front() + "` is one operand too many; scenes follow `--scene`");
    }
    if (!scenes.empty()) plan.scenes.clear();
    for (const std::string& name : scenes) plan.scenes.push_back(rowNamed(name, generators(), "generator"));

    if (const std::optional<std::string> list = arguments.text("n")) plan.counts = countsFrom(*list);
    if (const std::optional<std::string> list = arguments.text("broadphase")) {
        plan.algorithms.clear();
        for (const std::string& name : wordsOf(*list))
            plan.algorithms.push_back(rowNamed(name, broadphases(), "broad-phase"));
    }
    if (const auto method = arguments.word("method", methodWords())) plan.options.method = method;
    plan.options.boxes = arguments.word("boxes", boxesWords());
    plan.frames = arguments.wholeNumber("frames", 2, 1'000'000).value_or(plan.frames);

    // The trace is the reference's: 500 spheres on the pyramid. A smaller benchmark has a smaller one.
    if (std::ranges::count(plan.scenes, plan.traceScene) == 0) plan.traceScene = plan.scenes.front();
    if (arguments.has("frames")) plan.traceFrames = plan.frames;
    plan.traceCount = std::min(plan.traceCount, plan.counts.back());
    for (const GeneratorRow* scene : plan.scenes)
        for (const std::int64_t n : plan.counts)
            if (const std::optional<std::string> reason = checkRequest(*scene, requestFor(*scene, n)))
                throw UsageError(std::string(scene->name) + ": " + *reason);
    for (const GeneratorRow* scene : plan.scenes)
        readableScene(*scene, requestFor(*scene, plan.counts.back()));
    // Numbers of one scene stay together: an algorithm that is too slow is left out at the larger ones.
    plan.scenes = partOf(shard, plan.scenes);
    if (std::ranges::count(plan.scenes, plan.traceScene) == 0) plan.traceScene = nullptr;
    return plan;
}

int runBench(const Arguments& arguments) {
    if (const std::optional<std::string> parts = arguments.text("merge")) {
        mergeParts(*parts, std::array<std::string_view, 2>{"performance.csv", "trace.csv"});
        return exitcode::done;
    }
    const Shard shard = shardFrom(arguments);
    const BenchmarkPlan plan = planFrom(arguments, shard);
    catchInterrupts();
    const std::optional<std::string> folder = arguments.text("output");
    if (folder) makeFolder(*folder);
    const auto writeFigures = [&](const Benchmark& benchmark) {
        if (!folder) return;
        writeFile(*folder, nameOfPart("performance.csv", shard), pointsAsCsv(benchmark));
        writeFile(*folder, nameOfPart("trace.csv", shard), tracesAsCsv(benchmark));
        writeFile(*folder, nameOfPart("summary.txt", shard), summaryOf(benchmark));
    };
    std::unique_ptr<Progress> progress;
    Benchmark benchmark; // as far as it is
    benchmark.plan = plan;
    InterimResults interim("carom bench");
    {
        InterruptibleWork work([&] {
            printOut(summaryOf(benchmark));
            writeFigures(benchmark);
        });
        const auto goOn = [&progress](std::int64_t done, std::int64_t total) {
            if (!progress) progress = std::make_unique<Progress>(total);
            progress->update(done);
            return !interrupted();
        };
        const auto measured = [&](const Benchmark& soFar) {
            work.change([&] {
                benchmark = soFar;
                interim.write([&] { writeFigures(benchmark); });
            });
        };
        Benchmark whole = work.step([&] { return runBenchmark(plan, goOn, measured); });
        benchmark = std::move(whole);
    }
    progress.reset();

    printOut(summaryOf(benchmark));
    writeFigures(benchmark);
    if (folder && shard.isWhole() && chartDrawer().benchmark) chartDrawer().benchmark(benchmark, *folder);
    return benchmark.complete ? exitcode::done : exitcode::interrupted;
}

} // namespace

CommandRow benchCommand() {
    return {
        .name = "bench",
        .summary = "Measure the broad-phases on scenes of growing size",
        .operands = "",
        .example = "carom bench -o results\n"
                   "carom bench --scene pyramid -n 500,1000,2000 --broadphase all_pairs,sweep_and_sort",
        .options =
            {
                {"scene", 0, "NAME...",
                 "generators, separated by blanks or commas (default "
                 "pool_breaks,brownian,pyramid)"},
                {"n", 'n', "LIST", "numbers of bodies, separated by commas (default 100 to 20000)"},
                {"broadphase", 0, "LIST", "algorithms, separated by commas (default all)"},
                {"method", 0, "M", "method of motion (default microcollisions, the reference's)"},
                {"boxes", 0, "B", "boxes the algorithms work on: tight (default) or cube, the reference's"},
                {"frames", 0, "F", "frames of each run (default 120, and 600 for the trace)"},
                shardOption(),
                mergeOption(),
                {"output", 'o', "DIR",
                 "write performance.csv, trace.csv, summary.txt and the charts (SVG and PNG) there; with "
                 "`--shard`, which shares the scenes, performance-I-of-N.csv and so on"},
            },
        .details =
            "The worlds of one scene and number take turns, so a disturbance falls on all of them; times are "
            "processor times. "
            "An algorithm that needs more than 60 ms a frame is left out at larger numbers. Ctrl-C "
            "ends the benchmark: what was measured is written, and the exit code is 130.",
        .leastOperands = 0,
        .mostOperands = std::numeric_limits<std::size_t>::max(),
        .run = runBench,
        .drawsCharts = true};
}

} // namespace carom
