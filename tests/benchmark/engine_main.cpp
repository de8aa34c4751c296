// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmark/peer.h"

#include "app/errors.h"
#include "app/files.h"
#include "app/options.h"
#include "app/recorders.h"
#include "core/base/clock.h"
#include "core/base/text.h"
#include "core/simulation/build.h"
#include "core/simulation/world.h"

// carom-engine-NAME SCENE --frames N [--substeps K] [--iterations I] [--own-rules]: a scene of ours, read by
// our own parser, in another engine. What it prints is the protocol of `carom study accuracy --engines`
// (resources/help/diagrams.md).

namespace carom {
namespace {

/// What these engines have no counterpart for in the scene, a clause; empty: nothing.
std::string lackingIn(const Pipeline& pipeline) {
    if (!pipeline.scene().springs.empty()) return "springs";
    if (pipeline.simulates("rolling_resistance")) return "rolling resistance";
    if (!pipeline.bodies().forces.empty()) return "air";
    return {};
}

int runEngine(std::span<const std::string> words) {
    const std::vector<OptionRow> options = {
        {"frames", 'n', "N", "frames to run (default 120)"},
        {"substeps", 0, "K", "steps of the engine a frame (default 1)"},
        {"iterations", 0, "I", "iterations of its contact solver a step, 0: as it has them (default 50)"},
        {"own-rules", 0, "", "leave restitution, friction, iterations and sleeping as the engine has them"},
    };
    if (words.empty()) throw UsageError("a scene is missing");
    const std::string path = words.front();
    const Arguments arguments = readArguments(words.subspan(1), options);
    if (arguments.has("help")) return printOut(describe(options)), exitcode::done;
    const std::int64_t frames = arguments.wholeNumber("frames", 1, 10'000'000).value_or(120);
    PeerSettings settings;
    settings.substeps = static_cast<int>(arguments.wholeNumber("substeps", 1, 4096).value_or(1));
    settings.tuned = !arguments.has("own-rules");
    if (settings.tuned)
        settings.iterations = static_cast<int>(arguments.wholeNumber("iterations", 0, 100'000).value_or(50));
    SimulationSettings general;
    general.method = std::string(generalSolver().name);
    const Build built = build(readText(path), general);
    if (built.hasErrors()) throw UsageError("`" + path + "` has errors");
    const std::shared_ptr<const Pipeline> pipeline = built.pipeline;
    if (const std::string lacking = lackingIn(*pipeline); !lacking.empty()) {
        printOut("lacks," + lacking + "\n");
        return exitcode::done;
    }
    const std::unique_ptr<PeerWorld> world = makePeerWorld(pipeline, settings);
    std::string heading = "engine," + world->name() + "\n";
    for (const std::string& rule : world->differences()) heading += "differs," + rule + "\n";
    printOut(heading);
    TraceWriter trace("-", 1);
    State state = pipeline->initialState();
    trace.record(*pipeline, state);
    for (std::int64_t frame = 1; frame <= frames; ++frame) {
        const double start = processorTimeOfThread();
        world->step();
        printOut("spent," + shortest(processorTimeOfThread() - start) + "\n");
        world->read(state);
        state.frame = frame;
        state.time = static_cast<double>(frame) * pipeline->settings().step;
        trace.record(*pipeline, state);
    }
    trace.close();
    return exitcode::done;
}

} // namespace
} // namespace carom

int main(int argc, char** argv) {
    try {
        return carom::runEngine(std::vector<std::string>(argv + 1, argv + argc));
    } catch (const carom::UsageError& error) {
        carom::printError(std::string(argv[0]) + ": " + error.what() + "\n");
        return carom::exitcode::wrongUsage;
    } catch (const carom::FileError& error) {
        carom::printError(std::string(argv[0]) + ": " + error.what() + "\n");
        return carom::exitcode::fileError;
    }
}
