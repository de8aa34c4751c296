// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/scratch.h"
#include "core/dynamics/forced_steps.h"
#include "core/dynamics/ledger.h"
#include "core/dynamics/work_counters.h"
#include "core/solvers/contacts/ball_rows.h"
#include "core/solvers/contacts/contact_rows.h"
#include "core/solvers/contacts/energy_limit.h"
#include "core/solvers/contacts/manifolds.h"
#include "core/solvers/contacts/spring_rows.h"
#include "core/solvers/contacts/velocity_solve.h"
#include "core/solvers/pair_sort.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
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
//     begin      nobody
//     add        islands, and the pairs that may touch until the end: for a frame, pairs are searched once
//     advance    substep after substep: a few looks at where the contacts are, steps from look to look
//     end        forces become part of the manifolds again
//
// Pairs that do not meet as they move (open manifolds, idle balls) are no rows, but watched: where impulses
// have changed the velocity of one so that the pair would close its gap within the step, its contact is
// found, and the step is solved on with it; so up to a few times a step, for impulses that are passed on.

namespace carom {

/// What a substep is divided into.
struct Division {
    int looks = 1;  ///< a substep
    int steps = 2;  ///< a look
    int passes = 1; ///< of each kind a step
};

struct SteppedInput {
    const Bodies& bodies;
    Vec3 gravity; ///< [m/s²]
    State& state;
    Ledger* ledger = nullptr;
    double tolerance = 0; ///< no further pass where rows are solved to this [m/s]
};

struct SteppedReport {
    double residual = 0;       ///< [m/s], as the last pass found its rows
    double maxPenetration = 0; ///< [m]
    std::size_t contacts = 0;  ///< pairs that may touch, at the last look
    WorkCounters work;
    Loss loss;
};

class SteppedMotion {
  public:
    struct Entry {
        BodyPair pair;
        std::uint32_t place = Manifolds::none;
        double margin = 0;    ///< [m]
        bool isFresh = false; ///< the manifold is of the present poses
        bool operator<(const Entry& other) const { return pair < other.pair; }
    };

    /// `substep` [s] is that of all that come.
    void begin(const Bodies& bodies, const Division& division, double substep);
    bool isEmpty() const { return m_list.empty(); }
    /// Mobile bodies, in the order they were added.
    std::span<const BodyIndex> bodies() const { return m_list; }
    std::uint32_t islandOf(BodyIndex body) const { return m_island[m_local[body]]; }
    std::size_t islands() const { return m_islands - m_joined; }

    /// Bodies of an island, with the springs that hold them.
    void addIsland(const SteppedInput& input, std::span<const BodyIndex> list,
                   std::span<const std::uint32_t> springs);
    /// What is one island from now on.
    void joinIslands(std::uint32_t one, std::uint32_t other);
    /// To be called before pairs are added to islands that were.
    void beginPairs() { m_balls.begin(m_bodies.size()); }
    /// A pair of bodies that are here, or of one that is and one that cannot move. Its manifold is as it was
    /// last; balls need none.
    void addPair(const SteppedInput& input, const Entry& entry, Manifolds& manifolds);

    /// One substep, or `part` of it.
    SteppedReport advance(const SteppedInput& input, Manifolds& manifolds, double part = 1);
    /// visit(manifold) for every pair that is in contact, as of the last substep.
    template<class Visit>
    void forEachContact(const Bodies& bodies, const State& state, const Manifolds& manifolds,
                        const Visit& visit) const {
        for (const std::uint32_t entry : m_general)
            if (const PersistentManifold& manifold = manifolds[m_entries[entry].place];
                manifold.count > 0 && !manifold.open)
                visit(manifold);
        m_balls.forEach([&](std::uint32_t index, const Vec3& normal, const Vec3& impulse) {
            if (impulse != Vec3::Zero()) visit(manifoldOfBalls(bodies, state, index, normal, impulse));
        });
    }
    /// visit(island, points in contact, round) for every pair that has a manifold or is of balls in contact,
    /// as of the last substep.
    template<class Visit>
    void forEachCount(const Manifolds& manifolds, const Visit& visit) const {
        const auto islandHere = [this](BodyPair pair) {
            return m_island[m_local[pair.a] != 0 ? m_local[pair.a] : m_local[pair.b]];
        };
        for (const std::uint32_t entry : m_general) {
            const PersistentManifold& manifold = manifolds[m_entries[entry].place];
            visit(islandHere(manifold.pair), manifold.open ? 0 : manifold.count, manifold.round);
        }
        m_balls.forEach([&](std::uint32_t index, const Vec3&, const Vec3& impulse) {
            if (impulse != Vec3::Zero()) visit(islandHere(m_entries[index].pair), 1, true);
        });
    }
    /// What islandOf() returns is below this.
    std::size_t islandNumbers() const { return m_islands; }
    /// Whether `isCalm(body)` holds for all bodies of any island.
    template<class IsCalm>
    bool anyIsland(const IsCalm& isCalm) {
        m_isCalm.assign(m_islands, 0);
        for (std::size_t i = 1; i < m_island.size(); ++i) m_isCalm[m_island[i]] = 1;
        for (std::size_t i = 1; i < m_island.size(); ++i)
            if (!isCalm(m_list[i - 1])) m_isCalm[m_island[i]] = 0;
        return std::find(m_isCalm.begin(), m_isCalm.end(), 1) != m_isCalm.end();
    }
    /// visit(entry) for every pair.
    template<class Visit>
    void forEachEntry(const Visit& visit) {
        std::for_each(m_entries.begin(), m_entries.end(), visit);
    }
    /// Whether the bodies are where, and as fast as, the last substep left them.
    bool isUnchanged(const State& state) const;
    /// Of what a copy holds.
    std::size_t bytes() const;
    /// The pairs, ascending, with their manifolds as they are now; of balls only where there is a force.
    /// Nobody is here then.
    void end(const SteppedInput& input, Manifolds& manifolds, std::vector<Entry>& entries);
    /// Nobody is here.
    void clear();

