// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/settings.h"

#include "core/integrators/integrator.h"
#include "core/simulation/method_choice.h"
#include "core/solvers/solver.h"

#include "core/base/catalogue.h"
#include "core/broadphase/broadphase.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace carom {
namespace {

/// One setting as it was asked for.
struct Asked {
    const Scene& scene;
    std::string_view parameter;
    bool onCommandLine = false;

    SourceRange place() const {
        if (onCommandLine || !scene.simulation.source) return {};
        const ParameterSource* given = scene.find(*scene.simulation.source, parameter);
        return given != nullptr ? given->value : scene.simulation.source->type;
    }

    void warn(std::string message, std::vector<Diagnostic>& warnings) const {
        if (onCommandLine) message += " (asked for on the command line)";
        warnings.push_back({.code = DiagnosticCode::NotSimulatedYet,
                            .range = place(),
                            .message = std::move(message),
                            .notes = {},
                            .fixIt = {}});
    }
};

// The row that was asked for, or the fallback with a warning.
template<class Row>
const Row* rowFor(const std::optional<std::string>& name, std::span<const Row> known, const Row* fallback,
                  const Asked& asked, std::vector<Diagnostic>& warnings) {
    if (!name) return fallback;
    if (const Row* row = findByName(known, *name)) return row;
    asked.warn(std::string(asked.parameter) + " `" + *name + "` is not simulated yet; `" +
                   std::string(fallback->name) + "` runs in its place",
               warnings);
    return fallback;
}

constexpr std::string_view defaultPreset = "default";
constexpr std::string_view automatic = "auto";

} // namespace

std::span<const PresetRow> presets() {
    static constexpr std::array rows = {
#define CAROM_PRESET(word, help) PresetRow{#word, help},
#include "core/scene/presets.def"
#undef CAROM_PRESET
    };
    static_assert(rows.size() == presetCount);
    return rows;
}

namespace {

// The method asked for, or what `auto` stands for.
void settleMethod(const Scene& scene, const SimulationSettings& options, const SimulationSettings& wanted,
                  RunSettings& settings, std::vector<Diagnostic>& warnings) {
    const SolverRow* fallback = &generalSolver();
    const Asked asked{scene, "method", options.method.has_value()};
    if (!wanted.method || wanted.method == automatic) {
        MethodChoice choice = chooseMethod(scene, wanted.impacts == "simultaneous");
        settings.method = choice.row;
        settings.methodReason = std::move(choice.reason);
        return;
    }
    settings.method = rowFor(wanted.method, solvers(), fallback, asked, warnings);
    const std::optional<SolverObjection> objection = objectionTo(*settings.method, scene);
    if (!objection) return;
    Diagnostic error{.code = DiagnosticCode::UnsuitableMethod,
                     .range = objection->place,
                     .message = "method `" + std::string(settings.method->name) +
                                "` cannot treat this scene: " + objection->reason.text() + "; `" +
                                std::string(fallback->name) + "` runs in its place",
                     .notes = {},
                     .fixIt = {}};
    if (!asked.onCommandLine) error.notes.push_back({asked.place(), "the method is asked for here"});
    warnings.push_back(std::move(error));
    settings.method = fallback;
}

} // namespace

