// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/scratch.h"
#include "core/base/workers.h"
#include "core/dynamics/forced_steps.h"
#include "core/dynamics/invariant_terms.h"
#include "core/dynamics/ledger.h"
#include "core/dynamics/work_counters.h"
#include "core/solvers/contacts/ball_rows.h"
#include "core/solvers/contacts/contact_rows.h"
#include "core/solvers/contacts/energy_limit.h"
#include "core/solvers/contacts/manifolds.h"
#include "core/solvers/contacts/pair_ends.h"
#include "core/solvers/contacts/spring_limit.h"
#include "core/solvers/contacts/spring_rows.h"
#include "core/solvers/contacts/standing_still.h"
#include "core/solvers/contacts/stepped_bodies.h"
#include "core/solvers/contacts/stepped_input.h"
#include "core/solvers/contacts/stepped_islands.h"
#include "core/solvers/contacts/stepped_pairs.h"
#include "core/solvers/contacts/turning_bodies.h"
#include "core/solvers/contacts/velocity_solve.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

// The base path of `contacts`: moves any bodies with any contacts through the substeps of a frame at a cost
// that is known beforehand,
//
//     contact points × looks × steps × passes
//
// whatever their shapes, restitution and friction. Forces are found by sweeps over four contacts at a time
// (velocity_solve.h). What accuracy this has is a matter of the number of substeps; islands that are worth it
// and within the budget are refined instead (island_motion.h).
//
//     begin      no bodies
//     add        islands, and the pairs that may touch until the end: for a frame, pairs are searched once
//     advance    substep after substep: contacts are updated in a few looks, with steps from look to look
//     leave      some islands leave, and their forces become part of the manifolds again; the others stay
//                as they are, to the bit
//     end        all leave
//
// Within a frame, a look keeps the rows of pairs that have moved little against each other, and makes anew
// only those of others (stepped_motion_keeping.cpp). Contacts that roll keep theirs only as long as their
// points would be kept if they did not follow (manifolds.h).
//
// Pairs that do not meet as they move (open manifolds, idle balls) have no rows, but are watched. If impulses
// have changed the velocity of a body so that a pair would close its gap within the step, its contact is
// found, and the solve of the step continues with it; this may happen a few times in a step, as impulses are
// passed on.
//
// Where a body turns far within a look, its contacts are found anew in between, where the two will be nearest
// (stepped_motion_ahead.cpp): a rim that is held where it was at the start passes over that point, and sinks
// in beside it. Where an impact within the step makes it turn, they are found once more.
//
// What contacts do in a step gives an island no more energy than pushing overlaps apart takes, and the speed
// of rest gives: a step begins with the impulses of the one before, and those of an impact that is over would
// throw bodies up.
//
// Threads share the loops over pairs and over bodies, and the passes through large islands (sections.h).
//
// Which rows an island has, and their order, depends on that island alone. How often they are swept does not:
// where some island is struck within a step, or has too much energy by its springs, all are swept once more.
// When islands leave within a frame, the contacts of the others are found anew.
//
// Bodies that are at rest while others of their island move stand still (still_bodies.h): they are treated as
// immobile until the forces on them change.

namespace carom {

class SteppedMotion {
  public:
    using Entry = SteppedPairs::Entry;

    /// `substep` [s] is that of all that come.
    void begin(const Bodies& bodies, const Division& division, double substep);
    bool isEmpty() const { return m_islands.isEmpty(); }
    /// Mobile bodies, in the order they were added.
    std::span<const BodyIndex> bodies() const { return m_islands.bodies(); }
    /// Of these bodies: which are joined, and which are to leave.
    const SteppedIslands& islands() const { return m_islands; }
    SteppedIslands& islands() { return m_islands; }