  private:
    struct Watched {
        std::uint32_t entry = 0;
        std::uint32_t a = 0, b = 0; ///< bodies of the solve
        Vec3 normal = Vec3::Zero();
        double gap = 0;                  ///< along the normal, when the rows were made [m]
        double radiusA = 0, radiusB = 0; ///< of what turns with the bodies [m]
    };
    void addBall(const SteppedInput& input, std::uint32_t entry, const ContactPair& laws,
                 const Manifolds& manifolds);
    PersistentManifold manifoldOfBalls(const Bodies& bodies, const State& state, std::uint32_t entry,
                                       const Vec3& normal, const Vec3& impulse) const;
    void storeBalls(const SteppedInput& input, Manifolds& manifolds);
    void look(const SteppedInput& input, double duration, Manifolds& manifolds, SteppedReport& report);
    void addRow(const SteppedInput& input, std::uint32_t entry, const PlacedManifold& contact);
    void watch(const ManifoldInput& here, std::uint32_t entry, const Manifolds& manifolds);
    bool isStruck(const Watched& pair, double duration) const;
    bool addStruck(const SteppedInput& input, double duration, Manifolds& manifolds, SteppedReport& report);
    std::size_t points() const { return wideLanes * (m_rows.points().size() + m_balls.activeGroups()); }
    void sweep(const StepSettings& settings, bool first, SteppedReport& report);
    void step(const SteppedInput& input, double duration, bool first, Manifolds& manifolds,
              SteppedReport& report);
    void rebound(const StepSettings& settings, SteppedReport& report);
    void applyTerms(const SteppedInput& input, double duration);
    void bookTerms(const SteppedInput& input);
    void move(const SteppedInput& input, double duration);
    /// A ball without springs: where it points matters to nobody before the next look.
    bool turnsLater(const SolverBody& body) const { return body.roundInverse > 0 && m_links.empty(); }
    void turnBalls(const SteppedInput& input);
    void storeForces(Manifolds& manifolds) const;

    Division m_division;
    double m_substep = 0, m_step = 0; // [s]
    std::vector<BodyIndex> m_list;
    std::vector<std::uint32_t> m_local; // by body of the scene: its number in the arrays below, or 0
    // By number; 0 cannot move.
    std::vector<SolverBody> m_bodies;
    std::vector<Displacement> m_moved;
    std::vector<BodyPlace> m_places;
    std::vector<Quat> m_orientations;
    std::vector<std::uint32_t> m_island;
    std::vector<std::array<double, 3>> m_free;    // velocities that only gravity and force terms have changed
    std::vector<std::uint8_t> m_struck;           // by anything since the last look
    Scratch<std::vector<SolverBody>> m_before;    // the rebound of an impact
    Scratch<std::vector<std::uint8_t>> m_stirred; // by it

    std::size_t m_islands = 0, m_joined = 0;     // numbers given, and those that stand for none any more
    Scratch<std::vector<std::uint8_t>> m_isCalm; // by island
    std::vector<std::uint32_t> m_links;          // springs
    Scratch<std::vector<SpringRow>> m_springs;
    std::vector<Entry> m_entries;
    std::vector<std::uint8_t> m_isFlipped; // by entry of balls: B is the pair's first
    std::vector<std::uint32_t> m_general;  // entries that are not of balls
    BallRows m_balls;
    // Of a look or a step.
    Scratch<ContactRows> m_rows;
    Scratch<std::vector<Watched>> m_watched;
    Scratch<EnergyLimit> m_energy;
    Scratch<PairSort<Entry>> m_sort;
    Scratch<ForcedSteps> m_forced; // of the bodies that force terms act on; owners are their numbers
    Scratch<std::vector<Vec3>>
        m_halfWays; // by number: how far the velocity at the end is too far, with terms
};

} // namespace carom