RunSettings settledSettings(const Scene& scene, const SimulationSettings& options,
                            std::vector<Diagnostic>& warnings) {
    const SimulationSettings wanted = overridden(scene.simulation, options);
    const PresetRow* preset = findByName(presets(), wanted.preset.value_or(std::string(defaultPreset)));
    if (preset == nullptr) preset = findByName(presets(), defaultPreset);

    RunSettings settings;
    settings.preset = preset;
    if (wanted.step) settings.step = *wanted.step;
    settleMethod(scene, options, wanted, settings, warnings);
    const SolverRow& method = *settings.method;
    // Frames that are too crowded for an exact method are left to the general one.
    const SolverRow& stepping = method.isExact ? generalSolver() : method;
    const PresetValues& values = stepping.presets[static_cast<std::size_t>(preset - presets().data())];
    const IntegratorRow* integrator = findIntegrator(method.integrator);
    settings.integrator = rowFor(wanted.integrator, integrators(), integrator,
                                 {scene, "integrator", options.integrator.has_value()}, warnings);
    if (!method.iterates() && settings.integrator->motion.moveOnSprings == nullptr &&
        !scene.springs.empty()) {
        Asked{scene, "integrator", options.integrator.has_value()}.warn(
            "integrator `" + std::string(settings.integrator->name) + "` moves springs by method `" +
                std::string(generalSolver().name) + "` only; `" + std::string(integrator->name) +
                "` runs in its place",
            warnings);
        settings.integrator = integrator;
    }
    settings.substeps = std::max(1, wanted.substeps.value_or(values.substeps));
    if (method.isExact) settings.crowdedSubsteps = std::exchange(settings.substeps, 1);
    settings.threads = std::max(1, wanted.threads.value_or(1));
    settings.duration = wanted.duration;
    settings.boxes = wanted.boxes == "cube" ? BoxKind::Cube : BoxKind::Tight;
    settings.simultaneousImpacts = wanted.impacts == "simultaneous";
    if (stepping.iterates()) {
        settings.effort = values.effort;
        settings.reserve = values.reserve;
        settings.iterations = std::max(1, wanted.iterations.value_or(stepping.iterations));
        settings.tolerance = wanted.tolerance.value_or(values.tolerance);
    }
    const bool isChosen = !settings.methodReason.empty(); // by `auto`: it leaves frames to what iterates
    if (method.iterates() || isChosen) return settings;

    const std::string name(method.name);
    if (wanted.impacts == "simultaneous")
        Asked{scene, "impacts", options.impacts.has_value()}.warn(
            "impacts `simultaneous` is not simulated yet; method `" + name +
                "` treats impacts one after the other",
            warnings);
    if (wanted.iterations)
        Asked{scene, "iterations", options.iterations.has_value()}.warn(
            "`iterations` has no effect yet; method `" + name + "` treats every pair once a substep",
            warnings);
    if (wanted.tolerance)
        Asked{scene, "tolerance", options.tolerance.has_value()}.warn(
            "`tolerance` has no effect yet; method `" + name + "` does not iterate", warnings);
    return settings;
}

void settleBroadphase(const Scene& scene, const SimulationSettings& options, const Bodies& bodies,
                      RunSettings& settings, std::vector<Diagnostic>& warnings) {
    std::vector<Aabb> boxes;
    std::vector<std::uint8_t> mobile;
    boxes.reserve(bodies.bounded.size());
    mobile.reserve(bodies.bounded.size());
    for (const BodyIndex i : bodies.bounded) {
        boxes.push_back(bodies.boxAt(i, scene.bodies[i].pose));
        mobile.push_back(bodies.mobile[i]);
    }
    const BroadphaseChoice choice = chooseBroadphase({boxes, bodies.bounded, mobile});

    std::optional<std::string> name = options.broadphase ? options.broadphase : scene.simulation.broadphase;
    if (name == automatic) name.reset();
    settings.broadphase = rowFor(name, broadphases(), choice.row,
                                 {scene, "broadphase", options.broadphase.has_value()}, warnings);
    if (!name || findBroadphase(*name) == nullptr) settings.broadphaseReason = choice.reason;
}

std::int64_t framesUntil(double time, double step) {
    constexpr double mostFrames = 1e15; // where frames still count exactly in a double
    return static_cast<std::int64_t>(std::clamp(std::ceil(time / step * (1 - 1e-12)), 0.0, mostFrames));
}

std::int64_t framesOf(const RunSettings& settings) {
    // Frames: ten seconds at the default step, by convention. At twice or half, runs without a duration last
    // twice or half as long.
    constexpr std::int64_t withoutDuration = 600;
    if (!settings.duration) return withoutDuration;
    return std::max<std::int64_t>(1, framesUntil(*settings.duration, settings.step));
}

} // namespace carom
