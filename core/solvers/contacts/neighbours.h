// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/broadphase/box_columns.h"
#include "core/broadphase/broadphase.h"
#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

// The pairs that can meet in the next few substeps (a Verlet list). A search is the largest cost of a sparse
// scene, so each body gets a skin, the broad-phase finds the pairs whose skins overlap, and they are valid
// until some body has moved by its skin (L. Verlet, "Computer experiments on classical fluids", 1967):
//
//        ______________
//       /  ____   skin \         serves while   moved + path <= skin   for every body
//      |  /body\___>    |        where path is what it needs in the substep at hand;
//      |  \____/  moved |
//       \______________/                more, for what may be hit on the way, is asked for by covers()
//
// Where only some have used it up, all others are compared with these, and the rest of the lists stays.
//
// Users of the list test its pairs at their present poses: the motion depends neither on the skins nor on
// when they were renewed, only the time does.

namespace carom {

/// The gap between the bounding balls of two bodies, or of a ball and a wall [m]; the bodies are no nearer.
double boundingGap(const Bodies& bodies, const State& state, BodyPair pair);
/// Whether the boxes of a pair are within `margin` [m]; to be asked for pairs whose bounding balls are. A
/// list that covers both bodies for `margin` has all pairs for which both is true, and may have others.
bool areBoxesWithin(const Bodies& bodies, const State& state, BodyPair pair, double margin);
/// Both.
inline bool areWithin(const Bodies& bodies, const State& state, BodyPair pair, double margin) {
    return boundingGap(bodies, state, pair) <= margin && areBoxesWithin(bodies, state, pair, margin);
}

/// What was found from each body to those of larger index, ascending, and the rest, as one: `down` is sorted.
/// No memory is taken while crowds are no larger than they were.
template<class Pair>
void mergeAscending(const std::vector<Pair>& up, std::vector<Pair>& down, std::vector<Pair>& all) {
    std::sort(down.begin(), down.end());
    all.reserve(up.capacity() + down.capacity());
    all.resize(up.size() + down.size());
    std::merge(up.begin(), up.end(), down.begin(), down.end(), all.begin());
}

class Neighbours {
  public:
    explicit Neighbours(const Bodies& bodies);

    /// Records the poses of the bodies and how far each moves within `duration` [s] by its velocity and
    /// gravity. Searches if the list could miss a pair.
    void update(const Bodies& bodies, const State& state, std::span<const BodyIndex> list,
                const Vec3& gravity, double duration, Broadphase& broadphase);
    /// The same for some of the bodies, while the others go on as they did when noted last. False if the list
    /// could miss a pair of them: search() must be called.
    bool follow(const Bodies& bodies, const State& state, std::span<const BodyIndex> list,
                const Vec3& gravity, double duration);
    /// Searches, with wider skins of the bodies for which covers() was false; only for these, if they are
    /// few.
    void search(const Bodies& bodies, const State& state, Broadphase& broadphase);

    /// Whether the list has all pairs that a body can meet within `room` [m] of its present place. If not,
    /// the body is noted, and search() must be called.
    bool covers(BodyIndex body, double room);

    /// The number of searches for all bodies.
    std::uint64_t searches() const { return m_searches; }

    /// An upper bound of the speed of a body's surface [m/s]; a sphere's spin does not count.
    static double surfaceSpeed(const Bodies& bodies, const State& state, BodyIndex body);

    /// An upper bound of the displacement of any point of a body [m].
    static double displacement(const Bodies& bodies, BodyIndex body, const Pose& from, const Pose& to);

    /// How far a body's surface can move in the last given duration [m].
    double reach(BodyIndex body) const { return reachFactor * m_path[body]; }
    /// How far springs and force terms move it at most [m] in the last given duration, or in a longer `time`
    /// [s].
    double pull(BodyIndex body, double time) const {
        const double times = std::max(1.0, time / m_duration);
        return m_pull[body] * times * times;
    }

    /// The limit by momentum of a body's speed or distance, which is `own` before a striker with `other` and
    /// `part` of the mass of both has struck it.
    static double momentumLimit(double part, double own, double other) {
        return own + 2 * part * (own + other);
    }
    /// How far a mobile body, which moves `own` by itself, may move after `striker`, which moves `other`, has
    /// struck it [m]: no further than the striker, and than momentum allows.
    static double reachAfter(const Bodies& bodies, BodyIndex body, double own, BodyIndex striker,
                             double other) {
        const double part =
            bodies.inverseMass[body] / (bodies.inverseMass[body] + bodies.inverseMass[striker]);
        return std::max(own, std::min(other, momentumLimit(part, own, other)));
    }

    /// The bodies in pairs with `body`, walls among them, ascending; none for immobile bodies.
    std::span<const BodyIndex> around(BodyIndex body) const { return m_around[body]; }
    /// The sum of the lengths of all these lists: at least the number of pairs.
    std::size_t ends() const { return m_ends; }

    /// A body may come this many times as far as it would without impacts: an impact may speed it up on the
    /// way. At half, pairs are missed that meet after an impact within the substep; at twice, there are more
    /// pairs to look at.
    static constexpr double reachFactor = 2.2;
    /// And always this far, relative to its size, so that forces are remembered through small hops. At half,
    /// bodies that hop a little lose their forces; at twice, there are more pairs to look at.
    static constexpr double leastMargin = 0.01;

  private:
    Aabb boxWithSkin(const Bodies& bodies, const State& state, BodyIndex body) const;
    bool doSkinsTouch(const Bodies& bodies, const State& state, BodyIndex body, BodyIndex other) const;
    void renewSkin(const Bodies& bodies, const State& state, BodyIndex body);
    void noteTypical(const Bodies& bodies, std::span<const BodyIndex> list);
    bool areFewOutrun() const;
    void searchAll(const Bodies& bodies, const State& state, Broadphase& broadphase);
    void searchForOutrun(const Bodies& bodies, const State& state);
    void findAround(const Bodies& bodies, const State& state, BodyIndex body);
    void notePulls(const Bodies& bodies, const State& state, double duration);
    void findWallPairs(const Bodies& bodies, const State& state);
    void addPair(const Bodies& bodies, BodyPair pair);

    std::vector<std::uint8_t> m_mobile;  // of bodies.bounded
    std::vector<std::uint32_t> m_number; // by body: its place in bodies.bounded
    std::vector<Aabb> m_boxes;           // of bodies.bounded
    std::vector<double> m_path;          // by body: how far it comes if nothing hits it [m]
    std::vector<double> m_pull;          // by body: how much further springs and force terms take it [m]
    std::vector<double> m_moved;         // by body: at most so far from where the list found it [m]
    std::vector<double> m_skin;          // by body [m]
    std::vector<double> m_asked; // by body: the most room covers() was asked for since its skin was made [m]
    std::vector<Pose> m_origin;  // by body: where the list found it
    double m_duration = 1;       // noted last [s]
    double m_typical = 0;        // root mean square of what bodies need [m]
    std::uint64_t m_searches = 0;
    std::vector<BodyIndex> m_outrun;      // since the last search; some may be named twice
    std::vector<std::uint8_t> m_isOutrun; // by body, of m_outrun: 1, or 2 once it has been found anew
    BoxColumns m_columns;                 // of bodies.bounded, each with its skin, where the list found it
    std::vector<std::uint32_t> m_hits;    // of m_columns
    std::vector<BodyPair> m_wallPairs;
    std::vector<std::vector<BodyIndex>> m_around; // by body
    std::size_t m_ends = 0;                       // of m_around together
};

} // namespace carom
