// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/ledger.h"
#include "core/dynamics/state.h"
#include "core/math/compensated.h"
#include "core/solvers/event_times.h"
#include "core/solvers/neighbours.h"
#include "core/solvers/platforms.h"
#include "core/solvers/resting.h"

#include <algorithm>
#include <span>
#include <vector>

// Spheres that fly, or slide without friction on one wall, and meet others one at a time. Between impacts
// their motion is a closed form, and an impact of two spheres or of a sphere and a wall is one too and
// concerns nobody else: so a frame is lived through from impact to impact, each at its own time, however
// many bodies move (as event_gas.h does for a whole run). A gas costs little but its impacts, and nothing
// overlaps.
//
// Whatever is not of that kind is grounded for a substep and left to the islands: bodies that rest on each
// other or with friction, overlap, hang on springs, are no spheres, meet several others at one instant, or
// meet others more than `mostImpacts` times in the substep. What comes near the grounded does not fly either:
//
//     seeds    those grounded at the start or at rest (resting.h), and the spheres within reach of them
//     groups   a sphere that would meet a grounded one, and all that it has met in this substep
//
// but for the light balls about a platform (platforms.h), which fly and strike it as they would a wall.
//
//     frame   |--------------|--------------|--------------|--------------|
//     flying  o- - - - - x - - - - - - - - - - - - - - - - - - - -x - - - o   x impacts
//     grounded       moved substep by substep; may take off at each |, where those that fly may land
//
// Nobody who flies is looked at between impacts: the State of a flying sphere is that of the moment it took
// off, until it lands among the grounded or the frame ends.

namespace carom {

/// One substep of a frame; times count from the frame's start.
struct FlightInput {
    const Bodies& bodies;
    State& state;
    Vec3 gravity;                       ///< [m/s²]
    double substep = 0;                 ///< [s]
    double now = 0, until = 0, end = 0; ///< this substep, and the frame's end [s]
    double restingSpeed = 0;            ///< closing speeds up to this are rest, whatever the gravity [m/s]
    Neighbours& neighbours;
    const Resting& resting;
    Ledger* ledger = nullptr;
};

/// Bodies that fly through the whole frame under one acceleration.
struct Course {
    Vec3 acceleration = Vec3::Zero(); ///< [m/s²]
    std::vector<BodyIndex> bodies;    ///< ascending
};

class Flights {
  public:
    explicit Flights(const Bodies& bodies);

    /// Finds out who flies through the substep, and lives through its impacts; changes nothing else. False if
    /// the neighbours do not cover the paths: they must search, and the same substep be planned again.
    bool plan(const FlightInput& input);
    /// Brings the State of the grounded to the start of the substep.
    void bring(const FlightInput& input);
    /// Of a body at rest that was woken: it does not fly in this substep, but may in the next.
    void rouse(BodyIndex body);
    /// Gives the platforms what struck them in the substep.
    void kickPlatforms(const FlightInput& input) const;
    /// At the end of the frame: who met nobody, to be moved on by the caller.
    std::span<const Course> chart(const Bodies& bodies);
    /// At the end of the frame: moves the others that fly.
    void land(const FlightInput& input);

    bool flies(BodyIndex body) const { return m_grounded[body] == 0; }
    /// Mobile bodies that do not fly in this substep, ascending.
    std::span<const BodyIndex> grounded() const { return m_groundedBodies; }
    /// Of those that fly, in this substep.
    std::size_t impacts() const { return m_impacts; }

  private:
    static constexpr std::uint32_t none = 0xffffffffU;

