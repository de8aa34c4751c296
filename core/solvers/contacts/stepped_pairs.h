// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/scratch.h"
#include "core/solvers/contacts/ball_rows.h"
#include "core/solvers/contacts/contact_rows.h"
#include "core/solvers/contacts/manifolds.h"
#include "core/solvers/contacts/pair_ends.h"
#include "core/solvers/contacts/pair_sort.h"
#include "core/solvers/contacts/stepped_input.h"
#include "core/solvers/contacts/stepped_islands.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// The pairs of a block of the base path, and the order in which passes go through them.
//
//     entries   all, in the order in which they were added
//     balls     pairs of balls, or of a ball and a wall, without rolling resistance: their rows last
//     general   the others, which have manifolds; in order they ascend, so that passes go from the top to the
//               ground

namespace carom {

/// What is known of a pair since the last update of its manifold. If it could not meet then, it is not
/// updated again while its gap along the normal of then, less what the two may have closed of it since, is
/// too large for them to meet.
struct OpenPair {
    std::uint32_t a = 0, b = 0;      ///< bodies of the solve
    Vec3 normal = Vec3::Zero();      ///< as of the last update
    double gap = 0;                  ///< along the normal [m]; 0 if the pair must be updated
    double radiusA = 0, radiusB = 0; ///< of the bodies, as far as they turn: 0 for balls [m]
    double slack = 0; ///< within it they may touch however slow they are [m]; 0 before its first update
    bool hasPoints = false;
    bool lacksRows = false; ///< it can meet; the gap is that of points without rows, 0 if there are none
};

class SteppedPairs {
  public:
    struct Entry {
        BodyPair pair;
        std::uint32_t place = Manifolds::none;
        double margin = 0;      ///< [m]
        bool isFresh = false;   ///< the manifold is of the present poses
        bool isNear = false;    ///< they touch, or soon do: solved before others, which are idle together
        bool isLate = false;    ///< came since its island was put in order, and is solved after that
        bool isFlipped = false; ///< of balls: B is the pair's first
        bool operator<(const Entry& other) const { return pair < other.pair; }
    };
    struct General {
        std::uint32_t entry = 0;
        OpenPair open;
        double heldDepth = -1; ///< overlap of two that stand still in contact, otherwise below 0 [m]
    };
    /// The law of the contact of a pair.
    struct Laws {
        double friction = 0, restitution = 0, rolling = 0, push = 0; ///< as in PairInput; push is above 0
        double size = 0;                                             ///< as in ContactPair [m]
    };

    /// None, for substeps of so many seconds.
    void begin(double substep);
    /// `step` is the length of the steps that follow [s].
    void add(const SteppedInput& input, const Entry& entry, const SteppedIslands& islands,
             std::span<const SolverBody> solved, double step, Manifolds& manifolds);
    /// Removes pairs of which `is(entry)` holds, with their manifolds. False if there are none.
    template<class Is>
    bool drop(const Is& is, SteppedIslands& islands, Manifolds& manifolds, NewNumbers& numbers,
              Workers& workers) {
        numbers.going.clear();
        workers.forLists(m_entries.size(), Workers::enoughOf(5), numbers.going,
                         [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& going) {
                             const std::span<const Entry> entries = m_entries;
                             for (std::size_t i = begin; i < end; ++i)
                                 if (is(entries[i])) going.push_back(static_cast<std::uint32_t>(i));
                         });
        if (numbers.going.empty()) return false;
        numbers.entries.assign(m_entries.size(), 0);
        for (const std::uint32_t i : numbers.going) {
            numbers.entries[i] = gone;
            if (m_entries[i].place != Manifolds::none) manifolds.remove(m_entries[i].place);
            islands.noteUnordered(m_entries[i].pair);
        }
        renumber(numbers.entries);
        m_balls.renumber(numbers.entries, immobile, workers);
        return true;
    }
    /// Appends those of marked islands, or all, with their present manifolds; of balls only those with a
    /// force.
    void handOver(const SteppedInput& input, const SteppedIslands& islands, bool all, double step,
                  Manifolds& manifolds, std::vector<Entry>& entries);
    /// Gives those of marked islands no new number.
    void findLeaving(const SteppedIslands& islands, std::vector<std::uint32_t>& newNumbers) const;
    /// Removes them, once bodies have their new numbers, too.
    void leave(NewNumbers& numbers);

