// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"
#include "core/solvers/event_cells.h"
#include "core/solvers/event_queue.h"
#include "core/solvers/event_times.h"

#include <array>
#include <cstdint>
#include <vector>

// Balls between walls, moved from event to event. Between two events of its own a ball's flight is a closed
// form, so it is written down once, as a stamp, and read at any time; only collisions with balls and walls
// make a new stamp. Every ball keeps
//
//     pair      the earliest meeting with another ball it has found, and how often that other had
//               changed when it was found: if it has changed since, the meeting is off and is looked for anew
//     wall      the earliest meeting with a wall
//     crossing  when it leaves its cell; then the nine new cells are searched
//
// and the queue holds the earliest of the three. Only the ball that searched knows of a pair. That loses
// nothing: what one of the two dropped, it dropped for something earlier, and looks again then.
//
// B. J. Alder, T. E. Wainwright, "Studies in molecular dynamics I", Journal of Chemical Physics 31 (1959);
// D. C. Rapaport, "The event scheduling problem in molecular dynamic simulation", Journal of Computational
// Physics 34 (1980). Where we deviate: one pair event a ball instead of all, and ties in time are broken by
// place, never by number, so the order of declarations does not matter.

namespace carom {

/// What happened in a stretch of time.
struct EventCounts {
    std::uint64_t collisions = 0; ///< of two balls
    std::uint64_t bounces = 0;    ///< off walls
    std::uint64_t crossings = 0;  ///< from cell to cell
    std::uint64_t stale = 0;      ///< meetings that were off
    std::uint64_t tested = 0;     ///< pairs whose meeting was computed

    std::uint64_t events() const { return collisions + bounces + crossings + stale; }
};

class EventGas {
  public:
    /// Takes every sphere and wall of `bodies`; there must be nothing else. `gravity` [m/s²].
    EventGas(const Bodies& bodies, const State& state, const Vec3& gravity);

    /// Lives through everything up to `time` [s] after the start; times must not decrease. Breaks off with
    /// the ball concerned if time ceases to pass between the events (inelastic collapse).
    Loss advanceTo(double time);

    /// Writes positions and velocities at the time of the last advanceTo.
    void write(State& state) const;

    const EventCounts& counts() const { return m_counts; }
    std::size_t memoryBytes() const;

  private:
    static constexpr std::uint32_t nobody = 0xffffffffU;
    static constexpr std::uint16_t noWall = 0xffffU;
    static constexpr std::size_t mostSupports = 3;

    enum class EventKind : std::uint8_t { Crossing, Wall, Pair }; // in the order ties are broken

    struct Agenda {
        double pairTime = never;
        double wallTime = never;
        double crossingTime = never;
        std::uint32_t partner = nobody;
        std::uint32_t partnerChanges = 0;
        std::uint32_t changes = 0;   ///< how often this ball has got a new stamp
        std::uint32_t last = nobody; ///< the ball it collided with last, if nothing has happened to it since
        std::uint16_t wall = noWall;
        std::uint16_t touching =
            noWall;           ///< the wall this stamp was made at: its gap is 0, not what rounding left
        std::int8_t axis = 0; ///< of the crossing
        std::int8_t direction = 0;

        double earliest() const;
        EventKind kind() const;
    };

    struct BoundedWall {
        Vec3 normal;
        double offset = 0;
        double elastic = 1;
    };

    /// Walls a ball rests on; its velocity has no part along their normals.
    struct Supports {
        std::array<std::uint16_t, mostSupports> wall{};
        std::uint8_t count = 0;
    };

    struct Ball {
        BodyIndex body = noBody;
        double inverseMass = 0;
        double elastic = 1;
        double lastDissipation = -never; ///< when it last lost energy to another ball [s]
        Vec3 acceleration = Vec3::Zero();
        Supports supports{};
        bool mobile = false;
        bool free = false; ///< mobile and on no wall: its acceleration is gravity
    };

    void takeBodies(const Bodies& bodies, const State& state);
    void sortByPlace();
    Aabb regionOfCentres() const;
    void layCells();
    void planAll(double now);
    void handle(std::uint32_t i);
    void collide(std::uint32_t i, std::uint32_t j, double time);
    void bounce(std::uint32_t i, double time);
    void crossCell(std::uint32_t i);
    void restamp(std::uint32_t i, double time);
    void plan(std::uint32_t i);
    void planPairs(std::uint32_t i);
    void considerPair(std::uint32_t i, std::uint32_t j);
    void planWalls(std::uint32_t i);
    void planCrossing(std::uint32_t i, double now);
    void schedule(std::uint32_t i);
    double meeting(std::uint32_t i, std::uint32_t j) const;
    bool comesBefore(std::uint32_t i, std::uint32_t j) const;
    bool pairBefore(std::uint32_t i, std::uint32_t a, std::uint32_t j, std::uint32_t b) const;
    bool restsAfter(double speed, double acceleration, double restitution, double radius) const;
    void settle(std::uint32_t i, const Supports& before);
    void support(std::uint32_t i, std::uint16_t wall);
    void refreshAcceleration(std::uint32_t i);
    void setClockBack();

    std::vector<Stamp> m_stamps;
    std::vector<Agenda> m_agendas;
    std::vector<Ball> m_balls;
    std::vector<BoundedWall> m_walls;
    EventCells m_cells;
    EventQueue m_queue;
    Vec3 m_gravity;
    double m_typicalTime = 1; ///< a radius at the scene's typical speed [s]: what counts as short
    double m_now = 0;         ///< [s] since the clock was last set back
    double m_secondsPast = 0; ///< by which it has been set back
    EventCounts m_counts;
    std::uint64_t m_countsAtShift = 0;
};

} // namespace carom