    /// Bodies of an island, with the springs that hold them.
    void addIsland(const SteppedInput& input, std::span<const BodyIndex> list,
                   std::span<const std::uint32_t> springs);
    /// Adds a pair of bodies that have been added, or of one of these and an immobile one. Its manifold is
    /// that of the last update; balls need none.
    void addPair(const SteppedInput& input, const Entry& entry, Manifolds& manifolds);
    /// The same of a pair that comes to an island that has been solved before. Where many have, the island is
    /// put in order when the next frame begins.
    void addLate(const SteppedInput& input, const Entry& entry, Manifolds& manifolds) {
        addPair(input, entry, manifolds);
        m_pairs.entries().back().isLate = true;
        m_islands.noteUnordered(entry.pair);
    }
    /// So many pairs come that they are put in order before the next substep.
    void orderSoon() { m_isOrderedSoon = true; }
    /// Removes pairs of which `is(entry)` holds: they are too far apart to meet. When a frame begins.
    template<class Is>
    void drop(const Is& is, Manifolds& manifolds, NewNumbers& numbers, Workers& workers) {
        if (m_pairs.drop(is, m_islands, manifolds, numbers, workers)) m_bodies.forgetMoving();
    }
    void setPasses(int passes) { m_division.passes = passes; }
    /// One substep, or `part` of it.
    SteppedReport advance(const SteppedInput& input, Manifolds& manifolds, double part = 1);
    /// visit(manifold) for every pair that is in contact, as of the last substep.
    template<class Visit>
    void forEachContact(const Bodies& bodies, const State& state, const Manifolds& manifolds,
                        const Visit& visit) const {
        m_pairs.forEachContact(bodies, state, manifolds, m_step, visit);
    }
    /// Adds to the counts of their islands, by add(counts, island, points in contact, round), all pairs that
    /// have a manifold or are of balls in contact, as of the last substep. Counts of parts are given to
    /// append(counts), those of no pair are `none`.
    template<class Counts, class Add, class Append>
    void count(const Manifolds& manifolds, Counts& all, const Counts& none, const Add& add,
               const Append& append, Workers& workers) const {
        const auto addPairs = [&](std::size_t pairs, const auto& visit) {
            const std::size_t least = std::max(Workers::enoughOf(10), m_islands.islandNumbers());
            workers.forLists(
                pairs, least, all,
                [&](std::size_t begin, std::size_t end, Counts& counts) {
                    if (&counts != &all) counts = none;
                    visit(begin, end, [&](BodyPair pair, int points, bool isRound) {
                        add(counts, m_islands.of(pair), points, isRound);
                    });
                },
                append);
        };
        addPairs(m_pairs.general().size(), [&](std::size_t begin, std::size_t end, const auto& visit) {
            for (const SteppedPairs::General& pair : m_pairs.general().subspan(begin, end - begin)) {
                const PersistentManifold& manifold = manifolds[m_pairs.entries()[pair.entry].place];
                visit(manifold.pair, manifold.open ? 0 : manifold.count, manifold.round);
            }
        });
        addPairs(m_pairs.balls().groups(), [&](std::size_t begin, std::size_t end, const auto& visit) {
            m_pairs.balls().forEachPressed(
                begin, end, [&](std::uint32_t index) { visit(m_pairs.entries()[index].pair, 1, true); });
        });
    }
    /// Lets bodies of which `is(body)` holds stand still from now on, if the forces on them balance; not in
    /// islands that are marked.
    template<class Is>
    void hold(const SteppedInput& input, const Manifolds& manifolds, const Is& is) {
        m_islands.settle();
        m_candidates.clear();
        for (std::uint32_t i = 1; i < m_islands.numbers(); ++i)
            if (!m_still.is(i) && is(m_islands.bodyOf(i))) m_candidates.push_back(i);
        holdStill(input, manifolds);
    }
    /// Sets slowestTime() (calm.h) of their island, by body at the end of a spring [s].
    void findSlowest(const SteppedInput& input, std::vector<double>& slowest);
    std::size_t stillBodies() const { return m_still.bodies().count(); }
    bool isStill(BodyIndex body) const { return m_still.is(m_islands.numberOf(body)); }
    /// Those that moved on in the last substep.
    std::span<const BodyIndex> movedOn() const { return m_movedOn; }
    std::span<Entry> entries() { return m_pairs.entries(); }
    /// Whether the bodies are where, and as fast as, the last substep left them.
    bool isUnchanged(const State& state, Workers& workers) const {
        return m_bodies.isUnchanged(state, m_islands, workers);
    }
    /// Memory that a copy holds.
    std::size_t bytes() const;
    /// Appends the bodies and the pairs of islands that are marked, with their present manifolds; pairs of
    /// balls only if they have a force. Removes these islands.
    void leave(const SteppedInput& input, Manifolds& manifolds, NewNumbers& numbers,
               std::vector<BodyIndex>& bodies, std::vector<Entry>& entries);
    /// The same for all islands.
    void end(const SteppedInput& input, Manifolds& manifolds, std::vector<Entry>& entries);
    /// Removes all bodies, and keeps nothing of theirs.
    void clear();

