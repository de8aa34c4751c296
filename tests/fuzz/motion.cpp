// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/motion.h"

#include "core/simulation/build.h"
#include "core/simulation/world.h"
#include "core/solvers/contacts/work_budget.h"
#include "tests/fuzz/properties.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace carom::test {
namespace {

constexpr int frames = 20, middle = 10;
constexpr double operationsPerEvent = 100;
// A scene may ask for more, and is right to: they are its author's to wait for.
constexpr int substeps = 2, iterations = 20;

// What a state must be that is said to be in order, and what must be said of another one.
std::string brokenState(const World& world, std::int64_t frame) {
    const Health& health = world.health();
    const Bodies& bodies = world.pipeline().bodies();
    if (world.state().pose.size() != bodies.count()) return "bodies were lost or made";
    const Loss loss = findLoss(bodies, world.state());
    if (health.finite) {
        if (world.state().frame != frame) return "a frame was left out";
        return loss ? "a state that is no longer finite counts as healthy" : "";
    }
    if (health.body >= bodies.count()) return "a run stopped for a body that is not there";
    return health.quantity.empty() ? "a run stopped for no reason" : "";
}

bool isQuiet(const FrameStatistics& frame) {
    return frame.contacts == 0 && frame.events == 0 && frame.work.impacts == 0;
}

/// Of the body that goes farthest, relative to its size, within the first frame.
double sizesInAFrame(const Pipeline& pipeline) {
    const Bodies& bodies = pipeline.bodies();
    const double step = pipeline.settings().step;
    double most = 0;
    for (const BodyIndex i : bodies.mobileBodies) {
        const double speed = pipeline.initialState().velocity[i].norm() + bodies.gravity.norm() * step;
        most = std::max(most, speed * step / bodies.boundingRadius[i]);
    }
    return most;
}

std::string brokenRun(const std::shared_ptr<const Pipeline>& pipeline, const MotionLimits& limits) {
    World world(pipeline);
    std::optional<Checkpoint> checkpoint;
    double work = 0;
    int frame = 0, quiet = 0;
    while (frame < frames && work < limits.operations && quiet < limits.quietFrames) {
        world.step();
        ++frame;
        quiet = isQuiet(world.statistics()) ? quiet + 1 : 0;
        work += operationsOf(world.statistics().work) +
                operationsPerEvent * static_cast<double>(world.statistics().events);
        if (std::string broken = brokenState(world, frame); !broken.empty()) return broken;
        if (!world.health().finite) {
            const std::uint64_t hash = world.stateHash();
            world.step();
            return world.stateHash() == hash ? "" : "a run that has stopped goes on";
        }
        if (frame == middle) checkpoint = world.checkpoint();
    }
    if (!checkpoint || !limits.comparesCheckpoint) return {};
    World again(pipeline);
    again.restore(*checkpoint);
    while (again.state().frame < frame) again.step();
    return again.stateHash() == world.stateHash() ? "" : "a run from a checkpoint ends elsewhere";
}

} // namespace

std::string brokenMotion(std::string_view text, const SolverRow& method, const MotionLimits& limits) {
    SimulationSettings options;
    options.method = method.name;
    options.substeps = substeps;
    options.iterations = iterations;
    options.threads = 1;
    const Build made = build(std::string(text), options);
    if (made.analysis.scene.bodies.size() > limits.bodies) return {};
    if (sizesInAFrame(*made.pipeline) > limits.sizesAFrame) return {};
    const std::string broken = brokenRun(made.pipeline, limits);
    return broken.empty() ? broken : std::string(method.name) + ": " + broken;
}

std::string brokenProperty(std::string_view text) {
    for (const SolverRow& method : solvers())
        if (std::string broken = brokenMotion(text, method, {}); !broken.empty()) return broken;
    return {};
}

} // namespace carom::test
