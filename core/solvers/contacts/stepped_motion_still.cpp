// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/wide.h"
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
#include <tuple>
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
    m_stopped.clear();
    for (const std::uint32_t i : m_still.hold(stillInput(input, manifolds), m_candidates)) {
        m_stopped.push_back(m_islands.bodyOf(i));
        m_bodies.setMass(input, m_islands.bodyOf(i), i, true);
        m_bodies.stop(i);
    }
    stop(input.bodies, m_stopped, input.state, input.ledger);
    if (m_stopped.size() < m_candidates.size()) m_still.addUpLoads(stillInput(input, manifolds));
    holdPairs();
}

StandingStill::Input SteppedMotion::stillInput(const SteppedInput& input, const Manifolds& manifolds) {
    return {input, m_islands, m_pairs, manifolds, m_links, m_step};
}

// Updates what depends on which bodies stand still, where that has changed.
void SteppedMotion::noteStill(const SteppedInput& input, const Manifolds& manifolds) {
    m_still.addUpLoads(stillInput(input, manifolds));
    holdPairs();
}

void SteppedMotion::holdPairs() {
    const StillBodies& still = m_still.bodies();
    m_pairs.balls().hold(still.flags(), still.changed(), m_bodies.solved());
    m_islands.noteStill(still.flags());
    m_still.forgetChanges();
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
    for (const Watched& pair : m_found.watched) joinParts(pair.open.a, pair.open.b);
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

// Lets these bodies move on that stood still.
void SteppedMotion::moveOn(const SteppedInput& input, std::span<const std::uint32_t> numbers,
                           const Manifolds& manifolds) {
    m_bodies.forgetMoving();
    for (const std::uint32_t i : numbers) {
        m_still.moveOn(i);
        m_bodies.setMass(input, m_islands.bodyOf(i), i, false);
        m_bodies.noteFar(i); // its rows are those of an immobile body
        m_movedOn.push_back(m_islands.bodyOf(i));
    }
    noteStill(input, manifolds);
}

// What stands still keeps all that the ledger knows of it but its weight.
void SteppedMotion::rememberBefore(const SteppedInput& input) {
    const bool isKnown = m_isAfterKnown && m_bodies.isMovingKnown() && !input.isFirst;
    m_isAfterKnown = false;
    findMoving(input.workers);
    m_atBegin = isKnown ? m_after
                        : invariantsOf(input.bodies, m_bodies.moving().bodies, input.state, input.gravity,
                                       m_invariantTerms, input.workers);
}

// Impulses of a sweep are not told apart: all are recorded under Contact.
void SteppedMotion::recordMotion(const SteppedInput& input, double duration) {
    m_after = invariantsOf(input.bodies, m_bodies.moving().bodies, input.state, input.gravity,
                           m_invariantTerms, input.workers);
    m_isAfterKnown = true;
    const Vec3 change = duration * input.gravity;
    if (!m_weight.isKnown || m_weight.change != change)
        static_cast<Weight&>(m_weight) = {weightOf(input.bodies, m_islands.bodies(), change), change, true};
    recordDifference(m_atBegin, m_after, m_weight.sum, LedgerAccount::Contact, *input.ledger);
}

} // namespace carom
