// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/base/wide.h"
#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"
#include "core/math/compensated.h"
#include "core/solvers/events/event_cells.h"
#include "core/solvers/events/event_queue.h"
#include "core/solvers/events/event_record.h"
#include "core/solvers/events/event_rest.h"
#include "core/solvers/events/event_times.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

// Event-driven dynamics of balls between walls. Between two events of its own a ball's path is a closed form.
// It is stored once, as the origin of the trajectory (TrajectoryOrigin), and evaluated at any time; only
// collisions with balls and walls make a new origin. Every ball keeps
//
//     pair      the earliest collision with another ball that was predicted, and how often that ball had
//               changed by then: if it has changed since, the prediction is stale and is made anew
//     other     its next wall
//     crossing  when it leaves its cell; then the nine cells that come into reach are searched
//
// and the queue holds the earlier of pair and other. Cell crossings, five for every collision, need no order
// among themselves, nor exact times: cells are wider than balls, so a ball may enter its next cell a little
// early. So all crossings of the next slice of time are made when it begins, in the order of memory. Only a
// ball that would be too far from its cell then crosses as an event of its own, in the place of the wall.
//
//     time   |-----x---x-----x--|--x------x----x---|---x----      x collisions, bounces
//            ^ crossings up to  ^ crossings up to  ^
//
// A predicted collision is stored with one of its two balls only. None is lost: a ball replaces a prediction
// by an earlier event only, and after that it predicts again.
//
// Balls that lose energy come to rest: on walls, where they slide in closed form, and exactly above a ball at
// rest. Balls that lie on each other in any other way make bounces of a billionth of a radius (event_rest.h),
// some 1e5 a second for balls of 10 cm: correct, but a heap costs that much.
//
// B. J. Alder, T. E. Wainwright, "Studies in molecular dynamics I", Journal of Chemical Physics 31 (1959);
// D. C. Rapaport, "The event scheduling problem in molecular dynamic simulation", Journal of Computational
// Physics 34 (1980). Where we deviate: one pair event a ball instead of all, and ties in time are broken by
// place, or by speed where balls touch, never by number, so the order of declarations does not matter.

namespace carom {

/// The events of an interval of time.
struct EventCounts {
    std::uint64_t collisions = 0; ///< of two balls
    std::uint64_t bounces = 0;    ///< off walls
    std::uint64_t crossings = 0;  ///< from cell to cell
    std::uint64_t stale = 0;      ///< predicted collisions that other events invalidated
    std::uint64_t tested = 0;     ///< pairs for which a collision was computed

    std::uint64_t events() const { return collisions + bounces + crossings + stale; }
};

/// The impulses of an interval of time, from which the pressure follows.
struct ImpulseTally {
    std::uint64_t collisions = 0;
    double virial = 0; ///< of collisions, the sum of impulse · distance of the centres [J]; R. Clausius
    std::vector<double> walls; ///< given to each wall along its normal [N s], in the order of the scene
};

class EventGas {
  public:
    /// Takes every sphere and wall of `bodies`; there must be nothing else. `gravity` [m/s²].
    EventGas(const Bodies& bodies, const State& state, const Vec3& gravity);

    /// Advances to `time` [s] after the start; times must not decrease. Breaks off with
    /// the ball concerned if time ceases to pass between the events (inelastic collapse), or there are more
    /// than `mostEvents` of them, or of what costs as much; if a ball
    /// that rests on walls would be pushed into one of them; with the fastest if the balls would pass 5e6
    /// cells and a thousand more for each ball and each collision and bounce, or the fastest would move 1e12
    /// radii; or if squares of velocities or of gravity are no numbers.
    Loss advanceTo(double time, std::uint64_t mostEvents = std::numeric_limits<std::uint64_t>::max());

    /// How long it goes by one clock [s]; setting it back rounds times anew.
    double clockTurn() const { return m_clockTurn; }

    /// Writes positions and velocities at the time of the last advanceTo.
    void write(State& state) const;

    const EventCounts& counts() const { return m_counts; }
    /// What tally() is about from now on: collisions whose middle is in the box, and bounces whose ball is in
    /// it but for the coordinate that faces the wall. At first everywhere.
    void watch(const Aabb& region) { m_watched = region; }
    const ImpulseTally& tally() const { return m_tally; }
    std::size_t bytes() const;

