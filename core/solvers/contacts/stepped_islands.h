// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/held_bytes.h"
#include "core/base/scratch.h"
#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"
#include "core/solvers/contacts/sections.h"
#include "core/solvers/contacts/stepped_input.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

// The bodies of a block of the base path (stepped_motion.h), their numbers, and the islands that they are of.
//
//     number     of a body, from 1 on, in the order in which they were added; 0 stands for what cannot move
//     island     what pairs and springs join. One that is joined to another keeps its own number until
//                islands leave, and the bodies of both get that of the other by settle()
//     marked     the island leaves next; numbers of bodies and islands that stay are then closed up
//     unordered  of the island came or went so many pairs that it is put in order when the next frame begins:
//                divided into slabs anew (sections.h), and its pairs sorted

namespace carom {

/// New numbers of what stays when others leave, by the old ones; a caller keeps the memory.
struct NewNumbers {
    std::vector<std::uint32_t> entries, bodies;
    std::vector<std::uint32_t> going; ///< entries
};

class SteppedIslands {
  public:
    static constexpr std::uint32_t immobile = 0;
    static constexpr std::uint32_t gone = 0xffffffff; ///< new number of what does not stay

    /// Nobody, of a scene of so many bodies.
    void begin(std::size_t bodies);
    void clear();
    /// Bodies of a new island.
    void add(std::span<const BodyIndex> list);

    bool isEmpty() const { return m_list.empty(); }
    /// In the order they were added.
    std::span<const BodyIndex> bodies() const { return m_list; }
    BodyIndex bodyOf(std::size_t number) const { return m_list[number - 1]; }
    /// Numbers are below this.
    std::uint32_t numbers() const { return static_cast<std::uint32_t>(m_list.size() + 1); }
    std::uint32_t numberOf(BodyIndex body) const { return m_local[body]; }
    std::uint32_t numberAt(BodyIndex end) const { return end != noBody ? m_local[end] : immobile; }
    std::pair<std::uint32_t, std::uint32_t> numbersOf(BodyPair pair) const {
        return {m_local[pair.a], m_local[pair.b]};
    }
    /// The number of a mobile body of the pair.
    std::uint32_t memberOf(BodyPair pair) const {
        return m_local[pair.a] != immobile ? m_local[pair.a] : m_local[pair.b];
    }
    /// By body of the scene: its number, or 0.
    std::span<const std::uint32_t> local() const { return m_local; }

    std::size_t count() const { return m_groups.size() - m_joined; }
    /// The island of a body, or of a pair.
    std::uint32_t of(BodyIndex body) const { return rootOf(m_island[m_local[body]]); }
    std::uint32_t of(BodyPair pair) const { return rootOf(m_island[memberOf(pair)]); }
    /// What of() returns is below this.
    std::size_t islandNumbers() const { return m_groups.size(); }
    std::size_t bodiesOf(std::uint32_t island) const { return m_groups[island].bodies; }
    /// The islands of these two are one from now on.
    void join(BodyIndex one, BodyIndex other);
    void settle();
    /// By number, as of the last settle().
    std::span<const std::uint32_t> byNumber() const { return m_island; }

    /// The island will leave with the next leave().
    void mark(std::uint32_t island) {
        m_groups[island].leaves = true;
        m_isMarked = true;
    }
    bool isMarked(BodyIndex body) const { return m_isMarked && m_groups[of(body)].leaves; }
    bool isMarked(BodyPair pair) const { return m_isMarked && m_groups[of(pair)].leaves; }
    bool anyMarked() const { return m_isMarked; }
    /// Marks the islands of which `is(body)` holds for all bodies.
    template<class Is>
    void markWhere(const Is& is) {
        settle();
        m_isChosen.assign(m_groups.size(), 0);
        for (std::size_t i = 1; i < m_island.size(); ++i) m_isChosen[m_island[i]] = 1;
        for (std::size_t i = 1; i < m_island.size(); ++i)
            if (m_isChosen[m_island[i]] != 0 && !is(bodyOf(i))) m_isChosen[m_island[i]] = 0;
        for (std::uint32_t island = 0; island < m_groups.size(); ++island)
            if (m_isChosen[island] != 0) mark(island);
    }
    /// Removes marked islands. Gives the new numbers of bodies by the old ones.
    void leave(std::vector<std::uint32_t>& bodies);

    /// Whether some of its bodies stand still.
    bool hasStill(std::uint32_t island) const { return m_groups[rootOf(island)].hasStill; }
    void noteStill(std::span<const std::uint8_t> isStill);

    /// A pair has come or gone.
    void noteUnordered(BodyPair pair) {
        ++m_groups[of(pair)].unordered;
        m_isUnordered = true;
    }
    bool isUnordered(BodyPair pair) const { return m_groups[m_island[memberOf(pair)]].isUnordered(); }
    /// Divides unordered islands into slabs. False if there are none.
    bool divide(const SteppedInput& input);
    /// Numbers of the bodies that the last call divided.
    std::span<const std::uint32_t> divided() const { return m_divided; }
    /// The pairs of all islands are in order.
    void noteOrdered();
    SectionPlan& plan() {
        if (!m_plan.isMade()) m_plan.make(m_island, m_slab, m_groups.size());
        return m_plan;
    }
    std::size_t bytes() const { return heldBytes(m_list, m_local, m_island, m_slab, m_groups); }

  private:
    /// An island is unordered if more than one pair for so many of its bodies has come or gone since it was
    /// put in order. At half, passes go through more pairs out of order and through empty lanes; at twice,
    /// heaps that come to rest are put in order in every second frame.
    static constexpr std::size_t fewUnordered = 4;
    struct Group {
        std::uint32_t joined = 0; ///< the island that it has been joined to; its own number if none
        std::size_t bodies = 0;
        bool leaves = false;
        bool hasStill = false;     ///< bodies that stand still
        std::size_t unordered = 0; ///< pairs that came or went since it was put in order
        bool isUnordered() const { return fewUnordered * unordered > bodies; }
    };
    std::uint32_t rootOf(std::uint32_t island) const {
        while (m_groups[island].joined != island) island = m_groups[island].joined;
        return island;
    }

    std::vector<BodyIndex> m_list;
    std::vector<std::uint32_t> m_local; // by body of the scene: its number, or 0
    std::vector<std::uint32_t> m_island;
    std::vector<std::uint8_t> m_slab; // of the island, when it was put in order last
    std::vector<Group> m_groups;      // by what of() returns, and by what has been joined to another
    std::size_t m_joined = 0;         // of these that are part of another
    bool m_isSettled = true;          // m_island names islands
    bool m_isMarked = false;          // any of them
    bool m_isUnordered = false;       // pairs of some island came or went
    Scratch<std::vector<std::uint8_t>> m_isChosen;    // by island
    Scratch<std::vector<std::uint32_t>> m_newIslands; // by the old ones
    Derived<SectionPlan> m_plan;
    Scratch<Slabs> m_slabs;                        // of an island
    Scratch<std::vector<std::uint32_t>> m_divided; // numbers, by island
};

} // namespace carom
