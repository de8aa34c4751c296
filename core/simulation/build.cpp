// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/build.h"

#include <algorithm>
#include <utility>

namespace carom {
namespace {

/// The analysis's share of the time, as it is for 200,000 spheres in a gas.
constexpr double analysed = 0.35;

Build buildOf(std::string text, const SimulationSettings& options, const WorkStage& stage) {
    Build built;
    built.analysis = analyse(std::move(text), stage.part(0, analysed));
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

std::optional<Build> buildWhile(const GoOn& goOn, std::string text, const SimulationSettings& options) {
    try {
        return buildOf(std::move(text), options, WorkStage(goOn));
    } catch (const Stopped&) {
        return std::nullopt;
    }
}

} // namespace carom
