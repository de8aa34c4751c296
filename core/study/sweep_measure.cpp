// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/sweep_measure.h"

#include "core/base/text.h"
#include "core/narrowphase/time_of_impact.h"
#include "core/scene/schema.h"
#include "core/simulation/frame_impulses.h"
#include "core/simulation/world.h"
#include "core/solvers/solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
/// Times nearer to each other than this share of a frame are equal. The rounding of a frame's number times
/// its length reaches 1e-9 of it after four million frames: at half, after two; at twice, after eight.
constexpr double sameMoment = 1e-9;
constexpr std::string_view impact = "impact", impacts = "impacts";

double extreme(const std::vector<double>& figures, bool largest) {
    double result = nothing;
    for (const double figure : figures)
        if (std::isnan(result) || (largest ? figure > result : figure < result)) result = figure;
    return result;
}

double meanOf(const std::vector<double>& figures) {
    double sum = 0;
    for (const double figure : figures) sum += figure;
    return figures.empty() ? nothing : sum / static_cast<double>(figures.size());
}

} // namespace

std::vector<BodyIndex> bodiesNamed(const Scene& scene, const std::string& owner) {
    if (const BodyIndex body = scene.labelled(owner); body != noBody) return {body};
    if (owner.starts_with("body ")) {
        const std::optional<unsigned long long> number = unsignedNumberIn(owner.substr(5));
        if (!number || *number >= scene.bodies.size()) return {};
        return {static_cast<BodyIndex>(*number)};
    }
    if (scene.generated && scene.generated->bodies && scene.generated->bodies.name == owner)
        return *scene.generated->bodies.bodies;
    std::vector<BodyIndex> members;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        if (!owner.empty() && familyOf(scene.bodies[i].label) == owner)
            members.push_back(static_cast<BodyIndex>(i));
    return members;
}

std::optional<std::string> objectionToMeasure(const SweepMeasure& measure, const Pipeline& pipeline) {
    const Scene& scene = pipeline.scene();
    const bool ofTwo = !measure.to.empty();
    for (const std::string* owner : {&measure.of, &measure.to}) {
        if (owner->empty()) continue;
        const std::size_t count = bodiesNamed(scene, *owner).size();
        if (count == 0) return "`" + measure.text + "`: the scene has no body `" + *owner + "`";
        if (count > 1 && (ofTwo || measure.quantity == impact))
            return "`" + measure.text + "`: `" + *owner + "` are " + std::to_string(count) +
                   " bodies, and it must be one";
    }
    if (measure.quantity == impacts && !ImpactWatch::sees(pipeline.bodies()))
        return "`" + measure.text + "`: impacts are not seen where there are springs";
    return std::nullopt;
}

MeasureWatch::MeasureWatch(std::span<const SweepMeasure> measures, std::shared_ptr<const Pipeline> pipeline)
    : m_pipeline(std::move(pipeline)) {
    const Scene& scene = m_pipeline->scene();
    for (const SweepMeasure& measure : measures) {
        Followed followed;
        followed.measure = &measure;
        followed.bodies = bodiesNamed(scene, measure.of);
        const bool special =
            measure.quantity == impact || measure.quantity == impacts || isOfTwoBodies(measure.quantity);
        if (!special) {
            const bool ofWhole = measure.of.empty() && quantityNamed(measure.quantity, false) != nullptr;
            followed.row = quantityNamed(measure.quantity, !ofWhole);
            if (ofWhole) followed.bodies = {noBody};
        }
        if (measure.of.empty() && measure.quantity == impacts) followed.bodies = {noBody};
        if (measure.of.empty() && followed.bodies.empty())
            followed.bodies = m_pipeline->bodies().mobileBodies;
        if (!measure.to.empty()) followed.other = bodiesNamed(scene, measure.to).front();
        if (measure.quantity == impact)
            followed.firstImpact =
                BreakWatch({{.kind = BreakKind::Contact, .a = followed.bodies.front(), .b = followed.other}});
        m_followed.push_back(std::move(followed));
    }
}

bool MeasureWatch::needsLedger() const {
    return std::ranges::any_of(m_followed, [](const Followed& followed) {
        return followed.row != nullptr && followed.row->audited;
    });
}

void MeasureWatch::begin(const World& world) {
    m_impacts.reset();
    m_allImpacts = 0;
    for (Followed& followed : m_followed) {
        followed.sums.assign(followed.bodies.size(), 0);
        followed.before.clear();
        followed.figure = nothing;
        followed.frames = 0;
        followed.firstImpact.begin(world);
        if (followed.measure->quantity == impacts && !m_impacts)
            m_impacts.emplace(m_pipeline->bodies(), m_pipeline->gravity(), m_pipeline->settings().step,
                              world.state());
    }
    m_before = {};
    const Moment start = momentOf(*m_pipeline, world.state(), world.statistics());
    for (Followed& followed : m_followed) {
        // Of forces nothing is known before the first frame, and a mean is of what follows it.
        const bool isForce = followed.row != nullptr && followed.row->word.starts_with("contact_force");
        if (!isForce && followed.measure->kind != MeasureKind::Mean) take(followed, world, start);
    }
    m_before.take(world);
}

void MeasureWatch::look(const World& world) {
    if (!world.health().finite) return;
    const Moment moment = m_before.momentOf(world);
    if (m_impacts) {
        const auto hit = static_cast<double>(m_impacts->look(world.state()));
        // Event-driven methods count impacts themselves; for others they are found from the states at the
        // ends of frames.
        const bool exact = m_pipeline->settings().method->isExact;
        m_allImpacts += exact ? static_cast<double>(world.statistics().contacts) : hit;
    }
    for (Followed& followed : m_followed) take(followed, world, moment);
    m_before.take(world);
}