  private:
    static constexpr std::size_t fewAwake = SteppedBodies::fewAwake;
    static constexpr std::uint32_t immobile = SteppedIslands::immobile;
    static constexpr std::uint32_t gone = SteppedIslands::gone;
    /// A general pair whose bodies may be struck.
    struct Watched {
        std::uint32_t entry = 0, number = 0;
        OpenPair open; ///< when the rows were made
    };
    /// What a look finds of a pair.
    struct Seen {
        std::uint32_t number = 0;   ///< in m_general
        std::uint32_t a = 0, b = 0; ///< of the solve, of one in contact
        std::uint8_t near = 0;      ///< points of such a one that may touch (nearPoints)
        bool isRound = false;
        bool hasPoints = false;
        bool isTouching = false;
        bool isWatched = false; ///< not in contact, and near enough to be struck
    };
    /// What follows from a look.
    struct Found {
        std::vector<Seen> touching;
        std::vector<Watched> watched;
        std::vector<std::uint32_t> parted; ///< entries that had rows, and are not in contact

        void append(const Found& later) {
            touching.insert(touching.end(), later.touching.begin(), later.touching.end());
            watched.insert(watched.end(), later.watched.begin(), later.watched.end());
            parted.insert(parted.end(), later.parted.begin(), later.parted.end());
        }
    };
    /// A pair in contact, with the place of its rows.
    struct Placed {
        LanePacker::Place place;
        std::uint32_t number = 0; ///< in m_general
        std::uint32_t entry = 0;
        std::uint32_t frameA = 0, frameB = 0; ///< into m_frames
        std::uint8_t near = 0;                ///< as in Seen
        bool isAgain = false;                 ///< the pair had rows there
    };
    /// What becomes of the rows that a pair had when a look begins.
    enum class Rows : std::uint8_t { None, Kept, Old };
    /// Of an island: how many of its pairs keep their rows, and how many do not.
    struct RowCount {
        std::uint32_t kept = 0, old = 0;
        bool keeps() const { return kept > old; }
        bool drops() const { return old > 0 && !keeps(); }
    };
    /// A body whose frame rows need.
    struct Framed {
        BodyIndex body = 0;
        bool turns = false; ///< otherwise along the axes of the world
    };
    /// Momentum that gravity gives all bodies in a substep [kg m/s], where it changes velocities by `change`.
    struct Weight {
        Vec3 sum = Vec3::Zero(), change = Vec3::Zero();
        bool isKnown = false;
    };
    /// How far a body has moved since the last look, and how far it may move until the next.
    struct Travel {
        Vec3 came = Vec3::Zero(), comes = Vec3::Zero(); ///< its centre [m]
        double turned = 0, turns = 0;                   ///< its surface at most, beyond its centre [m]
    };
    /// A body that is moved ahead, and where it is.
    struct Foreseen {
        std::uint32_t number = 0;
        Pose pose;
        Displacement moved;
        Vec3 shift = Vec3::Zero(), turn = Vec3::Zero(); ///< in the step [m], [rad]
    };
    /// A pair with rows whose contact is to be found ahead: to be added to its rows, or in their place.
    struct AheadTask {
        LanePacker::Place place;
        bool adds = false;
    };
    /// Such pairs, ascending.
    struct AheadList {
        std::vector<AheadTask> tasks;
        std::vector<std::size_t> groups;    ///< the first task of every group of rows that has any
        std::vector<std::uint32_t> changed; ///< groups of which some rows change

