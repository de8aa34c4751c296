// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/expectations/scene_check.h"

#include "core/base/clock.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

constexpr double openEnd = 10; ///< how long what follows is looked at where nothing says [s]

/// A time written as so many frames must not gain one by rounding.
std::int64_t framesUntil(double time, double step) {
    constexpr double mostFrames = 1e15; // where frames still count exactly in a double
    return static_cast<std::int64_t>(std::clamp(std::ceil(time / step * (1 - 1e-12)), 0.0, mostFrames));
}

} // namespace

bool SceneCheck::allHold() const {
    return std::ranges::all_of(
        judgements, [](const Judgement& judgement) { return judgement.state == ExpectationState::Holds; });
}

std::int64_t framesToJudge(const Pipeline& pipeline, const ExpectationWatch& watch,
                           std::optional<double> mostOpen) {
    if (watch.empty()) return 0;
    const RunSettings& settings = pipeline.settings();
    double open = settings.duration.value_or(watch.isOpenEnded() ? openEnd : 0);
    if (mostOpen) open = std::min(open, *mostOpen);
    double end = std::max(open, watch.lastNamedTime());
    if (settings.duration) end = std::min(end, *settings.duration);
    return std::max<std::int64_t>(1, framesUntil(end, settings.step));
}

std::optional<SceneCheck> checkScene(std::shared_ptr<const Pipeline> pipeline,
                                     const std::function<bool()>& goOn, std::optional<double> mostOpen) {
    const Stopwatch clock;
    World world(pipeline);
    ExpectationWatch watch(pipeline);
    world.keepLedger(watch.needsLedger());
    const std::int64_t frames = framesToJudge(*pipeline, watch, mostOpen);
    watch.begin(world);
    while (world.state().frame < frames && world.health().finite) {
        if (goOn && !goOn()) return std::nullopt;
        world.step();
        watch.look(world);
    }
    watch.finish();
    return SceneCheck{.pipeline = std::move(pipeline),
                      .judgements = watch.judgements(),
                      .health = world.health(),
                      .frames = world.state().frame,
                      .seconds = clock.elapsed() / 1000};
}

} // namespace carom
