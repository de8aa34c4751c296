// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/build.h"

#include "core/simulation/generated_scene.h"

#include <algorithm>
#include <utility>

namespace carom {
namespace {

/// The analysis's share of the time, as it is for 200,000 spheres in a gas. At twice or half the progress
/// that is shown runs unevenly; nothing else depends on it.
constexpr double analysed = 0.35;

/// One more mistake in the text, in its place among the others.
void report(Analysis& analysis, Diagnostic diagnostic) {
    const auto behind = std::ranges::upper_bound(analysis.diagnostics, diagnostic.range.offset, {},
                                                 [](const Diagnostic& other) { return other.range.offset; });
    analysis.diagnostics.insert(behind, std::move(diagnostic));
    ++analysis.mistakes;
}

Build buildOf(std::string text, const SimulationSettings& options, const WorkStage& stage,
              std::optional<int> seed = {}) {
    Build built;
    built.analysis = analyse(std::move(text), stage.part(0, analysed));
    const WorkStage none = stage.part(analysed, analysed); // asked, but short beside the others
    if (std::optional<Diagnostic> wrong = addGenerated(built.analysis.scene, seed, none))
        report(built.analysis, std::move(*wrong));
    built.pipeline = std::make_shared<const Pipeline>(built.analysis.scene, options, stage.part(analysed, 1));
    built.diagnostics = built.analysis.diagnostics;
    const std::vector<Diagnostic>& warnings = built.pipeline->warnings();
    built.diagnostics.insert(built.diagnostics.end(), warnings.begin(), warnings.end());
    std::stable_sort(
        built.diagnostics.begin(), built.diagnostics.end(),
        [](const Diagnostic& a, const Diagnostic& b) { return a.range.offset < b.range.offset; });
    stage.reach(1);
    return built;
}

} // namespace

Build build(std::string text, const SimulationSettings& options) {
    return buildOf(std::move(text), options, {});
}

Build buildSeeded(std::string text, const SimulationSettings& options, int seed) {
    return buildOf(std::move(text), options, {}, seed);
}

std::optional<Build> buildWhile(const GoOn& goOn, std::string text, const SimulationSettings& options) {
    try {
        return buildOf(std::move(text), options, WorkStage(goOn));
    } catch (const Stopped&) {
        return std::nullopt;
    }
}

} // namespace carom
