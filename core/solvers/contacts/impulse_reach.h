// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/contacts/manifolds.h"
#include "core/solvers/contacts/neighbours.h"

#include <cstdint>
#include <span>
#include <vector>

// The bodies that impulses can reach within a substep. Most bodies of a sparse scene are near others but
// touch none of them: as long as nothing strikes them they move on a parabola and need not be in an island.
//
//     sources   bodies of pairs that may meet as they move, on springs, and on the base path: reached at 0
//     spread    a body that is reached at t may from then on move anywhere at a speed S, that of the impact
//               law (Neighbours::speedAfter); its neighbour k moves on its own path:
//
//                   i ──── gap(t) ──── k        t_k = t + (gap(t) − slack)/(S + s_k)
//
//               and is reached if that is within the substep
//
//     legend    gap(t)  of balls |d + u t| − rA − rB, of other shapes at least gap(0) − (s_i + s_k) t
//               s       how fast a body's surface comes while nothing strikes it
//
// Limits: pairs are those of the candidates, where a body extends the reach of its direct neighbours only
// (candidates.h). In a row of resting bodies an impulse is followed to the third within a substep; the fourth
// is reached in the next one.

namespace carom {

class ImpulseReach {
  public:
    explicit ImpulseReach(std::size_t bodies)
        : m_time(bodies), m_speed(bodies), m_first(bodies), m_end(bodies) {}

    struct Input {
        const ManifoldInput& here;
        const Neighbours& neighbours;             ///< as they followed the bodies last
        std::span<const BodyIndex> members;       ///< ascending; bodies of all pairs that can move
        std::span<const ContactPair> pairs;       ///< ascending
        std::span<const double> gaps;             ///< by pair, at least this far apart [m]
        std::span<const std::uint8_t> canMeet;    ///< by pair
        std::span<const std::uint8_t> isOnSpring; ///< by body
        std::span<const std::uint8_t> isPlaced;   ///< by body, not 0: on the base path
        Workers& workers = Workers::alone();
    };
    void find(const Input& input);
    /// By pair, 1: impulses can reach both of its bodies, as far as they can move.
    std::span<const std::uint8_t> pairs() const { return m_isReached; }

  private:
    void reach(BodyIndex body, double time, double speed);
    void listAround(const Input& input);
    void meet(const Input& input, std::uint32_t pair);
    void spread(const Input& input, BodyIndex body, std::uint32_t pair);

    // By body.
    std::vector<double> m_time;                // when it is reached [s]; infinite: never
    std::vector<double> m_speed;               // and how fast it may be then [m/s]
    std::vector<std::uint32_t> m_first, m_end; // of members: where their pairs are in m_around

    std::vector<std::uint32_t> m_around;
    std::vector<BodyIndex> m_queue;
    std::vector<std::uint8_t> m_isReached; // by pair
};

} // namespace carom
