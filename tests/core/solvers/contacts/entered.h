// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/constants.h"
#include "tests/support/contact_scenes.h"

#include "core/narrowphase/narrowphase.h"
#include "core/solvers/contacts/base_path.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace carom::test {

inline constexpr int substeps = 4; // a frame
inline constexpr double frame = substeps * substep;
inline constexpr double skin = 0.05;

/// A scene whose bodies all may enter the base path.
class Entered {
  public:
    explicit Entered(const Scene& scene)
        : bodies(bodiesOf(scene)), state(initialStateOf(scene)), path(bodies.count(), 1),
          m_gravity(scene.gravity.acceleration), m_neighbours(bodies),
          m_broadphase(findBroadphase("all_pairs")->create()) {
        bodies.springs = springsOf(scene);
        for (const SpringForce& spring : bodies.springs) m_links.push_back({spring.from, spring.to});
    }

    SteppedInput input(bool isFirst = true) {
        return {.bodies = bodies, .gravity = m_gravity, .state = state, .isFirst = isFirst};
    }

    /// With the manifolds of those that are near, as they are now.
    void enter(const std::vector<BodyIndex>& list) {
        m_neighbours.update(bodies, state, {bodies.mobileBodies, bodies.mobileBodies}, m_gravity,
                            {substep, frame}, *m_broadphase);
        while (!path.prepare(input(), list, frame, skin, m_neighbours))
            m_neighbours.search(bodies, state, *m_broadphase);
        std::vector<Manifolds::Entry> known;
        for (BodyIndex a = 0; a < bodies.count(); ++a)
            for (BodyIndex b = a + 1; b < bodies.count(); ++b)
                if (isListed(list, a) || isListed(list, b)) know({a, b}, known);
        path.enter(input(), list, m_neighbours, m_links, substep, known, manifolds);
        for (const Manifolds::Entry& entry : known)
            if (entry.place != Manifolds::none) manifolds.remove(entry.place);
        carried.clear();
    }
    void enterAll() { enter(bodies.mobileBodies); }
    /// All of them for one substep, those that touch as islands.
    void enterBriefly() {
        std::vector<Manifolds::Entry> known;
        for (BodyIndex a = 0; a < bodies.count(); ++a)
            for (BodyIndex b = a + 1; b < bodies.count(); ++b) know({a, b}, known);
        std::vector<BodyPair> pairs;
        for (const Manifolds::Entry& entry : known) pairs.push_back(entry.pair);
        Islands islands;
        islands.find(bodies, bodies.mobileBodies, pairs, {});
        std::vector<Island> entering;
        std::vector<SteppedMotion::Entry> entries;
        for (std::size_t i = 0; i < islands.count(); ++i) {
            entering.push_back(islands[i]);
            for (const std::uint32_t index : islands[i].pairs)
                entries.push_back({.pair = pairs[index],
                                   .place = known[index].place,
                                   .margin = 0.05,
                                   .isFresh = true,
                                   .isNear = SteppedPairs::isNear(input(), pairs[index])});
        }
        path.enterBriefly(input(), entering, entries, substep, manifolds);
        carried.clear();
    }
    void leave() {
        carried.clear();
        path.leave(input(), manifolds, carried);
        std::sort(
            carried.begin(), carried.end(),
            [](const Manifolds::Entry& one, const Manifolds::Entry& other) { return one.pair < other.pair; });
    }
    /// The bodies of marked islands, ascending.
    std::vector<BodyIndex> leaveMarked() {
        std::vector<BodyIndex> left;
        carried.clear();
        path.leaveMarked(input(), manifolds, left, carried);
        std::sort(left.begin(), left.end());
        std::sort(
            carried.begin(), carried.end(),
            [](const Manifolds::Entry& one, const Manifolds::Entry& other) { return one.pair < other.pair; });
        return left;
    }
    /// Whether the pairs serve for another substep, perhaps after some were found anew.
    bool renew(bool isFirst = true) { return renew(path, input(isFirst), manifolds); }
    bool renew(BasePath& which, const SteppedInput& with, Manifolds& itsManifolds) {
        if (!m_neighbours.follow(bodies, with.state, bodies.mobileBodies, m_gravity, substep))
            m_neighbours.search(bodies, with.state, *m_broadphase);
        if (with.isFirst) which.markIfMoved(with.state, with.workers);
        return which.renew(with, frame, skin, m_neighbours, *m_broadphase, itsManifolds);
    }
    void advance(bool isFirst = true) { path.advance(input(isFirst), manifolds); }
    /// A substep, the first one of a frame or not; all enter anew if the pairs do not serve for it.
    void step(bool isFirst = true) {
        if (path.isEmpty()) enterAll();
        if (!renew(isFirst)) {
            leave();
            enterAll();
            ++renewals;
        }
        advance(isFirst);
    }
    /// The pairs that are on the base path and have a manifold.
    std::vector<BodyPair> pairs() {
        BasePath copy = path;
        Manifolds itsManifolds = manifolds;
        std::vector<Manifolds::Entry> entries;
        copy.leave(input(), itsManifolds, entries);
        std::vector<BodyPair> result;
        for (const Manifolds::Entry& entry : entries) result.push_back(entry.pair);
        std::sort(result.begin(), result.end());
        return result;
    }
    PlacedShape shapeOf(BodyIndex i) const { return {&bodies.shape[i], &state.pose[i]}; }
    double distanceOf(BodyPair pair) const { return proximityOf(shapeOf(pair.a), shapeOf(pair.b)).distance; }
    /// Between two bodies, on the second [N].
    Vec3 forceOf(BodyPair pair) {
        Vec3 sum = Vec3::Zero();
        path.forEachContact(bodies, state, manifolds, [&](const PersistentManifold& manifold) {
            if (manifold.pair != pair) return;
            for (int k = 0; k < manifold.count; ++k)
                sum += manifold.points[static_cast<std::size_t>(k)].force;
        });
        return sum;
    }

    Bodies bodies;
    State state;
    Manifolds manifolds;
    BasePath path;
    std::vector<Manifolds::Entry> carried; ///< of those that left last
    int renewals = 0;

  private:
    static bool isListed(const std::vector<BodyIndex>& list, BodyIndex body) {
        return std::binary_search(list.begin(), list.end(), body);
    }
    void know(BodyPair pair, std::vector<Manifolds::Entry>& known) {
        const ManifoldInput here{bodies, state, m_gravity, substep};
        for (const Manifolds::Entry& entry : carried)
            if (entry.pair == pair) known.push_back(entry);
        const bool isCarried = !known.empty() && known.back().pair == pair;
        if (bodies.mobile[pair.a] == 0 && bodies.mobile[pair.b] == 0) return;
        if (!isCarried && boundingGap(bodies, state, pair) > 0.05) return;
        if (!isCarried) known.push_back({pair, manifolds.add(pair)});
        updateManifold(here, 0.05, manifolds[known.back().place]);
    }

    Vec3 m_gravity;
    Neighbours m_neighbours;
    std::unique_ptr<Broadphase> m_broadphase;
    std::vector<BodyPair> m_links; // the ends of springs
};

} // namespace carom::test
