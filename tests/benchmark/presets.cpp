// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/varied_scene.h"

#include "app/errors.h"
#include "app/files.h"
#include "app/options.h"
#include "core/simulation/build.h"
#include "core/simulation/world.h"
#include "core/solvers/contacts/work_budget.h"

#include "core/base/clock.h"
#include "core/base/figures.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

// carom-presets [-n FRAMES] [--varied FIRST,LAST] [SCENE ...]: what the presets cost and how wrong they are:
// a row for each preset of each scene, of files and of random scenes by their seeds (varied_scene.h).
// Processor time of stepping; only ratios between the rows of one scene mean something.

namespace carom {
namespace {

constexpr std::array<const char*, 3> presetNames = {"fast", "default", "accurate"};
constexpr std::size_t usual = 1;

struct Cost {
    double time = 0, worst = 0; // [ms]
    int worstFrame = 0;
    double operations = 0, refined = 0, worstOperations = 0;
    std::uint64_t rows = 0, pairs = 0, searches = 0, unfinished = 0;
    double residual = 0, overlap = 0; // means over the frames [m/s], [m]
    int asleep = 0;                   // the first frame from which on all bodies are, 0: none
};

Cost costOf(const std::string& text, const char* preset, int frames, bool contacts) {
    SimulationSettings options;
    options.preset = preset;
    if (contacts) options.method = "contacts";
    World world(build(text, options).pipeline);
    const std::size_t mobile = world.pipeline().bodies().mobileBodies.size();
    Cost cost;
    for (int frame = 1; frame <= frames && world.health().finite; ++frame) {
        const double before = processorTimeOfThread();
        world.step();
        const double time = processorTimeOfThread() - before;
        const FrameStatistics& statistics = world.statistics();
        const double operations = operationsOf(statistics.work);
        cost.time += time;
        cost.operations += operations;
        cost.refined += statistics.work.operations;
        cost.rows += statistics.work.rowsSwept;
        cost.pairs += statistics.work.pairsCollided;
        cost.searches += statistics.work.searches;
        cost.unfinished += statistics.work.unfinished;
        cost.worstOperations = std::max(cost.worstOperations, operations);
        cost.residual += statistics.residual / frames;
        cost.overlap += statistics.maxPenetration / frames;
        if (time > cost.worst) cost.worstFrame = frame;
        cost.worst = std::max(cost.worst, time);
        if (cost.asleep == 0 && statistics.resting >= mobile) cost.asleep = frame;
        if (statistics.resting < mobile) cost.asleep = 0;
    }
    return cost;
}

void compare(const std::string& name, const std::string& text, std::optional<std::int64_t> wanted,
             bool contacts) {
    const Build built = build(text);
    const RunSettings& settings = built.pipeline->settings();
    const int frames = static_cast<int>(wanted.value_or(
        settings.duration ? static_cast<std::int64_t>(std::ceil(*settings.duration / settings.step)) : 600));
    costOf(text, presetNames[usual], std::min(frames, 3), contacts); // the first run finds cold caches
    std::array<Cost, presetNames.size()> costs;
    for (std::size_t i = 0; i < costs.size(); ++i) costs[i] = costOf(text, presetNames[i], frames, contacts);
    for (std::size_t i = 0; i < costs.size(); ++i) {
        const Cost& cost = costs[i];
        printOut(name + "," + std::to_string(built.pipeline->bodies().mobileBodies.size()) + "," +
                 std::to_string(frames) + "," + presetNames[i]);
        for (const double value : {cost.time, cost.time / costs[usual].time, cost.worst})
            printOut("," + figure(value, 3));
        printOut("," + std::to_string(cost.worstFrame));
        for (const double value :
             {cost.operations, cost.operations / costs[usual].operations, cost.worstOperations, cost.refined})
            printOut("," + figure(value, 3));
        for (const std::uint64_t count : {cost.rows, cost.pairs, cost.searches, cost.unfinished})
            printOut("," + std::to_string(count));
        printOut("," + figure(cost.residual, 2) + "," + figure(cost.overlap, 2) + "," +
                 std::to_string(cost.asleep) + "\n");
    }
}

/// The first and the last seed, from FIRST,LAST.
std::pair<std::uint64_t, std::uint64_t> seedsOf(const std::string& text) {
    std::uint64_t first = 0, last = 0;
    const char* const end = text.data() + text.size();
    const std::from_chars_result one = std::from_chars(text.data(), end, first);
    if (one.ec == std::errc() && one.ptr != end && *one.ptr == ',') {
        const std::from_chars_result other = std::from_chars(one.ptr + 1, end, last);
        if (other.ec == std::errc() && other.ptr == end && first <= last) return {first, last};
    }
    throw UsageError("--varied needs the first and the last seed, as 1,100; not `" + text + "`");
}

} // namespace
} // namespace carom

int main(int argc, char** argv) {
    using namespace carom;
    const std::vector<OptionRow> rows = {
        {"frames", 'n', "FRAMES", "frames of each run (default: the duration of the scene, else 600)"},
        {"contacts", 0, "", "by the method `contacts`, whatever the scene would take"},
        {"bodies", 0, "N", "most bodies of a random scene (default 500)"},
        {"varied", 0, "FIRST,LAST", "seeds of random scenes, as 1,100"}};
    try {
        const Arguments arguments = readArguments(std::vector<std::string>(argv + 1, argv + argc), rows);
        const auto frames = arguments.wholeNumber("frames", 1, 1'000'000);
        const auto varied = arguments.text("varied");
        if (varied) seedsOf(*varied); // before anything is printed
        printOut("scene,bodies,frames,preset,ms,ms_by_default,worst_ms,worst_frame,operations,operations_by_"
                 "default,worst_operations,refined,rows,pairs,searches,unfinished,residual,overlap,asleep\n");
        for (const std::string& path : arguments.operands)
            compare(titleOf(path), readText(path), frames, arguments.has("contacts"));
        if (varied) {
            const int most = static_cast<int>(arguments.wholeNumber("bodies", 1, 100'000).value_or(500));
            for (auto [seed, last] = seedsOf(*varied); seed <= last; ++seed)
                compare("varied " + std::to_string(seed), test::variedScene(seed, most), frames,
                        arguments.has("contacts"));
        }
    } catch (const UsageError& error) {
        printError(std::string("carom-presets: ") + error.what() + "\n" + describe(rows));
        return exitcode::wrongUsage;
    }
    return exitcode::done;
}
