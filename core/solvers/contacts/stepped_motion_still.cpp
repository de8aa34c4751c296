// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/contact_memory.h"
#include "core/dynamics/free_rotation.h"
#include "core/solvers/contacts/calm.h"
#include "core/solvers/contacts/stepped_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

// Which bodies of the base path stand still (still_bodies.h), and what makes them move on.

namespace carom {
void SteppedMotion::findSlowest(const SteppedInput& input, std::vector<double>& slowest) {
    if (m_links.empty()) return;
    std::vector<double>&mass = m_islandMass, &times = m_islandTime;
    mass.assign(m_islands.islandNumbers(), 0);
    times.assign(m_islands.islandNumbers(), 0);
    for (const BodyIndex body : m_islands.bodies()) mass[m_islands.of(body)] += input.bodies.mass[body];
    const auto forEachEnd = [&](const auto& visit) {
        for (const std::uint32_t& link : m_links)
            for (const BodyIndex end : {input.bodies.springs[link].from, input.bodies.springs[link].to})
                if (m_islands.numberAt(end) != immobile) visit(link, end);
    };
    forEachEnd([&](const std::uint32_t& link, BodyIndex end) {
        double& time = times[m_islands.of(end)];
        time = std::max(time, slowestTime(input.bodies, input.state, std::span(&link, 1),
                                          mass[m_islands.of(end)], input.gravity));
    });
    forEachEnd([&](std::uint32_t, BodyIndex end) { slowest[end] = times[m_islands.of(end)]; });
}

// Stops the candidates on which the forces balance: they stand still from now on.
void SteppedMotion::holdStill(const SteppedInput& input, const Manifolds& manifolds) {
    if (m_candidates.empty()) return;
    m_bodies.forgetMoving();
    for (const std::uint32_t i : std::span<const std::uint32_t>(m_candidates)) m_still.set(i, true);
    addUpLoads(input, manifolds);
    m_stopped.clear();
    for (const std::uint32_t i : std::span<const std::uint32_t>(m_candidates)) {
        if (isUnbalanced(input, i, StillBodies::toStand)) {
            m_still.set(i, false);
            continue;
        }
        m_stopped.push_back(m_islands.bodyOf(i));
        m_bodies.setMass(input, m_islands.bodyOf(i), i, true);
        m_bodies.stop(i);
    }
    stop(input.bodies, m_stopped, input.state, input.ledger);
    if (m_stopped.size() < m_candidates.size()) addUpLoads(input, manifolds);
    holdPairs();
}

bool SteppedMotion::isUnbalanced(const SteppedInput& input, std::uint32_t number, double part) const {
    const BodyIndex body = m_islands.bodyOf(number);
    return m_still.isUnbalanced(number, input.bodies.mass[body] * input.gravity.norm(),
                                input.bodies.boundingRadius[body], part);
}

// Updates what depends on which bodies stand still, where that has changed.
void SteppedMotion::noteStill(const SteppedInput& input, const Manifolds& manifolds) {
    addUpLoads(input, manifolds);
    holdPairs();
}

void SteppedMotion::holdPairs() {
    m_pairs.balls().hold(m_still.flags(), m_still.changed(), m_bodies.solved());
    m_still.forgetChanges();
    m_areStillNoted = true;
    m_islands.noteStill(m_still.flags());
}

// Adds up the loads by gravity and by the present forces of all contacts, of bodies that have changed or
// touch one that has.
void SteppedMotion::addUpLoads(const SteppedInput& input, const Manifolds& manifolds) {
    touchBesideChanged(input, manifolds);
    m_loadPairs.clear(m_pairs.general().size());
    for (std::uint32_t i = 1; i < m_islands.numbers(); ++i) {
        if (!m_still.isTouched(i)) continue;
        for (const std::uint32_t number : m_pairs.ends(m_islands).pairsOf(i)) m_loadPairs.add(number);
        m_still.clearLoads(i);
        if (m_still.is(i)) m_still.lasting(i).force = input.bodies.mass[m_islands.bodyOf(i)] * input.gravity;
    }
    m_loadPairs.forEach([&](std::uint32_t number) { addUpLoads(input, number, manifolds); });
    m_heldContacts = 0;
    m_heldDeepest = 0;
    for (const SteppedPairs::General& pair : m_pairs.general()) {
        m_heldContacts += pair.heldDepth >= 0 ? 1 : 0;
        m_heldDeepest = std::max(m_heldDeepest, pair.heldDepth);
    }
    const double perStep = 1 / m_step;
    m_pairs.balls().forEachPressing(m_still.touched(), [&](const BallRows::Contact& contact) {
        const Vec3 force = perStep * contact.impulse;
        const auto [a, b] = std::pair(contact.a, contact.b);
        if (addsLoad(a)) loadOf(a, b).add(contact.radiusA * contact.normal, -force);
        if (addsLoad(b)) loadOf(b, a).add(-contact.radiusB * contact.normal, force);
    });
    addUpSpringLoads(input);
}

// The loads by springs as they are now; samples of those to bodies that move follow.
void SteppedMotion::addUpSpringLoads(const SteppedInput& input) {
    for (const std::uint32_t link : m_links) {
        const SpringForce& spring = input.bodies.springs[link];
        const std::uint32_t a = m_islands.numberAt(spring.from), b = m_islands.numberAt(spring.to);
        if (!addsLoad(a) && !addsLoad(b)) continue;
        const Vec3 force = forceOf(spring, input.state);
        const auto armOf = [&](BodyIndex body, const Vec3& point) -> Vec3 {
            return input.state.pose[body].orientation * point;
        };
        if (addsLoad(a)) loadOf(a, b).add(armOf(spring.from, spring.fromAt), -force);
        if (addsLoad(b)) loadOf(b, a).add(armOf(spring.to, spring.toAt), force);
    }
}

void SteppedMotion::touchBesideChanged(const SteppedInput& input, const Manifolds& manifolds) {
    m_still.beginLoads();
    const std::span<const std::uint8_t> changed = m_still.changed();
    for (std::uint32_t i = 1; i < m_islands.numbers(); ++i) {
        if (changed[i] == 0) continue;
        for (const std::uint32_t number : m_pairs.ends(m_islands).pairsOf(i)) {
            const PersistentManifold& manifold = manifolds[m_pairs.entryOf(number).place];
            if (manifold.count == 0 || manifold.open) continue;
            const auto [a, b] = m_pairs.ends(m_islands).of(number);
            m_still.touch(a);
            m_still.touch(b);
        }
    }
    m_pairs.balls().forEachPressing(changed, [this](const BallRows::Contact& contact) {
        m_still.touch(contact.a);
        m_still.touch(contact.b);
    });
    for (const std::uint32_t link : m_links) {
        const SpringForce& spring = input.bodies.springs[link];
        const std::uint32_t a = m_islands.numberAt(spring.from), b = m_islands.numberAt(spring.to);
        if (changed[a] == 0 && changed[b] == 0) continue;
        m_still.touch(a);
        m_still.touch(b);
    }
}

// The loads by a pair that is not of two balls, on bodies of which loads are added up.
void SteppedMotion::addUpLoads(const SteppedInput& input, std::uint32_t number, const Manifolds& manifolds) {
    const auto [a, b] = m_pairs.ends(m_islands).of(number);
    double& heldDepth = m_pairs.general()[number].heldDepth;
    heldDepth = -1;
    if (!m_still.is(a) && !m_still.is(b)) return;
    const PersistentManifold& manifold = manifolds[m_pairs.entryOf(number).place];
    if (manifold.count == 0 || manifold.open) return;
    const bool isHeld = m_still.is(a) && m_still.is(b);
    const PlacedManifold contact = placed({input.bodies, input.state, input.gravity, m_step}, manifold);
    if (isHeld) heldDepth = 0;
    for (const PointInput& point : std::span(contact.points).first(static_cast<std::size_t>(contact.count))) {
        if (isHeld) heldDepth = std::max(heldDepth, -point.separation);
        if (addsLoad(a)) loadOf(a, b).add(point.armA, -point.impulse);
        if (addsLoad(b)) loadOf(b, a).add(point.armB, point.impulse);
    }
    if (addsLoad(a)) loadOf(a, b).torque -= contact.torque;
    if (addsLoad(b)) loadOf(b, a).torque += contact.torque;
}

// Samples the forces of the last step between bodies that stand still and bodies that move.
void SteppedMotion::sampleLoads() {
    if (!m_still.any()) return;
    const double perStep = 1 / m_step;
    m_still.beginSamples();
    for (const RowGroup& group : m_rows.groups())
        for (std::size_t lane = 0; lane < wideLanes; ++lane) {
            const std::uint32_t a = group.a[lane], b = group.b[lane];
            if (group.source[lane] == ContactRows::noPair || (!m_still.rests(a) && !m_still.rests(b)))
                continue;
            for (std::uint32_t k = 0; k < group.points; ++k) {
                const RowPoint& point = m_rows.points()[group.firstPoint + k];
                const Vec3 force = perStep * m_rows.impulseOf(group, static_cast<int>(lane), k);
                if (m_still.rests(a)) m_still.sample(a).add(laneOf(point.armA, lane), -force);
                if (m_still.rests(b)) m_still.sample(b).add(laneOf(point.armB, lane), force);
            }
        }
    for (const RollingRow& row : m_rows.rolling()) {
        if (m_still.rests(row.a)) m_still.sample(row.a).torque -= perStep * row.torque;
        if (m_still.rests(row.b)) m_still.sample(row.b).torque += perStep * row.torque;
    }
    for (const SpringRow& spring : static_cast<const std::vector<SpringRow>&>(m_springs)) {
        if (m_still.is(spring.a) == m_still.is(spring.b)) continue;
        const Vec3 force = perStep * (spring.frame * spring.impulse);
        if (m_still.rests(spring.a)) m_still.sample(spring.a).add(spring.armA, -force);
        if (m_still.rests(spring.b)) m_still.sample(spring.b).add(spring.armB, force);
    }
    m_pairs.balls().forEachBeside(m_still.flags(), [&](const BallRows::Contact& contact) {
        const auto [a, b] = std::pair(contact.a, contact.b);
        const Vec3 force = perStep * contact.impulse;
        if (m_still.rests(a)) m_still.sample(a).add(contact.radiusA * contact.normal, -force);
        if (m_still.rests(b)) m_still.sample(b).add(-contact.radiusB * contact.normal, force);
    });
}

// Lets bodies move on whose forces are out of balance by this part. True if there are any.
bool SteppedMotion::wakeUnbalanced(const SteppedInput& input, double part) {
    bool any = false;
    if (!m_still.any()) return any;
    for (const std::uint32_t i : m_still.pressed()) {
        if (!m_still.is(i) || !m_still.isPressed(i) || !isUnbalanced(input, i, part)) continue;
        moveOn(input, i);
        any = true;
    }
    return any;
}

// Springs between bodies that stand still are loads of these alone.
void SteppedMotion::findPulling(const Bodies& bodies) {
    m_pulling.clear();
    for (const std::uint32_t link : m_links)
        if (!m_still.is(m_islands.numberAt(bodies.springs[link].from)) ||
            !m_still.is(m_islands.numberAt(bodies.springs[link].to)))
            m_pulling.push_back(link);
}

// Finds the parts of islands that bodies which stand still divide: these, like immobile bodies, carry no
// motion from one contact to another.
void SteppedMotion::findParts() {
    if (!m_still.any() || std::exchange(m_arePartsFound, true)) return;
    for (const std::uint32_t i : m_bodies.moving().awake) m_part[i] = i;
    for (const RowGroup& group : m_rows.groups())
        for (std::size_t lane = 0; lane < wideLanes; ++lane) joinParts(group.a[lane], group.b[lane]);
    for (const Watched& pair : m_watched) joinParts(pair.open.a, pair.open.b);
    for (const SpringRow& spring : static_cast<const std::vector<SpringRow>&>(m_springs))
        joinParts(spring.a, spring.b);
    m_pairs.balls().forEachPair([this](std::uint32_t a, std::uint32_t b) { joinParts(a, b); });
    for (const std::uint32_t i : m_bodies.moving().awake) m_part[i] = partWith(i);
}

std::uint32_t SteppedMotion::partWith(std::uint32_t number) {
    while (m_part[number] != number) number = m_part[number] = m_part[m_part[number]];
    return number;
}

void SteppedMotion::joinParts(std::uint32_t a, std::uint32_t b) {
    if (m_part[a] == m_part[b] || m_still.is(a) || m_still.is(b)) return;
    const std::uint32_t one = partWith(a), other = partWith(b);
    m_part[std::max(one, other)] = std::min(one, other);
}

void SteppedMotion::moveOn(const SteppedInput& input, std::uint32_t number) {
    m_bodies.forgetMoving();
    m_still.set(number, false);
    m_bodies.setMass(input, m_islands.bodyOf(number), number, false);
    m_movedOn.push_back(m_islands.bodyOf(number));
    m_bodies.noteFar(number); // its rows are those of an immobile body
}

// Lets bodies that stand still move on if a body strikes them before the next look, and others that these
// strike in turn. True if there are any.
bool SteppedMotion::wakeStruck(const SteppedInput& input, const Manifolds& manifolds) {
    if (!m_still.any()) return false;
    m_given.resize(m_islands.numbers(), 0);
    m_struckStill.clear();
    const auto strike = [&](std::uint32_t a, std::uint32_t b, double closing, double restitution) {
        if (m_still.is(a) == m_still.is(b)) return;
        strikeStill(input, m_still.is(a) ? b : a, m_still.is(a) ? a : b, closing, restitution);
    };
    for (const RowGroup& group : m_rows.groups())
        for (std::size_t lane = 0; lane < wideLanes; ++lane) {
            const std::uint32_t a = group.a[lane], b = group.b[lane];
            if (group.source[lane] == ContactRows::noPair || m_still.is(a) == m_still.is(b)) continue;
            const Vec3 normal = laneOf(group.normal, lane);
            for (std::uint32_t k = 0; k < group.points; ++k) {
                const RowPoint& point = m_rows.points()[group.firstPoint + k];
                if (!(point.massNormal[lane] > 0)) continue;
                const Vec3 speed = velocityAt(m_bodies.solved()[a], laneOf(point.armA, lane)) -
                                   velocityAt(m_bodies.solved()[b], laneOf(point.armB, lane));
                strike(a, b, normal.dot(speed), group.restitution[lane]);
            }
        }
    m_pairs.balls().forEachBeside(m_still.flags(), [&](const BallRows::Contact& contact) {
        if (!contact.isSolved) return;
        const auto [a, b] = std::pair(contact.a, contact.b);
        strike(a, b,
               contact.normal.dot(vectorOf(m_bodies.solved()[a].velocity) -
                                  vectorOf(m_bodies.solved()[b].velocity)),
               contact.restitution);
    });
    if (m_struckStill.empty()) return false;
    passOnStrikes(input, manifolds);
    m_woken.clear();
    for (const std::uint32_t i : std::span<const std::uint32_t>(m_struckStill)) {
        m_given[i] = 0;
        moveOn(input, i);
        m_woken.push_back(m_islands.bodyOf(i));
    }
    if (input.ledger != nullptr)
        m_atBegin.potential += invariantsOf(input.bodies, m_woken, input.state, input.gravity).potential;
    noteStill(input, manifolds);
    return true;
}

// Estimates the speed that `from`, approaching at `closing` [m/s], can give to `to`, which stands still. If
// that is not calm, `to` is noted as struck.
void SteppedMotion::strikeStill(const SteppedInput& input, std::uint32_t from, std::uint32_t to,
                                double closing, double restitution) {
    if (to == immobile || from == immobile) return;
    const double mass = input.bodies.mass[m_islands.bodyOf(from)],
                 other = input.bodies.mass[m_islands.bodyOf(to)];
    const double size = input.bodies.boundingRadius[m_islands.bodyOf(to)];
    const double speed = (1 + restitution) * closing * mass / (mass + other);
    if (!(speed > StillBodies::struckSpeed * std::sqrt(size * input.gravity.norm()))) return;
    if (m_given[to] == 0) m_struckStill.push_back(to);
    m_given[to] = std::max(m_given[to], speed);
}

// Passes the estimated speeds on from contact to contact, as long as they are not calm.
void SteppedMotion::passOnStrikes(const SteppedInput& input, const Manifolds& manifolds) {
    std::size_t known = 0;
    const auto passOn = [&](std::uint32_t a, std::uint32_t b, double restitution) {
        if (m_given[a] > 0 && m_given[b] == 0) strikeStill(input, a, b, m_given[a], restitution);
        if (m_given[b] > 0 && m_given[a] == 0) strikeStill(input, b, a, m_given[b], restitution);
    };
    while (known < m_struckStill.size()) {
        known = m_struckStill.size();
        for (const SteppedPairs::General& pair : m_pairs.general()) {
            const Entry& entry = m_pairs.entries()[pair.entry];
            const auto [a, b] = m_islands.numbersOf(entry.pair);
            if (!m_still.is(a) || !m_still.is(b)) continue;
            if ((m_given[a] > 0) == (m_given[b] > 0)) continue;
            const PersistentManifold& manifold = manifolds[entry.place];
            if (manifold.count > 0 && !manifold.open)
                passOn(a, b, pairOf(input.bodies, entry.pair, 0).restitution);
        }
        m_pairs.balls().forEachPressing(m_still.flags(), [&](const BallRows::Contact& contact) {
            if (m_still.is(contact.a) && m_still.is(contact.b))
                passOn(contact.a, contact.b, contact.restitution);
        });
    }
}

// Loads may depend on this pair, which is new.
void SteppedMotion::noteChanged(BodyPair pair) {
    const std::uint32_t a = m_islands.numberOf(pair.a), b = m_islands.numberOf(pair.b);
    if (!m_still.rests(a) && !m_still.rests(b)) return;
    m_still.note(a);
    m_still.note(b);
    m_areStillNoted = false;
}

// What stands still keeps all that the ledger knows of it but its weight.
void SteppedMotion::rememberBefore(const SteppedInput& input) {
    const bool isKnown = m_isAfterKnown && m_bodies.isMovingKnown() && !input.isFirst;
    m_isAfterKnown = false;
    findMoving();
    m_atBegin =
        isKnown ? m_after : invariantsOf(input.bodies, m_bodies.moving().bodies, input.state, input.gravity);
}

// Impulses of a sweep are not told apart: all are recorded under Contact.
void SteppedMotion::recordMotion(const SteppedInput& input, double duration) {
    m_after = invariantsOf(input.bodies, m_bodies.moving().bodies, input.state, input.gravity);
    m_isAfterKnown = true;
    const Vec3 change = duration * input.gravity;
    if (!m_weight.isKnown || m_weight.change != change)
        static_cast<Weight&>(m_weight) = {weightOf(input.bodies, m_islands.bodies(), change), change, true};
    recordDifference(m_atBegin, m_after, m_weight.sum, LedgerAccount::Contact, *input.ledger);
}

} // namespace carom
