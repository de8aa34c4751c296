// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/standing_still.h"

#include "core/dynamics/contact_memory.h"
#include "core/dynamics/spring_force.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom {
void StandingStill::begin() {
    m_still.begin();
    m_isChanged = false;
    m_heldContacts = 0;
    m_heldDeepest = 0;
}

void StandingStill::leave(std::span<const std::uint32_t> newNumbers, std::size_t kept) {
    m_still.leave(newNumbers, kept);
    m_isChanged = m_still.any();
}

void StandingStill::notePair(std::uint32_t a, std::uint32_t b) {
    if (!m_still.rests(a) && !m_still.rests(b)) return;
    m_still.note(a);
    m_still.note(b);
    m_isChanged = true;
}

void StandingStill::forgetChanges() {
    m_still.forgetChanges();
    m_isChanged = false;
}

std::span<const std::uint32_t> StandingStill::hold(const Input& input,
                                                   std::span<const std::uint32_t> candidates) {
    for (const std::uint32_t i : candidates) m_still.set(i, true);
    addUpLoads(input);
    m_found.clear();
    for (const std::uint32_t i : candidates)
        if (isUnbalanced(input.of, input.islands, i, StillBodies::toStand))
            m_still.set(i, false);
        else
            m_found.push_back(i);
    return m_found;
}

bool StandingStill::isUnbalanced(const SteppedInput& input, const SteppedIslands& islands,
                                 std::uint32_t number, double part) const {
    const BodyIndex body = islands.bodyOf(number);
    return m_still.isUnbalanced(number, input.bodies.mass[body] * input.gravity.norm(),
                                input.bodies.boundingRadius[body], part);
}

std::span<const std::uint32_t> StandingStill::unbalanced(const SteppedInput& input,
                                                         const SteppedIslands& islands) {
    m_found.clear();
    if (!m_still.any()) return m_found;
    for (const std::uint32_t i : m_still.pressed())
        if (m_still.is(i) && m_still.isPressed(i) && isUnbalanced(input, islands, i, StillBodies::toMoveOn))
            m_found.push_back(i);
    return m_found;
}

void StandingStill::addUpLoads(const Input& input) {
    touchBesideChanged(input);
    m_loadPairs.clear(input.pairs.general().size());
    for (std::uint32_t i = 1; i < input.islands.numbers(); ++i) {
        if (!m_still.isTouched(i)) continue;
        for (const std::uint32_t number : input.pairs.ends(input.islands, input.of.workers).pairsOf(i))
            m_loadPairs.add(number);
        m_still.clearLoads(i);
        if (m_still.is(i))
            m_still.lasting(i).force = input.of.bodies.mass[input.islands.bodyOf(i)] * input.of.gravity;
    }
    m_loadPairs.forEach([&](std::uint32_t number) { addUpLoadsOf(input, number); });
    m_heldContacts = 0;
    m_heldDeepest = 0;
    for (const SteppedPairs::General& pair : input.pairs.general()) {
        m_heldContacts += pair.heldDepth >= 0 ? 1 : 0;
        m_heldDeepest = std::max(m_heldDeepest, pair.heldDepth);
    }
    const double perStep = 1 / input.step;
    input.pairs.balls().forEachPressing(m_still.touched(), [&](const BallRows::Contact& contact) {
        addLoads(contact.a, contact.b, contact.radiusA * contact.normal, -contact.radiusB * contact.normal,
                 perStep * contact.impulse);
    });
    addUpSpringLoads(input);
}

// The loads by springs as they are now; samples of those to bodies that move follow.
void StandingStill::addUpSpringLoads(const Input& input) {
    for (const std::uint32_t link : input.springs) {
        const SpringForce& spring = input.of.bodies.springs[link];
        const std::uint32_t a = input.islands.numberAt(spring.from), b = input.islands.numberAt(spring.to);
        if (!addsLoad(a) && !addsLoad(b)) continue;
        const SpringPoint from = springPoint(input.of.state, spring.from, spring.fromAt);
        const SpringPoint to = springPoint(input.of.state, spring.to, spring.toAt);
        const Vec3 force = forceOf(spring, from, to);
        if (addsLoad(a)) loadOf(a, b).add(from.arm, -force);
        if (addsLoad(b)) loadOf(b, a).add(to.arm, force);
    }
}

