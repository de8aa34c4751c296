// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/coasting.h"
#include "core/solvers/contacts/course.h"
#include "core/solvers/contacts/neighbours.h"
#include "core/solvers/solver.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

// Bodies that nothing can strike for some substeps move by the parabola and turn freely, which is exact over
// any time, so those substeps leave them out:
//
//     start    at the start of a frame all bodies fly that nothing holds, until they meet one that flies too,
//              sleeps, or cannot move
//     findDue  in each substep, the flights of those end that do
//     spread   and those of bodies that may be struck in it: by one that does not fly, or by one that such a
//              body strikes
//     end      at the end of the frame, the flights of all others end
//
// Two that fly meet when their bounding balls do on their parabolas; as both fall alike, that is a straight
// line for one seen from the other, however fast they are. A body that may be struck from the time t on is
// then anywhere its speed S of after the strike takes it, and so are those that it may strike:
//
//     |p_k(s) − p_i(t)| ≤ r_i + r_k + S_i (h − t)    for some s in [t, h]:    t_k = t + gap/(S_i + v_k)
//
// Who flies is in no pair that can meet in the substep, and the motion is the same but for rounding, whoever
// flies. It depends on positions and velocities only, not on the lists.
//
// During a flight the state has the body's present position and velocity; it turns when the flight ends.
//
// Bodies on springs, on the base path, and with force terms never fly, nor does any where the integrator is
// not exact in free motion.

namespace carom {

class FreeFlight {
  public:
    explicit FreeFlight(const Bodies& bodies);

    bool has(BodyIndex body) const { return m_kind[body] == Kind::Flying; }
    std::span<const BodyIndex> bodies() const { return m_bodies; } ///< that fly, ascending

    /// At the start of a frame: moves those that may fly from `members`, ascending, to bodies(). By body, not
    /// 0: `isOnSpring`; `isPlaced`, on the base path.
    void choose(const SolverInput& input, std::span<const std::uint8_t> isOnSpring,
                std::span<const std::uint8_t> isPlaced, std::vector<BodyIndex>& members);
    /// Finds when these meet something, and writes those that do at once to `landed`, ascending: they are
    /// members from now on. The neighbours have followed the other members.
    void start(const SolverInput& input, Neighbours& neighbours, std::vector<BodyIndex>& landed);
    /// Brings the positions and velocities of those that fly to the start of a later substep.
    void advance(const SolverInput& input);
    /// Ends the flights of bodies that meet others in this substep, and writes them to `due`, ascending. They
    /// are members from now on, and turned as far as they have.
    void findDue(const SolverInput& input, std::vector<BodyIndex>& due);
    /// The same for those that may be struck because of these members. reachOf(member) is how far its surface
    /// may move in the substep [m].
    template<class ReachOf>
    void spread(const SolverInput& input, std::span<const BodyIndex> members, Neighbours& neighbours,
                const ReachOf& reachOf, std::vector<BodyIndex>& met) {
        m_strikes.clear();
        if (!m_bodies.empty())
            for (const BodyIndex i : members)
                if (m_kind[i] != Kind::Struck)
                    m_strikes.push_back({i, m_landing[i].part == input.part ? m_landing[i].time : 0,
                                         reachOf(i) / input.substep});
        strikeAll(input, neighbours, met);
    }
    /// These bodies slept, and are members from now on.
    void join(std::span<const BodyIndex> woken) {
        for (const BodyIndex i : woken) join(i);
    }
    /// Ends all flights, after the last substep of a frame.
    void end(const SolverInput& input);
    /// Forgets all flights.
    void clear();

  private:
    /// Left: immobile or asleep. Struck: a member that may have been struck in flight in this substep.
    enum class Kind : std::uint8_t { Left, Member, Struck, Flying };
    /// Of what flies: where it was when the frame began, how fast, and when it meets something, of the frame;
    /// and how far the surface may turn in the frame, 0 if it has not flown in it. Together in memory, as
    /// whoever asks for one asks for most of it.
    struct alignas(64) Flight {
        Vec3 position = Vec3::Zero(), velocity = Vec3::Zero(); // [m], [m/s]
        double due = 0;                                        // [s]
        double turn = 0;                                       // [m]
    };
    /// Of a member: the time at which its flight ended, and how fast its surface may then be if it has been
    /// struck.
    struct Landing {
        double time = 0, speed = 0; // of the substep [s], [m/s]
        int part = -1;              // the substep; -1 if it has not flown in this frame
    };
    /// A body that may be struck from `time` [s] of the substep on, and how fast its surface may then be.
    struct Strike {
        BodyIndex body = 0;
        double time = 0, speed = 0; // [s], [m/s]
    };
    /// A body that a strike may hit at a time [s] of the substep, and how fast its surface may then be [m/s].
    struct Hit {
        std::size_t strike = 0; // its place in m_strikes
        BodyIndex body = 0;
        double at = 0, after = 0;
    };
    /// It has not flown in this frame.
    void join(BodyIndex member) {
        m_kind[member] = Kind::Member;
        m_flight[member].turn = 0;
        m_landing[member] = {};
    }
    double turnInFrame(const SolverInput& input, BodyIndex body) const;
    double roomOf(const SolverInput& input, BodyIndex body) const;
    Vec3 placeIn(const SolverInput& input, BodyIndex body, int part) const;
    double timeOfMeeting(const SolverInput& input, BodyIndex body, BodyIndex other) const;
    double timeOfMeetingUnmoved(const SolverInput& input, BodyIndex body, BodyIndex other) const;
    bool doBoxesMeet(const SolverInput& input, BodyIndex body, BodyIndex other, int part) const;
    void strikeAll(const SolverInput& input, Neighbours& neighbours, std::vector<BodyIndex>& met);
    double roomAfter(const SolverInput& input, const Strike& by) const;
    /// The body has been struck harder since this strike was noted, and another one stands for that.
    bool isOutdated(const Strike& by) const {
        return m_kind[by.body] == Kind::Struck &&
               (by.time != m_landing[by.body].time || by.speed != m_landing[by.body].speed);
    }
    /// The body has been struck no later than this striker, and is no slower.
    bool isStruckBefore(BodyIndex body, const Strike& by) const {
        return m_kind[body] == Kind::Struck && m_landing[body].time <= by.time &&
               m_landing[body].speed >= by.speed;
    }
    void coverStruck(const SolverInput& input, std::size_t begin, Neighbours& neighbours);
    void findHits(const SolverInput& input, std::size_t number, const Neighbours& neighbours,
                  std::vector<Hit>& hits) const;
    void take(const SolverInput& input, const Hit& hit, std::vector<BodyIndex>& met);
    void land(const SolverInput& input, std::vector<BodyIndex>& landed);
    void finish(const SolverInput& input, int parts, std::span<const BodyIndex> landed);

    // By body.
    std::vector<Kind> m_kind;
    std::vector<Flight> m_flight;
    std::vector<Landing> m_landing;

    double m_fall = 0; // how far what flies comes by gravity in a substep [m]
    std::vector<BodyIndex> m_bodies;
    std::vector<BodyIndex> m_meeting; // those that flew when the frame began and meet something in it
    std::vector<Strike> m_strikes;
    std::vector<Hit> m_hits;         // of a round of strikes
    std::vector<BodyIndex> m_struck; // of this kind
    Coasting m_coasting;
};

} // namespace carom
