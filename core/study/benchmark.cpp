// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/benchmark.h"

#include "core/simulation/build.h"
#include "core/simulation/world.h"

#include "core/base/assert.h"
#include "core/base/clock.h"
#include "core/base/figures.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>

namespace carom {
namespace {

// Frames that one world advances before the next one: enough to fill the caches, few enough that a
// disturbance of a tenth of a second affects several worlds. At a tenth, every frame begins with cold caches;
// at ten times, a disturbance affects one world.
constexpr std::int64_t turn = 10;

/// Worlds that differ in nothing but their broad-phase.
struct Contest {
    const GeneratorRow* scene = nullptr;
    std::int64_t n = 0;
    std::shared_ptr<const Pipeline> pipeline;
    std::vector<const BroadphaseRow*> algorithms;
    std::vector<std::unique_ptr<World>> worlds;
    std::vector<std::vector<FrameStatistics>> frames; ///< by world
};

Contest prepare(std::shared_ptr<const Pipeline> pipeline,
                const std::vector<const BroadphaseRow*>& algorithms) {
    Contest contest;
    contest.pipeline = std::move(pipeline);
    contest.n = static_cast<std::int64_t>(contest.pipeline->bodies().count());
    contest.algorithms = algorithms;
    for (const BroadphaseRow* row : algorithms) {
        contest.worlds.push_back(std::make_unique<World>(contest.pipeline));
        contest.worlds.back()->useBroadphase(*row);
    }
    contest.frames.resize(algorithms.size());
    return contest;
}

Contest prepare(const GeneratorRow& scene, std::int64_t n, const SimulationSettings& options,
                const std::vector<const BroadphaseRow*>& algorithms) {
    Contest contest = prepare(build(generate(scene, requestFor(scene, n)), options).pipeline, algorithms);
    contest.scene = &scene;
    contest.n = n;
    return contest;
}

/// The frame with its times in processor time, of which it took `spent` [ms] in all. The parts are taken down
/// in proportion: where in the frame the thread had to wait is not known.
FrameStatistics inProcessorTime(FrameStatistics frame, double spent) {
    if (frame.simulate <= 0) return frame;
    const double share = spent / frame.simulate;
    for (double* time :
         {&frame.simulate, &frame.integrate, &frame.broadphase, &frame.narrowphase, &frame.respond})
        *time *= share;
    return frame;
}

/// False if it was told to stop; `heard` is called after each frame of each world.
bool advance(Contest& contest, std::int64_t frames, const std::function<bool()>& heard) {
    const bool oneThread = contest.pipeline->settings().threads == 1;
    for (std::int64_t begin = 0; begin < frames; begin += turn) {
        for (std::size_t k = 0; k < contest.worlds.size(); ++k) {
            for (std::int64_t f = begin; f < std::min(begin + turn, frames); ++f) {
                const double start = processorTimeOfThread();
                contest.worlds[k]->step();
                const double spent = processorTimeOfThread() - start;
                const FrameStatistics& frame = contest.worlds[k]->statistics();
                contest.frames[k].push_back(oneThread ? inProcessorTime(frame, spent) : frame);
                if (!heard()) return false;
            }
        }
    }
    return true;
}

double meanOf(std::span<const FrameStatistics> frames, double (*value)(const FrameStatistics&)) {
    double sum = 0;
    for (const FrameStatistics& frame : frames) sum += value(frame);
    return sum / static_cast<double>(std::max<std::size_t>(1, frames.size()));
}

BenchmarkPoint pointOf(const Contest& contest, std::size_t world) {
    using Frame = FrameStatistics;
    const std::span<const Frame> all = contest.frames[world];
    const std::span<const Frame> later = all.subspan(1);
    std::vector<double> times;
    for (const Frame& frame : later) times.push_back(frame.simulate);
    return {.scene = contest.scene,
            .n = contest.n,
            .bodies = contest.pipeline->bodies().count(),
            .algorithm = contest.algorithms[world],
            .first = all.front().simulate,
            .simulate = summarise(times),
            .broadphase = meanOf(later, [](const Frame& frame) { return frame.broadphase; }),
            .narrowphase = meanOf(later, [](const Frame& frame) { return frame.narrowphase; }),
            .pairs = meanOf(later, [](const Frame& frame) { return double(frame.broad.pairs); }),
            .tested = meanOf(later, [](const Frame& frame) { return double(frame.broad.tested); }),
            .contacts = meanOf(later, [](const Frame& frame) { return double(frame.contacts); }),
            .swaps = meanOf(later, [](const Frame& frame) { return double(frame.broad.swaps); }),
            .memoryBytes = later.back().broad.memoryBytes,
            .stateHash = contest.worlds[world]->state().frame > std::ssize(all)
                             ? 0
                             : contest.worlds[world]->stateHash()};
}

/// The frames of a world, each of its times the median over the repeats.
std::vector<FrameStatistics> withMedians(const std::vector<Contest>& repeats, std::size_t world) {
    std::vector<FrameStatistics> frames = repeats.front().frames[world];
    std::vector<double> times;
    for (double FrameStatistics::*time :
         {&FrameStatistics::simulate, &FrameStatistics::integrate, &FrameStatistics::broadphase,
          &FrameStatistics::narrowphase, &FrameStatistics::respond})
        for (std::size_t frame = 0; frame < frames.size(); ++frame) {
            times.clear();
            for (const Contest& repeat : repeats) times.push_back(repeat.frames[world][frame].*time);
            frames[frame].*time = summarise(times).median;
        }
    return frames;
}

/// Runs the plan and counts frames for the listener.
class Runner {
  public:
    Runner(const BenchmarkPlan& plan, const BenchmarkListener& goOn,
           const std::function<void(const Benchmark&)>& measured)
        : m_goOn(goOn), m_measured(measured) {
        m_result.plan = plan;
        const std::int64_t worlds = std::ssize(plan.algorithms);
        m_total = plan.frames * worlds * std::ssize(plan.scenes) * std::ssize(plan.counts);
        if (plan.traceScene) m_total += plan.traceFrames * worlds * plan.traceRepeats;
    }

