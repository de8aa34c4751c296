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
#include <cstdlib>
#include <string>
#include <vector>

// carom-presets [-n FRAMES] [--varied LIST] [SCENE ...]: what the presets cost and how wrong they are, scene
// by scene: files, and random scenes by their seeds (varied_scene.h). Processor time of stepping; ratios
// within one line mean something, figures of different runs do not.

namespace carom {
namespace {

constexpr std::array<const char*, 3> presetNames = {"fast", "default", "accurate"};

bool onlyAccurate = std::getenv("ONLYA") != nullptr;

struct Cost {
    double time = 0, worst = 0; // [ms]
    int worstFrame = 0;
    double operations = 0, refined = 0, worstOperations = 0;
    double rows = 0, pairs = 0, searches = 0, unfinished = 0;
    double residual = 0, overlap = 0; // means over the frames [m/s], [m]
    int asleep = 0;                   // the first frame in which all bodies are, 0: none
    int frames = 0;
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
        cost.rows += static_cast<double>(statistics.work.rowsSwept);
        cost.pairs += static_cast<double>(statistics.work.pairsCollided);
        cost.searches += static_cast<double>(statistics.work.searches);
        cost.unfinished += static_cast<double>(statistics.work.unfinished);
        cost.worstOperations = std::max(cost.worstOperations, operations);
        cost.residual += statistics.residual / frames;
        cost.overlap += statistics.maxPenetration / frames;
        if (time > cost.worst) cost.worstFrame = frame;
        cost.worst = std::max(cost.worst, time);
        if (cost.asleep == 0 && statistics.resting >= mobile) cost.asleep = frame;
        if (statistics.resting < mobile) cost.asleep = 0;
        ++cost.frames;
    }
    return cost;
}

template<class Of>
std::string three(const std::array<Cost, 3>& costs, const Of& of, int digits = 3) {
    return figure(of(costs[0]), digits) + " " + figure(of(costs[1]), digits) + " " +
           figure(of(costs[2]), digits);
}

void compare(const std::string& name, const std::string& text, std::optional<std::int64_t> wanted,
             bool contacts) {
    const Build built = build(text);
    const RunSettings& settings = built.pipeline->settings();
    const int frames = static_cast<int>(wanted.value_or(
        settings.duration ? static_cast<std::int64_t>(std::ceil(*settings.duration / settings.step)) : 600));
    std::array<Cost, 3> costs;
    if (!onlyAccurate)
        costOf(text, presetNames[1], std::min(frames, 3),
               contacts); // the first run of a scene finds cold caches
    for (std::size_t i = 0; i < costs.size(); ++i)
        if (!onlyAccurate || i == 2) costs[i] = costOf(text, presetNames[i], frames, contacts);
    const auto ratio = [&](std::size_t one, std::size_t other, auto of) {
        return figure(of(costs[one]) / of(costs[other]), 3);
    };
    const auto time = [](const Cost& cost) { return cost.time; };
    const auto operations = [](const Cost& cost) { return cost.operations; };
    std::string flags;
    if (costs[0].time > costs[1].time) flags += " FAST";
    if (costs[2].time > 30 * costs[1].time) flags += " 30x";
    if (costs[2].time < costs[1].time) flags += " INVERSE";
    for (const Cost& cost : costs)
        if (cost.worst > 1000) flags += " SECOND";
    printOut(name + ": N " + std::to_string(built.pipeline->bodies().mobileBodies.size()) + " frames " +
             std::to_string(frames) + " | ms " + three(costs, time) + " ratio f/d " + ratio(0, 1, time) +
             " a/d " + ratio(2, 1, time) + " | worst " + three(costs, [](const Cost& c) { return c.worst; }) +
             " at " + three(costs, [](const Cost& c) { return c.worstFrame; }) + " | Mops " +
             three(costs, [](const Cost& c) { return c.operations * 1e-6; }) + " refined " +
             three(costs, [](const Cost& c) { return c.refined * 1e-6; }) + " f/d " +
             ratio(0, 1, operations) + " a/d " + ratio(2, 1, operations) + " worst " +
             three(costs, [](const Cost& c) { return c.worstOperations * 1e-6; }) + " | rows " +
             three(costs, [](const Cost& c) { return c.rows; }) + " pairs " +
             three(costs, [](const Cost& c) { return c.pairs; }) + " searches " +
             three(costs, [](const Cost& c) { return c.searches; }) + " unfinished " +
             three(costs, [](const Cost& c) { return c.unfinished; }) + " | residual " +
             three(
                 costs, [](const Cost& c) { return c.residual; }, 2) +
             " overlap " +
             three(
                 costs, [](const Cost& c) { return c.overlap; }, 2) +
             " asleep " + three(costs, [](const Cost& c) { return c.asleep; }) + flags + "\n");
}

} // namespace
} // namespace carom

int main(int argc, char** argv) {
    using namespace carom;
    const std::vector<OptionRow> rows = {
        {"frames", 'n', "FRAMES", "frames of each run (default: the duration of the scene, else 600)"},
        {"contacts", 0, "", "by the method `contacts`, whatever the scene would take"},
        {"bodies", 0, "N", "most bodies of a random scene (default 500)"},
        {"varied", 0, "LIST", "first and last seed of random scenes, as 1,100"}};
    try {
        const Arguments arguments = readArguments(std::vector<std::string>(argv + 1, argv + argc), rows);
        const auto frames = arguments.wholeNumber("frames", 1, 1'000'000);
        for (const std::string& path : arguments.operands)
            compare(titleOf(path), readText(path), frames, arguments.has("contacts"));
        if (const auto list = arguments.text("varied")) {
            const std::vector<std::string> words = wordsOf(*list);
            const int most = static_cast<int>(arguments.wholeNumber("bodies", 1, 100'000).value_or(500));
            for (int seed = std::stoi(words.front()); seed <= std::stoi(words.back()); ++seed)
                compare("varied " + std::to_string(seed),
                        test::VariedScene(static_cast<std::uint64_t>(seed), most).text(), frames,
                        arguments.has("contacts"));
        }
    } catch (const UsageError& error) {
        printError(std::string("carom-presets: ") + error.what() + "\n" + describe(rows));
        return exitcode::wrongUsage;
    }
    return exitcode::done;
}
