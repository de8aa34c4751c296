// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/expectations/scene_check.h"

#include "core/base/clock.h"
#include "core/simulation/world.h"

#include <algorithm>
#include <set>

namespace carom {
namespace {

/// How long an expectation without an end is judged in a scene without a duration [s]. At half, bodies that
/// come to rest late fail; at twice, `carom test` takes twice as long.
constexpr double openEnd = 10;

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

namespace {

/// The seeds an expectation is judged with: from `first`, `count` of them.
struct Seeds {
    int first = 0, count = 1;

    bool contain(int seed) const { return seed >= first && seed - first < count; }
};

Seeds seedsOf(const Expectation& asked, int declared) {
    return {asked.seed.value_or(declared), asked.repeat};
}

/// The worse of two runs; either may have failed.
void take(Judgement& kept, const Judgement& seen, int seed) {
    const bool first = kept.runs == 0;
    const bool worse = first ||
                       (kept.state != ExpectationState::Fails && seen.state == ExpectationState::Fails) ||
                       (kept.state == seen.state && isWorse(seen, kept));
    const Expectation* expectation = kept.expectation; // of the pipeline that is kept
    const int runs = kept.runs + 1;
    if (worse) {
        kept = seen;
        kept.seed = seed;
    }
    kept.expectation = expectation;
    kept.runs = runs;
}

} // namespace

std::optional<SceneCheck> checkRepeated(const Build& built, const SimulationSettings& options,
                                        const std::function<bool()>& goOn, std::optional<double> mostOpen) {
    std::optional<SceneCheck> check = checkScene(built.pipeline, goOn, mostOpen);
    const Scene& scene = built.pipeline->scene();
    if (!check || !scene.generated) return check;
    const int declared = scene.generated->seed;
    std::set<int> seeds;
    const std::vector<Judgement> asWritten = check->judgements;
    for (Judgement& judgement : check->judgements) {
        const Expectation& asked = *judgement.expectation;
        if (asked.repeat == 1 && !asked.seed) continue;
        const Seeds own = seedsOf(asked, declared);
        for (int i = 0; i < own.count; ++i) seeds.insert(own.first + i);
        judgement.runs = 0;
    }
    for (const int seed : seeds) {
        std::optional<SceneCheck> run;
        if (seed != declared) {
            run = checkScene(buildSeeded(built.analysis.text, options, seed).pipeline, goOn, mostOpen);
            if (!run) return std::nullopt;
            ++check->runs;
            check->frames += run->frames;
            check->seconds += run->seconds;
        }
        const std::vector<Judgement>& seen = run ? run->judgements : asWritten;
        for (std::size_t i = 0; i < check->judgements.size(); ++i) {
            const Expectation& asked = *check->judgements[i].expectation;
            const bool repeats = asked.repeat != 1 || asked.seed;
            if (repeats && seedsOf(asked, declared).contain(seed)) take(check->judgements[i], seen[i], seed);
        }
    }
    return check;
}

} // namespace carom
