// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/workers.h"
#include "core/dynamics/contact_constraint.h"
#include "core/dynamics/work_counters.h"
#include "core/shapes/manifold.h"
#include "core/solvers/contacts/candidates.h"
#include "core/solvers/contacts/manifolds.h"
#include "core/solvers/contacts/refinement.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

// The contacts of a substep, in two forms. Bodies that took the base path in the substep before have their
// contacts carried along as manifolds; the others have them found anew by the exact kernels, with the forces
// they had. Contacts of bodies that change form are converted.
//
//     found      pairs with points, or that may come to touch; with a manifold or without. Points of
//                balls are computed only when they are asked for.
//     apart      pairs whose manifold is kept for the direction in which they are apart
//     distant    manifolds of pairs that cannot touch within the substep; dropped if not taken over

namespace carom {

class FoundContacts {
  public:
    FoundContacts() {
        for (ContactSet* set : {&m_scratch, &m_fresh}) set->reserve(1, Manifold::capacity);
    }
    /// `remembered` are the contacts with forces of those that have no manifolds.
    void find(const ManifoldInput& here, std::span<const BodyPair> candidates, const Candidates& margins,
              const Refinement& refinement, const ContactSet& remembered, WorkCounters& work,
              Workers& workers = Workers::alone());

    const ContactSet& set() const { return m_found; }
    /// By pair of the set, 1: its bodies may touch within the substep.
    std::span<const std::uint8_t> canMeet() const { return m_canMeet; }
    /// By pair of the set: a lower bound of the gap [m]; 0 if its bodies may touch.
    std::span<const double> gaps() const { return m_gap; }
    Manifolds& manifolds() { return m_manifolds; }
    const Manifolds& manifolds() const { return m_manifolds; }
    void recall(const Manifolds& manifolds) { m_manifolds = manifolds; }

    /// Computes the points of some of the pairs at the present poses by the exact kernels. Their manifolds
    /// are kept as well, for islands that remain unfinished.
    void makeExact(const ManifoldInput& here, std::span<const std::uint32_t> pairs, WorkCounters& work);
    /// Makes manifolds of some of the pairs.
    void makeManifolds(const ManifoldInput& here, std::span<const std::uint32_t> pairs, WorkCounters& work);
    /// Updates the manifolds of some of the pairs to the present poses.
    void updateManifolds(const ManifoldInput& here, std::span<const std::uint32_t> pairs, WorkCounters& work);
    /// Removes the manifolds of some of the pairs.
    void removeManifolds(std::span<const std::uint32_t> pairs);
    /// The manifold of a pair, if it has one.
    std::uint32_t placeOf(std::uint32_t pair) const { return m_place[pair]; }

    /// The same, to take over. All pairs of its bodies that may touch must be taken.
    std::uint32_t take(std::uint32_t pair) { return std::exchange(m_place[pair], Manifolds::none); }

    /// All manifolds, ascending. A caller that takes one over sets its place to none, and takes all pairs of
    /// its bodies.
    std::span<Manifolds::Entry> known();
    /// Forgets the pairs whose bodies were taken; drops what is apart or distant and was not taken over.
    template<class IsTaken>
    void forgetTaken(const IsTaken& isTaken) {
        for (std::size_t i = 0; i < m_place.size(); ++i)
            if (isTaken(m_found.pairs[i].bodies())) m_place[i] = Manifolds::none;
        std::vector<Manifolds::Entry>& dropped = m_listed;
        dropped.clear();
        for (const Manifolds::Entry& entry : m_apart)
            if (isTaken(entry.pair)) dropped.push_back(entry);
        drop(dropped);
        std::erase_if(m_apart, [&](const Manifolds::Entry& entry) { return isTaken(entry.pair); });
        dropDistant();
    }
    /// Drops manifolds of distant pairs.
    void dropDistant();
    /// Keeps the manifolds of the pairs, and `others`, ascending, for the next substep.
    void carryOn(std::span<const Manifolds::Entry> others);
    /// Keeps `others` in addition.
    void carryWith(std::span<const Manifolds::Entry> others);

  private:
    void updateCarried(const ManifoldInput& here, std::span<const BodyPair> candidates,
                       const Candidates& margins, const Refinement& refinement, Workers& workers,
                       WorkCounters& work);
    void collideAnew(const ManifoldInput& here, std::span<const BodyPair> candidates,
                     const Candidates& margins, const ContactSet& remembered, Workers& workers,
                     WorkCounters& work);
    void findPoints(const ManifoldInput& here, std::uint32_t pair, WorkCounters& work);
    void list();
    void drop(std::span<const Manifolds::Entry> entries);

    Manifolds m_manifolds;
    ContactSet m_found, m_scratch, m_fresh, m_anew;
    std::vector<BodyPair> m_pairs;                            // that are compared anew
    std::vector<ContactSet> m_parts;                          // of m_anew, as threads find them
    std::vector<std::uint8_t> m_canMeet;                      // by pair of m_found
    std::vector<double> m_gap;                                // by pair of m_found [m]
    std::vector<std::span<const ContactConstraint>> m_memory; // by pair of m_found: what is remembered of it
    std::vector<std::uint8_t> m_isPending; // by pair of m_found: its points are to be found
    std::vector<std::uint32_t> m_place;    // by pair of m_found: its manifold, or none
    std::vector<Manifolds::Entry> m_apart, m_distant, m_listed, m_known, m_updated;
};

} // namespace carom