void StandingStill::touchBesideChanged(const Input& input) {
    m_still.beginLoads();
    const std::span<const std::uint8_t> changed = m_still.changed();
    for (std::uint32_t i = 1; i < input.islands.numbers(); ++i) {
        if (changed[i] == 0) continue;
        for (const std::uint32_t number : input.pairs.ends(input.islands, input.of.workers).pairsOf(i)) {
            const PersistentManifold& manifold = input.manifolds[input.pairs.entryOf(number).place];
            if (manifold.count == 0 || manifold.open) continue;
            const auto [a, b] = input.pairs.ends(input.islands, input.of.workers).of(number);
            m_still.touch(a);
            m_still.touch(b);
        }
    }
    input.pairs.balls().forEachPressing(changed, [this](const BallRows::Contact& contact) {
        m_still.touch(contact.a);
        m_still.touch(contact.b);
    });
    for (const std::uint32_t link : input.springs) {
        const SpringForce& spring = input.of.bodies.springs[link];
        const std::uint32_t a = input.islands.numberAt(spring.from), b = input.islands.numberAt(spring.to);
        if (changed[a] == 0 && changed[b] == 0) continue;
        m_still.touch(a);
        m_still.touch(b);
    }
}

// The loads by a pair that is not of two balls, on bodies of which loads are added up.
void StandingStill::addUpLoadsOf(const Input& input, std::uint32_t number) {
    const auto [a, b] = input.pairs.ends(input.islands, input.of.workers).of(number);
    double& heldDepth = input.pairs.general()[number].heldDepth;
    heldDepth = -1;
    if (!m_still.is(a) && !m_still.is(b)) return;
    const PersistentManifold& manifold = input.manifolds[input.pairs.entryOf(number).place];
    if (manifold.count == 0 || manifold.open) return;
    const bool isHeld = m_still.is(a) && m_still.is(b);
    const PlacedManifold contact =
        placed({input.of.bodies, input.of.state, input.of.gravity, input.step}, manifold);
    if (isHeld) heldDepth = 0;
    for (const PointInput& point : std::span(contact.points).first(static_cast<std::size_t>(contact.count))) {
        if (isHeld) heldDepth = std::max(heldDepth, -point.separation);
        addLoads(a, b, point.armA, point.armB, point.impulse);
    }
    if (addsLoad(a)) loadOf(a, b).torque -= contact.torque;
    if (addsLoad(b)) loadOf(b, a).torque += contact.torque;
}

void StandingStill::sampleLoads(const ContactRows& rows, std::span<const SpringRow> springs, BallRows& balls,
                                double step) {
    if (!m_still.any()) return;
    const double perStep = 1 / step;
    m_still.beginSamples();
    const auto sample = [this](std::uint32_t a, std::uint32_t b, const Vec3& armA, const Vec3& armB,
                               const Vec3& force) {
        if (m_still.rests(a)) m_still.sample(a).add(armA, -force);
        if (m_still.rests(b)) m_still.sample(b).add(armB, force);
    };
    for (const RowGroup& group : rows.groups())
        for (std::size_t lane = 0; lane < wideLanes; ++lane) {
            const std::uint32_t a = group.a[lane], b = group.b[lane];
            if (group.source[lane] == ContactRows::noPair || (!m_still.rests(a) && !m_still.rests(b)))
                continue;
            for (std::uint32_t k = 0; k < group.points; ++k) {
                const RowPoint& point = rows.points()[group.firstPoint + k];
                const Vec3 force = perStep * rows.impulseOf(group, static_cast<int>(lane), k);
                sample(a, b, laneOf(point.armA, lane), laneOf(point.armB, lane), force);
            }
        }
    for (const RollingRow& row : rows.rolling()) {
        if (m_still.rests(row.a)) m_still.sample(row.a).torque -= perStep * row.torque;
        if (m_still.rests(row.b)) m_still.sample(row.b).torque += perStep * row.torque;
    }
    for (const SpringRow& spring : springs) {
        if (m_still.is(spring.a) == m_still.is(spring.b)) continue;
        sample(spring.a, spring.b, spring.armA, spring.armB, perStep * (spring.frame * spring.impulse));
    }
    balls.forEachBeside(m_still.flags(), [&](const BallRows::Contact& contact) {
        sample(contact.a, contact.b, contact.radiusA * contact.normal, -contact.radiusB * contact.normal,
               perStep * contact.impulse);
    });
}

