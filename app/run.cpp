// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/command.h"
#include "app/errors.h"
#include "app/files.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/recorders.h"
#include "app/run_summary.h"
#include "app/scene_options.h"
#include "core/simulation/energy_guard.h"
#include "core/simulation/world.h"

#include <exception>
#include <limits>
#include <new>
#include <optional>

namespace carom {

CommandRow runCommand();

namespace {

constexpr std::int64_t anyCount = std::numeric_limits<std::int64_t>::max();

/// Which files were asked for.
struct Recording {
    explicit Recording(const Arguments& arguments)
        : trace(arguments.text("trace")), statistics(arguments.text("stats")),
          every(arguments.wholeNumber("every", 1, anyCount)) {
        if (every && !trace) throw UsageError("`--every` needs `--trace`");
        if (trace == "-" && statistics == "-")
            throw UsageError("`--trace` and `--stats` cannot both be standard output");
    }
    bool onStandardOutput() const { return trace == "-" || statistics == "-"; }

    std::optional<std::string> trace, statistics;
    std::optional<std::int64_t> every;
};

/// The files themselves.
struct Recorders {
    explicit Recorders(const Recording& recording) {
        if (recording.trace) trace.emplace(*recording.trace, recording.every.value_or(1));
        if (recording.statistics) statistics.emplace(*recording.statistics);
    }

    void record(const World& world) {
        if (trace) trace->record(world);
        if (statistics && world.state().frame > 0) statistics->record(world.statistics());
    }

    void close() {
        if (trace) trace->close();
        if (statistics) statistics->close();
    }

    std::optional<TraceWriter> trace;
    std::optional<StatisticsWriter> statistics;
};

int runScene(const Arguments& arguments) {
    const SimulationSettings options = simulationSettings(arguments);
    const std::optional<std::int64_t> wanted = arguments.wholeNumber("frames", 0, anyCount);
    const Recording recording(arguments);
    const std::string& path = arguments.operands.front();
    refuseSharedFiles({{"the scene", path},
                       {"`--trace`", recording.trace.value_or("")},
                       {"`--stats`", recording.statistics.value_or("")}});
    const Build built = loadScene(path, options);
    if (arguments.has("strict") && built.hasErrors()) return exitcode::sceneHasErrors;
    Recorders recorders(recording);

    World world(built.pipeline);
    world.keepLedger(true);
    RunSummary summary(displayName(path), built, world);
    const std::int64_t frames = wanted.value_or(framesOf(built.pipeline->settings()));
    const auto writeWhatThereIs = [&] {
        const std::string text = arguments.has("json") ? summary.asJson() : summary.asText();
        if (recording.onStandardOutput())
            printError(text);
        else
            printOut(text);
        recorders.close();
    };
    catchInterrupts();
    recorders.record(world);
    EnergyGuard guard(*built.pipeline, world.statistics());
    std::optional<EnergyRise> rise;
    std::exception_ptr problem;
    {
        InterruptibleWork work(writeWhatThereIs);
        Progress progress(frames);
        try {
            for (std::int64_t frame = 0; frame < frames && !interrupted(); ++frame) {
                work.step([&] { world.step(); });
                if (!world.health().finite) break;
                summary.add(world.statistics());
                recorders.record(world);
                progress.update(frame + 1);
                if (!rise) rise = guard.look(world.statistics());
                if (rise && !arguments.has("keep-going")) break;
            }
            summary.finish(world);
        } catch (const FileError& error) { // no room for a file: what was computed counts
            if (error.isBrokenPipe()) throw;
            summary.finish(world);
            problem = std::current_exception();
        } catch (const std::bad_alloc&) { // or in memory, within a frame
            problem = std::current_exception();
        }
    }
    writeWhatThereIs();
    if (problem) std::rethrow_exception(problem);
    if (!world.health().finite) {
        printError(describeLoss("carom run", world));
        return exitcode::unphysical;
    }
    if (rise) {
        const bool goesOn = arguments.has("keep-going");
        printError("carom run: the scene " + describe(*rise) +
                   (goesOn ? "; what follows is not to be believed\n"
                           : "; the run stops there (a smaller step or more substeps may help; "
                             "`--keep-going` goes on)\n"));
        if (!goesOn) return exitcode::unphysical;
    }
    return interrupted() ? exitcode::interrupted : exitcode::done;
}

} // namespace

CommandRow runCommand() {
    std::vector<OptionRow> options = {
        {"frames", 'n', "FRAMES", "frames to simulate (default: the duration if there is one, else 600)"},
        {"trace", 0, "FILE", "write the motion of every mobile body as CSV"},
        {"every", 0, "K", "trace every K-th frame only, frame 0 included (default 1)"},
        {"stats", 0, "FILE", "write time, pairs, energy and momentum of every frame as CSV"},
        {"json", 0, "", "print the summary as one JSON object"},
        {"strict", 0, "", "do not run a scene that has errors; end with 1"},
        {"keep-going", 0, "",
         "go on where the energy of the scene rises by more than a tenth of what it has to spend"},
    };
    const std::vector<OptionRow> shared = simulationOptions();
    options.insert(options.end(), shared.begin(), shared.end());
    return {.name = "run",
            .summary = "Simulate a scene and print a summary",
            .operands = "SCENE",
            .example = "carom run scenes/pool_break.sdl -n 300 --stats break.csv\n"
                       "carom generate brownian --n 1600 | carom run - --broadphase sweep_and_sort --json",
            .options = options,
            .details = "Declarations with errors are reported on standard error and left out. The simulation "
                       "options, from "
                       "--step on, override the scene's `simulation` declaration. FILE may be - for standard "
                       "output; the "
                       "summary then goes to standard error.\n\n"
                       "Mean, median and percentiles are those of the frames behind the first, which is "
                       "given apart; the "
                       "total is that of all. Ctrl-C ends the run: what was computed is written, and the "
                       "exit code is 130. "
                       "It is 4 if the state of a body ceases to be finite, or if the energy of the scene "
                       "rises: nothing "
                       "in a scene gives energy, so its motion is wrong from there on.",
            .leastOperands = 1,
            .mostOperands = 1,
            .run = runScene};
}

} // namespace carom
