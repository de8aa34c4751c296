// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/accuracy.h"

#include "core/simulation/world.h"
#include "core/study/accuracy_run.h"
#include "core/study/convergence.h"
#include "core/study/engines.h"
#include "core/study/measures.h"

#include "core/effects/effect.h"
#include "core/math/statistics.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace carom {
namespace {

/// The parts of the budget at which stages end: the reference solution, first runs of all settings, copies of
/// crowds, everything. Time that a stage does not use is left to the next ones. At half of the first,
/// reference solutions are less exact; at twice, fewer settings are measured.
constexpr double referenceBy = 0.4, pointsBy = 0.8, crowdsBy = 0.9, allBy = 0.98;
/// The part of the budget that one run with the scene's own setting may take; where it would take more, less
/// of the scene is studied. At twice it half as many settings of an expensive scene are measured, at half of
/// it half the scene.
constexpr double ownRun = 0.05;
/// The part of the remaining time that a run of unknown cost may take: four that fail leave a third of it, at
/// twice a sixteenth; at half, some settings that would have fitted are omitted.
constexpr double unknownRun = 0.25;
/// Every setting has so many times. Those that nothing beats, and the scene's own, have more until the middle
/// half of them is as narrow as `agreeingTimes` relative to their median.
constexpr std::size_t leastTimes = 3;

bool agree(const std::vector<double>& times) {
    const Quartiles middle = quartilesOf(times);
    return middle.upper - middle.lower <= agreeingTimes * middle.median;
}

/// Measures the points of a study from coarse to fine, then repeats their runs, until the budget is spent.
class Runner {
  public:
    Runner(const Scene& scene, const AccuracyPlan& plan, const AccuracyListener& listener)
        : m_scene(scene), m_listener(listener), m_begin(listener.clock.wall()) {
        m_study.plan = plan;
        std::vector<Diagnostic> ignored;
        m_study.settings = settledSettings(scene, {}, ignored);
        m_study.conservative = !firstDamping(scene);
        m_study.duration = plan.duration;
        m_study.measure = plan.measure != nullptr ? plan.measure : &measures().front();
        addPoints();
    }

    AccuracyStudy run(const KnownPoints& known) {
        for (AccuracyPoint& point : m_study.points)
            for (const AccuracyPoint& old : known.points)
                if (old.setting == point.setting && old.status != PointStatus::Timed) takeOver(old, point);
        if (known.duration > 0) m_study.duration = known.duration;
        m_study.complete = (known.duration > 0 || fitDuration()) && findReference() && measureAll() &&
                           watchCrowds() && repeatTimes();
        std::erase_if(m_study.points,
                      [](const AccuracyPoint& point) { return point.status == PointStatus::Waiting; });
        chooseAgain();
        m_study.seconds = spent();
        return std::move(m_study);
    }

  private:
    void addPoints() {
        const AccuracySetting standard = ownSettingOf(m_scene);
        m_study.points.push_back({.setting = standard, .isDefault = true});
        for (const AccuracySetting& setting : m_study.plan.settings)
            if (!(setting == standard)) m_study.points.push_back({.setting = setting});
    }

    static void takeOver(const AccuracyPoint& old, AccuracyPoint& point) {
        const bool isDefault = point.isDefault;
        point = old;
        point.isDefault = isDefault;
    }

    double spent() const { return 1e-3 * (m_listener.clock.wall() - m_begin); }     ///< [s]
    double left(double part) const { return part * m_study.plan.budget - spent(); } ///< [s]
    bool goOn() const { return m_listener.goOn(spent()); }

    void chooseAgain() {
        if (m_study.plan.measure == nullptr && m_study.reference) m_study.measure = &chooseMeasure(m_study);
    }
    void changed() {
        chooseAgain();
        m_study.seconds = spent();
        if (m_listener.changed) m_listener.changed(m_study);
    }

    AccuracyRun theRun(double limit) {
        return {m_scene, m_study, m_trajectory, m_listener.clock, limit, [this] { return goOn(); }};
    }

    bool fitDuration();
    bool findReference();
    bool measureAll();
    bool measureOne(AccuracyPoint& point, double limit);
    std::optional<double> predicted(const AccuracySetting& setting) const;
    bool watchCrowds();
    bool needsTime(const AccuracyPoint& point) const;
    bool repeatTimes();