std::span<const std::uint32_t> StandingStill::struck(const Input& input, const ContactRows& rows,
                                                     std::span<const SolverBody> solved) {
    m_struckStill.clear();
    if (!m_still.any()) return m_struckStill;
    m_given.resize(input.islands.numbers(), 0);
    const auto strikeEither = [&](std::uint32_t a, std::uint32_t b, double closing, double restitution) {
        if (m_still.is(a) == m_still.is(b)) return;
        strike(input, m_still.is(a) ? b : a, m_still.is(a) ? a : b, closing, restitution);
    };
    for (const RowGroup& group : rows.groups())
        for (std::size_t lane = 0; lane < wideLanes; ++lane) {
            const std::uint32_t a = group.a[lane], b = group.b[lane];
            if (group.source[lane] == ContactRows::noPair || m_still.is(a) == m_still.is(b)) continue;
            const Vec3 normal = laneOf(group.normal, lane);
            for (std::uint32_t k = 0; k < group.points; ++k) {
                const RowPoint& point = rows.points()[group.firstPoint + k];
                if (!(point.massNormal[lane] > 0)) continue;
                const Vec3 speed = velocityAt(solved[a], laneOf(point.armA, lane)) -
                                   velocityAt(solved[b], laneOf(point.armB, lane));
                strikeEither(a, b, normal.dot(speed), group.restitution[lane]);
            }
        }
    input.pairs.balls().forEachBeside(m_still.flags(), [&](const BallRows::Contact& contact) {
        if (!contact.isSolved) return;
        const auto [a, b] = std::pair(contact.a, contact.b);
        strikeEither(a, b, contact.normal.dot(vectorOf(solved[a].velocity) - vectorOf(solved[b].velocity)),
                     contact.restitution);
    });
    passOnStrikes(input);
    for (const std::uint32_t i : std::span<const std::uint32_t>(m_struckStill)) m_given[i] = 0;
    return m_struckStill;
}

// Estimates the speed that `from`, approaching at `closing` [m/s], can give to `to`, which stands still. If
// that is not calm, `to` is noted as struck.
void StandingStill::strike(const Input& input, std::uint32_t from, std::uint32_t to, double closing,
                           double restitution) {
    if (to == immobile || from == immobile) return;
    const Bodies& bodies = input.of.bodies;
    const BodyIndex striker = input.islands.bodyOf(from), body = input.islands.bodyOf(to);
    const double mass = bodies.mass[striker], other = bodies.mass[body], size = bodies.boundingRadius[body];
    const double speed = (1 + restitution) * closing * mass / (mass + other);
    if (!(speed > StillBodies::struckSpeed * std::sqrt(size * input.of.gravity.norm()))) return;
    if (m_given[to] == 0) m_struckStill.push_back(to);
    m_given[to] = std::max(m_given[to], speed);
}

// Passes the estimated speeds on from contact to contact, as long as they are not calm.
void StandingStill::passOnStrikes(const Input& input) {
    std::size_t known = 0;
    const auto passOn = [&](std::uint32_t a, std::uint32_t b, double restitution) {
        if (m_given[a] > 0 && m_given[b] == 0) strike(input, a, b, m_given[a], restitution);
        if (m_given[b] > 0 && m_given[a] == 0) strike(input, b, a, m_given[b], restitution);
    };
    while (known < m_struckStill.size()) {
        known = m_struckStill.size();
        for (const SteppedPairs::General& pair : input.pairs.general()) {
            const SteppedPairs::Entry& entry = input.pairs.entries()[pair.entry];
            const auto [a, b] = input.islands.numbersOf(entry.pair);
            if (!m_still.is(a) || !m_still.is(b)) continue;
            if ((m_given[a] > 0) == (m_given[b] > 0)) continue;
            const PersistentManifold& manifold = input.manifolds[entry.place];
            if (manifold.count > 0 && !manifold.open)
                passOn(a, b, pairOf(input.of.bodies, entry.pair, 0).restitution);
        }
        input.pairs.balls().forEachPressing(m_still.flags(), [&](const BallRows::Contact& contact) {
            if (m_still.is(contact.a) && m_still.is(contact.b))
                passOn(contact.a, contact.b, contact.restitution);
        });
    }
}

} // namespace carom
