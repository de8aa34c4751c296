// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/scene_options.h"

#include "app/errors.h"
#include "app/files.h"
#include "core/scene/schema.h"
#include "core/simulation/world.h"

namespace carom {
namespace {

// Largest values of options: a typing mistake is reported. They bound nothing else.
constexpr std::int64_t mostSubsteps = 1'000'000;
constexpr std::int64_t mostIterations = 1'000'000;
constexpr std::int64_t mostThreads = 1024;

std::optional<int> asInt(std::optional<std::int64_t> number) {
    return number ? std::optional<int>(static_cast<int>(*number)) : std::nullopt;
}

std::string words(std::span<const std::string_view> list) {
    std::string text;
    for (const std::string_view word : list) text.append(text.empty() ? "" : ", ").append(word);
    return text;
}

} // namespace

std::vector<OptionRow> simulationOptions() {
    return {
        {"step", 0, "S", "length of a frame in seconds"},
        {"substeps", 0, "K", "equal substeps of a frame"},
        {"method", 0, "M", "method of motion: " + words(methodWords())},
        {"integrator", 0, "I", "scheme for smooth motion: " + words(integratorWords())},
        {"broadphase", 0, "B", "search for pairs: " + words(broadphaseWords())},
        {"boxes", 0, "B", "boxes that the search works on: " + words(boxesWords())},
        {"iterations", 0, "N", "iterations of the contact solver a substep"},
        {"tolerance", 0, "E", "relative contact residual to reach"},
        {"impacts", 0, "I", "how impacts at one time are treated: " + words(impactsWords())},
        {"preset", 0, "P", "sets what nothing else sets: " + words(presetWords())},
        {"threads", 0, "T", "threads to compute with; the result is the same to the bit"},
        {"duration", 0, "S", "seconds to simulate"},
    };
}

SimulationSettings simulationSettings(const Arguments& arguments) {
    SimulationSettings settings;
    settings.step = arguments.positiveNumber("step");
    settings.substeps = asInt(arguments.wholeNumber("substeps", 1, mostSubsteps));
    settings.method = arguments.word("method", methodWords());
    settings.integrator = arguments.word("integrator", integratorWords());
    settings.broadphase = arguments.word("broadphase", broadphaseWords());
    settings.boxes = arguments.word("boxes", boxesWords());
    settings.iterations = asInt(arguments.wholeNumber("iterations", 1, mostIterations));
    settings.tolerance = arguments.positiveNumber("tolerance");
    settings.impacts = arguments.word("impacts", impactsWords());
    settings.preset = arguments.word("preset", presetWords());
    settings.threads = asInt(arguments.wholeNumber("threads", 1, mostThreads));
    settings.duration = arguments.positiveNumber("duration");
    return settings;
}

Build loadScene(const std::string& path, const SimulationSettings& options) {
    Build built = build(readText(path), options);
    for (const Diagnostic& diagnostic : built.diagnostics)
        printError(formatDiagnostic(built.analysis, diagnostic, displayName(path)) + "\n");
    return built;
}

std::string describeLoss(std::string_view who, const World& world) {
    const Health& health = world.health();
    return std::string(who) + ": the " + std::string(health.quantity) + " of " +
           world.pipeline().scene().nameOf(health.body) + " (body " + std::to_string(health.body) +
           ") is not finite, or too large to follow, in frame " + std::to_string(health.frame) +
           "; the run stops there\n";
}

} // namespace carom
