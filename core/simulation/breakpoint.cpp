// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/breakpoint.h"

#include "core/narrowphase/narrowphase.h"
#include "core/simulation/frame_impulses.h"
#include "core/simulation/world.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace carom {
namespace {

/// Bodies nearer than this part of the smaller one touch: the gap of a resting contact varies about 0. At a
/// tenth, such a contact may be reported again and again; at ten times, bodies touch visibly early.
constexpr double touchingWithin = 1e-4;

/// Of the closing speed: even an impact without restitution changes it by all of it; at twice such impacts
/// would be missed, at a tenth contact forces would count.
constexpr double leastJump = 0.5;

constexpr std::array rows = {
    BreakKindRow{BreakKind::Contact, "contact", "", 2},
    BreakKindRow{BreakKind::Penetration, "penetration", "depth [m]", 0},
    BreakKindRow{BreakKind::EnergyDrift, "energy drift", "share of the energy at the start", 0},
    BreakKindRow{BreakKind::Speed, "speed", "speed [m/s]", 1},
    BreakKindRow{BreakKind::PlaneCrossed, "plane crossed", "place on the axis [m]", 1},
};

bool anyMobile(const World& world, BodyIndex body, const auto& test) {
    const std::vector<BodyIndex>& mobile = world.pipeline().bodies().mobileBodies;
    if (body == noBody) return std::any_of(mobile.begin(), mobile.end(), test);
    return body < world.pipeline().bodies().count() && test(body);
}

double energyOf(const FrameStatistics& frame) { return frame.kinetic + frame.potential; }

/// Relative to the larger of the energy at the start and the kinetic energy now: the potential's zero is
/// arbitrary, and may make the total vanish.
double driftOf(const World& world) {
    FrameStatistics start;
    account(world.pipeline(), world.pipeline().initialState(), start);
    const FrameStatistics& now = world.statistics();
    const double change = std::abs(energyOf(now) - energyOf(start));
    const double scale = std::max({std::abs(energyOf(start)), start.kinetic, now.kinetic});
    return change > 0 ? change / scale : 0;
}

} // namespace

std::span<const BreakKindRow> breakKinds() { return rows; }

void BreakWatch::begin(const World& world) {
    if (empty()) return;
    m_poseBefore = world.state().pose;
    m_velocityBefore = world.state().velocity;
    m_held.clear();
    for (const Breakpoint& breakpoint : m_breakpoints) m_held.push_back(holds(breakpoint, world));
}

std::optional<std::size_t> BreakWatch::check(const World& world) {
    if (empty()) return std::nullopt;
    std::optional<std::size_t> first;
    for (std::size_t i = 0; i < m_breakpoints.size() && !first; ++i) {
        const Breakpoint& breakpoint = m_breakpoints[i];
        const bool begins = !m_held[i] && holds(breakpoint, world);
        if (begins || happened(breakpoint, world) || wereStruck(breakpoint, world)) first = i;
    }
    begin(world);
    return first;
}

/// Conditions of one state.
bool BreakWatch::holds(const Breakpoint& breakpoint, const World& world) const {
    const State& state = world.state();
    switch (breakpoint.kind) {
    case BreakKind::Penetration:
        return world.statistics().maxPenetration > breakpoint.limit;
    case BreakKind::EnergyDrift:
        return driftOf(world) > breakpoint.limit;
    case BreakKind::Speed:
        return anyMobile(world, breakpoint.a,
                         [&](BodyIndex i) { return state.velocity[i].norm() > breakpoint.limit; });
    case BreakKind::Contact:
    case BreakKind::PlaneCrossed:
        break;
    }
    return false;
}

