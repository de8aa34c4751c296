// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"
#include "core/solvers/contacts/neighbours.h"

#include <cstdint>
#include <span>
#include <vector>

// The pairs that a substep must test for the bodies that are not asleep (the members): those that may touch
// within it, and those so near that their forces are kept through small bounces. Pairs with immobile bodies
// are among them, pairs with mobile bodies that are no members are not.

namespace carom {

class Candidates {
  public:
    explicit Candidates(const Bodies& bodies);

    /// Takes note of how far the members come in the substep that the neighbours followed last, and of the
    /// pairs among them, without those of two that are `placed` (by body, not 0: its pairs with others that
    /// are placed and with what cannot move are known). False if a body may come further than what was
    /// searched: the neighbours must search, and be asked again.
    bool look(const Bodies& bodies, const State& state, std::span<const BodyIndex> members,
              std::span<const std::uint8_t> placed, Neighbours& neighbours);

    /// How far a member's surface may move [m]: a body that is struck may leave as fast as the striker, so
    /// neighbours share their reach.
    double reach(BodyIndex member) const { return m_reach[member]; }
    /// Pairs that may touch, ascending.
    std::span<const BodyPair> find(const Bodies& bodies, const State& state);
    /// Up to which separation points of a pair are kept [m].
    double marginOf(BodyPair pair) const;

  private:
    struct Near {
        BodyPair pair;
        double gap = 0; // of their bounding balls [m]
    };
    /// The bounding ball of a body; of walls the radius is infinite.
    struct Ball {
        Vec3 centre = Vec3::Zero(); // [m]
        double radius = 0;          // [m]
    };
    double leastMarginOf(BodyPair pair) const;
    double gapOf(const Bodies& bodies, const State& state, BodyPair pair) const;
    bool shareReach(const Bodies& bodies, const State& state, const Near& near, Neighbours& neighbours);

    /// Left: mobile, and no member.
    enum class Kind : std::uint8_t { Immobile, Left, Placed, Member };
    std::vector<Kind> m_kind;     // by body
    std::vector<double> m_reach;  // by body [m]
    std::vector<Ball> m_ball;     // by body
    std::vector<Near> m_upward;   // from a member to a larger index, ascending
    std::vector<Near> m_downward; // from a member to something immobile or placed of smaller index
    std::vector<BodyPair> m_up, m_down, m_pairs;
};

} // namespace carom
