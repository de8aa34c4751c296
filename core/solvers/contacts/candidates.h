// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/workers.h"
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

    /// Takes note of who is a member; of each member, lookAt() must then be called once.
    void note(const Bodies& bodies, const State& state, std::span<const BodyIndex> members,
              std::span<const std::uint8_t> placed);
    /// Takes note of how far members come in the substep that the neighbours followed last, and has the
    /// neighbours searched where they may come further than what was searched. Pairs of two that are `placed`
    /// (by body, not 0) are left out: its pairs with others that are placed and with what cannot move are
    /// known. Looks at those members that are active, ascending: nothing of the others has changed, and all
    /// of them are placed.
    void lookAt(const Bodies& bodies, const State& state, std::span<const BodyIndex> active,
                std::span<const std::uint8_t> placed, Neighbours& neighbours, Broadphase& broadphase,
                Workers& workers = Workers::alone());
    /// The same where these bodies, ascending, which are not placed, have become members since.
    void join(const Bodies& bodies, const State& state, std::span<const BodyIndex> joined,
              Neighbours& neighbours, Broadphase& broadphase, Workers& workers = Workers::alone());
    /// Members whose reach the last of these has set, after lookAt() only those that share that of others;
    /// some may be named twice.
    std::span<const BodyIndex> changed() const { return m_changed; }
    /// Members that are not placed, ascending.
    std::span<const BodyIndex> free() const { return m_free; }

    /// How far a member's surface may move [m]: a body that is struck may leave faster than it came, so
    /// neighbours share their reach.
    double reach(BodyIndex member) const { return m_body[member].reach; }
    /// Whether members have more pairs within their reach in so many substeps than in one, taken as often.
    bool comeFar(std::span<const BodyIndex> members, int substeps) const;
    /// Pairs that may touch, ascending.
    std::span<const BodyPair> find(const Bodies& bodies, const State& state, const Neighbours& neighbours,
                                   Workers& workers = Workers::alone());
    /// Up to which separation points of a pair are kept [m].
    double marginOf(BodyPair pair) const;

  private:
    /// Left: mobile, and no member.
    enum class Kind : std::uint8_t { Immobile, Left, Placed, Member };
    /// A body and its bounding ball; of walls the radius is infinite.
    struct Body {
        Vec3 centre = Vec3::Zero(); // [m]
        double radius = 0;          // [m]
        double extent = 0;          // the radius, and how far it reaches at least as a pair's margin is [m]
        double reach = 0;           // [m]
    };
    struct Larger {
        BodyIndex body = 0;
        double reach = 0; ///< [m]
    };
    /// From members to other members of larger index, and to what is immobile or placed.
    using Found = UpAndDown<BodyPair>;
    static Kind kindOf(std::uint8_t placed) { return placed != 0 ? Kind::Placed : Kind::Member; }
    static bool mayBeWithin(const Body& a, const Body& b) {
        const double extents = a.extent + b.extent;
        return (b.centre - a.centre).squaredNorm() <= extents * extents;
    }
    void notePlace(const Bodies& bodies, const State& state, BodyIndex body);
    void setReach(BodyIndex body, double reach);
    bool noteReach(const Bodies& bodies, const State& state, std::span<const BodyIndex> members,
                   Neighbours& neighbours);
    bool shareReach(const Bodies& bodies, const State& state, std::span<const BodyIndex> from,
                    Neighbours& neighbours, Workers& workers);
    void findLarger(const Bodies& bodies, const State& state, BodyIndex i, bool isOfAll,
                    const Neighbours& neighbours, std::vector<Larger>& larger) const;
    bool areWithin(const Bodies& bodies, const State& state, BodyPair pair, double margin) const;
    double leastMarginOf(BodyPair pair) const;

    // By body.
    std::vector<Body> m_body; // of those that are not left
    std::vector<Aabb> m_box;  // of those that are neither left nor balls
    std::vector<Kind> m_kind;

    std::vector<BodyIndex> m_immobile; // and bounded
    std::vector<BodyIndex> m_free, m_merged, m_changed;
    Found m_found;
    std::vector<Larger> m_larger;
    std::vector<BodyPair> m_pairs;
};

} // namespace carom
