// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmark/overlaps.h"
#include "tests/benchmark/peer.h"

#include "app/engines.h"
#include "app/errors.h"
#include "app/files.h"
#include "app/options.h"
#include "app/temporary_file.h"

#include "core/dynamics/energy.h"
#include "core/generators/generator.h"
#include "core/simulation/build.h"
#include "core/simulation/world.h"

#include "core/base/clock.h"
#include "core/base/figures.h"
#include "core/base/text.h"
#include "core/math/statistics.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

// carom-peers [--scene LIST] [-n LIST] [--frames F] [--engines LIST] [--seconds S]: our scenes, read by our
// own parser, in our methods and in other engines, one after another, in processor time; before that the
// broad-phases alone on the motion of the first scene. Other engines are the programs of `carom study
// accuracy --engines`.

namespace carom {
namespace {

/// Overlaps are looked at after so many frames, and at the end.
constexpr std::int64_t framesBetweenLooks = 10;

/// A run in one engine.
struct PeerRun {
    std::string name;
    std::string problem;                ///< why it ended early, or nothing
    std::vector<double> milliseconds{}; ///< of each frame
    Overlaps onTheWay{};                ///< of every state looked at
    State last{};
    std::optional<std::uint64_t> resting{}; ///< bodies that the last step left alone, where the engine tells

