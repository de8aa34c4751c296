// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/expectations/expectation_watch.h"

#include "core/narrowphase/narrowphase.h"
#include "core/scene/schema.h"
#include "core/simulation/world.h"
#include "core/solvers/solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace carom {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Times nearer than this share of a frame are one: above the rounding of a frame's number times its length,
/// which reaches 1e-9 of it after four million frames.
constexpr double sameMoment = 1e-9;

/// The share of a limit that is used; 0 / 0 is none.
double shareOf(double off, double allowed) {
    if (std::isnan(off)) return infinite;
    if (off <= 0) return 0;
    return allowed > 0 ? off / allowed : infinite;
}

/// The same for a bound: 1 at it, at most 1 within, in the bound's own size where it has one.
double shareOfBound(double quantity, double bound, bool isMost) {
    if (std::isnan(quantity)) return infinite;
    const double q = isMost ? quantity : -quantity, most = isMost ? bound : -bound;
    if (q > most) return most > 0 ? q / most : infinite;
    if (q <= 0 && most >= 0) return 0;
    return most > 0 ? q / most : most / q;
}

} // namespace

std::string_view nameOf(Criterion criterion) {
    static constexpr std::array<std::string_view, 5> names = {"value", "min", "max", "drift", "rest"};
    return names[static_cast<std::size_t>(criterion)];
}

bool isWorse(const Judgement& a, const Judgement& b) {
    return !b.measured || a.share > b.share || (a.share == b.share && a.off > b.off);
}

ExpectationWatch::ExpectationWatch(std::shared_ptr<const Pipeline> pipeline)
    : m_pipeline(std::move(pipeline)) {
    const Bodies& bodies = m_pipeline->bodies();
    for (const Expectation& asked : m_pipeline->scene().expectations) {
        if (!asked.preset.empty() && asked.preset != m_pipeline->settings().preset->name) continue;
        Followed followed;
        const bool special =
            asked.quantity.empty() || asked.quantity == "impacts" || isOfTwoBodies(asked.quantity);
        if (!special) {
            const bool ofWhole =
                asked.of == noBody && !asked.ofEach && quantityNamed(asked.quantity, false) != nullptr;
            followed.row = quantityNamed(asked.quantity, !ofWhole);
            if (ofWhole) followed.bodies = {noBody};
        }
        if (asked.ofEach) followed.bodies = *asked.ofEach.bodies;
        if (followed.bodies.empty() && asked.of != noBody) followed.bodies = {asked.of};
        if (!asked.ofEach && followed.bodies.empty() && asked.quantity == "impacts")
            followed.bodies = {noBody};
        if (!asked.ofEach && followed.bodies.empty()) followed.bodies = bodies.mobileBodies;
        followed.sums.resize(followed.bodies.size());
        if (asked.rest) followed.resting = bodies.mobileBodies;
        if (asked.rest && asked.ofEach) followed.resting = *asked.ofEach.bodies;
        if (asked.rest && asked.of != noBody) followed.resting = {asked.of};
        m_followed.push_back(std::move(followed));
        m_judgements.push_back({.expectation = &asked, .failedAt = {}});
    }
}

bool ExpectationWatch::needsLedger() const {
    return std::ranges::any_of(m_followed, [](const Followed& followed) {
        return followed.row != nullptr && followed.row->audited;
    });
}

double ExpectationWatch::lastNamedTime() const {
    double last = 0;
    for (const Judgement& judgement : m_judgements)
        for (const std::optional<double>& time :
             {judgement.expectation->at, judgement.expectation->from, judgement.expectation->until})
            last = std::max(last, time.value_or(0));
    return last;
}

bool ExpectationWatch::isOpenEnded() const {
    return std::ranges::any_of(m_judgements, [](const Judgement& judgement) {
        return !judgement.expectation->at && !judgement.expectation->until;
    });
}

void ExpectationWatch::remember(const World& world) {
    m_before.take(world);
    m_allImpactsBefore = m_allImpacts;
}

