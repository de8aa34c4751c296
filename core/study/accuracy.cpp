// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/accuracy.h"

#include "core/study/accuracy_run.h"

#include "core/base/figures.h"
#include "core/integrators/integrator.h"
#include "core/math/statistics.h"
#include "core/simulation/method_choice.h"
#include "core/simulation/pipeline.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom {
namespace {

/// Whether integrators differ on this scene: something accelerates bodies, or turns them unevenly.
bool integratorsMatter(const Pipeline& pipeline) {
    return pipeline.simulates("gravity") || pipeline.simulates("spring") ||
           pipeline.simulates("gyroscopic_term") || !pipeline.bodies().forces.empty();
}

/// Schemes that are exact in free fall are one and the same where nothing bends the fall; one will do.
bool duplicates(const IntegratorRow& integrator, const SolverRow& method, const Pipeline& pipeline) {
    const bool bent = pipeline.simulates("spring") || !pipeline.bodies().forces.empty() ||
                      (method.abilities.gyroscopicTerm && pipeline.simulates("gyroscopic_term"));
    if (bent || !integrator.motion.isExactInFreeFall) return false;
    const auto isExact = [](const IntegratorRow& row) { return row.motion.isExactInFreeFall; };
    const IntegratorRow* own = findIntegrator(method.integrator);
    const std::span<const IntegratorRow> rows = integrators();
    return &integrator != (isExact(*own) ? own : &*std::find_if(rows.begin(), rows.end(), isExact));
}

bool losesNothing(const Scene& scene) {
    for (const Body& body : scene.bodies)
        if (body.elastic < 1 || body.friction > 0 || body.rolling > 0) return false;
    return std::all_of(scene.springs.begin(), scene.springs.end(),
                       [](const Spring& spring) { return spring.damping == 0; }) &&
           Pipeline(scene).bodies().forces.empty();
}

/// Measures the points of a study, one after the other, then times them in turns.
class Runner {
  public:
    Runner(const Scene& scene, const AccuracyPlan& plan, const AccuracyListener& listener)
        : m_scene(scene), m_listener(listener) {
        m_study.plan = plan;
        std::vector<Diagnostic> ignored;
        m_study.settings = settledSettings(scene, {}, ignored);
        m_study.conservative = losesNothing(scene);
        addPoints();
    }

    AccuracyStudy run(const std::vector<AccuracyPoint>& known) {
        for (AccuracyPoint& point : m_study.points)
            for (const AccuracyPoint& old : known)
                if (old.setting == point.setting) takeOver(old, point);
        m_study.complete = findReference() && measureAll() && timeAll();
        std::erase_if(m_study.points,
                      [](const AccuracyPoint& point) { return point.status == PointStatus::Waiting; });
        return std::move(m_study);
    }

  private:
    void addPoints() {
        const RunSettings& own = m_study.settings;
        AccuracySetting standard{own.method, own.integrator, own.substeps, own.tolerance};
        if (own.method->isExact) standard = {own.method, nullptr, 1, 0};
        m_study.points.push_back({.setting = standard, .isDefault = true});
        for (const AccuracySetting& setting : m_study.plan.settings)
            if (!(setting == standard)) m_study.points.push_back({.setting = setting});
        for (const AccuracyPoint& point : m_study.points)
            m_total += (1.0 + m_study.plan.runs) * point.setting.substeps;
        m_total *= 1.25; // a fifth of the whole for the reference solution, as far as one can know
        m_done = 0;
    }

    static void takeOver(const AccuracyPoint& old, AccuracyPoint& point) {
        const bool isDefault = point.isDefault;
        point = old;
        point.isDefault = isDefault;
    }

    bool goOn() { return m_listener.goOn(std::min(1.0, m_done / m_total)); }
    void changed() {
        if (m_listener.changed) m_listener.changed(m_study);
    }

    bool findReference() {
        int finest = 1;
        for (const AccuracyPoint& point : m_study.points) finest = std::max(finest, point.setting.substeps);
        m_study.reference = findReferenceSolution({.scene = m_scene,
                                                   .settings = m_study.settings,
                                                   .duration = m_study.plan.duration,
                                                   .finest = finest,
                                                   .timeLimit = 4 * m_study.plan.timeLimit,
                                                   .copies = m_study.plan.copies,
                                                   .goOn = [this] { return goOn(); }});
        if (m_study.reference && m_study.reference->crowd)
            for (const AccuracyPoint& point : m_study.points)
                m_total += 1.25 * m_study.plan.copies * point.setting.substeps;
        m_done = 0.2 * m_total;
        if (m_study.reference) m_trajectory = std::exchange(m_study.reference->trajectory, {});
        return m_study.reference.has_value();
    }

