// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/stepped_motion.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

// How bodies leave the base path: their forces become part of the manifolds again.

namespace carom {

// Makes a manifold like updateManifold() would.
PersistentManifold SteppedMotion::manifoldOfBalls(const Bodies& bodies, const State& state,
                                                  std::uint32_t entry, const Vec3& normal,
                                                  const Vec3& impulse) const {
    PersistentManifold manifold;
    manifold.pair = m_entries[entry].pair;
    const bool isFlipped = m_isFlipped[entry] != 0;
    const auto [first, second] = manifold.pair;
    const BodyIndex a = isFlipped ? second : first, b = isFlipped ? first : second;
    const Pose &poseA = state.pose[a], &poseB = state.pose[b];
    const Vec3 onB = -bodies.boundingRadius[b] * normal;
    Vec3 onA = bodies.boundingRadius[a] * normal;
    if (const Wall* wall = std::get_if<Wall>(&bodies.shape[a]))
        onA = poseB.position - distanceTo(*wall, poseB.position) * normal - poseA.position;
    manifold.count = 1;
    manifold.round = true;
    manifold.open = impulse == Vec3::Zero();
    manifold.normal = isFlipped ? Vec3(-normal) : normal;
    manifold.gap = normal.dot(poseB.position + onB - poseA.position - onA);
    manifold.points[0] = {isFlipped ? onB : onA, isFlipped ? onA : onB,
                          (isFlipped ? -1 : 1) / m_step * impulse};
    return manifold;
}

template<class Goes>
void SteppedMotion::storeBalls(const SteppedInput& input, const Goes& goes, Manifolds& manifolds) {
    m_balls.forEach([&](std::uint32_t index, const Vec3& normal, const Vec3& impulse) {
        Entry& entry = m_entries[index];
        if (!goes(entry.pair)) return;
        if (entry.place == Manifolds::none) {
            if (impulse == Vec3::Zero()) return;
            entry.place = manifolds.add(entry.pair);
        }
        manifolds[entry.place] = manifoldOfBalls(input.bodies, input.state, index, normal, impulse);
    });
}

void SteppedMotion::end(const SteppedInput& input, Manifolds& manifolds, std::vector<Entry>& entries) {
    storeBalls(
        input, [](BodyPair) { return true; }, manifolds);
    for (const Entry& entry : m_entries)
        if (entry.place != Manifolds::none) entries.push_back(entry);
    clear();
}

void SteppedMotion::leave(const SteppedInput& input, Manifolds& manifolds, NewNumbers& numbers,
                          std::vector<BodyIndex>& bodies, std::vector<Entry>& entries) {
    if (!m_islands.anyMarked()) return;
    m_islands.settle();
    const auto goes = [this](BodyPair pair) { return m_islands.isMarked(pair); };
    storeBalls(input, goes, manifolds);
    for (const Entry& entry : m_entries)
        if (entry.place != Manifolds::none && goes(entry.pair)) entries.push_back(entry);
    std::ranges::copy_if(m_islands.bodies(), std::back_inserter(bodies),
                         [this](BodyIndex body) { return m_islands.isMarked(body); });
    keepUnmarked(input.bodies, numbers);
}

// Removes the bodies of marked islands. The others get new numbers; nothing else of theirs changes.
void SteppedMotion::keepUnmarked(const Bodies& bodies, NewNumbers& numbers) {
    numbers.entries.assign(m_entries.size(), 0);
    for (std::size_t i = 0; i < m_entries.size(); ++i)
        if (m_islands.isMarked(m_entries[i].pair)) numbers.entries[i] = gone;
    renumberEntries(numbers.entries);
    m_open.assign(m_general.size(), {}); // numbers change: they are looked at anew
    m_heldDepth.assign(m_general.size(), -1);
    std::erase_if(m_links, [&](std::uint32_t link) {
        const SpringForce& spring = bodies.springs[link];
        return m_islands.isMarked(m_islands.numberAt(spring.from) != immobile ? spring.from : spring.to);
    });
    m_islands.leave(numbers.bodies);
    m_isAfterKnown = m_weight.isKnown = false;
    forgetPairs();
    m_rows.begin(m_islands.numbers(), immobile);
    m_bodies.leave(numbers.bodies, m_islands.numbers());
    m_still.leave(numbers.bodies, m_islands.numbers());
    m_areStillNoted = !m_still.any();
    m_balls.keep(numbers.entries, numbers.bodies, immobile);
}

} // namespace carom
