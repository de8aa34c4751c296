// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmark/overlaps.h"
#include "tests/benchmark/peer.h"

#include "app/errors.h"
#include "app/files.h"
#include "app/options.h"

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
#include <sstream>

// carom-peers [--scene LIST] [-n LIST] [--frames F] [--seconds S]: our scenes, read by our own parser, in our
// methods, in Bullet and in ODE, taking turns on one machine, in processor time; before that the broad-phases
// alone on the motion of the first scene.

namespace carom {
namespace {

constexpr std::int64_t turn = 10; // frames one engine advances before the next

class CaromWorld final : public PeerWorld {
  public:
    explicit CaromWorld(std::shared_ptr<const Pipeline> pipeline) : m_world(std::move(pipeline)) {}
    std::string name() const override {
        return "Carom " + std::string(m_world.pipeline().settings().method->name);
    }
    void step() override { m_world.step(); }
    void read(State& state) const override { state = m_world.state(); }
    std::uint64_t resting() const override { return m_world.statistics().resting; }

  private:
    World m_world;
};

/// What is said about one engine.
struct Account {
    std::vector<double> milliseconds; ///< of each frame
    double used = 0;                  ///< their sum [ms]
    Overlaps onTheWay;                ///< of every state looked at
    Overlaps atTheEnd;
    double energyDrift = 0;  ///< relative to the energy at the start
    double speed = 0;        ///< mean of the mobile bodies at the end [m/s]
    std::size_t escaped = 0; ///< bodies whose centres are behind a wall at the end
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

/// Advances a world by a turn, and looks at it once.
void takeTurn(PeerWorld& world, const Bodies& bodies, std::int64_t frames, State& state, Account& account) {
    for (std::int64_t frame = 0; frame < frames; ++frame) {
        const double start = processorTimeOfThread();
        world.step();
        account.milliseconds.push_back(processorTimeOfThread() - start);
        account.used += account.milliseconds.back();
    }
    world.read(state);
    account.atTheEnd = overlapsAt(bodies, state);
    account.onTheWay.add(account.atTheEnd);
}

/// One line a world. The first frame is given apart: engines allocate in it.
std::string rowOf(const PeerWorld& world, const Account& account, std::size_t nameWidth) {
    const std::span<const double> later = std::span(account.milliseconds).subspan(1);
    const Summary summary = summarise(later);
    std::string row = "  " + world.name();
    row.resize(std::max(row.size(), nameWidth), ' ');
    row += column(std::to_string(account.milliseconds.size()), 8);
    for (const double time : {account.milliseconds.front(), summary.mean, summary.median, summary.maximum})
        row += column(figure(time), 9);
    row += column(figure(summary.maximum / summary.median, 2), 8);
    for (const double part : {account.energyDrift, account.onTheWay.mean(), account.onTheWay.largest,
                              account.atTheEnd.largest, account.speed})
        row += column(figure(part, 2), 10);
    return row + column(std::to_string(world.resting()), 8) + column(std::to_string(account.escaped), 8) +
           "\n";
}

std::string headingOf(const ComparedScene& scene, std::int64_t n, std::size_t nameWidth) {
    std::string heading = scene.name + ", N = " + std::to_string(n);
    heading.resize(std::max(heading.size(), nameWidth), ' ');
    heading += column("frames", 8);
    for (const char* time : {"first", "mean", "median", "worst"}) heading += column(time, 9);
    heading += column("/median", 8);
    for (const char* part : {"energy", "overlap", "largest", "at end", "speed"}) heading += column(part, 10);
    return heading + column("asleep", 8) + column("escaped", 8) + "\n";
}

struct Limits {
    std::int64_t frames = 120;
    double seconds = 0; ///< of processor time, for each engine
};

void compareEngines(const ComparedScene& scene, std::int64_t n, const Limits& limits) {
    constexpr std::size_t nameWidth = 30;
    const std::vector<std::shared_ptr<const Pipeline>> pipelines = pipelinesOf(textOf(scene, n));
    const Pipeline& pipeline = *pipelines.front();
    std::vector<std::unique_ptr<PeerWorld>> worlds;
    for (const std::shared_ptr<const Pipeline>& each : pipelines)
        worlds.push_back(std::make_unique<CaromWorld>(each));
    worlds.push_back(makeBulletWorld(pipelines.front()));
    worlds.push_back(makeOdeWorld(pipelines.front()));

    std::vector<Account> accounts(worlds.size());
    State state = pipeline.initialState();
    for (std::int64_t begin = 0; begin < limits.frames; begin += turn)
        for (std::size_t k = 0; k < worlds.size(); ++k)
            if (accounts[k].used < 1e3 * limits.seconds)
                takeTurn(*worlds[k], pipeline.bodies(), std::min(turn, limits.frames - begin), state,
                         accounts[k]);

    const double energy = energyOf(pipeline, pipeline.initialState());
    std::string table = headingOf(scene, n, nameWidth);
    for (std::size_t k = 0; k < worlds.size(); ++k) {
        worlds[k]->read(state);
        accounts[k].energyDrift = energyOf(pipeline, state) / energy - 1;
        accounts[k].speed = meanSpeedOf(pipeline.bodies(), state);
        accounts[k].escaped = escapedFrom(pipeline.bodies(), state);
        table += rowOf(*worlds[k], accounts[k], nameWidth);
    }
    printOut(table + "\n");
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
        {"seconds", 0, "S",
         "an engine that has used so much processor time on a scene takes no more turns (default 60)"},
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
    std::vector<ComparedScene> scenes;
    for (const std::string& name :
         wordsOf(arguments.text("scene").value_or("brownian,pool_breaks,pyramid,pile")))
        scenes.push_back(sceneNamed(name));
    for (const std::int64_t n : counts) compareBroadphases(scenes.front(), n);
    for (const ComparedScene& scene : scenes)
        for (const std::int64_t n : counts) compareEngines(scene, n, limits);
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
    }
}