    std::span<Entry> entries() { return m_entries; }
    std::span<const Entry> entries() const { return m_entries; }
    std::span<General> general() { return m_general; }
    std::span<const General> general() const { return m_general; }
    Entry& entryOf(std::uint32_t number) { return m_entries[m_general[number].entry]; }
    const Entry& entryOf(std::uint32_t number) const { return m_entries[m_general[number].entry]; }
    BallRows& balls() { return m_balls; }
    const BallRows& balls() const { return m_balls; }
    /// Of the general pairs.
    const PairEnds& ends(const SteppedIslands& islands, Workers& workers);
    void forgetEnds() { m_ends.forget(); }

    /// Of an entry.
    const Laws& lawsOf(const Bodies& bodies, std::uint32_t entry);
    /// The same of one that has had a row.
    const Laws& lawsOf(std::uint32_t entry) const { return m_laws[entry]; }
    /// What is the same for a pair at every look.
    PairInput inputOf(const Bodies& bodies, const SteppedIslands& islands, std::uint32_t entry);
    /// For lawsOf() and inputOf() by several threads.
    void beginLook() { m_laws.resize(m_entries.size()); }

    /// Puts the general pairs in order. False if they are.
    bool order();
    /// Sorts the pairs of balls of islands that are not in order.
    void orderBalls(const SteppedInput& input, SteppedIslands& islands);
    /// Whether the bodies of a pair are so near that they touch, or soon do.
    static bool isNear(const SteppedInput& input, BodyPair pair);

    /// visit(manifold) for every pair that is in contact, as of the last step, of so many seconds.
    template<class Visit>
    void forEachContact(const Bodies& bodies, const State& state, const Manifolds& manifolds, double step,
                        const Visit& visit) const {
        for (const General& pair : m_general)
            if (const PersistentManifold& manifold = manifolds[m_entries[pair.entry].place];
                manifold.count > 0 && !manifold.open)
                visit(manifold);
        m_balls.forEach([&](std::uint32_t index, const Vec3& normal, const Vec3& impulse) {
            if (impulse != Vec3::Zero())
                visit(manifoldOf(bodies, state, m_entries[index], normal, 1 / step * impulse));
        });
    }
    std::size_t bytes() const { return heldBytes(m_entries, m_general, m_balls); }

  private:
    static constexpr std::uint32_t immobile = SteppedIslands::immobile, gone = SteppedIslands::gone;

    void addBalls(const SteppedInput& input, const SteppedIslands& islands,
                  std::span<const SolverBody> solved, const ContactPair& laws, const Vec3& impulse);
    /// Of balls, with a force on the second body of their row [N].
    static PersistentManifold manifoldOf(const Bodies& bodies, const State& state, const Entry& entry,
                                         const Vec3& normal, const Vec3& force);
    void renumber(std::vector<std::uint32_t>& numbers);

    double m_substep = 0; // [s]
    std::vector<Entry> m_entries;
    std::vector<General> m_general;
    std::size_t m_ascending = 0; // so many of the first are in order
    BallRows m_balls;
    Scratch<std::vector<Laws>> m_laws; // by entry
    Derived<PairEnds> m_ends;
    Scratch<std::vector<General>> m_added;
    Scratch<PlacedPairs> m_placed; // to be put in order
    Scratch<PairSort<PlacedPair>> m_sort;
    Scratch<std::vector<std::uint32_t>> m_order;
};

} // namespace carom