    Benchmark run() {
        m_result.complete = runScenes() && runTraces(); // what is there first was done within a second
        return std::move(m_result);
    }

  private:
    bool runTraces() {
        const BenchmarkPlan& plan = m_result.plan;
        if (!plan.traceScene) return true;
        std::vector<Contest> repeats;
        for (int repeat = 0; repeat < plan.traceRepeats; ++repeat) {
            repeats.push_back(prepare(*plan.traceScene, plan.traceCount, plan.options, plan.algorithms));
            if (!advance(repeats.back(), plan.traceFrames, m_heard)) return false;
            const Contest& contest = repeats.front();
            m_result.traces.clear();
            for (std::size_t k = 0; k < contest.worlds.size(); ++k)
                m_result.traces.push_back({.scene = contest.scene,
                                           .n = contest.n,
                                           .algorithm = contest.algorithms[k],
                                           .frames = withMedians(repeats, k)});
            if (m_measured) m_measured(m_result);
        }
        return true;
    }

    bool runScenes() {
        for (const GeneratorRow* scene : m_result.plan.scenes) {
            std::vector<const BroadphaseRow*> algorithms = m_result.plan.algorithms;
            for (const std::int64_t n : m_result.plan.counts) {
                Contest contest = prepare(*scene, n, m_result.plan.options, algorithms);
                if (!advance(contest, m_result.plan.frames, m_heard)) return false;
                record(contest);
                dropTheSlow(algorithms, n);
                if (m_measured) m_measured(m_result);
            }
        }
        return true;
    }

    void record(const Contest& contest) {
        for (std::size_t k = 0; k < contest.worlds.size(); ++k) {
            m_result.points.push_back(pointOf(contest, k));
            if (!contest.worlds[k]->health().finite)
                m_result.remarks.push_back(std::string(contest.scene->name) + ", N = " +
                                           std::to_string(contest.n) + ": a state ceased to be finite");
            if (m_result.points.back().stateHash != contest.worlds.front()->stateHash())
                m_result.remarks.push_back(
                    std::string(contest.scene->name) + ", N = " + std::to_string(contest.n) + ": " +
                    std::string(contest.algorithms[k]->name) + " arrived at another state than " +
                    std::string(contest.algorithms.front()->name));
        }
    }