void ExpectationWatch::begin(const World& world) {
    for (std::size_t i = 0; i < m_followed.size(); ++i) {
        m_judgements[i] = {.expectation = m_judgements[i].expectation, .failedAt = {}};
        m_followed[i].started = false;
        std::ranges::fill(m_followed[i].sums, 0);
    }
    m_allImpacts = 0;
    const bool counts = std::ranges::any_of(m_judgements, [](const Judgement& judgement) {
        return judgement.expectation->quantity == "impacts";
    });
    m_impacts.reset();
    if (counts)
        m_impacts.emplace(m_pipeline->bodies(), m_pipeline->gravity(), m_pipeline->settings().step,
                          world.state());
    remember(world);
    const Moment moment = momentOf(*m_pipeline, world.state(), world.statistics());
    const double time = world.state().time;
    for (std::size_t i = 0; i < m_followed.size(); ++i) {
        const Expectation& asked = *m_judgements[i].expectation;
        // Of forces nothing is known before the first frame.
        if (m_followed[i].row != nullptr && m_followed[i].row->word.starts_with("contact_force")) continue;
        if (asked.at || !asked.from || *asked.from <= time) start(i, moment, time);
        const bool now = asked.at ? *asked.at <= time : !asked.from || *asked.from <= time;
        if (now) judge(i, moment, 1, world.state().frame, time);
    }
}

void ExpectationWatch::look(const World& world) {
    if (empty()) return;
    if (!world.health().finite) return finish();
    const State& state = world.state();
    const Moment moment = m_before.momentOf(world);
    if (m_impacts) {
        const auto hit = static_cast<double>(m_impacts->look(state));
        // Event-driven methods count impacts themselves; for others they are found from the states at the
        // ends of frames.
        const bool exact = m_pipeline->settings().method->isExact;
        m_allImpacts += exact ? static_cast<double>(world.statistics().contacts) : hit;
    }
    const double near = sameMoment * m_pipeline->settings().step;
    std::optional<StateBetween> inside;
    for (std::size_t i = 0; i < m_followed.size(); ++i) {
        Followed& followed = m_followed[i];
        const Expectation& asked = *m_judgements[i].expectation;
        if (!followed.started && (asked.at || !asked.from)) start(i, moment, state.time);
        if (asked.at && *asked.at > m_before.time + near && *asked.at < state.time - near) {
            inside.emplace(m_before, world, *asked.at);
            const Moment middle = inside->momentOf(world, m_before);
            judge(i, middle, inside->part, state.frame, *asked.at);
        }
        const bool here = asked.at ? std::abs(*asked.at - state.time) <= near
                                   : (!asked.from || state.time >= *asked.from - near) &&
                                         (!asked.until || state.time <= *asked.until + near);
        if (here) {
            if (!followed.started) start(i, moment, state.time);
            judge(i, moment, 1, state.frame, state.time);
        }
        if (followed.row == nullptr || !followed.row->audited) continue;
        for (std::size_t k = 0; k < followed.bodies.size(); ++k)
            followed.sums[k] += followed.row->measure(moment, followed.bodies[k]);
    }
    remember(world);
}

void ExpectationWatch::finish() {
    const double near = sameMoment * m_pipeline->settings().step;
    for (Judgement& judgement : m_judgements) {
        const Expectation& asked = *judgement.expectation;
        const double end = asked.at ? *asked.at : asked.until.value_or(0);
        if (judgement.state == ExpectationState::Waiting || end > m_before.time + near)
            judgement.state = ExpectationState::Fails;
    }
}

void ExpectationWatch::start(std::size_t i, const Moment& moment, double time) {
    Followed& followed = m_followed[i];
    followed.started = true;
    followed.start.clear();
    followed.startScale.clear();
    followed.startPose.clear();
    for (std::size_t k = 0; k < followed.bodies.size(); ++k) {
        const BodyIndex body = followed.bodies[k];
        followed.start.push_back(measure(followed, *m_judgements[i].expectation, moment, k, 1, time));
        const bool scaled = followed.row != nullptr && followed.row->scale != nullptr;
        followed.startScale.push_back(scaled ? followed.row->scale(moment, body) : 0);
    }
    for (const BodyIndex body : followed.resting) followed.startPose.push_back(moment.pose[body]);
}

/// What the quantity is; `part` of the frame has passed at `time` [s].
double ExpectationWatch::measure(const Followed& followed, const Expectation& asked, const Moment& moment,
                                 std::size_t k, double part, double time) const {
    const BodyIndex body = followed.bodies[k];
    if (followed.row != nullptr) {
        const double figure = followed.row->measure(moment, body);
        return followed.row->audited ? followed.sums[k] + part * figure : figure;
    }
    if (isOfTwoBodies(asked.quantity)) {
        const std::vector<Shape>& shape = m_pipeline->bodies().shape;
        return proximityOf({&shape[asked.of], &moment.pose[asked.of]},
                           {&shape[asked.to], &moment.pose[asked.to]})
            .distance;
    }
    if (asked.quantity.empty() || !m_impacts) return 0;
    if (body == noBody) return part < 1 ? m_allImpactsBefore : m_allImpacts;
    return static_cast<double>(std::ranges::count_if(
        m_impacts->record()[body], [time](const SeenImpact& impact) { return impact.time <= time; }));
}

