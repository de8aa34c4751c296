// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/impacts.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

/// A change of velocity by contact forces is below this many times gravity's in a frame: one time holds the
/// weight, the other is for friction and slopes.
constexpr double asGravity = 2;
/// Rounding of velocities, relative to the fastest body at the start.
constexpr double rounding = 1e-9;
constexpr double alikeWithin = 0.5, strongEnough = 0.01;

/// The longest time up to `end` in which the body is not hit [s].
double longestFlight(const std::vector<Impact>& impacts, double end) {
    double longest = 0, last = 0;
    for (const Impact& impact : impacts) {
        longest = std::max(longest, std::min(impact.time, end) - last);
        last = std::min(impact.time, end);
    }
    return std::max(longest, end - last);
}

bool alike(const Impact& a, const Impact& b, double mostApart) {
    return std::abs(a.time - b.time) <= mostApart &&
           (a.change - b.change).norm() <= alikeWithin * std::max(a.change.norm(), b.change.norm());
}

std::vector<Impact> strong(const std::vector<Impact>& impacts, double least) {
    std::vector<Impact> kept;
    for (const Impact& impact : impacts)
        if (impact.change.norm() >= least) kept.push_back(impact);
    return kept;
}

void compareBody(const std::vector<Impact>& truth, const std::vector<Impact>& run, double end,
                 ImpactErrors& errors) {
    std::size_t same = 0;
    const double mostApart = longestFlight(truth, end);
    while (same < truth.size() && same < run.size() && alike(truth[same], run[same], mostApart)) ++same;
    const auto within = [end](const Impact& impact) { return impact.time <= end; };
    const auto expected = static_cast<std::size_t>(std::ranges::count_if(truth, within));
    auto seen = static_cast<std::size_t>(std::ranges::count_if(run, within));
    // A pair that belongs together may lie on both sides of the end: it counts where the true one lies.
    for (std::size_t k = 0; k < same; ++k) {
        if (k < expected && !within(run[k])) ++seen;
        if (k >= expected && within(run[k])) --seen;
    }
    const std::size_t matched = std::min(same, expected);
    for (std::size_t k = 0; k < matched; ++k)
        errors.time = std::max(errors.time, std::abs(truth[k].time - run[k].time));
    errors.expected += expected;
    errors.seen += seen;
    errors.matched += matched;
}

} // namespace

ImpactWatch::ImpactWatch(const Bodies& bodies, const Vec3& gravity, double frame, const State& start)
    : m_bodies(bodies), m_gravity(gravity), m_frame(frame), m_place(bodies.count()),
      m_velocity(start.velocity), m_record(bodies.count()) {
    double fastest = 0;
    for (const BodyIndex i : bodies.mobileBodies) {
        m_place[i] = start.pose[i].position;
        fastest = std::max(fastest, m_velocity[i].norm());
    }
    m_least = asGravity * gravity.norm() * frame + rounding * fastest;
}

std::size_t ImpactWatch::look(const State& state) {
    std::size_t hit = 0;
    const double begin = static_cast<double>(m_looks) * m_frame;
    for (const BodyIndex i : m_bodies.mobileBodies) {
        const Vec3& place = state.pose[i].position;
        const Vec3& velocity = state.velocity[i];
        const Vec3 change = velocity - m_velocity[i] - m_frame * m_gravity;
        const double square = change.squaredNorm();
        if (square > m_least * m_least) {
            const Vec3 excess =
                place - m_place[i] - m_frame * m_velocity[i] - (0.5 * m_frame * m_frame) * m_gravity;
            const double before = m_frame - std::clamp(excess.dot(change) / square, 0.0, m_frame);
            m_record[i].push_back({begin + before, change});
            ++hit;
        }
        m_place[i] = place;
        m_velocity[i] = velocity;
    }
    ++m_looks;
    return hit;
}

ImpactErrors compareImpacts(const ImpactRecord& truth, const ImpactRecord& run, double end) {
    double strongest = 0;
    for (const std::vector<Impact>& impacts : truth)
        for (const Impact& impact : impacts) strongest = std::max(strongest, impact.change.norm());
    ImpactErrors errors;
    for (std::size_t i = 0; i < truth.size(); ++i)
        compareBody(strong(truth[i], strongEnough * strongest), strong(run[i], strongEnough * strongest), end,
                    errors);
    return errors;
}

} // namespace carom
