// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmark/peer.h"

#include "app/errors.h"
#include "app/files.h"
#include "app/options.h"

#include "core/dynamics/energy.h"
#include "core/generators/generator.h"
#include "core/simulation/build.h"
#include "core/simulation/touching.h"
#include "core/simulation/world.h"

#include "core/base/clock.h"
#include "core/base/figures.h"
#include "core/base/text.h"
#include "core/math/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

// carom-peers [--scene LIST] [-n LIST] [--frames F]: our scenes, read by our own parser, in our methods, in
// Bullet and in ODE, taking turns on one machine, in processor time; then the broad-phases alone on the
// motion of the gas.

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

  private:
    World m_world;
};

/// What is said about one engine.
struct Account {
    std::vector<double> milliseconds;
    double energyDrift = 0;  ///< relative to the energy at the start
    double deepest = 0;      ///< overlap over the thinner body's half thickness, the worst met
    double meanDepth = 0;    ///< the same, mean over touching pairs at the end
    std::size_t escaped = 0; ///< bodies whose centres are behind a wall at the end
};

double energyOf(const Pipeline& pipeline, const State& state) {
    const Invariants invariants = invariantsOf(pipeline.bodies(), state, pipeline.gravity());
    return invariants.kinetic + invariants.potential;
}

double thicknessOf(const Bodies& bodies, const BodyPair& pair) {
    double least = std::numeric_limits<double>::max();
    for (const BodyIndex i : {pair.a, pair.b})
        if (!isWall(bodies.shape[i])) least = std::min(least, halfThicknessOf(bodies.shape[i]));
    return least;
}

void lookAtOverlaps(const Bodies& bodies, const State& state, Account& account) {
    double sum = 0;
    const std::vector<TouchingPair> touching = touchingPairs(bodies, state);
    for (const TouchingPair& pair : touching) {
        double depth = 0;
        for (int k = 0; k < pair.manifold.count; ++k)
            depth = std::max(depth, -pair.manifold.points[static_cast<std::size_t>(k)].separation);
        depth /= thicknessOf(bodies, pair.pair);
        account.deepest = std::max(account.deepest, depth);
        sum += depth;
    }
    account.meanDepth = touching.empty() ? 0 : sum / static_cast<double>(touching.size());
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

std::string textOf(const GeneratorRow& scene, std::int64_t n) {
    GeneratorRequest request;
    request.n = n;
    if (const std::optional<std::string> reason = checkRequest(scene, request)) throw UsageError(*reason);
    return generate(scene, request);
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

void compareEngines(const GeneratorRow& scene, std::int64_t n, std::int64_t frames) {
    const std::vector<std::shared_ptr<const Pipeline>> pipelines = pipelinesOf(textOf(scene, n));
    const Pipeline& pipeline = *pipelines.front();
    std::vector<std::unique_ptr<PeerWorld>> worlds;
    for (const std::shared_ptr<const Pipeline>& each : pipelines)
        worlds.push_back(std::make_unique<CaromWorld>(each));
    worlds.push_back(makeBulletWorld(pipelines.front()));
    worlds.push_back(makeOdeWorld(pipelines.front()));

    std::vector<Account> accounts(worlds.size());
    State state = pipeline.initialState();
    for (std::int64_t begin = 0; begin < frames; begin += turn) {
        for (std::size_t k = 0; k < worlds.size(); ++k) {
            for (std::int64_t frame = begin; frame < std::min(begin + turn, frames); ++frame) {
                const double start = processorTimeOfThread();
                worlds[k]->step();
                accounts[k].milliseconds.push_back(processorTimeOfThread() - start);
            }
            worlds[k]->read(state);
            lookAtOverlaps(pipeline.bodies(), state, accounts[k]);
        }
    }
    const double energy = energyOf(pipeline, pipeline.initialState());
    std::string table = std::string(scene.name) + ", N = " + std::to_string(n) + ", " +
                        std::to_string(frames) + " frames" + column("ms/frame", 12) + column("mean ms", 10) +
                        column("energy", 12) + column("deepest", 10) + column("mean", 10) +
                        column("escaped", 9) + "\n";
    const std::size_t first = table.find("ms/frame") - 12 + std::string("ms/frame").size();
    for (std::size_t k = 0; k < worlds.size(); ++k) {
        worlds[k]->read(state);
        Account& account = accounts[k];
        account.energyDrift = energyOf(pipeline, state) / energy - 1;
        account.escaped = escapedFrom(pipeline.bodies(), state);
        const Summary summary = summarise(account.milliseconds);
        std::string row = "  " + worlds[k]->name();
        row.resize(std::max(row.size(), first - 4), ' ');
        table += row + column(figure(summary.median), 12) + column(figure(summary.mean), 10) +
                 column(figure(account.energyDrift, 2), 12) + column(figure(account.deepest, 2), 10) +
                 column(figure(account.meanDepth, 2), 10) + column(std::to_string(account.escaped), 9) + "\n";
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

void compareBroadphases(const GeneratorRow& scene, std::int64_t n) {
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
    std::string table = "Broad-phases alone, " + std::string(scene.name) + ", N = " + std::to_string(n) +
                        "\n" + column("ms", 38) + column("/ tree", 12) + column("/ sweep", 12) +
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
        {"scene", 0, "LIST", "generators, separated by commas (default brownian,pool_breaks,pyramid,pile)"},
        {"n", 'n', "LIST", "numbers of bodies, separated by commas (default 1000,2000,10000)"},
        {"frames", 0, "F", "frames of each run (default 120)"},
    };
    const Arguments arguments = readArguments(words, options);
    if (arguments.has("help")) return printOut(describe(options)), exitcode::done;
    const std::int64_t frames = arguments.wholeNumber("frames", 1, 100'000).value_or(120);
    std::vector<std::int64_t> counts;
    for (const std::string& word : wordsOf(arguments.text("n").value_or("1000,2000,10000"))) {
        const std::optional<long long> count = wholeNumberIn(word);
        if (!count || *count < 1)
            throw UsageError("`-n` has `" + word + "`; it must be a whole number from 1 on");
        counts.push_back(*count);
    }
    std::vector<const GeneratorRow*> scenes;
    for (const std::string& name :
         wordsOf(arguments.text("scene").value_or("brownian,pool_breaks,pyramid,pile"))) {
        scenes.push_back(findGenerator(name));
        if (!scenes.back()) throw UsageError("there is no generator `" + name + "`");
    }
    for (const std::int64_t n : counts) compareBroadphases(*scenes.front(), n);
    for (const GeneratorRow* scene : scenes)
        for (const std::int64_t n : counts) compareEngines(*scene, n, frames);
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