void ExpectationWatch::judge(std::size_t i, const Moment& moment, double part, std::int64_t frame,
                             double time) {
    const Followed& followed = m_followed[i];
    const Expectation& asked = *m_judgements[i].expectation;
    if (asked.rest) judgeRest(i, moment, frame, time);
    if (asked.quantity.empty()) return;
    for (std::size_t k = 0; k < followed.bodies.size(); ++k)
        judgeBody(i, moment, k, measure(followed, asked, moment, k, part, time), frame, time);
}

void ExpectationWatch::judgeBody(std::size_t i, const Moment& moment, std::size_t k, double quantity,
                                 std::int64_t frame, double time) {
    const Followed& followed = m_followed[i];
    const Expectation& asked = *m_judgements[i].expectation;
    Judgement seen{.expectation = &asked,
                   .measured = true,
                   .figure = quantity,
                   .body = followed.bodies[k],
                   .frame = frame,
                   .time = time,
                   .failedAt = {}};
    const auto takeAs = [&](Criterion criterion, double off, double allowed, double share) {
        seen.criterion = criterion;
        seen.off = off;
        seen.allowed = allowed;
        seen.share = share;
        take(i, seen);
    };
    if (asked.value) {
        const double off = std::abs(quantity - *asked.value);
        const double allowed =
            std::max(asked.within.value_or(0), asked.relative.value_or(0) * std::abs(*asked.value));
        takeAs(Criterion::Value, off, allowed, shareOf(off, allowed));
    }
    if (asked.least)
        takeAs(Criterion::Least, *asked.least - quantity, 0, shareOfBound(quantity, *asked.least, false));
    if (asked.most)
        takeAs(Criterion::Most, quantity - *asked.most, 0, shareOfBound(quantity, *asked.most, true));
    if (!asked.drift) return;
    const double change = std::abs(quantity - followed.start[k]);
    double scale = std::max({std::abs(quantity), std::abs(followed.start[k]), followed.startScale[k]});
    if (followed.row != nullptr && followed.row->scale != nullptr)
        scale = std::max(scale, followed.row->scale(moment, followed.bodies[k]));
    seen.figure = change == 0 ? 0 : change / scale;
    takeAs(Criterion::Drift, seen.figure, *asked.drift, shareOf(seen.figure, *asked.drift));
}

void ExpectationWatch::judgeRest(std::size_t i, const Moment& moment, std::int64_t frame, double time) {
    const Followed& followed = m_followed[i];
    const Expectation& asked = *m_judgements[i].expectation;
    const Bodies& bodies = m_pipeline->bodies();
    for (std::size_t k = 0; k < followed.resting.size(); ++k) {
        const BodyIndex body = followed.resting[k];
        const Pose &pose = moment.pose[body], &start = followed.startPose[k];
        const bool inPlace =
            pose.position == start.position && pose.orientation.coeffs() == start.orientation.coeffs();
        const double turning = moment.angularVelocity[body].norm();
        const double speed =
            std::max(moment.velocity[body].norm(),
                     turning > 0 ? turning * bodies.boundingRadius[body] : 0); // of walls inf
        const double moved = (pose.position - start.position).norm() / m_pipeline->settings().step;
        const bool rests = inPlace && speed == 0;
        take(i, {.expectation = &asked,
                 .measured = true,
                 .criterion = Criterion::Rest,
                 .figure = std::max(speed, moved),
                 .off = std::max(speed, moved),
                 .share = rests ? 0 : infinite,
                 .body = body,
                 .frame = frame,
                 .time = time,
                 .failedAt = {}});
    }
}

/// Keeps the worst; of several that are as bad, the one further off, and then the first.
void ExpectationWatch::take(std::size_t i, const Judgement& seen) {
    Judgement& kept = m_judgements[i];
    const bool fails = !(seen.share <= 1);
    const bool worse = isWorse(seen, kept);
    const std::optional<std::int64_t> failedAt =
        kept.failedAt || !fails ? kept.failedAt : std::optional(seen.frame);
    const bool failed = fails || kept.state == ExpectationState::Fails;
    if (worse) kept = seen;
    kept.failedAt = failedAt;
    kept.state = failed ? ExpectationState::Fails : ExpectationState::Holds;
}

} // namespace carom