        void clear() {
            tasks.clear();
            groups.clear();
            changed.clear();
        }
        void append(const AheadList& later) {
            for (const std::size_t first : later.groups) groups.push_back(tasks.size() + first);
            tasks.insert(tasks.end(), later.tasks.begin(), later.tasks.end());
            changed.insert(changed.end(), later.changed.begin(), later.changed.end());
        }
    };
    /// Where the bodies of such a pair are moved to, and how far they have come since the look then.
    struct AheadPair {
        PosesOfPair at;
        std::array<Displacement, 2> moved;
    };
    /// A contact that was found ahead and needs rows of its own.
    struct AheadContact {
        AheadTask task;
        PlacedManifold contact;
    };
    /// What one thread finds ahead.
    struct AheadFinds {
        std::vector<AheadContact> toAdd;
        std::size_t collided = 0;
        bool anyEmpty = false; ///< some pair has rows without points

        void clear() {
            toAdd.clear();
            collided = 0;
            anyEmpty = false;
        }
    };
    /// How far a body moves until the end of a step, from its pose at the look.
    struct alignas(32) Coming {
        std::array<double, 3> shift{}; ///< [m]
        double turn = 0;               ///< [rad]
        bool isStruck = false;         ///< by anything since the look, this step included
    };
    const RowCount& rowCountOf(std::uint32_t entry) const {
        return m_rowCounts[m_islands.byNumber()[m_islands.memberOf(m_pairs.entries()[entry].pair)]];
    }
    void order(const SteppedInput& input);
    void look(const SteppedInput& input, double duration, Manifolds& manifolds, SteppedReport& report);
    void keepRows(const SteppedInput& input, const Manifolds& manifolds);
    void dropRows(Workers& workers);
    /// Where the rows are that a pair had when the look began, and that it does not keep.
    LanePacker::Place oldRowsOf(std::uint32_t entry) const {
        return {m_rows.numberNow(m_rowOf[entry].group), m_rowOf[entry].lane};
    }
    void lookAgain(const SteppedInput& input, double duration, std::span<const std::uint32_t> struck,
                   Manifolds& manifolds, SteppedReport& report);
    BodyFrame frameOf(const ManifoldInput& here, const Framed& framed) const;
    PlacedManifold placedAtLook(const ManifoldInput& here, const PersistentManifold& manifold) const;
    static PlacedManifold placedAtLook(const ManifoldInput& here, const PersistentManifold& manifold,
                                       const std::array<Displacement, 2>& moved);
    PairInput rowOf(const Bodies& bodies, std::uint32_t entry, const PlacedManifold& contact);
    void addRows(const ManifoldInput& here, Manifolds& manifolds, Workers& workers);
    PairInput rowOf(const Bodies& bodies, const Placed& placed, const PersistentManifold& manifold);
    void setRow(const ManifoldInput& here, const Placed& placed, Manifolds& manifolds);
    void noteCap(const Seen& seen, const PersistentManifold& manifold);
    std::uint32_t frameOf(BodyIndex body, std::uint32_t number, bool turns);
    void findContacts(const SteppedInput& input, double duration, std::span<const std::uint32_t> pairs,
                      Manifolds& manifolds, SteppedReport& report);
    std::size_t listFound(Workers& workers);
    void updatePairs(const ManifoldInput& here, std::span<const std::uint32_t> pairs, Manifolds& manifolds,
                     Workers& workers, SteppedReport& report);
    Seen see(const ManifoldInput& here, std::uint32_t number, double fall, Manifolds& manifolds,
             std::size_t& collided);
    Seen seeAnew(const ManifoldInput& here, std::uint32_t number, double fall, Manifolds& manifolds,
                 std::size_t& collided);
    void rememberBefore(const SteppedInput& input);
    void recordMotion(const SteppedInput& input, double duration);
    void findMoving(Workers& workers);
    void noteTravel(const SteppedInput& input, double duration);
    double comesAlong(const Vec3& normal, std::uint32_t numberA, std::uint32_t numberB) const;
    bool staysOpen(OpenPair& pair, double fall) const;
    OpenPair openPairOf(const Bodies& bodies, BodyPair pair) const;
    void foreseeStruck(double duration, Workers& workers);
    void foreseeStruck(double duration, std::span<const std::uint32_t> numbers);
    bool isStruck(const Watched& pair) const;
    std::size_t nextStruck(std::size_t number, std::size_t end) const;
    bool addStruck(const SteppedInput& input, double duration, Manifolds& manifolds, SteppedReport& report);
    std::size_t points() { return wideLanes * (m_rows.points().size() + m_pairs.balls().activeGroups()); }
    void foreseeTurned(const SteppedInput& input, double duration);
    void foreseeTurned(const SteppedInput& input, double duration, std::span<const std::uint32_t> list,
                       std::vector<Foreseen>& foreseen);
    void foreseeTurned(const SteppedInput& input, double duration, std::uint32_t number,
                       std::vector<Foreseen>& foreseen);
    static void moveAhead(const Foreseen& body, double part, Pose& pose, Displacement& moved);
    bool lookAhead(const SteppedInput& input, double duration, Manifolds& manifolds, SteppedReport& report,
                   bool isSolved);
    void listAhead(bool isSolved, Workers& workers);
    void listAhead(bool isSolved, std::uint32_t group, AheadList& ahead) const;
    void removeAdded(bool hasRebounded);
    bool moveToNearest(const ManifoldInput& there, const std::array<std::uint32_t, 2>& numbers,
                       const Vec3& normal, AheadPair& ahead) const;
    double surfaceSpeed(const Bodies& bodies, std::uint32_t number) const;
    void findAnew(const ManifoldInput& here, const AheadTask& task, Manifolds& manifolds, AheadFinds& finds);
    void addAhead(const ManifoldInput& there, const AheadContact& ahead);
    void sweep(const StepSettings& settings, Workers& workers, SteppedReport& report);
    void step(const SteppedInput& input, double duration, Manifolds& manifolds, SteppedReport& report);
    void limitEnergy(const StepSettings& settings, Workers& workers, bool corrects);
    void findCorrection(const StepSettings& settings);
    bool mayGainEnergy(const StepSettings& settings, Workers& workers);
    void rebound(const StepSettings& settings, Workers& workers, SteppedReport& report);
    void findPulling(const Bodies& bodies);
    SpringIslands springIslands(const SteppedInput& input) const;
    void rememberSprings(const SteppedInput& input);
    void limitSprings(const SteppedInput& input, const StepSettings& settings, SteppedReport& report);
    void storeForces(Manifolds& manifolds, Workers& workers) const;
    void findParts();
    std::uint32_t partWith(std::uint32_t number);
    void joinParts(std::uint32_t a, std::uint32_t b);
    /// By number: the parts into which bodies that stand still divide an island; the island if none does.
    std::span<const std::uint32_t> partOf() const {
        return m_still.any() ? std::span<const std::uint32_t>(m_part) : m_islands.byNumber();
    }
    EnergyLimit::Members movingParts() const { return {m_bodies.moving().awake, partOf()}; }
    std::size_t parts() const { return m_still.any() ? m_islands.numbers() : m_islands.islandNumbers(); }
    void holdStill(const SteppedInput& input, const Manifolds& manifolds);
    StandingStill::Input stillInput(const SteppedInput& input, const Manifolds& manifolds);
    void noteStill(const SteppedInput& input, const Manifolds& manifolds);
    void holdPairs();
    void moveOn(const SteppedInput& input, std::span<const std::uint32_t> numbers,
                const Manifolds& manifolds);

