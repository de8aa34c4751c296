// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/found_contacts.h"

#include "core/base/reserve.h"
#include "core/dynamics/contact_memory.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

namespace carom {

namespace {

/// Whether the gap of a pair is that of its bounding balls.
bool areBalls(const Bodies& bodies, BodyPair pair) {
    const auto isBall = [&](BodyIndex i) { return isSphere(bodies, i) || isWall(bodies.shape[i]); };
    return isBall(pair.a) && isBall(pair.b);
}

/// Pairs that one thread compares at least.
constexpr std::size_t fewCompared = Workers::enoughOf(1000);

/// What is remembered of pairs, which ascend.
class Memory {
  public:
    Memory(const ContactSet& remembered, BodyPair first)
        : m_remembered(remembered),
          m_next(std::ranges::lower_bound(remembered.pairs, first, {}, &ContactPair::bodies)) {}

    std::span<const ContactConstraint> of(BodyPair pair) {
        while (m_next != m_remembered.pairs.end() && m_next->bodies() < pair) ++m_next;
        if (m_next == m_remembered.pairs.end() || m_next->bodies() != pair) return {};
        return m_remembered.pointsOf(*m_next);
    }

  private:
    const ContactSet& m_remembered;
    std::vector<ContactPair>::const_iterator m_next;
};

} // namespace

void FoundContacts::find(const ManifoldInput& here, std::span<const BodyPair> candidates,
                         const Candidates& margins, const Refinement& refinement,
                         const ContactSet& remembered, WorkCounters& work, Workers& workers) {
    updateCarried(here, candidates, margins, refinement, workers, work);
    collideAnew(here, candidates, margins, remembered, workers, work);
    m_found.clear();
    m_found.reserve(candidates.size(), candidates.size());
    m_place.clear();
    m_canMeet.clear();
    m_gap.clear();
    m_memory.clear();
    m_isPending.clear();
    reserveFor(candidates.size(), m_gap);
    reserveFor(candidates.size(), m_memory);
    reserveFor(candidates.size(), m_isPending);
    m_apart.clear();
    Memory memory(remembered, {0, 0});
    auto anew = m_anew.pairs.cbegin();
    auto updated = m_updated.begin();
    for (const BodyPair pair : candidates) {
        const double margin = margins.marginOf(pair);
        const ContactPair contact = pairOf(here.bodies, pair, margin);
        if (updated != m_updated.end() && updated->pair == pair) {
            const std::uint32_t place = (updated++)->place;
            const PersistentManifold& manifold = m_manifolds[place];
            if (manifold.count == 0) {
                m_apart.push_back({pair, place, true});
                continue;
            }
            m_found.pairs.push_back(contact);
            m_place.push_back(place);
            m_canMeet.push_back(manifold.open ? 0 : 1);
            m_gap.push_back(manifold.open || manifold.round ? manifold.gap : 0);
            m_memory.emplace_back();
            m_isPending.push_back(0);
            continue;
        }
        double gap = std::numeric_limits<double>::infinity();
        const bool isPending = areBalls(here.bodies, pair);
        if (isPending) {
            gap = boundingGap(here.bodies, here.state, pair);
            if (gap > margin) continue;
            m_found.pairs.push_back(contact);
        } else {
            if (anew == m_anew.pairs.cend() || anew->bodies() != pair) continue;
            m_found.append(*anew, m_anew.pointsOf(*anew));
            ++anew;
            for (const ContactConstraint& point : m_found.pointsOf(m_found.pairs.back()))
                gap = std::min(gap, point.separation);
        }
        m_memory.push_back(isPending ? memory.of(pair) : std::span<const ContactConstraint>{});
        m_isPending.push_back(isPending ? 1 : 0);
        m_place.push_back(Manifolds::none);
        m_canMeet.push_back(carom::canMeet(here, pair, gap) ? 1 : 0);
        m_gap.push_back(gap);
    }
}

// Updates the manifolds of the candidates that have one, or get one; lists the others that are carried as
// distant.
void FoundContacts::updateCarried(const ManifoldInput& here, std::span<const BodyPair> candidates,
                                  const Candidates& margins, const Refinement& refinement, Workers& workers,
                                  WorkCounters& work) {
    m_updated.clear();
    m_distant.clear();
    auto carried = m_manifolds.entries().begin();
    const auto carriedEnd = m_manifolds.entries().end();
    for (const BodyPair pair : candidates) {
        for (; carried != carriedEnd && carried->pair < pair; ++carried)
            m_distant.push_back({carried->pair, carried->place});
        if (carried != carriedEnd && carried->pair == pair)
            m_updated.push_back({pair, (carried++)->place});
        else if (refinement.isStepped(here.bodies, pair))
            m_updated.push_back({pair, m_manifolds.add(pair)});
    }
    for (; carried != carriedEnd; ++carried) m_distant.push_back({carried->pair, carried->place});
    std::atomic<std::size_t> collided = 0;
    workers.forRanges(m_updated.size(), fewManifolds, [&](std::size_t begin, std::size_t end) {
        std::size_t count = 0;
        for (const Manifolds::Entry& entry : std::span(m_updated).subspan(begin, end - begin))
            count += updateManifold(here, margins.marginOf(entry.pair), m_manifolds[entry.place]) ? 1 : 0;
        collided += count;
    });
    work.pairsCollided += collided;
}

// Finds the contacts of the candidates without a manifold, but for those of balls.
void FoundContacts::collideAnew(const ManifoldInput& here, std::span<const BodyPair> candidates,
                                const Candidates& margins, const ContactSet& remembered, Workers& workers,
                                WorkCounters& work) {
    m_pairs.clear();
    auto updated = m_updated.begin();
    for (const BodyPair pair : candidates)
        if (updated != m_updated.end() && updated->pair == pair)
            ++updated;
        else if (!areBalls(here.bodies, pair))
            m_pairs.push_back(pair);
    work.pairsCollided += m_pairs.size();
    const std::span<ContactSet> parts = workers.forKeptLists(
        m_pairs.size(), fewCompared, m_parts, [&](std::size_t begin, std::size_t end, ContactSet& set) {
            if (begin == end) return;
            Memory memory(remembered, m_pairs[begin]);
            for (const BodyPair pair : std::span(m_pairs).subspan(begin, end - begin))
                collideInto(here.bodies, here.state, pairOf(here.bodies, pair, margins.marginOf(pair)),
                            memory.of(pair), set);
        });
    std::swap(m_anew, parts.front());
    for (const ContactSet& part : parts.subspan(1))
        for (const ContactPair& pair : part.pairs) m_anew.append(pair, part.pointsOf(pair));
}

void FoundContacts::findPoints(const ManifoldInput& here, std::uint32_t index, WorkCounters& work) {
    m_isPending[index] = 0;
    m_fresh.clear();
    ++work.pairsCollided;
    ContactPair& found = m_found.pairs[index];
    collideInto(here.bodies, here.state, found, m_memory[index], m_fresh);
    found.first = static_cast<std::uint32_t>(m_found.points.size());
    found.count = 0;
    if (m_fresh.pairs.empty()) return;
    found.count = m_fresh.pairs.front().count;
    found.resolution = m_fresh.pairs.front().resolution;
    m_found.points.insert(m_found.points.end(), m_fresh.points.begin(), m_fresh.points.end());
}

void FoundContacts::makeExact(const ManifoldInput& here, std::span<const std::uint32_t> pairs,
                              WorkCounters& work) {
    for (const std::uint32_t index : pairs) {
        if (m_place[index] != Manifolds::none) {
            m_scratch.clear();
            appendTo(m_scratch, here, m_found.pairs[index], m_manifolds[m_place[index]]);
            m_memory[index] = m_scratch.points;
        } else if (m_isPending[index] == 0) {
            continue;
        }
        findPoints(here, index, work);
        m_memory[index] = {};
    }
}

void FoundContacts::makeManifolds(const ManifoldInput& here, std::span<const std::uint32_t> pairs,
                                  WorkCounters& work) {
    for (const std::uint32_t index : pairs) {
        if (m_place[index] != Manifolds::none) continue;
        if (m_isPending[index] != 0) findPoints(here, index, work);
        const ContactPair& pair = m_found.pairs[index];
        PersistentManifold manifold = manifoldOf(here, pair, m_found.pointsOf(pair));
        ++work.pairsCollided;
        updateManifold(here, pair.margin, manifold);
        m_place[index] = m_manifolds.add(manifold);
    }
}

void FoundContacts::updateManifolds(const ManifoldInput& here, std::span<const std::uint32_t> pairs,
                                    WorkCounters& work) {
    for (const std::uint32_t index : pairs)
        if (m_place[index] != Manifolds::none)
            work.pairsCollided +=
                updateManifold(here, m_found.pairs[index].margin, m_manifolds[m_place[index]]) ? 1 : 0;
}

void FoundContacts::removeManifolds(std::span<const std::uint32_t> pairs) {
    for (const std::uint32_t index : pairs)
        if (m_place[index] != Manifolds::none)
            m_manifolds.remove(std::exchange(m_place[index], Manifolds::none));
}

// Lists pairs in contact and pairs that are apart, ascending.
void FoundContacts::list() {
    m_listed.clear();
    auto apart = m_apart.begin();
    for (std::size_t i = 0; i < m_place.size(); ++i) {
        if (m_place[i] == Manifolds::none) continue;
        const BodyPair pair = m_found.pairs[i].bodies();
        while (apart != m_apart.end() && apart->pair < pair) m_listed.push_back(*apart++);
        m_listed.push_back({pair, m_place[i], true});
    }
    m_listed.insert(m_listed.end(), apart, m_apart.end());
}

std::span<Manifolds::Entry> FoundContacts::known() {
    list();
    m_known.clear();
    std::merge(m_listed.begin(), m_listed.end(), m_distant.begin(), m_distant.end(),
               std::back_inserter(m_known));
    return m_known;
}

// Removes the manifolds of some known entries, in ascending order, except those that have been taken over.
void FoundContacts::drop(std::span<const Manifolds::Entry> entries) {
    auto known = m_known.begin();
    for (const Manifolds::Entry& entry : entries) {
        while (known != m_known.end() && known->pair < entry.pair) ++known;
        const bool isTaken =
            known != m_known.end() && known->pair == entry.pair && known->place == Manifolds::none;
        if (!isTaken) m_manifolds.remove(entry.place);
    }
}

void FoundContacts::dropDistant() {
    drop(m_distant);
    m_distant.clear();
    m_known.clear();
}

void FoundContacts::carryOn(std::span<const Manifolds::Entry> others) {
    list();
    m_manifolds.exchange(m_listed);
    carryWith(others);
}

void FoundContacts::carryWith(std::span<const Manifolds::Entry> others) {
    const std::span<const Manifolds::Entry> carried = m_manifolds.entries();
    m_known.clear();
    std::merge(carried.begin(), carried.end(), others.begin(), others.end(), std::back_inserter(m_known));
    m_manifolds.exchange(m_known);
    m_known.clear();
}

} // namespace carom
