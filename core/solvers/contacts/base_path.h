// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/contacts/islands.h"
#include "core/solvers/contacts/neighbours.h"
#include "core/solvers/contacts/pair_ends.h"
#include "core/solvers/contacts/pair_sort.h"
#include "core/solvers/contacts/stepped_motion.h"

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <vector>

// The bodies on the base path: they enter with all pairs that can touch for some time, so that substeps need
// no search.
//
//     reach    how far a body's surface can move within a frame, with a multiple of its last substep for
//              impacts, and how much further if another strikes it, in the substep in which it does; then it
//              is renewed
//     pairs    those of the neighbours' lists within the reach of both
//     islands  bodies that such pairs join. Contacts of small ones are updated more often and in smaller
//              steps: bodies that turn touch at other points, and an impact passes through a chain of bodies
//              by a few of them a pass. So there is a block of bodies for every division of the substep.
//     levels   while an island of many bodies lies on each other in many levels, its block makes twice the
//              passes: one takes too little of its slow modes (velocity_solve.h). A body is on the level of
//              the least number of contacts that lead from it to something immobile, through bodies that are
//              slow; levels are counted once in a number of frames
//     renewal  if some bodies of an island may move beyond their reach, their pairs are found anew; at the
//              start of a frame also those of bodies that need far less than they have, pairs that can no
//              longer meet are removed, and all pairs of such an island are sorted again, or at once where
//              more than a quarter of its bodies have new pairs
//     leaving  single islands leave, and may enter again: those that refinement is to try again, that have
//              too many contacts for their block's division, or that meet another block. Bodies at rest stay
//              for many frames.

namespace carom {

/// What decides how an island divides a substep.
struct ContactCount {
    std::size_t points = 0;
    bool round = true; ///< all of them are of balls
    void add(int count, bool isRound) {
        points += static_cast<std::size_t>(count);
        round = round && isRound;
    }
    void add(const ContactCount& other) {
        points += other.points;
        round = round && other.round;
    }
};

class BasePath {
  public:
    using Entry = SteppedMotion::Entry;

    /// The passes of each division are multiplied by `passes`.
    BasePath(std::size_t bodies, int passes)
        : m_passes(passes), m_reach(bodies, 0.0), m_origin(bodies), m_block(bodies, noBlock),
          m_lastBlock(bodies, noBlock), m_renewal(bodies, 0) {}

    bool isEmpty() const { return m_isEmpty; }
    bool has(BodyIndex body) const { return isHere(m_block[body]); }
    /// By body: the number of its block; 0 for bodies that are not on the base path.
    std::span<const std::uint8_t> blockOf() const { return m_block; }
    std::size_t islands() const;
    /// When a frame begins: marks all islands if a body is elsewhere, or has another velocity, than the last
    /// substep left it. True if so.
    bool markIfMoved(const State& state, Workers& workers);
    /// Ensures that the pairs are valid for another substep, for which the neighbours have followed the
    /// bodies. Bodies that may move beyond their reach, or be struck by such a body, get a new reach for
    /// `time` [s] and `skin` times their size, and the pairs within it. False if some islands are marked:
    /// those must leave.
    bool renew(const SteppedInput& input, double time, double skin, Neighbours& neighbours,
               Broadphase& broadphase, Manifolds& manifolds);
    /// Whether a body stands still on the base path.
    bool isStill(BodyIndex body) const { return has(body) && blockWith(body).isStill(body); }
    /// Calls visit(body) for those that stood still, and moved on in the last substep.
    template<class Visit>
    void forEachMovedOn(const Visit& visit) const {
        for (const SteppedMotion& block : m_blocks)
            if (!block.isEmpty()) std::ranges::for_each(block.movedOn(), visit);
    }