    void look(const Bodies& bodies, const State& state) {
        last = state;
        if (state.frame > 0 && state.frame % framesBetweenLooks == 0) onTheWay.add(overlapsAt(bodies, state));
    }
};

double energyOf(const Pipeline& pipeline, const State& state) {
    const Invariants invariants = invariantsOf(pipeline.bodies(), state, pipeline.gravity());
    return invariants.kinetic + invariants.potential;
}

double meanSpeedOf(const Bodies& bodies, const State& state) {
    double sum = 0;
    for (const BodyIndex i : bodies.mobileBodies) sum += state.velocity[i].norm();
    return bodies.mobileBodies.empty() ? 0 : sum / static_cast<double>(bodies.mobileBodies.size());
}

std::size_t escapedFrom(const Bodies& bodies, const State& state) {
    std::size_t count = 0;
    for (const BodyIndex i : bodies.mobileBodies)
        count += std::any_of(bodies.walls.begin(), bodies.walls.end(), [&](BodyIndex wall) {
            return distanceTo(std::get<Wall>(bodies.shape[wall]), state.pose[i].position) < 0;
        });
    return count;
}

std::string column(const std::string& text, std::size_t width) {
    return std::string(text.size() < width ? width - text.size() : 1, ' ') + text;
}

/// A generator with options: `heap:cuboids=0`.
struct ComparedScene {
    std::string name; ///< as it was asked for
    const GeneratorRow* generator = nullptr;
    GeneratorRequest request;
};

ComparedScene sceneNamed(const std::string& name) {
    ComparedScene scene{.name = name, .request = {}};
    std::istringstream parts(name);
    std::string part;
    std::getline(parts, part, ':');
    scene.generator = findGenerator(part);
    if (!scene.generator) throw UsageError("there is no generator `" + part + "`");
    while (std::getline(parts, part, ':')) {
        const std::size_t equals = std::min(part.find('='), part.size());
        const std::optional<double> value = numberIn(part.substr(std::min(equals + 1, part.size())));
        if (!value) throw UsageError("`" + part + "` is no option of a generator; write `cuboids=0.5`");
        scene.request.options[part.substr(0, equals)] = *value;
    }
    return scene;
}

std::string textOf(ComparedScene scene, std::int64_t n) {
    scene.request.n = n;
    if (const std::optional<std::string> reason = checkRequest(*scene.generator, scene.request))
        throw UsageError(*reason);
    return generate(*scene.generator, scene.request);
}

/// Our pipeline once for each method that takes the scene; the first is also what the peers are built from.
std::vector<std::shared_ptr<const Pipeline>> pipelinesOf(const std::string& text) {
    std::vector<std::shared_ptr<const Pipeline>> pipelines;
    for (const SolverRow& method : solvers()) {
        SimulationSettings options;
        options.method = std::string(method.name);
        const std::shared_ptr<const Pipeline> pipeline = build(text, options).pipeline;
        if (pipeline->settings().method == &method) pipelines.push_back(pipeline);
    }
    return pipelines;
}

struct Limits {
    std::int64_t frames = 120;
    double seconds = 60; ///< of wall time, for each run
};

PeerRun runOurs(const std::shared_ptr<const Pipeline>& pipeline, const Limits& limits) {
    World world(pipeline);
    PeerRun run{.name = "Carom " + std::string(pipeline->settings().method->name), .problem = {}};
    const Stopwatch watch;
    for (std::int64_t frame = 0; frame < limits.frames && watch.elapsed() < 1e3 * limits.seconds; ++frame) {
        const double start = processorTimeOfThread();
        world.step();
        run.milliseconds.push_back(processorTimeOfThread() - start);
        run.look(pipeline->bodies(), world.state());
    }
    run.resting = world.statistics().resting;
    return run;
}

PeerRun runPeer(const std::string& engine, const std::string& scene, const Pipeline& pipeline,
                const Limits& limits) {
    PeerRun run{.name = engine, .problem = {}};
    EngineOutput output(pipeline, [&](const State& state) { run.look(pipeline.bodies(), state); });
    run.problem = runEngineProgram(scene, {.engine = engine,
                                           .isTuned = true,
                                           .iterations = 0,
                                           .frames = limits.frames,
                                           .limit = limits.seconds,
                                           .read = [&](std::string_view piece) { output.add(piece); },
                                           .goOn = [] { return true; }});
    if (!output.problem().empty()) run.problem = output.problem();
    if (!output.lacking().empty()) run.problem = "it has no " + output.lacking();
    if (!output.version().empty()) run.name = output.version();
    run.milliseconds = output.times();
    return run;
}

std::string lineOf(std::string name, const std::vector<std::string>& cells) {
    constexpr std::size_t nameWidth = 30, width = 10;
    name.resize(std::max(name.size(), nameWidth), ' ');
    for (const std::string& cell : cells) name += column(cell, width);
    return name + "\n";
}

/// One line a run. The first frame is given apart: engines allocate in it.
std::string rowOf(const Pipeline& pipeline, const PeerRun& run) {
    if (run.milliseconds.size() < 2) return "  " + run.name + ": " + run.problem + "\n";
    const Summary later = summarise(std::span(run.milliseconds).subspan(1));
    const double drift = energyOf(pipeline, run.last) / energyOf(pipeline, pipeline.initialState()) - 1;
    std::vector<std::string> cells = {std::to_string(run.milliseconds.size())};
    for (const double time : {run.milliseconds.front(), later.mean, later.median, later.maximum})
        cells.push_back(figure(time));
    for (const double part :
         {later.maximum / later.median, drift, run.onTheWay.mean(), run.onTheWay.largest,
          overlapsAt(pipeline.bodies(), run.last).largest, meanSpeedOf(pipeline.bodies(), run.last)})
        cells.push_back(figure(part, 2));
    cells.push_back(run.resting ? std::to_string(*run.resting) : "-");
    cells.push_back(std::to_string(escapedFrom(pipeline.bodies(), run.last)));
    return lineOf("  " + run.name, cells);
}

void compareEngines(const ComparedScene& scene, std::int64_t n, const std::vector<std::string>& engines,
                    const Limits& limits) {
    const std::string text = textOf(scene, n);
    const TemporaryFile file((std::filesystem::temp_directory_path() / "carom-peers").string());
    replaceFile(file.path(), text);
    printOut(lineOf(scene.name + ", N = " + std::to_string(n),
                    {"frames", "first", "mean", "median", "worst", "/median", "energy", "overlap", "largest",
                     "at end", "speed", "asleep", "escaped"}));
    const std::vector<std::shared_ptr<const Pipeline>> pipelines = pipelinesOf(text);
    const Pipeline& pipeline = *pipelines.front();
    for (const auto& each : pipelines) printOut(rowOf(pipeline, runOurs(each, limits)));
    for (const std::string& engine : engines)
        printOut(rowOf(pipeline, runPeer(engine, file.path(), pipeline, limits)));
    printOut("\n");
}

/// The boxes of every frame of a run.
std::vector<std::vector<Aabb>> trajectoryOf(const std::shared_ptr<const Pipeline>& pipeline, int frames) {
    World world(pipeline);
    std::vector<std::vector<Aabb>> trajectory;
    for (int frame = 0; frame < frames; ++frame) {
        trajectory.emplace_back();
        for (const BodyIndex i : pipeline->bodies().bounded)
            trajectory.back().push_back(boundsOf(pipeline->bodies().shape[i], world.state().pose[i]));
        world.step();
    }
    return trajectory;
}

void compareBroadphases(const ComparedScene& scene, std::int64_t n) {
    constexpr int frames = 40;
    const std::shared_ptr<const Pipeline> pipeline = build(textOf(scene, n)).pipeline;
    const std::vector<std::vector<Aabb>> trajectory = trajectoryOf(pipeline, frames);
    const Bodies& bodies = pipeline->bodies();
    std::vector<std::uint8_t> mobile;
    for (const BodyIndex i : bodies.bounded) mobile.push_back(bodies.mobile[i]);

    std::vector<std::pair<std::string, std::unique_ptr<Broadphase>>> algorithms;
    for (const BroadphaseRow& row : broadphases()) algorithms.emplace_back(row.name, row.create());
    algorithms.emplace_back("Bullet's tree", makeBulletTree());
    algorithms.emplace_back("Bullet's three-axis sweep", makeBulletSweep());

    std::vector<std::vector<double>> times(algorithms.size());
    for (const std::vector<Aabb>& boxes : trajectory)
        for (std::size_t k = 0; k < algorithms.size(); ++k) {
            const double start = processorTimeOfThread();
            algorithms[k].second->update({boxes, bodies.bounded, mobile});
            times[k].push_back(processorTimeOfThread() - start);
        }
    const auto medianOf = [&times](std::size_t k) {
        return summarise(std::span(times[k]).subspan(1)).median;
    };
    const double tree = medianOf(algorithms.size() - 2), sweep = medianOf(algorithms.size() - 1);
    std::string table = "Broad-phases alone, " + scene.name + ", N = " + std::to_string(n) + "\n" +
                        column("ms", 38) + column("/ tree", 12) + column("/ sweep", 12) +
                        column("pairs", 10) + "\n";
    for (std::size_t k = 0; k < algorithms.size(); ++k) {
        std::string row = "  " + algorithms[k].first;
        row.resize(28, ' ');
        table += row + column(figure(medianOf(k)), 10) + column(figure(medianOf(k) / tree, 2), 12) +
                 column(figure(medianOf(k) / sweep, 2), 12) +
                 column(std::to_string(algorithms[k].second->counters().pairs), 10) + "\n";
    }
    printOut(table + "\n");
}

int comparePeers(std::span<const std::string> words) {
    const std::vector<OptionRow> options = {
        {"scene", 0, "LIST",
         "generators, separated by commas, with options behind colons, as in heap:cuboids=0 (default "
         "brownian,pool_breaks,pyramid,pile)"},
        {"n", 'n', "LIST", "numbers of bodies, separated by commas (default 1000,2000,10000)"},
        {"frames", 0, "F", "frames of each run (default 120)"},
        {"engines", 0, "LIST", "programs carom-engine-NAME, separated by commas (default bullet,ode)"},
        {"seconds", 0, "S", "wall time after which a run is ended (default 60)"},
    };
    const Arguments arguments = readArguments(words, options);
    if (arguments.has("help")) return printOut(describe(options)), exitcode::done;
    Limits limits;
    limits.frames = arguments.wholeNumber("frames", 1, 100'000).value_or(120);
    limits.seconds = arguments.positiveNumber("seconds").value_or(60);
    std::vector<std::int64_t> counts;
    for (const std::string& word : wordsOf(arguments.text("n").value_or("1000,2000,10000"))) {
        const std::optional<long long> count = wholeNumberIn(word);
        if (!count || *count < 1)
            throw UsageError("`-n` has `" + word + "`; it must be a whole number from 1 on");
        counts.push_back(*count);
    }
    const std::vector<std::string> engines = wordsOf(arguments.text("engines").value_or("bullet,ode"));
    for (const std::string& engine : engines) engineProgram(engine);
    std::vector<ComparedScene> scenes;
    for (const std::string& name :
         wordsOf(arguments.text("scene").value_or("brownian,pool_breaks,pyramid,pile")))
        scenes.push_back(sceneNamed(name));
    for (const std::int64_t n : counts) compareBroadphases(scenes.front(), n);
    for (const ComparedScene& scene : scenes)
        for (const std::int64_t n : counts) compareEngines(scene, n, engines, limits);
    return exitcode::done;
}

} // namespace
} // namespace carom

int main(int argc, char** argv) {
    try {
        return carom::comparePeers(std::vector<std::string>(argv + 1, argv + argc));
    } catch (const carom::UsageError& error) {
        carom::printError(std::string("carom-peers: ") + error.what() + "\n");
        return carom::exitcode::wrongUsage;
    } catch (const carom::FileError& error) {
        carom::printError(std::string("carom-peers: ") + error.what() + "\n");
        return carom::exitcode::fileError;
    }
}