    bool measureAll() {
        for (AccuracyPoint& point : m_study.points) {
            if (point.status == PointStatus::Waiting && hopeless(point.setting)) {
                point.status = PointStatus::TimedOut;
                point.reason = "coarser settings of its family timed out";
            }
            if (point.status == PointStatus::Waiting && !measure(theRun(), point)) return false;
            m_done += point.setting.substeps;
            if (m_study.reference->crowd) {
                if (point.finished() && !point.crowd && !measureCrowd(theRun(), point)) return false;
                m_done += m_study.plan.copies * point.setting.substeps;
            }
            changed();
        }
        return true;
    }

    bool hopeless(const AccuracySetting& setting) const {
        return std::any_of(m_study.points.begin(), m_study.points.end(), [&](const AccuracyPoint& point) {
            return point.status == PointStatus::TimedOut && point.setting.family() == setting.family() &&
                   point.setting.substeps < setting.substeps;
        });
    }

    AccuracyRun theRun() {
        return {m_scene, m_study, m_trajectory, [this] { return goOn(); }};
    }
    bool timeAll();

    const Scene& m_scene;
    const AccuracyListener& m_listener;
    AccuracyStudy m_study;
    Trajectory m_trajectory;        // of the reference solution
    double m_done = 0, m_total = 0; // substeps a frame, over all runs
};

bool Runner::timeAll() {
    for (int run = 0; run < m_study.plan.runs; ++run) {
        for (AccuracyPoint& point : m_study.points) {
            m_done += point.setting.substeps;
            if (!point.finished() || std::ssize(point.times) > run) continue;
            if (!timeOnce(theRun(), point)) return false;
            changed();
        }
    }
    return true;
}

} // namespace

std::string AccuracySetting::family() const {
    std::string text(method->name);
    if (integrator != nullptr) text.append(", ").append(integrator->name);
    if (tolerance > 0) text += ", tolerance " + figure(tolerance);
    return text;
}

std::string AccuracySetting::name() const {
    return integrator == nullptr
               ? family()
               : family() + ", " + counted(static_cast<std::size_t>(substeps), "substep", "substeps");
}

SimulationSettings AccuracySetting::options() const {
    SimulationSettings options;
    options.method = method->name;
    if (integrator != nullptr) options.integrator = integrator->name;
    options.substeps = substeps;
    if (tolerance > 0) options.tolerance = tolerance;
    options.threads = 1;
    return options;
}

std::string_view nameOf(PointStatus status) {
    switch (status) {
    case PointStatus::Waiting:
        return "waiting";
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

AccuracyPlan planFor(const Scene& scene) {
    AccuracyPlan plan;
    if (scene.simulation.duration) plan.duration = std::min(*scene.simulation.duration, 10.0);
    SimulationSettings general;
    general.method = std::string(generalSolver().name);
    const Pipeline pipeline(scene, general);
    const bool collides = pipeline.bodies().count() > 1;
    for (const SolverRow& method : solvers()) {
        if (method.isExact) continue;
        std::vector<double> tolerances = {0};
        if (method.iterates())
            tolerances = collides ? std::vector<double>{1e-6, 1e-10} : std::vector<double>{1e-6};
        for (const IntegratorRow& integrator : integrators()) {
            const bool standard = integrator.name == method.integrator;
            if (!standard && !integratorsMatter(pipeline)) continue;
            if (duplicates(integrator, method, pipeline)) continue;
            if (!method.iterates() && integrator.motion.moveOnSprings == nullptr) continue;
            for (const double tolerance : tolerances) {
                if (!standard && tolerance == tolerances.back() && tolerances.size() > 1) continue;
                for (int substeps = 1; substeps <= 64; substeps *= 2)
                    plan.settings.push_back({&method, &integrator, substeps, tolerance});
            }
        }
    }
    for (const SolverRow& method : solvers())
        if (method.isExact && !objectionTo(method, scene)) plan.settings.push_back({&method, nullptr, 1, 0});
    return plan;
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
                add({setting.method, setting.integrator, static_cast<int>(count), tolerance});
    }
    plan.settings = std::move(varied);
}

AccuracyStudy runAccuracy(const Scene& scene, const AccuracyPlan& plan, const AccuracyListener& listener,
                          const std::vector<AccuracyPoint>& known) {
    return Runner(scene, plan, listener).run(known);
}

} // namespace carom