    /// Computes the reach of bodies that are to enter, ascending: how far they may move within `time` [s],
    /// and `skin` times their size more. False if the neighbours must be searched and this be called again.
    bool prepare(const SteppedInput& input, std::span<const BodyIndex> list, double time, double skin,
                 Neighbours& neighbours);
    /// The bodies that were prepared enter. `known` are existing manifolds, ascending; those of pairs that
    /// enter are taken over: their place becomes Manifolds::none.
    void enter(const SteppedInput& input, std::span<const BodyIndex> list, const Neighbours& neighbours,
               std::span<const BodyPair> links, double substep, std::span<Manifolds::Entry> known,
               Manifolds& manifolds);
    /// Islands enter for a single substep, with the pairs that may touch within it: `pairs` are those of the
    /// first, then of the second, and so on.
    void enterBriefly(const SteppedInput& input, std::span<const Island> islands,
                      std::span<const Entry> pairs, double substep, Manifolds& manifolds);
    SteppedReport advance(const SteppedInput& input, Manifolds& manifolds);
    /// visit(manifold) for every pair that is in contact, as of the last substep.
    template<class Visit>
    void forEachContact(const Bodies& bodies, const State& state, const Manifolds& manifolds,
                        const Visit& visit) const {
        for (const SteppedMotion& block : m_blocks)
            if (!block.isEmpty()) block.forEachContact(bodies, state, manifolds, visit);
    }
    bool anyMarked() const {
        return std::any_of(m_blocks.begin(), m_blocks.end(), [](const SteppedMotion& block) {
            return !block.isEmpty() && block.islands().anyMarked();
        });
    }
    /// Marks the island of a body on the base path: it is to leave.
    void mark(BodyIndex body) {
        SteppedMotion& block = blockWith(body);
        block.islands().mark(block.islands().of(body));
    }
    /// Whether some body stands still in the island of this body on the base path.
    bool hasStill(BodyIndex body) const {
        const SteppedMotion& block = m_blocks[m_block[body] - 1u];
        return block.islands().hasStill(block.islands().of(body));
    }
    /// Marks the islands of which `is(body)` holds for all bodies.
    template<class Is>
    void markIslands(const Is& is) {
        for (SteppedMotion& block : m_blocks)
            if (!block.isEmpty()) block.islands().markWhere(is);
    }
    /// Lets bodies of which `is(body)` holds stand still from now on, if the forces on them balance
    /// (still_bodies.h).
    template<class Is>
    void hold(const SteppedInput& input, const Manifolds& manifolds, const Is& is) {
        for (SteppedMotion& block : m_blocks)
            if (!block.isEmpty()) block.hold(input, manifolds, is);
    }
    /// Sets what slowestTime() (calm.h) gives of their island, by body at the end of a spring [s].
    void findSlowest(const SteppedInput& input, std::vector<double>& slowest) {
        for (SteppedMotion& block : m_blocks)
            if (!block.isEmpty()) block.findSlowest(input, slowest);
    }
    std::size_t stillBodies() const {
        std::size_t sum = 0;
        for (const SteppedMotion& block : m_blocks) sum += block.isEmpty() ? 0 : block.stillBodies();
        return sum;
    }
    /// Counts levels, if it is time: when a frame begins.
    void countLevels(const SteppedInput& input, const Manifolds& manifolds);
    /// Marks islands that, as of the last substep, have so many contacts that they would enter another block,
    /// of a coarser division: they have grown since they entered. True if there are any.
    bool markOutgrown(const Manifolds& manifolds, Workers& workers = Workers::alone());
    std::size_t bytes() const;
    /// Removes marked islands. `left` are their bodies; appends their manifolds, which remain in use.
    void leaveMarked(const SteppedInput& input, Manifolds& manifolds, std::vector<BodyIndex>& left,
                     std::vector<Manifolds::Entry>& carried);
    /// Removes all islands, and appends their manifolds.
    void leave(const SteppedInput& input, Manifolds& manifolds, std::vector<Manifolds::Entry>& carried);
    /// Removes all islands and drops their manifolds.
    void clear();

    /// How an island with such contacts divides a substep.
    static Division divisionFor(const ContactCount& count, int passes);
    /// How an island that is not on the base path would divide it: as the last time it was, or by its
    /// contacts. The stiffness of contacts depends on the division, so bodies rise or sink a little when it
    /// changes.
    Division divisionFor(const Island& island, const ContactCount& count) const;

  private:
    static constexpr std::uint8_t noBlock = 0, entering = 0xff; // otherwise a number of m_blocks and 1
    static constexpr std::size_t divisions = 8;
    static bool isHere(std::uint8_t block) { return block != noBlock && block != entering; }
    /// Bodies with one division. An empty block takes no memory in a copy, such as in a checkpoint.
    class Block {
      public:
        Block() = default;
        Block(const Block& other) { *this = other; }
        Block(Block&&) noexcept = default;
        Block& operator=(Block&&) noexcept = default;
        ~Block() = default;
        Block& operator=(const Block& other) {
            const bool isEmpty = other.m_motion == nullptr || other.m_motion->isEmpty();
            m_motion = isEmpty ? nullptr : std::make_unique<SteppedMotion>(*other.m_motion);
            return *this;
        }
        operator SteppedMotion&() {
            if (m_motion == nullptr) m_motion = std::make_unique<SteppedMotion>();
            return *m_motion;
        }
        operator const SteppedMotion&() const {
            static const SteppedMotion none{};
            return m_motion != nullptr ? *m_motion : none;
        }
        std::size_t bytes() const {
            return m_motion != nullptr ? sizeof(SteppedMotion) + pieceOverhead + m_motion->bytes() : 0;
        }

      private:
        std::unique_ptr<SteppedMotion> m_motion;
    };
    struct Renewed {
        BodyIndex body = 0;
        double reach = 0;        // [m]
        bool isNarrowed = false; // it had more than it needs
    };
    struct Present {
        BodyPair pair;
    };
    /// Pairs of bodies that enter: from each to those of larger index, and to others that are here.
    using Paired = UpAndDown<Entry>;
    /// Pairs that bodies with a new reach need, and bodies of different blocks that may meet.
    struct Missing {
        std::vector<Entry> entries;
        std::vector<BodyIndex> parting;