    Division m_division;
    double m_substep = 0, m_step = 0; // [s]
    Invariants m_atBegin;             // of the bodies that move, with a ledger, before the substep
    Invariants m_after;               // as the last substep left them
    bool m_isAfterKnown = false;      // the same bodies are here since
    Scratch<InvariantTerms> m_invariantTerms;
    Derived<Weight> m_weight;
    SteppedIslands m_islands;
    SteppedBodies m_bodies;
    SteppedPairs m_pairs;
    StandingStill m_still;
    Scratch<std::vector<std::uint32_t>> m_candidates; // numbers
    Scratch<std::vector<BodyIndex>> m_stopped, m_movedOn;
    Scratch<std::vector<std::uint32_t>> m_part;  // by number: the least number of its part; its own if still
    bool m_arePartsFound = false;                // since the last look
    Scratch<std::vector<BodyVelocity>> m_before; // the rebound of an impact
    Scratch<std::vector<std::uint8_t>> m_active; // by it

    std::vector<std::uint32_t> m_links;            // springs
    Scratch<std::vector<std::uint32_t>> m_pulling; // of these, with an end that does not stand still
    Scratch<std::vector<SpringRow>> m_springs;
    Scratch<SpringLimit> m_springLimit;
    Scratch<std::vector<double>> m_islandMass, m_islandTime; // [kg], [s]
    Scratch<std::vector<double>> m_corrected; // by number: energy that position correction may add [J]
    double m_deepest = 0;                     // overlap at the last look [m]
    bool m_isOrderedSoon = false;
    // Of a look or a step.
    Scratch<ContactRows> m_rows;
    Scratch<std::vector<Placed>> m_placed;
    Scratch<std::vector<Framed>> m_framed;
    Scratch<std::vector<BodyFrame>> m_frames;
    Scratch<std::vector<std::uint32_t>> m_frameOf; // by number: its place in m_frames, if it has one
    Scratch<std::vector<Seen>> m_seen, m_sorted;   // of a look: all, and those in contact
    Scratch<Found> m_found;
    Scratch<std::vector<std::size_t>> m_struckPairs; // of those that are watched
    Scratch<std::vector<Travel>> m_travel;           // by number
    Scratch<std::vector<Coming>> m_coming;           // by number
    Scratch<std::vector<std::uint8_t>> m_hasTurned;  // by number: since the rows had their effective masses
    Scratch<std::vector<LanePacker::Place>> m_rowOf; // by entry: place of its rows when the look began
    Scratch<std::vector<Rows>> m_rowState;           // by entry
    Scratch<std::vector<RowCount>> m_rowCounts;      // by island
    Scratch<std::vector<std::uint32_t>> m_again;     // pairs to be looked at once more
    Scratch<std::vector<Foreseen>> m_foreseen;       // ascending
    Scratch<std::vector<LanePacker::Place>> m_addedRows; // for the rest of a step
    Scratch<AheadList> m_ahead;
    Scratch<std::vector<AheadFinds>> m_aheadFinds;
    bool m_hasEmptyRows = false;                 // pairs have rows without points
    Scratch<std::vector<double>> m_gained;       // by part: about twice the energy that contacts give [J]
    Scratch<std::vector<double>> m_gains;        // the same by body that does not stand still
    Scratch<EnergyLimit> m_stepEnergy, m_energy; // of the step, and of the rebound
};

} // namespace carom
