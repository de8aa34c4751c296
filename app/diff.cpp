// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/command.h"
#include "app/errors.h"
#include "app/files.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/scene_options.h"
#include "core/base/figures.h"
#include "core/simulation/world.h"
#include "core/study/race.h"

#include <limits>
#include <optional>

namespace carom {

CommandRow diffCommand();

namespace {

constexpr const char* bothNames = "AB";

/// One of the two runs: its scene, its options, and how messages name it.
struct Side {
    std::string path;
    SimulationSettings options;
};

/// The words behind `--` are those of the second run: options, and a scene where it is another.
std::pair<Side, Side> sidesOf(const Arguments& arguments) {
    const Side first{arguments.operands.front(), simulationSettings(arguments)};
    const std::span<const std::string> words = std::span(arguments.operands).subspan(1);
    const Arguments second = readArguments(words, simulationOptions());
    if (second.operands.size() > 1)
        throw UsageError("`" + second.operands[1] + "` is one scene too many behind `--`");
    const bool another = !second.operands.empty();
    return {first, {another ? second.operands.front() : first.path, simulationSettings(second)}};
}

std::string describe(char name, const Side& side, const RunSettings& settings) {
    return std::string(1, name) + ": " + displayName(side.path) + ", " + settingOf(settings) + "\n";
}

int runDiff(const Arguments& arguments) {
    const auto [sideA, sideB] = sidesOf(arguments);
    const std::optional<std::int64_t> wanted =
        arguments.wholeNumber("frames", 1, std::numeric_limits<std::int64_t>::max());
    const std::optional<std::string> file = arguments.text("output");
    refuseSharedFiles({{"the scene", sideA.path}, {"`--output`", file.value_or("")}});
    refuseSharedFiles({{"the second scene", sideB.path}, {"`--output`", file.value_or("")}});
    const Build builtA = loadScene(sideA.path, sideA.options), builtB = loadScene(sideB.path, sideB.options);
    if (const std::optional<std::string> objection = objectionToRace(*builtA.pipeline, *builtB.pipeline))
        throw UsageError(*objection);
    Race race(builtA.pipeline, builtB.pipeline);
    const Scene& scene = builtA.pipeline->scene();
    const std::int64_t frames = wanted.value_or(framesOf(builtA.pipeline->settings()));

    printOut(describe(bothNames[0], sideA, builtA.pipeline->settings()) +
             describe(bothNames[1], sideB, builtB.pipeline->settings()));
    CsvTable table(raceColumns);
    bool named = false;  // the first difference
    double nextLine = 0; // [m] from which a line is worth printing
    const auto look = [&] {
        const auto& [frame, time, last] = race.now();
        addRow(table, race.now(), scene);
        if (!named && race.firstDifference()) {
            printOut("first difference: " +
                     describe(scene, *race.firstDifference(), builtA.pipeline->settings().step) + "\n");
            named = true;
        }
        if (!(last.distance > nextLine)) return;
        printOut("frame " + std::to_string(frame) + ", " + figure(time, 6) + " s: " + figure(last.distance) +
                 " m apart, " + scene.nameOf(last.body) + "\n");
        constexpr double apart = 10; // a line for every power of ten
        nextLine = apart * last.distance;
    };
    const auto conclude = [&] {
        const std::string run = counted(static_cast<std::size_t>(race.now().frame), "frame", "frames");
        printOut(named ? "after " + run + ": " + figure(race.now().apart.distance) + " m apart\n"
                       : "no bit differs in " + run + "\n");
        if (file) replaceFile(*file, table.take());
    };
    catchInterrupts();
    look();
    {
        InterruptibleWork work(conclude);
        Progress progress(frames);
        while (race.now().frame < frames && race.isFinite() && !interrupted()) {
            bool goesOn = false;
            work.step([&] { goesOn = race.step(); });
            if (!goesOn) break;
            progress.pause();
            look();
            progress.update(race.now().frame);
        }
    }
    conclude();
    for (const World* world : {&race.a(), &race.b()})
        if (!world->health().finite) {
            printError(describeLoss("carom diff", *world));
            return exitcode::unphysical;
        }
    return interrupted() ? exitcode::interrupted : exitcode::done;
}

} // namespace

CommandRow diffCommand() {
    std::vector<OptionRow> options = {
        {"frames", 'n', "FRAMES", "frames to compare (default: the duration if there is one, else 600)"},
        {"output", 'o', "FILE", "write the distance of every frame as CSV"},
    };
    for (OptionRow& row : simulationOptions()) options.push_back(std::move(row));
    return {.name = "diff",
            .summary = "Run a scene twice and say how the runs part",
            .operands = "SCENE",
            .example = "carom diff scenes/pool_break.sdl -- --substeps 2\n"
                       "carom diff scenes/table.sdl -n 100 --threads 1 -- --threads 2",
            .options = options,
            .details =
                "The options before `--` are those of the first run, those behind it of the second; a "
                "scene behind "
                "`--` is run in place of the first one's text, if it has the same bodies. The first "
                "frame, body and quantity "
                "in which a bit differs is named, then each frame in which the bodies are ten times "
                "further apart than on the line before: the greatest distance of one body from itself. "
                "The CSV has the columns frame, time, distance, body and label.",
            .leastOperands = 1,
            .mostOperands = std::numeric_limits<std::size_t>::max(),
            .run = runDiff};
}

} // namespace carom
