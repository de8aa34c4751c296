// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/broadphase/broadphase.h"
#include "core/generators/generator.h"
#include "core/simulation/pipeline.h"
#include "core/simulation/statistics.h"

#include "core/math/statistics.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

// The reference's performance evaluation (S. Stokes, "Collision Detection in the Simulation of Rigid Body
// Motion", 2005, section 4.3) for every broad-phase: time against the number of bodies, and the course of a
// run. For each scene and number the worlds of all algorithms advance in turns, a few frames each, so other
// load of the machine affects all of them equally. With one thread, times are processor times: on an idle
// machine these equal wall times, and on a busy one they exclude waiting.

namespace carom {

struct BenchmarkPlan {
    std::vector<const GeneratorRow*> scenes;
    std::vector<std::int64_t> counts; ///< ascending
    std::vector<const BroadphaseRow*> algorithms;
    /// Of every world; the broad-phase is the algorithm's, and the standard method the reference's.
    SimulationSettings options;
    std::int64_t frames = 120; ///< of each world; at least 2

    const GeneratorRow* traceScene = nullptr; ///< null: no traces
    std::int64_t traceCount = 500;
    std::int64_t traceFrames = 600;
    int traceRepeats = 3; ///< the motion is the same each time; a frame's time is the median, which excludes
                          ///< peaks by other load

    /// An algorithm whose median frame took longer is left out at larger numbers of that scene [ms].
    double timeLimit = 60;
};

/// The three scenes and every algorithm, with numbers of bodies up to more than run in real time.
BenchmarkPlan standardBenchmark();

/// The benchmark's request to a generator; one that takes no number of bodies makes its only scene.
GeneratorRequest requestFor(const GeneratorRow& scene, std::int64_t n);

/// The run of one world.
struct BenchmarkPoint {
    const GeneratorRow* scene = nullptr; ///< null: a scene of the user's
    std::int64_t n = 0;                  ///< number given to the generator
    std::uint64_t bodies = 0;            ///< built, walls included
    const BroadphaseRow* algorithm = nullptr;

    double first = 0;       ///< [ms], the first frame
    Summary simulate;       ///< [ms], the later frames
    double broadphase = 0;  ///< [ms], mean of those frames; so are all below
    double narrowphase = 0; ///< [ms]
    double pairs = 0, tested = 0, contacts = 0, swaps = 0;
    std::uint64_t memoryBytes = 0; ///< held by the broad-phase at the end
    /// Of the last frame: the same for every algorithm. 0 where the world had gone on beyond that frame.
    std::uint64_t stateHash = 0;
};

/// Every frame of one world.
struct BenchmarkTrace {
    const GeneratorRow* scene = nullptr; ///< null: a scene of the user's
    std::int64_t n = 0;
    const BroadphaseRow* algorithm = nullptr;
    std::vector<FrameStatistics> frames;
};

struct Benchmark {
    BenchmarkPlan plan;
    std::vector<BenchmarkPoint> points; ///< by scene, then number, then algorithm, as in the plan
    std::vector<BenchmarkTrace> traces;
    std::vector<std::string> remarks; ///< what was left out, and why
    bool complete = false;            ///< false: it was stopped; the points up to then are complete
};

/// Called after each frame with the frames done and about how many there are; false ends the benchmark.
using BenchmarkListener = std::function<bool(std::int64_t done, std::int64_t total)>;

/// `measured` is called with the results after every scene and number, then after every repeat of the traces,
/// whose times are medians of the repeats so far.
Benchmark runBenchmark(const BenchmarkPlan& plan, const BenchmarkListener& goOn,
                       const std::function<void(const Benchmark&)>& measured = {});

/// Every algorithm on one scene over the same frames, at least 2, taking turns: the points, and every frame
/// as traces. Their `scene` is null and their `n` is the number of bodies. If it is stopped, it keeps the
/// frames that every algorithm has done; `plan.frames` is their number. There are no points with fewer
/// than 2.
Benchmark compareBroadphases(const std::shared_ptr<const Pipeline>& pipeline, std::int64_t frames,
                             const BenchmarkListener& goOn);

} // namespace carom