        void append(const Missing& later) {
            entries.insert(entries.end(), later.entries.begin(), later.entries.end());
            parting.insert(parting.end(), later.parting.begin(), later.parting.end());
        }
    };
    double pathOf(const SteppedInput& input, BodyIndex body, double time, const Neighbours& neighbours) const;
    /// What is left of a body's reach [m].
    double roomOf(const SteppedInput& input, BodyIndex body) const {
        return m_reach[body] -
               Neighbours::displacement(input.bodies, body, m_origin[body], input.state.pose[body]);
    }
    void findOutrun(const SteppedInput& input, double time, double skin, const Neighbours& neighbours);
    double ownReach(const SteppedInput& input, BodyIndex body, double time, double skin,
                    const Neighbours& neighbours) const;
    static double kickOf(const SteppedInput& input, BodyIndex body, BodyIndex striker,
                         const Neighbours& neighbours);
    void findStruck(const SteppedInput& input, double time, double skin, const Neighbours& neighbours);
    void strikeAround(const SteppedInput& input, const Renewed& renewed, double time, double skin,
                      const Neighbours& neighbours, std::vector<BodyIndex>& struck);
    bool coversRenewed(Neighbours& neighbours) const;
    void orderWhereMany();
    void findMissing(const SteppedInput& input, BodyIndex i, const Neighbours& neighbours,
                     Missing& missing) const;
    void loadPairs(const SteppedInput& input, Neighbours& neighbours, Manifolds& manifolds);
    SteppedMotion& block(std::size_t number) { return m_blocks[number]; }
    SteppedMotion& blockWith(BodyIndex body) { return block(m_block[body] - 1u); }
    const SteppedMotion& blockWith(BodyIndex body) const { return m_blocks[m_block[body] - 1u]; }
    double roomLeft(const SteppedInput& input, BodyIndex body) const;
    double marginOf(const SteppedInput& input, BodyPair pair) const;
    bool coversThoseHere(Neighbours& neighbours) const;
    void findPairs(const SteppedInput& input, std::span<const BodyIndex> list, const Neighbours& neighbours,
                   std::span<Manifolds::Entry> known);
    ContactCount countOf(const Island& island, const Manifolds& manifolds) const;
    std::uint8_t numberFor(const Island& island, const Manifolds& manifolds, Workers& workers);
    void addIsland(const SteppedInput& input, const Island& island, std::uint8_t number, double substep);
    std::uint32_t levelsOf(const SteppedInput& input, SteppedMotion& block, const Manifolds& manifolds);
    void countContacts(std::size_t number, const Manifolds& manifolds, Workers& workers);
    void loadMember(const SteppedInput& input, BodyIndex member, std::uint8_t number, Entry& entry,
                    Manifolds& manifolds);
    /// The body of a pair that is on the base path already, or noBody.
    BodyIndex hereOf(BodyPair pair) const { return has(pair.a) ? pair.a : has(pair.b) ? pair.b : noBody; }

    int m_passes = 1;
    bool m_isEmpty = true;
    bool m_isTall = false; // the block of large islands that are not of balls alone, when levels were counted
    int m_untilLevels = 0; // frames until they are counted again
    Scratch<PairEnds> m_ends;                               // of pairs in contact; bodies are numbered from 1
    Scratch<std::vector<BodyPair>> m_touching;              // these
    Scratch<std::vector<std::uint32_t>> m_level, m_reached; // by number; in the order they are reached
    std::vector<double> m_reach;                            // by body [m]
    std::vector<Pose> m_origin;                             // by body: its pose when its reach was computed
    std::vector<std::uint8_t> m_block;                      // by body
    std::vector<std::uint8_t> m_lastBlock;                  // by body: the block it was in last
    std::array<Block, divisions> m_blocks;
    Scratch<std::vector<Entry>> m_entering, m_leaving;
    Scratch<Paired> m_paired;
    Scratch<Missing> m_missing;
    Scratch<std::array<std::vector<ContactCount>, divisions>> m_counts; // by block and island, if counted
    Scratch<NewNumbers> m_newNumbers;
    Scratch<std::vector<BodyPair>> m_pairs; // of m_entering
    Scratch<Islands> m_islands;
    Scratch<std::vector<std::uint8_t>> m_numbers;                      // by island that enters: its block
    Scratch<std::array<std::vector<std::size_t>, divisions>> m_outrun; // by block and island: bodies
    Scratch<std::vector<Renewed>> m_needed;                            // by bodies of a block
    Scratch<std::vector<double>> m_kick;                               // by body, of those that enter [m]
    Scratch<std::vector<double>> m_room; // by body: what is left of its reach in this substep [m]
    std::vector<Renewed> m_renewed;
    Scratch<std::vector<Renewed>> m_outrunners; // of these, before others that they may strike
    std::vector<std::uint32_t> m_renewal;       // by body: its number in m_renewed and 1, or 0
    Scratch<std::vector<double>> m_raised;      // by body: what others give it by striking it, or 0 [m]
    Scratch<std::vector<BodyIndex>> m_struck;   // and those that had reach enough; some are named twice
    Scratch<std::vector<Present>> m_present;    // pairs of renewed bodies that are here
    Scratch<PairSort<Present>> m_sort;
};

} // namespace carom