/// Events between two states.
bool BreakWatch::happened(const Breakpoint& breakpoint, const World& world) const {
    if (breakpoint.kind == BreakKind::PlaneCrossed)
        return anyMobile(world, breakpoint.a, [&](BodyIndex i) {
            const double before = m_poseBefore[i].position[breakpoint.axis] - breakpoint.limit;
            const double now = world.state().pose[i].position[breakpoint.axis] - breakpoint.limit;
            return (before < 0) != (now < 0);
        });
    if (breakpoint.kind != BreakKind::Contact) return false;
    if (breakpoint.a != noBody && breakpoint.b != noBody) return met(world, breakpoint.a, breakpoint.b);
    const BodyIndex one = breakpoint.a != noBody ? breakpoint.a : breakpoint.b;
    const BodyIndex count = static_cast<BodyIndex>(world.pipeline().bodies().count());
    for (BodyIndex i = 0; i < count; ++i) {
        if (one != noBody) {
            if (i != one && met(world, one, i)) return true;
            continue;
        }
        for (BodyIndex k = i + 1; k < count; ++k)
            if (met(world, i, k)) return true;
    }
    return false;
}

/// Whether the bodies of a contact took an impulse from each other, as those do that touch already and are
/// struck through others: these neither approach nor need to separate.
bool BreakWatch::wereStruck(const Breakpoint& breakpoint, const World& world) const {
    if (breakpoint.kind != BreakKind::Contact) return false;
    const auto isOf = [&](BodyIndex body, const BodyPair& pair) {
        return body == noBody || body == pair.a || body == pair.b;
    };
    const FrameImpulses frame(world.pipeline(), {m_poseBefore, m_velocityBefore}, world.state());
    return std::ranges::any_of(frame.struckPairs(), [&](const BodyPair& pair) {
        return isOf(breakpoint.a, pair) && isOf(breakpoint.b, pair);
    });
}

/// Whether two bodies came into contact in the step: they touch now and did not before, or they bounced in
/// between. Then they approach before and separate afterwards, their paths touch, and they changed their
/// relative velocity by more than gravity does. (Two bodies that pass each other while a third hits one of
/// them look the same where that brings its path to the other.)
bool BreakWatch::met(const World& world, BodyIndex a, BodyIndex b) const {
    const Bodies& bodies = world.pipeline().bodies();
    if (a >= bodies.count() || b >= bodies.count() || (bodies.mobile[a] == 0 && bodies.mobile[b] == 0))
        return false;
    const State& state = world.state();
    const auto size = [&](BodyIndex i) {
        return isWall(bodies.shape[i]) ? bodies.boundingRadius[i == a ? b : a] : bodies.boundingRadius[i];
    };
    const double smaller = std::min(size(a), size(b));
    const double way = ((m_velocityBefore[b] - m_velocityBefore[a]).norm() +
                        (state.velocity[b] - state.velocity[a]).norm()) *
                       world.pipeline().settings().step;
    const bool wall = isWall(bodies.shape[a]) || isWall(bodies.shape[b]);
    if (!wall && (state.pose[b].position - state.pose[a].position).norm() >
                     bodies.boundingRadius[a] + bodies.boundingRadius[b] + way + smaller)
        return false;
    const auto proximity = [&](const std::vector<Pose>& pose) {
        return proximityOf({&bodies.shape[a], &pose[a]}, {&bodies.shape[b], &pose[b]});
    };
    const Proximity before = proximity(m_poseBefore), now = proximity(state.pose);
    if (before.distance <= touchingWithin * smaller) return false;
    if (now.distance <= touchingWithin * smaller) return true;
    const double closing = -before.normal.dot(m_velocityBefore[b] - m_velocityBefore[a]);
    const double parting = now.normal.dot(state.velocity[b] - state.velocity[a]);
    const double fall = world.pipeline().settings().step * (bodies.mobile[b] - bodies.mobile[a]);
    const Vec3 jump = (state.velocity[b] - state.velocity[a]) - (m_velocityBefore[b] - m_velocityBefore[a]) -
                      fall * world.pipeline().gravity();
    return closing > 0 && parting > 0 && before.distance + now.distance <= way &&
           jump.dot(now.normal) > leastJump * closing &&
           FrameImpulses(world.pipeline(), {m_poseBefore, m_velocityBefore}, state).mayHaveTouched(a, b);
}

} // namespace carom
