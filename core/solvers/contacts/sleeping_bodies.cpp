// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/sleeping_bodies.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace carom {
namespace {

/// Calls onPair(set, pair) for the pairs of both sets, ascending.
template<class OnPair>
void eachPair(const ContactSet& one, const ContactSet& other, const OnPair& onPair) {
    auto next = other.pairs.begin();
    for (const ContactPair& pair : one.pairs) {
        while (next != other.pairs.end() && next->bodies() < pair.bodies()) onPair(other, *next++);
        onPair(one, pair);
    }
    while (next != other.pairs.end()) onPair(other, *next++);
}

} // namespace

void SleepingBodies::putToSleep(std::span<const BodyIndex> island) {
    for (std::size_t i = 0; i < island.size(); ++i) m_next[island[i]] = island[(i + 1) % island.size()];
    m_fallenAsleep.insert(m_fallenAsleep.end(), island.begin(), island.end());
    m_changed = true;
}

void SleepingBodies::wake(BodyIndex body, std::vector<BodyIndex>& woken) {
    while (isAsleep(body)) {
        woken.push_back(body);
        const BodyIndex next = m_next[body];
        m_next[body] = noBody;
        body = next;
    }
    m_changed = true;
}

void SleepingBodies::exchange(const Bodies& bodies, ContactSet& moving) {
    // Each set has room for all pairs, so that nothing is allocated when the first or the last bodies come to
    // rest.
    const std::size_t pairs = m_contacts.pairs.size() + moving.pairs.size();
    const std::size_t points = m_contacts.points.size() + moving.points.size();
    for (ContactSet* set : std::initializer_list<ContactSet*>{&m_contacts, &m_rests, &m_moves})
        set->reserve(pairs, points);
    if (!m_changed) return;
    m_changed = false;
    m_bodies.insert(m_bodies.end(), m_fallenAsleep.begin(), m_fallenAsleep.end());
    m_fallenAsleep.clear();
    std::erase_if(m_bodies, [&](BodyIndex i) { return !isAsleep(i); });
    std::sort(m_bodies.begin(), m_bodies.end());
    m_rests.clear();
    m_moves.clear();
    m_deepest = 0;
    eachPair(m_contacts, moving, [&](const ContactSet& set, const ContactPair& pair) {
        const bool rest = isAsleep(bodies.mobile[pair.a] != 0 ? pair.a : pair.b);
        (rest ? m_rests : m_moves).append(pair, set.pointsOf(pair));
        if (!rest) return;
        for (const ContactConstraint& point : set.pointsOf(pair))
            m_deepest = std::max(m_deepest, -point.separation);
    });
    std::swap<ContactSet>(m_contacts, m_rests);
    std::swap<ContactSet>(moving, m_moves);
}

void SleepingBodies::record(const Bodies& bodies, const State& state, const Vec3& gravity, double duration,
                            Ledger& ledger) const {
    double mass = 0;
    for (const BodyIndex i : m_bodies) mass += bodies.mass[i];
    const Vec3 weight = (mass * duration) * gravity;
    ledger[LedgerAccount::Gravity].momentum += weight;
    Vec3 pull = Vec3::Zero(); // [N s]
    const auto sleeps = [this](BodyIndex i) { return i != noBody && isAsleep(i); };
    for (const SpringForce& spring : bodies.springs)
        if (sleeps(spring.from) != sleeps(spring.to))
            pull += (sleeps(spring.to) ? duration : -duration) * forceOf(spring, state);
    ledger[LedgerAccount::Spring].momentum += pull;
    ledger[LedgerAccount::Contact].momentum -= weight + pull;
}

ContactSet merged(const ContactSet& one, const ContactSet& other) {
    ContactSet all;
    eachPair(one, other,
             [&](const ContactSet& set, const ContactPair& pair) { all.append(pair, set.pointsOf(pair)); });
    return all;
}

} // namespace carom
