// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/crowd_runs.h"

#include "core/math/random.h"
#include "core/simulation/world.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace carom {
namespace {

/// Balls of a crowd at least: an average over n balls has a deviation of 1/√n. It is 14 % with 50 balls, 20 %
/// at half as many, and 10 % at twice as many.
constexpr std::size_t leastBalls = 50;
/// The least part of a run in which copies have nothing in common any more. At half, a crowd's averages are
/// largely those of its start; at twice, no run would be long enough.
constexpr double leastPart = 0.5;
/// The histogram of speeds reaches to so many times the fastest at the start; faster ones share the last bin.
/// At a third, a gas that heats up would be in that bin wholly; at twice, bins are twice as wide.
constexpr double fasterThanStart = 3;

CrowdWatch::Sums without(const CrowdWatch::Sums& all, const CrowdWatch::Sums& one) {
    CrowdWatch::Sums rest = one;
    for (double& count : rest.speeds) count = -count;
    rest.momentum = -one.momentum;
    rest.impacts = -one.impacts;
    rest.ballFrames = -one.ballFrames;
    rest.looks = -one.looks;
    rest.add(all);
    return rest;
}

} // namespace

Scene nudged(const Scene& scene, double distance, std::uint64_t seed) {
    Scene copy = scene;
    Random random(seed);
    for (Body& body : copy.bodies) {
        if (!body.mobile()) continue;
        const Vec3 direction(random.gaussian(), random.gaussian(), random.gaussian());
        body.pose.position += distance * direction.normalized();
    }
    return copy;
}

std::int64_t framesToForget(double growth, double step) {
    if (!(growth > 0)) return 0;
    return static_cast<std::int64_t>(std::ceil(std::min(-std::log(crowdNudge) / (growth * step), 1e15)));
}

std::optional<CrowdWatch::Sums> runCopy(const CrowdRun& run, int copy, SimulationSettings options) {
    options.step = run.step;
    const Scene scene = nudged(run.scene, copy > 0 ? run.nudge : 0, static_cast<std::uint64_t>(copy));
    World world(std::make_shared<const Pipeline>(scene, options));
    const Bodies& bodies = world.pipeline().bodies();
    ImpactWatch impacts(bodies, world.pipeline().gravity(), run.step, world.state());
    CrowdWatch crowd(bodies, run.first, run.fastest);
    for (std::int64_t frame = 0; frame < run.frames; ++frame) {
        world.step();
        if (!world.health().finite || !run.goOn()) return std::nullopt;
        crowd.look(world.state(), impacts.look(world.state()));
    }
    return crowd.sums();
}

std::optional<ExactCrowd> exactCrowd(CrowdRun run, const Bodies& bodies, int copies) {
    if (bodies.mobileBodies.size() < leastBalls || copies < 2) return std::nullopt;
    if (static_cast<double>(run.first) > leastPart * static_cast<double>(run.frames)) return std::nullopt;
    for (const Body& body : run.scene.bodies)
        if (body.mobile()) run.fastest = std::max(run.fastest, fasterThanStart * body.velocity.norm());
    if (!(run.fastest > 0)) return std::nullopt;
    SimulationSettings options;
    options.method = "events";
    std::vector<CrowdWatch::Sums> each;
    for (int copy = 0; copy < copies && (!run.hasTime || run.hasTime()); ++copy) {
        std::optional<CrowdWatch::Sums> sums = runCopy(run, copy, options);
        if (!sums) return std::nullopt;
        each.push_back(std::move(*sums));
    }
    if (each.size() < 2) return std::nullopt;
    ExactCrowd crowd{.sums = each.front(), .first = run.first, .fastest = run.fastest};
    for (std::size_t k = 1; k < each.size(); ++k) crowd.sums.add(each[k]);
    std::vector<CrowdDeviation> scatter;
    for (const CrowdWatch::Sums& copy : each) scatter.push_back(deviationOf(copy, without(crowd.sums, copy)));
    crowd.scatter = figuresOf(scatter);
    return crowd;
}

} // namespace carom