    const Scene& m_scene;
    const AccuracyListener& m_listener;
    double m_begin; // [ms]
    AccuracyStudy m_study;
    Trajectory m_trajectory; // of the reference solution
    /// By family, the finest setting that was measured in this study, and what it took [s].
    struct Taken {
        int substeps = 1;
        double seconds = 0;
    };
    std::map<std::string, Taken> m_taken;
};

// Runs the scene's own setting, as long as it may take, to see how much of the scene can be studied. What can
// be said of it without a reference solution is said then.
bool Runner::fitDuration() {
    AccuracyPoint& point = m_study.points.front();
    const double step = m_study.settings.step;
    SimulationSettings options = point.setting.options();
    options.step = step;
    World world(std::make_shared<const Pipeline>(m_scene, options));
    RunCourse course(world, sizeOf(world.pipeline().bodies(), {step, {world.state().pose}}));
    const auto frames = static_cast<std::int64_t>(std::ceil(m_study.duration / step * (1 - 1e-12)));
    const double limit = ownRun * m_study.plan.budget, begin = spent();
    double time = 0; // [ms] behind the first frame
    std::int64_t frame = 0;
    while (frame < frames && (frame < 2 || spent() - begin < limit)) {
        const double before = m_listener.clock.processor();
        world.step();
        if (frame > 0) time += m_listener.clock.processor() - before;
        if (!goOn()) return false;
        if (!world.health().finite) return true;
        course.add(world);
        ++frame;
    }
    if (frame < frames) m_study.duration = static_cast<double>(frame) * step;
    if (frame < 2) return true;
    point.status = PointStatus::Timed;
    point.times = {time / (static_cast<double>(frame - 1) * step)};
    addInvariants(course, world, point);
    changed();
    return true;
}

bool Runner::findReference() {
    int finest = 1;
    for (const AccuracyPoint& point : m_study.points) finest = std::max(finest, point.setting.substeps);
    m_study.reference = findReferenceSolution({.scene = m_scene,
                                               .settings = m_study.settings,
                                               .duration = m_study.duration,
                                               .finest = finest,
                                               .seconds = left(referenceBy),
                                               .agreement = m_study.plan.target / 100,
                                               .copies = m_study.plan.copies,
                                               .clock = m_listener.clock,
                                               .goOn = [this] { return goOn(); }});
    if (!m_study.reference) return false;
    m_trajectory = std::exchange(m_study.reference->trajectory, {});
    m_study.duration = std::min(m_study.duration, m_study.reference->duration);
    return true;
}

// Nothing where nothing of the family has been measured yet.
std::optional<double> Runner::predicted(const AccuracySetting& setting) const {
    const auto taken = m_taken.find(setting.family());
    if (taken == m_taken.end()) return std::nullopt;
    return taken->second.seconds * setting.substeps / taken->second.substeps;
}

bool Runner::measureAll() {
    std::set<std::string> closed; // families of which nothing finer fits
    for (AccuracyPoint& point : m_study.points) {
        if (point.status != PointStatus::Waiting && point.status != PointStatus::Timed) continue;
        const std::string family = point.setting.family();
        const std::optional<double> expected = predicted(point.setting);
        const double rest = left(pointsBy);
        const bool fits = !closed.contains(family) && expected.value_or(0) <= rest;
        if (!point.isDefault && !fits) {
            closed.insert(family);
            m_study.leftOut.push_back(point.setting);
            continue;
        }
        const double begin = spent();
        AccuracyPoint measured{.setting = point.setting, .isDefault = point.isDefault};
        if (!measureOne(measured, expected || point.isDefault ? std::max(rest, unknownRun * left(allBy))
                                                              : unknownRun * rest))
            return false;
        point = std::move(measured);
        m_taken[family] = {point.setting.substeps, spent() - begin};
        if (point.status == PointStatus::TimedOut) closed.insert(family);
        changed();
    }
    return true;
}

bool Runner::measureOne(AccuracyPoint& point, double limit) {
    if (!point.setting.engine.empty()) return measureEngine(theRun(limit), point, m_study.engineNotes);
    if (!measure(theRun(limit), point)) return false;
    return !point.finished() || !point.times.empty() || timeOnce(theRun(limit), point);
}

bool Runner::watchCrowds() {
    if (!m_study.reference->crowd) return true;
    std::map<const AccuracyPoint*, std::vector<CrowdDeviation>> deviations;
    for (int copy = 0; copy < m_study.plan.copies; ++copy)
        for (AccuracyPoint& point : m_study.points) {
            std::vector<CrowdDeviation>& own = deviations[&point];
            const bool isKnown = point.crowd && own.empty();
            if (!point.finished() || isKnown || std::ssize(own) < copy) continue;
            if (!point.setting.engine.empty()) continue;
            if (1e-3 * point.cost() * m_study.duration > left(crowdsBy)) continue;
            const std::optional<CrowdDeviation> deviation = measureCrowd(theRun(left(crowdsBy)), point, copy);
            if (!goOn()) return false;
            if (!deviation) continue; // a copy that is lost says nothing
            own.push_back(*deviation);
            point.crowd = figuresOf(own);
            changed();
        }
    return true;
}

bool Runner::needsTime(const AccuracyPoint& point) const {
    if (!point.setting.engine.empty()) return false; // its program has measured it
    if (point.times.size() < leastTimes) return true;
    if (agree(point.times)) return false;
    const std::vector<const AccuracyPoint*> front = paretoFront(m_study);
    return point.isDefault || std::ranges::count(front, &point) > 0;
}

bool Runner::repeatTimes() {
    for (int run = 1; run < m_study.plan.runs; ++run)
        for (AccuracyPoint& point : m_study.points) {
            if (!point.finished() || std::ssize(point.times) > run || !needsTime(point)) continue;
            const double rest = left(allBy);
            if (1e-3 * point.cost() * m_study.duration > rest) continue;
            if (!timeOnce(theRun(rest), point)) return false;
            changed();
        }
    return true;
}

} // namespace

AccuracyStudy runAccuracy(const Scene& scene, const AccuracyPlan& plan, const AccuracyListener& listener,
                          const KnownPoints& known) {
    return Runner(scene, plan, listener).run(known);
}

} // namespace carom