  private:
    static constexpr std::uint32_t nobody = EventRecord::nobody;

    struct BoundedWall {
        Vec3 normal;
        double offset = 0;
        double elastic = 1;
    };

    /// Constants that many balls share.
    struct Material {
        double inverseMass = 0; ///< [1/kg], 0: fixed
        double elastic = 1;

        bool operator==(const Material&) const = default;
    };

    /// Two balls that touch and approach each other.
    struct Touch {
        std::uint32_t a = nobody, b = nobody;
        double closing = 0;          ///< [m/s]
        Vec3 normal = Vec3::UnitY(); ///< from a to b
    };

    /// From a cell to the next one.
    struct Crossing {
        int axis = 0, direction = 0;
    };

    // Setting up, in event_gas_setup.cpp.
    bool areSquaresFinite() const;
    void loadBodies(const Bodies& bodies, const State& state);
    void sortByPlace();
    Aabb regionOfCentres() const;
    void makeCells();
    void fillCells();
    void planAll();
    void fillQueue(double eventsPerSecond);
    double pendingRate(double now) const;
    void setClockBack();

    Loss fastest() const;
    std::uint32_t earliest(double limit);
    void handle(std::uint32_t i);
    void collide(std::uint32_t i, std::uint32_t j, double time);
    double restitutionAt(std::uint32_t i, std::uint32_t j, double time);
    double separationSpeedAt(const Touch& touch, double time);
    void collidePair(std::uint32_t i, std::uint32_t j, double time);
    bool comesToRestOn(std::uint32_t i, std::uint32_t j, const Vec3& normal, double closing);
    void push(std::uint32_t i, std::uint32_t j, const Vec3& normal, double impulse);
    void finishCollision(std::uint32_t i);
    void bounce(std::uint32_t i, std::uint16_t index, double time);
    void moveOrigin(std::uint32_t i, double time);
    void plan(std::uint32_t i, double now);
    void planPairs(std::uint32_t i);
    void considerPair(std::uint32_t i, std::uint32_t j);
    void noteCollision(std::uint32_t i, std::uint32_t j, double time);
    void planWalls(std::uint32_t i);
    void considerWalls(std::uint32_t i, unsigned near);
    void considerWall(std::uint32_t i, std::size_t k);
    double gapTo(const BoundedWall& wall, std::uint32_t i) const {
        return carom::gapTo(m_origins[i], m_placeRests[i], wall.normal, wall.offset);
    }
    double gapOnTheWay(std::uint32_t i, std::uint16_t wall) const;
    bool pairBefore(std::uint32_t i, std::uint32_t a, std::uint32_t j, std::uint32_t b) const;
    void keepDaysFitting();

    // Cell crossings, in event_crossings.cpp.
    void planCrossings(std::uint32_t i, double now);
    void planCrossing(std::uint32_t i, int axis, double now);
    void noteNextCrossing(std::uint32_t i);
    Crossing nextCrossing(std::uint32_t i) const;
    bool mayCrossEarly(std::uint32_t i, int axis, double now) const;
    void crossNext(std::uint32_t i, Crossing next);
    void crossEarly(std::uint32_t i, double now);
    void crossAll(std::uint32_t i, double now);
    void queueCrossing(std::uint32_t i);
    void crossCell(std::uint32_t i);
    void findCrossing();
    void beginSlice();

    // Clusters of simultaneous impacts, in event_clusters.cpp.
    bool isInCluster(std::uint32_t i, std::uint32_t j, double time);
    void gatherCluster(std::uint32_t i, std::uint32_t j, double time);
    void collideCluster(std::uint32_t i, std::uint32_t j, double time);
    void takeGroup();
    void collideJointly(double time);
    void note(const BoundedWall& wall, const TrajectoryOrigin& origin, double impulse);

    bool isMobile(std::uint32_t i) const { return inverseMassOf(i) > 0; }
    double inverseMassOf(std::uint32_t i) const { return m_materials[m_records[i].material].inverseMass; }
    bool isFree(std::uint32_t i) const { return m_records[i].rest == nobody; }
    const Vec3& accelerationOf(std::uint32_t i) const {
        return m_allFree || isFree(i) ? m_gravity : m_rests[m_records[i].rest].acceleration;
    }
    void settle(std::uint32_t i, const Rest& before);
    void restOn(std::uint32_t i, std::uint16_t wall);
    void findWedged(std::uint32_t i);
    Rest& newRest(std::uint32_t i);
    bool isStill(std::uint32_t i) const {
        return !isFree(i) && accelerationOf(i).isZero(0) && m_origins[i].velocity.isZero(0);
    }
    void releaseWhatStandsOn(std::uint32_t support, double time);
    void release(std::uint32_t i);