    struct BoundedWall {
        BodyIndex body = noBody;
        Vec3 normal;
        double offset = 0;
    };
    struct WallPair {
        BodyIndex ball = noBody;
        std::uint32_t wall = 0; // of m_walls
    };
    /// What a sphere that is not as it was at the frame's start has gone through since it took off.
    struct Log {
        BodyIndex body = noBody, last = noBody; // whom it met last
        std::uint32_t saved = none;             // index of m_saved, if touched in this substep
        std::uint32_t group = 0;                // in this substep: index of a log, its own at the root
        int impacts = 0;                        // in this substep
        bool landed = false;                    // at the root, the group
        double begin = 0;                       // when the State was as it is [s]
        double path = 0;                        // [m]
        double turned = 0;                      // time up to which the orientation is known [s]
        double rubbed = 0;        // work of friction [J]; of two spheres, in the log of the first
        Vec3 held = Vec3::Zero(); // momentum that the friction of walls gave [kg m/s]
        Vec3 spin = Vec3::Zero();
        Quat orientation = Quat::Identity();
    };
    /// As a sphere was at the start of the substep.
    struct Saved {
        Log log;
        Stamp stamp;
        Vec3 rest = Vec3::Zero();
        std::uint32_t support = 0;
    };
    /// Foreseen in one version of both; in any other it is off.
    struct Meeting {
        double time = never;
        BodyIndex a = noBody, b = noBody; // b may be a wall or a platform
        std::uint32_t version = 0;
    };
    /// A total order, so that equal times are met in the same order whatever was foreseen first.
    static bool isLater(const Meeting& x, const Meeting& y) {
        if (x.time != y.time) return x.time > y.time;
        return x.a != y.a ? x.a > y.a : x.b > y.b;
    }
    struct Law {
        double restitution, friction, leastImpact;
        bool rolls;
    };

    void begin(const FlightInput& input);
    void proceed(const FlightInput& input);
    void welcome(const FlightInput& input);
    void undo(const FlightInput& input);
    void freshen(const FlightInput& input, BodyIndex ball);
    void sortPairs(const Neighbours& neighbours);
    template<class OnWall>
    void eachFreshWall(const FlightInput& input, const OnWall& onWall) const;
    template<class OnPair>
    void eachFreshPair(const FlightInput& input, const OnPair& onPair) const;
    void restOnWalls(const FlightInput& input);
    void findClosePairs(const FlightInput& input);
    void choosePlatforms(const FlightInput& input);
    void groundNearSeeds(const FlightInput& input);
    void groundGroups();
    bool covered(const FlightInput& input) const;
    void settle(const FlightInput& input, BodyIndex ball, double time);
    void book(const FlightInput& input, const Log& log, double time) const;

    void foreseeAll(const FlightInput& input);
    void foresee(const FlightInput& input, BodyIndex a, BodyIndex b);
    void foreseeWall(const FlightInput& input, BodyIndex ball, const BoundedWall& wall);
    void foreseePlatform(const FlightInput& input, BodyIndex ball, BodyIndex platform);
    void foreseeAround(const FlightInput& input, BodyIndex body);
    void expect(const Meeting& meeting);
    void meetAll(const FlightInput& input);
    void meet(const FlightInput& input, const Meeting& meeting);
    void strike(const FlightInput& input, BodyIndex a, BodyIndex b);
    void strikeWall(const FlightInput& input, BodyIndex ball, std::uint32_t wall);
    void strikePlatform(const FlightInput& input, BodyIndex ball, BodyIndex platform);
    void keepSupport(const FlightInput& input, BodyIndex ball);
    bool closesOnOthers(const FlightInput& input, BodyIndex body, BodyIndex except, double time) const;
    bool comesNear(const FlightInput& input, BodyIndex ball, BodyIndex body) const;
    bool mayStrike(const FlightInput& input, BodyIndex ball, BodyIndex body) const;
    double reachOf(const FlightInput& input, BodyIndex body) const;
    void moveTo(const FlightInput& input, BodyIndex body, double time);
    void setSpin(BodyIndex body, const Vec3& spin);

