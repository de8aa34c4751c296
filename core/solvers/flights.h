// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/ledger.h"
#include "core/dynamics/state.h"
#include "core/solvers/event_times.h"
#include "core/solvers/neighbours.h"

#include <span>
#include <vector>

// Spheres that fly, or slide without friction on one wall, and meet others one at a time. Between impacts
// their motion is a closed form, and an impact of two spheres or of a sphere and a wall is one too and
// concerns nobody else: so a substep is lived through from impact to impact, each at its own time, however
// many bodies move (as event_gas.h does for a whole run). A gas costs little but its impacts, and nothing
// overlaps.
//
// Whatever is not of that kind is grounded and left to the islands: bodies that rest on each other or with
// friction, overlap, hang on springs, are no spheres, meet several others at one instant, or meet others more
// than `mostImpacts` times in the substep. What comes near the grounded does not fly either:
//
//     seeds    those grounded at the start, and the spheres within reach of them
//     groups   a sphere that would meet a grounded one, and all that it has met in this substep

namespace carom {

struct FlightInput {
    const Bodies& bodies;
    const State& state;
    Vec3 gravity;       ///< [m/s²]
    double substep = 0; ///< [s]
    double resting = 0; ///< closing speeds up to this are rest, whatever the gravity [m/s]
    Neighbours& neighbours;
};

/// Bodies that fly through the whole substep under one acceleration.
struct Course {
    Vec3 acceleration = Vec3::Zero(); ///< [m/s²]
    std::vector<BodyIndex> bodies;    ///< ascending
};

class Flights {
  public:
    explicit Flights(const Bodies& bodies);

    /// Finds out who flies and where to, and changes nothing. False if the neighbours do not cover the paths:
    /// they must search, and the plan be made again.
    bool plan(const FlightInput& input);
    /// Books what those that meet somebody go through within the substep; before they land. Friction from its
    /// impulses; along the normal, where nothing but gravity and the impacts acts, by the difference.
    void book(const Bodies& bodies, const Vec3& gravity, double substep, const State& state,
              Ledger& ledger) const;
    /// Moves those that meet somebody within the substep to its end.
    void land(double substep, State& state) const;

    bool flies(BodyIndex body) const { return m_grounded[body] == 0; }
    /// Those that fly and meet nobody.
    std::span<const Course> courses() const { return m_courses; }
    std::size_t impacts() const { return m_impacts; }

  private:
    static constexpr std::uint32_t noLog = 0xffffffffU, noWall = 0xffffffffU;

    struct BoundedWall {
        BodyIndex body = noBody;
        Vec3 normal;
        double offset = 0;
    };
    struct WallPair {
        BodyIndex ball = noBody;
        std::uint32_t wall = 0; // of m_walls
    };
    /// What a sphere that meets somebody goes through.
    struct Log {
        BodyIndex body = noBody, last = noBody; // whom it met last
        std::uint32_t group = 0;                // index of a log, its own at the root
        int impacts = 0;
        double path = 0;          // [m]
        double turned = 0;        // time up to which the orientation is known [s]
        double rubbed = 0;        // work of friction [J]; of two spheres, in the log of the first
        Vec3 held = Vec3::Zero(); // momentum that the friction of walls gave [kg m/s]
        Vec3 spin = Vec3::Zero();
        Quat orientation = Quat::Identity();
    };
    /// Foreseen while the two had had so many impacts; with any more it is off.
    struct Meeting {
        double time = never;
        BodyIndex a = noBody, b = noBody; // b may be a wall
        int impacts = 0;
    };
    struct Law {
        double restitution, friction, leastImpact;
        bool rolls;
    };

    void sortPairs(const Neighbours& neighbours);
    void restOnWalls(const FlightInput& input);
    void findClosePairs(const FlightInput& input);
    void groundNearSeeds(const FlightInput& input);
    void chart(const FlightInput& input);
    bool covered(const FlightInput& input) const;

    void foresee(const FlightInput& input, BodyIndex a, BodyIndex b);
    void foreseeWall(const FlightInput& input, BodyIndex ball, const BoundedWall& wall);
    void foreseeAround(const FlightInput& input, BodyIndex body);
    void meet(const FlightInput& input, const Meeting& meeting);
    void strike(const FlightInput& input, BodyIndex a, BodyIndex b);
    void strikeWall(const FlightInput& input, BodyIndex ball, std::uint32_t wall);
    void keepSupport(const FlightInput& input, BodyIndex ball);
    bool closesOnOthers(const FlightInput& input, BodyIndex body, BodyIndex except, double time) const;
    void moveTo(const FlightInput& input, BodyIndex body, double time);
    void setSpin(BodyIndex body, const Vec3& spin);
    void groundGroups();

    bool isWallBody(BodyIndex body) const { return m_wallAt[body] != noWall; }
    Law lawOf(const FlightInput& input, BodyIndex a, BodyIndex b) const;
    const Vec3& accelerationOf(BodyIndex body) const { return m_courses[m_support[body]].acceleration; }
    int impactsOf(BodyIndex body) const { return m_log[body] == noLog ? 0 : m_logs[m_log[body]].impacts; }
    double gapTo(const BoundedWall& wall, const Vec3& position, double radius) const {
        return wall.normal.dot(position) - wall.offset - radius;
    }
    Log& logOf(const FlightInput& input, BodyIndex body);
    std::uint32_t groupOf(std::uint32_t log);

    std::vector<BoundedWall> m_walls;
    std::vector<std::uint32_t> m_wallAt; // by body: index of m_walls, or noWall
    std::vector<std::uint8_t> m_simple;  // by body: a mobile sphere without springs
    std::uint64_t m_searches = 0;        // of the neighbours, when the pairs were sorted
    std::vector<WallPair> m_wallPairs;
    std::vector<BodyPair> m_ballPairs;
    std::vector<BodyPair> m_close;        // ball pairs that may meet in the substep
    std::vector<std::uint8_t> m_grounded; // by body
    std::vector<std::uint32_t> m_support; // by body: 0, or 1 + its wall in m_walls
    std::vector<Stamp> m_stamps;          // by body
    std::vector<BodyIndex> m_seeds;
    std::vector<std::uint32_t> m_log; // by body
    std::vector<Log> m_logs;
    std::vector<Meeting> m_meetings; // a heap, earliest first
    std::vector<Course> m_courses;   // by support
    std::size_t m_impacts = 0;
};

} // namespace carom
