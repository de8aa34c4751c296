// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/coasting.h"
#include "core/solvers/contacts/neighbours.h"
#include "core/solvers/solver.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

// Bodies that come near nothing for some substeps move by the parabola and turn freely, which is exact over
// any time, so those substeps leave them out:
//
//     start    at the start of a frame all bodies fly that nothing holds, until they come near one that flies
//              too, sleeps, or cannot move
//     findDue  in each substep, the flights of those end that do
//     findMet  and those of bodies that come near one that does not fly: it may be struck and change its
//              course
//     end      at the end of the frame, the flights of all others end
//
// Near means that bounding balls and boxes are within the sum of their reach: how far either can come in a
// substep, an impact included. So who flies is in no pair that the substep looks at (candidates.h), and the
// motion is the same but for rounding, whoever flies. It depends on positions and velocities only, not on the
// lists.
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

    /// At the start of a frame: moves those that fly from `members`, ascending, to bodies(). The neighbours
    /// have followed the members. By body, not 0: `isOnSpring`; `isPlaced`, on the base path.
    void start(const SolverInput& input, std::span<const std::uint8_t> isOnSpring,
               std::span<const std::uint8_t> isPlaced, Neighbours& neighbours,
               std::vector<BodyIndex>& members);
    /// Brings the positions and velocities of those that fly to the start of a later substep.
    void advance(const SolverInput& input);
    /// Ends the flights of bodies that come near others in this substep, and writes them to `due`, ascending.
    /// They are members from now on, and turned as far as they have.
    void findDue(const SolverInput& input, std::vector<BodyIndex>& due);
    /// The same for those that come near one of these members. reachOf(member) is how far its surface may
    /// move [m].
    template<class ReachOf>
    void findMet(const SolverInput& input, std::span<const BodyIndex> members, const Neighbours& neighbours,
                 const ReachOf& reachOf, std::vector<BodyIndex>& met);
    /// These bodies slept, and are members from now on.
    void join(std::span<const BodyIndex> woken) {
        for (const BodyIndex i : woken) m_kind[i] = Kind::Member;
    }
    /// Ends all flights, after the last substep of a frame.
    void end(const SolverInput& input);
    /// Forgets all flights.
    void clear();

  private:
    /// Left: immobile or asleep.
    enum class Kind : std::uint8_t { Left, Member, Flying };
    struct Start {
        Vec3 position = Vec3::Zero(), velocity = Vec3::Zero(); // [m], [m/s]
    };
    double reachOf(BodyIndex body) const { return has(body) ? m_reach[body] : 0; }
    double reachInFrame(const SolverInput& input, BodyIndex body) const;
    Vec3 placeIn(const SolverInput& input, BodyIndex body, int part) const;
    int partOfMeeting(const SolverInput& input, BodyIndex body, BodyIndex other) const;
    bool mayMeet(const SolverInput& input, BodyIndex body, BodyIndex other) const;
    bool isNear(const SolverInput& input, BodyIndex flying, BodyIndex other, double reach) const {
        return areWithin(input.bodies, input.state, {std::min(flying, other), std::max(flying, other)},
                         m_reach[flying] + reach);
    }
    void land(const SolverInput& input, std::vector<BodyIndex>& landed);
    void finish(const SolverInput& input, int parts, std::span<const BodyIndex> landed);

    // By body.
    std::vector<Kind> m_kind;
    std::vector<double> m_reach; // of those that fly: in any substep of the frame [m]
    std::vector<int> m_due;      // of those that fly: the substep in which they come near something
    std::vector<Start> m_start;  // of those that fly

    std::vector<BodyIndex> m_bodies;
    Coasting m_coasting;
};

template<class ReachOf>
void FreeFlight::findMet(const SolverInput& input, std::span<const BodyIndex> members,
                         const Neighbours& neighbours, const ReachOf& reachOf, std::vector<BodyIndex>& met) {
    met.clear();
    if (m_bodies.empty()) return;
    for (const BodyIndex i : members)
        for (const BodyIndex k : neighbours.around(i)) {
            if (!has(k) || !isNear(input, k, i, reachOf(i))) continue;
            m_kind[k] = Kind::Member;
            met.push_back(k);
        }
    land(input, met);
}

} // namespace carom