    bool isWallBody(BodyIndex body) const { return m_wallAt[body] != none; }
    /// A ball that is at rest is left alone: for those that fly it is as any body that never flies.
    bool isSimple(const FlightInput& input, BodyIndex body) const {
        return m_simple[body] != 0 && !input.resting.rests(body);
    }
    bool isFresh(const FlightInput& input, BodyIndex ball) const {
        return m_allFresh || (m_log[ball] != none && m_logs[m_log[ball]].begin == input.now);
    }
    Law lawOf(const FlightInput& input, BodyIndex a, BodyIndex b) const;
    const Vec3& accelerationOf(BodyIndex body) const { return m_courses[m_support[body]].acceleration; }
    Vec3 placeAt(BodyIndex ball, double time) const {
        return positionAt(m_stamps[ball], accelerationOf(ball), time);
    }
    Vec3 speedAt(BodyIndex ball, double time) const {
        return velocityAt(m_stamps[ball], accelerationOf(ball), time);
    }
    int impactsOf(BodyIndex body) const {
        return m_log[body] == none || m_logs[m_log[body]].saved == none ? 0 : m_logs[m_log[body]].impacts;
    }
    std::uint32_t versionOf(BodyIndex a, BodyIndex b) const { return m_version[a] + m_version[b]; }
    double gapTo(const BoundedWall& wall, BodyIndex ball) const {
        const Stamp& stamp = m_stamps[ball];
        return exactGap(wall.normal, wall.offset, stamp.radius, stamp.position, m_placeRests[ball]);
    }
    void setStamp(const State& state, BodyIndex ball, double time, double radius) {
        m_stamps[ball] = {state.pose[ball].position, time, state.velocity[ball], radius};
        m_placeRests[ball] = state.positionRest[ball];
    }
    void ground(BodyIndex ball) {
        if (m_grounded[ball] != 0) return;
        m_grounded[ball] = 1;
        m_landed.push_back(ball);
    }
    Log& logOf(const FlightInput& input, BodyIndex body);
    Log& touch(const FlightInput& input, BodyIndex body);
    std::uint32_t groupOf(std::uint32_t log);

    std::vector<BoundedWall> m_walls;
    std::vector<std::uint32_t> m_wallAt; // by body: index of m_walls, or none
    std::vector<std::uint8_t> m_simple;  // by body: a mobile sphere without springs
    std::vector<BodyIndex> m_never;      // bounded bodies that never fly, ascending
    std::vector<BodyIndex> m_bulky;      // of these, those without springs that are no spheres
    std::uint64_t m_searches = 0;        // of the neighbours, when the pairs were sorted
    std::vector<WallPair> m_wallPairs;
    std::vector<BodyPair> m_ballPairs;

    std::vector<std::uint8_t> m_grounded; // by body
    std::vector<std::uint32_t> m_support; // by body: 0, or 1 + its wall in m_walls
    std::vector<Stamp> m_stamps;          // by body
    std::vector<Vec3> m_placeRests;       // by body: what the place of the stamp rounded off [m]
    std::vector<std::uint32_t> m_log;     // by body
    std::vector<std::uint32_t> m_version; // by body: how often its path has changed
    std::vector<Log> m_logs;              // of the frame
    std::vector<std::uint32_t> m_touched; // logs of those whom something befell in this substep
    std::vector<Saved> m_saved;           // of these
    std::vector<Course> m_courses;        // by support
    std::vector<Meeting> m_meetings;      // a heap, earliest first

    bool m_allFresh = true;          // the frame begins
    double m_planned = -1;           // the substep that was planned last [s]
    std::vector<BodyIndex> m_fresh;  // else those that may take off: grounded balls of the substep before
    std::vector<BodyIndex> m_again;  // those whose impacts are to be lived through again
    std::vector<BodyIndex> m_landed; // balls grounded in this substep
    std::vector<BodyIndex> m_groundedBodies;
    std::vector<BodyPair> m_close;    // ball pairs that may meet
    std::vector<BodyPair> m_touching; // and those that touched when they were fresh
    Platforms m_platforms;
    std::vector<BodyPair> m_guests; // a ball, and the platform that it may strike
    std::size_t m_impacts = 0;
};

} // namespace carom
