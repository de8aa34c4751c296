// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/event_story.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>
#include <vector>

namespace carom {
namespace {

/// A body with a larger misfit is not the partner. A body that took no momentum has 1, so from there on any
/// uninvolved body would count; two that took half each have 0.5, and at less neither would be found.
constexpr double worst = 0.9;
/// The misfit of an immobile body, whose momentum does not change, where the direction is wrong by a right
/// angle: as much as that of a mobile one which took half. At twice that it would explain nothing there.
constexpr double immobileShare = 0.5;
/// The misfit of a wall that is a radius away: small beside that of a direction, because it only has to
/// distinguish parallel walls. At five times it would outweigh a direction that is wrong by a right angle.
constexpr double gapShare = 0.1;
/// Bodies may be further apart than they can have moved by this part of the radius: position corrections are
/// smaller. At 0 an impact of bodies at rest would find no neighbour; at ten times, uninvolved bodies would
/// count as near.
constexpr double slack = 0.05;
/// Changes of a momentum below this part of it are rounding: that of some thousand operations is 1e-13, so at
/// a ten-thousandth rounding would be told as an impact.
constexpr double unnoticed = 1e-9;
/// Changes of the energy below this part of what was added up are rounding: that of some thousand operations
/// is 1e-13, and each of the two sums has it, so at a tenth rounding would be told as a loss.
constexpr double energyUnnoticed = 1e-12;

struct Neighbour {
    BodyIndex body = noBody;
    double misfit = std::numeric_limits<double>::infinity();
    Vec3 at = Vec3::Zero(); ///< [m]
};

class Search {
  public:
    Search(const Bodies& bodies, const Snapshot& before, const Snapshot& after,
           const std::vector<Vec3>& given, BodyIndex body)
        : m_bodies(bodies), m_before(before), m_after(after), m_given(given), m_body(body),
          m_place(before.pose[body].position), m_radius(bodies.boundingRadius[body]) {}

    Neighbour find() const {
        Neighbour best;
        for (BodyIndex other = 0; other < m_bodies.count(); ++other) {
            if (other == m_body) continue;
            const Wall* wall = std::get_if<Wall>(&m_bodies.shape[other]);
            const Neighbour here = wall != nullptr ? ofWall(other, *wall) : ofBody(other);
            if (here.misfit < best.misfit) best = here;
        }
        return best.misfit < worst ? best : Neighbour{};
    }

  private:
    /// How far the two can have come towards each other [m].
    double reach(BodyIndex other) const {
        const double h = m_after.time - m_before.time;
        const auto fastest = [&](BodyIndex body) {
            return std::max(m_before.velocity[body].norm(), m_after.velocity[body].norm());
        };
        return 2 * h * (fastest(m_body) + fastest(other)) + slack * m_radius;
    }

    Neighbour ofWall(BodyIndex other, const Wall& wall) const {
        const double gap = distanceTo(wall, m_place) - m_radius;
        if (gap > reach(other)) return {};
        const double aside = 1 - m_given[m_body].normalized().dot(wall.normal);
        return {other, immobileShare * aside + gapShare * std::max(gap, 0.0) / m_radius,
                m_place - m_radius * wall.normal};
    }

    Neighbour ofBody(BodyIndex other) const {
        const Vec3 apart = m_place - m_before.pose[other].position;
        const double sum = m_radius + m_bodies.boundingRadius[other];
        if (apart.norm() > sum + reach(other)) return {};
        const Vec3 at = m_place - m_radius / sum * apart;
        if (m_bodies.mobile[other] != 0)
            return {other, (m_given[m_body] + m_given[other]).norm() / m_given[m_body].norm(), at};
        if (apart.isZero()) return {};
        return {other, immobileShare * (1 - m_given[m_body].normalized().dot(apart.normalized())), at};
    }

    const Bodies& m_bodies;
    const Snapshot &m_before, &m_after;
    const std::vector<Vec3>& m_given; // [N s]
    BodyIndex m_body;
    Vec3 m_place;
    double m_radius;
};

/// What kinetic and potential energy lost; 0 where that is rounding. Heights of either sign may cancel in the
/// sum, their rounding does not.
double energyLost(const Pipeline& pipeline, const Snapshot& before, const Snapshot& after) {
    const Bodies& bodies = pipeline.bodies();
    double lost = 0, added = 0; // [J]
    for (const auto& [one, sign] : {std::pair(&before, 1.0), std::pair(&after, -1.0)}) {
        lost += sign * (one->statistics.kinetic + one->statistics.potential);
        added += one->statistics.kinetic + std::abs(one->statistics.potential);
        for (const BodyIndex i : bodies.mobileBodies)
            added += std::abs(bodies.mass[i] * pipeline.gravity().dot(one->pose[i].position));
    }
    return std::abs(lost) > energyUnnoticed * added ? lost : 0;
}

} // namespace

EventStory storyOf(const Pipeline& pipeline, const Snapshot& before, const Snapshot& after) {
    const Bodies& bodies = pipeline.bodies();
    EventStory story{.frame = after.frame, .energyLost = energyLost(pipeline, before, after)};
    const Vec3 fallen = (after.time - before.time) * pipeline.gravity();
    std::vector<Vec3> given(bodies.count(), Vec3::Zero());
    for (const BodyIndex i : bodies.mobileBodies) {
        given[i] = bodies.mass[i] * (after.velocity[i] - before.velocity[i] - fallen);
        const double rounding = unnoticed * bodies.mass[i] * (before.velocity[i].norm() + fallen.norm());
        if (!(given[i].norm() > std::max(story.impulse, rounding))) continue;
        story.impulse = given[i].norm();
        story.a = i;
    }
    if (story.a == noBody) return story;
    const Neighbour other = Search(bodies, before, after, given, story.a).find();
    story.b = other.body;
    story.at = other.body == noBody ? after.pose[story.a].position : other.at;
    return story;
}

} // namespace carom