    /// Takes out of `algorithms` those whose last points were slower than the plan allows.
    void dropTheSlow(std::vector<const BroadphaseRow*>& algorithms, std::int64_t n) {
        const std::size_t measured = algorithms.size();
        for (std::size_t p = m_result.points.size() - measured; p < m_result.points.size(); ++p) {
            const BenchmarkPoint& point = m_result.points[p];
            if (point.simulate.median <= m_result.plan.timeLimit || n == m_result.plan.counts.back())
                continue;
            std::erase(algorithms, point.algorithm);
            m_result.remarks.push_back(std::string(point.scene->name) + ": " +
                                       std::string(point.algorithm->name) +
                                       " not beyond N = " + std::to_string(n) + ", where a frame took " +
                                       figure(point.simulate.median) + " ms");
        }
        const std::int64_t left = std::count_if(m_result.plan.counts.begin(), m_result.plan.counts.end(),
                                                [n](std::int64_t count) { return count > n; });
        m_total -= left * m_result.plan.frames * static_cast<std::int64_t>(measured - algorithms.size());
    }

    Benchmark m_result;
    const BenchmarkListener& m_goOn;
    const std::function<void(const Benchmark&)>& m_measured;
    std::int64_t m_done = 0, m_total = 0;
    const std::function<bool()> m_heard = [this] { return m_goOn(++m_done, m_total); };
};

} // namespace

GeneratorRequest requestFor(const GeneratorRow& scene, std::int64_t n) {
    GeneratorRequest request;
    if (scene.defaultN > 0) request.n = n;
    return request;
}

BenchmarkPlan standardBenchmark() {
    BenchmarkPlan plan;
    for (const std::string_view name : {"pool_breaks", "brownian", "pyramid"})
        plan.scenes.push_back(findGenerator(name));
    plan.counts = {100, 200, 500, 1000, 2000, 5000, 10000, 20000};
    for (const BroadphaseRow& row : broadphases()) plan.algorithms.push_back(&row);
    plan.options.method = "microcollisions";
    plan.traceScene = findGenerator("pyramid");
    return plan;
}

Benchmark runBenchmark(const BenchmarkPlan& plan, const BenchmarkListener& goOn,
                       const std::function<void(const Benchmark&)>& measured) {
    ASSERT(plan.frames >= 2 && plan.traceFrames >= 2 && plan.traceRepeats >= 1);
    return Runner(plan, goOn, measured).run();
}

Benchmark compareBroadphases(const std::shared_ptr<const Pipeline>& pipeline, std::int64_t frames,
                             const BenchmarkListener& goOn) {
    ASSERT(frames >= 2);
    Benchmark result;
    for (const BroadphaseRow& row : broadphases()) result.plan.algorithms.push_back(&row);
    Contest contest = prepare(pipeline, result.plan.algorithms);
    const std::int64_t total = frames * std::ssize(contest.worlds);
    std::int64_t done = 0;
    result.complete = advance(contest, frames, [&] { return goOn(++done, total); });
    result.plan.frames = frames;
    for (const std::vector<FrameStatistics>& run : contest.frames)
        result.plan.frames = std::min<std::int64_t>(result.plan.frames, std::ssize(run));
    for (std::size_t k = 0; k < contest.worlds.size(); ++k) {
        contest.frames[k].resize(static_cast<std::size_t>(result.plan.frames));
        if (result.plan.frames >= 2) result.points.push_back(pointOf(contest, k));
        result.traces.push_back({.scene = nullptr,
                                 .n = contest.n,
                                 .algorithm = contest.algorithms[k],
                                 .frames = std::move(contest.frames[k])});
    }
    return result;
}

} // namespace carom