    std::vector<TrajectoryOrigin> m_origins;
    std::vector<Vec3> m_placeRests; ///< what the places of the origins rounded off [m]
    std::vector<EventRecord> m_records;
    std::vector<BodyIndex> m_bodies;
    std::vector<Material> m_materials;
    std::vector<Rest> m_rests;
    std::vector<std::uint32_t> m_unusedRests;
    std::size_t m_standing = 0;            ///< balls that stand on others
    std::vector<std::uint32_t> m_released; ///< scratch of releaseWhatStandsOn
    std::vector<double> m_lastLosses; ///< when each ball last lost energy to another [s]; none if all bounce
                                      ///< elastically
    std::vector<BoundedWall> m_walls;
    std::vector<std::uint32_t> m_cluster;           ///< scratch of collideCluster
    std::vector<Touch> m_touches;                   ///< the same
    std::vector<Touch> m_group;                     ///< those of them that collide together
    std::vector<std::uint64_t> m_order;             ///< scratch of sortByPlace
    std::vector<std::array<double, 3>> m_crossings; ///< when each ball leaves its cell along each axis [s]
    std::vector<double> m_nextCrossings;            ///< the first of these
    std::vector<std::uint32_t> m_crossing;          ///< scratch of beginSlice
    EventCells m_cells;
    EventQueue m_queue;
    Vec3 m_gravity;
    bool m_weightless = false; ///< no gravity
    bool m_allFree = true;     ///< no ball rests on a wall or is fixed
    double m_typicalTime = 1;  ///< a radius at the scene's typical speed [s]: what counts as short
    double m_tie = 0;          ///< times no further apart are simultaneous, but for rounding [s]
    double m_clockTurn = 1;    ///< the clock is set back whenever so much time has passed [s]
    double m_now = 0;          ///< [s] since the clock was last set back
    double m_secondsPast = 0;  ///< by which it has been set back
    EventCounts m_counts;
    ImpulseTally m_tally;
    Aabb m_watched{Vec3::Constant(-never), Vec3::Constant(never)};
    double m_slice = 1;                ///< of time, see above [s]
    bool m_isWedged = false;           ///< a ball would be pushed into a wall on which it rests
    bool m_isComputable = true;        ///< false: velocities or gravity are too large for any event
    double m_sliceEnd = 0;             ///< crossings up to then are made, or in the queue
    std::size_t m_queuedCrossings = 0; ///< in this slice
    std::uint64_t m_handled = 0;       ///< events of the queue
    /// What costs as much as an event: balls that crossed into another cell, balls of clusters, and pairs
    /// with accelerations of their own.
    std::uint64_t m_lookedAt = 0;
    std::uint64_t m_handledAtTurn = 0;    ///< when the clock was last set back
    double m_daysPerSecond = 1;           ///< of the queue
    std::uint64_t m_handledAtFilling = 0; ///< when the queue was last filled,
    double m_timeOfFilling = 0;           ///< and when that was
};

// Two balls that have just collided and that nothing has happened to since move apart for ever, as long as
// gravity bends both paths alike; rounding must not make them collide again.
CAROM_INLINE void EventGas::considerPair(std::uint32_t i, std::uint32_t j) {
    ++m_counts.tested;
    const EventRecord& record = m_records[i];
    const TrajectoryOrigin &a = m_origins[i], &b = m_origins[j];
    const bool alike = m_allFree || accelerationOf(i) == accelerationOf(j);
    if (!alike) ++m_lookedAt;
    const double time = m_allFree && m_weightless ? pairTime(a, b)
                        : alike
                            ? pairTime(a, b, accelerationOf(i))
                            : pairTime(a, accelerationOf(i), b, accelerationOf(j), record.pairTime + m_tie);
    if (!(time <= record.pairTime + m_tie) || time == never) return;
    if (alike && record.last == j && m_records[j].last == i) return;
    noteCollision(i, j, time);
}

} // namespace carom
