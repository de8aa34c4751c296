// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/accuracy.h"

#include "core/base/catalogue.h"
#include "core/base/figures.h"
#include "core/integrators/integrator.h"
#include "core/math/statistics.h"
#include "core/simulation/method_choice.h"
#include "core/simulation/pipeline.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

/// Whether what accelerates bodies changes along their way.
bool forcesVary(const Bodies& bodies) { return !bodies.springs.empty() || !bodies.forces.empty(); }

/// Whether integrators differ on this scene: something accelerates bodies, or turns them unevenly.
bool integratorsMatter(const Pipeline& pipeline) {
    const Bodies& bodies = pipeline.bodies();
    return bodies.gravity != Vec3::Zero() || forcesVary(bodies) || anyPrecesses(bodies);
}

/// Schemes that are exact in free fall are one and the same where nothing bends the fall; one will do.
bool duplicates(const IntegratorRow& integrator, const SolverRow& method, const Pipeline& pipeline) {
    const Bodies& bodies = pipeline.bodies();
    const bool bent = forcesVary(bodies) || (method.abilities.gyroscopicTerm && anyPrecesses(bodies));
    if (bent || !integrator.motion.isExactInFreeFall) return false;
    const auto isExact = [](const IntegratorRow& row) { return row.motion.isExactInFreeFall; };
    const IntegratorRow* own = findIntegrator(method.integrator);
    const std::span<const IntegratorRow> rows = integrators();
    return &integrator != (isExact(*own) ? own : &*std::find_if(rows.begin(), rows.end(), isExact));
}

/// The families of a method that iterates: one for each preset that something can tell from the others.
std::vector<const PresetRow*> presetsFor(const SolverRow& method, bool isStandard, bool collides) {
    const PresetRow* standard = findByName(presets(), "default");
    if (!method.iterates()) return {nullptr};
    if (!isStandard || !collides) return {standard};
    std::vector<const PresetRow*> rows;
    for (const PresetRow& row : presets()) rows.push_back(&row);
    return rows;
}

const PresetValues& valuesOf(const SolverRow& method, const PresetRow& preset) {
    return method.presets[static_cast<std::size_t>(&preset - presets().data())];
}

/// What a preset sets, all of it.
bool isWholePreset(const AccuracySetting& setting) {
    return setting.preset != nullptr && setting.integrator->name == setting.method->integrator &&
           setting.substeps == valuesOf(*setting.method, *setting.preset).substeps;
}

void addFamilies(const SolverRow& method, const Pipeline& pipeline, AccuracyPlan& plan) {
    const bool collides = anyCanMeet(pipeline.bodies());
    for (const IntegratorRow& integrator : integrators()) {
        const bool standard = integrator.name == method.integrator;
        if (!standard && !integratorsMatter(pipeline)) continue;
        if (duplicates(integrator, method, pipeline)) continue;
        if (!method.iterates() && integrator.motion.moveOnSprings == nullptr) continue;
        for (const PresetRow* preset : presetsFor(method, standard, collides))
            for (int substeps = 1; substeps <= 64; substeps *= 2)
                plan.settings.push_back({&method, &integrator, substeps,
                                         preset != nullptr ? valuesOf(method, *preset).tolerance : 0,
                                         preset});
    }
}

} // namespace

std::string AccuracySetting::family() const {
    if (!engine.empty()) return engine + (isTuned ? ", tuned" : ", its own rules");
    std::string text(method->name);
    if (integrator != nullptr) text.append(", ").append(integrator->name);
    if (preset != nullptr) text.append(", preset ").append(preset->name);
    if (preset != nullptr && tolerance != valuesOf(*method, *preset).tolerance)
        text += ", tolerance " + figure(tolerance);
    return text;
}

std::string AccuracySetting::name() const {
    return integrator == nullptr && engine.empty()
               ? family()
               : family() + ", " + counted(static_cast<std::size_t>(substeps), "substep", "substeps");
}

SimulationSettings AccuracySetting::options() const {
    SimulationSettings options;
    options.method = method->name;
    if (integrator != nullptr) options.integrator = integrator->name;
    options.substeps = substeps;
    if (preset != nullptr) options.preset = preset->name;
    if (tolerance > 0) options.tolerance = tolerance;
    options.threads = 1;
    return options;
}

std::string_view nameOf(PointStatus status) {
    switch (status) {
    case PointStatus::Waiting:
        return "waiting";
    case PointStatus::Timed:
        return "timed";
    case PointStatus::Measured:
        return "measured";
    case PointStatus::Broken:
        return "broken";
    case PointStatus::Failed:
        return "failed";
    case PointStatus::TimedOut:
        return "timed out";
    }
    return {};
}

double AccuracyPoint::cost() const { return times.empty() ? 0 : summarise(times).median; }
double AccuracyPoint::leastCost() const {
    return times.empty() ? 0 : *std::min_element(times.begin(), times.end());
}
double AccuracyPoint::mostCost() const {
    return times.empty() ? 0 : *std::max_element(times.begin(), times.end());
}

AccuracySetting ownSettingOf(const Scene& scene) {
    std::vector<Diagnostic> ignored;
    const RunSettings own = settledSettings(scene, {}, ignored);
    if (own.method->isExact) return {own.method, nullptr, 1, 0};
    return {own.method, own.integrator, own.substeps, own.tolerance,
            own.method->iterates() ? own.preset : nullptr};
}

AccuracyPlan planFor(const Scene& scene) {
    AccuracyPlan plan;
    if (scene.simulation.duration) plan.duration = std::min(*scene.simulation.duration, 10.0);
    SimulationSettings general;
    general.method = std::string(generalSolver().name);
    const Pipeline pipeline(scene, general);
    for (const SolverRow& method : solvers())
        if (method.isExact && !objectionTo(method, scene)) plan.settings.push_back({&method, nullptr, 1, 0});
    for (const SolverRow& method : solvers())
        if (!method.isExact) addFamilies(method, pipeline, plan);
    sortForStudy(plan);
    return plan;
}

void sortForStudy(AccuracyPlan& plan) {
    const auto rank = [](const AccuracySetting& setting) {
        const bool isExact = setting.integrator == nullptr && setting.engine.empty();
        return isExact || isWholePreset(setting) ? 0 : setting.substeps;
    };
    std::ranges::stable_sort(plan.settings, {}, rank);
}

void vary(AccuracyPlan& plan, const std::vector<double>& substeps, const std::vector<double>& tolerances) {
    std::vector<AccuracySetting> varied;
    const auto add = [&](const AccuracySetting& setting) {
        if (std::find(varied.begin(), varied.end(), setting) == varied.end()) varied.push_back(setting);
    };
    for (const AccuracySetting& setting : plan.settings) {
        std::vector<double> steps = {double(setting.substeps)}, limits = {setting.tolerance};
        if (!substeps.empty() && setting.integrator != nullptr) steps = substeps;
        if (!tolerances.empty() && setting.tolerance > 0) limits = tolerances;
        for (const double tolerance : limits)
            for (const double count : steps)
                add({setting.method, setting.integrator, static_cast<int>(count), tolerance, setting.preset});
    }
    plan.settings = std::move(varied);
    sortForStudy(plan);
}

} // namespace carom