/// One more frame, which `moment` is the end of.
void MeasureWatch::take(Followed& followed, const World& world, const Moment& moment) {
    const SweepMeasure& measure = *followed.measure;
    const double time = world.state().time;
    if (measure.quantity == impact) {
        if (std::isnan(followed.figure) && world.state().frame > 0 && followed.firstImpact.check(world))
            followed.figure = momentOfImpact(followed, world);
        return;
    }
    const double near = sameMoment * m_pipeline->settings().step;
    if (measure.kind == MeasureKind::At && std::isnan(followed.figure)) {
        const bool isBehind = world.state().frame > 0 && measure.at > m_before.time + near;
        if (std::abs(measure.at - time) <= near) {
            followed.figure = meanOf(measured(followed, moment, 1, time));
        } else if (isBehind && measure.at < time) {
            const StateBetween between(m_before, world, measure.at);
            followed.figure =
                meanOf(measured(followed, between.momentOf(world, m_before), between.part, measure.at));
        }
    }
    if (measure.kind != MeasureKind::At) {
        const std::vector<double> now = measured(followed, moment, 1, time);
        switch (measure.kind) {
        case MeasureKind::Final:
            followed.figure = meanOf(now);
            break;
        case MeasureKind::Max:
        case MeasureKind::Min:
            followed.figure = extreme({followed.figure, extreme(now, measure.kind == MeasureKind::Max)},
                                      measure.kind == MeasureKind::Max);
            break;
        case MeasureKind::Mean:
            followed.figure = (followed.frames > 0 ? followed.figure : 0) + meanOf(now);
            ++followed.frames;
            break;
        case MeasureKind::First:
            takeFirst(followed, world, now);
            break;
        case MeasureKind::At:
            break;
        }
    }
    if (followed.row == nullptr || !followed.row->audited || world.state().frame == 0) return;
    for (std::size_t k = 0; k < followed.bodies.size(); ++k)
        followed.sums[k] += followed.row->measure(moment, followed.bodies[k]);
}

double MeasureWatch::momentOfImpact(const Followed& followed, const World& world) const {
    const Bodies& bodies = m_pipeline->bodies();
    const auto moving = [&](BodyIndex i) {
        MovingShape shape{.start = {&bodies.shape[i], &m_before.pose[i]}};
        if (bodies.mobile[i] == 0) return shape;
        shape.velocity = m_before.velocity[i];
        shape.angularVelocity = m_before.angularVelocity[i];
        shape.acceleration = m_pipeline->gravity();
        return shape;
    };
    const BodyIndex body = followed.bodies.front();
    const double step = m_pipeline->settings().step;
    double first = step;
    for (BodyIndex other = 0; other < bodies.count(); ++other) {
        if (other == body || (followed.other != noBody && other != followed.other)) continue;
        const std::optional<Impact> met = timeOfImpact(moving(body), moving(other), first);
        if (met && met->time > 0) first = met->time; // what it rests on it does not meet
    }
    if (first < step) return m_before.time + first;
    const FrameImpulses frame(*m_pipeline, {m_before.pose, m_before.velocity}, world.state());
    return m_before.time + frame.timeStruck(body, followed.other);
}

void MeasureWatch::takeFirst(Followed& followed, const World& world, const std::vector<double>& now) {
    const SweepMeasure& measure = *followed.measure;
    const auto isBeyond = [&](double figure) {
        return measure.isAbove ? figure > measure.limit : figure < measure.limit;
    };
    const double time = world.state().time;
    for (std::size_t k = 0; k < now.size() && followed.frames == 0; ++k) {
        if (!isBeyond(now[k])) continue;
        double moment = time;
        if (!followed.before.empty() && now[k] != followed.before[k])
            moment -= (time - m_before.time) * (now[k] - measure.limit) / (now[k] - followed.before[k]);
        if (std::isnan(followed.figure) || moment < followed.figure) followed.figure = moment;
    }
    if (!std::isnan(followed.figure)) followed.frames = 1; // it has happened
    followed.before = now;
}

/// One figure a body; `part` of the frame has passed at `time` [s].
std::vector<double> MeasureWatch::measured(const Followed& followed, const Moment& moment, double part,
                                           double time) const {
    std::vector<double> figures;
    const SweepMeasure& measure = *followed.measure;
    if (isOfTwoBodies(measure.quantity)) {
        const std::vector<Shape>& shape = m_pipeline->bodies().shape;
        const BodyIndex a = followed.bodies.front(), b = followed.other;
        return {proximityOf({&shape[a], &moment.pose[a]}, {&shape[b], &moment.pose[b]}).distance};
    }
    for (std::size_t k = 0; k < followed.bodies.size(); ++k) {
        if (followed.row == nullptr) {
            figures.push_back(impactsOf(followed.bodies[k], time));
            continue;
        }
        const double figure = followed.row->measure(moment, followed.bodies[k]);
        figures.push_back(followed.row->audited ? followed.sums[k] + part * figure : figure);
    }
    return figures;
}

double MeasureWatch::impactsOf(BodyIndex body, double time) const {
    if (!m_impacts) return 0;
    if (body == noBody) return m_allImpacts;
    return static_cast<double>(std::ranges::count_if(
        m_impacts->record()[body], [time](const SeenImpact& seen) { return seen.time <= time; }));
}

std::vector<double> MeasureWatch::figures() const {
    std::vector<double> figures;
    for (const Followed& followed : m_followed) {
        const bool isMean = followed.measure->kind == MeasureKind::Mean;
        figures.push_back(isMean && followed.frames > 0
                              ? followed.figure / static_cast<double>(followed.frames)
                              : followed.figure);
    }
    return figures;
}

} // namespace carom
