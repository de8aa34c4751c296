// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

// The members of a substep of which nothing changes: bodies that stand still on the base path
// (still_bodies.h), where all that is computed of them in a substep is what it was in the one before. They
// keep it, so that a substep costs what those cost that stir:
//
//     stirs     all is computed of it in each substep
//     begins    it stood still when the first substep of a frame began, and nothing of it has changed since
//     settled   it began in that substep, and might settle at its end: not computed again
//
// Whoever changes something that is kept of a body rouses it: then it stirs, from this substep on if it is
// still to be looked at, and in the next one anyway.

namespace carom {

class SettledBodies {
  public:
    explicit SettledBodies(std::size_t bodies) : m_stage(bodies, Stage::Stirs) {}

    bool has(BodyIndex body) const { return m_stage[body] == Stage::Settled; }
    /// The first substep of a frame begins, in which this one, which stirs, stands still.
    void begin(BodyIndex body) { m_stage[body] = Stage::Begins; }
    void rouse(BodyIndex body) {
        if (has(body)) m_roused.push_back(body);
        m_stage[body] = Stage::Stirs;
    }
    void rouseAll() {
        for (BodyIndex i = 0; i < m_stage.size(); ++i) rouse(i);
    }
    /// Members that stir are `stirring`, ascending, from now on: those of all `members`, ascending.
    void list(std::span<const BodyIndex> members, std::vector<BodyIndex>& stirring) {
        m_roused.clear();
        stirring.clear();
        for (const BodyIndex i : members)
            if (!has(i)) stirring.push_back(i);
    }
    /// Adds to them those that were roused since, which must be members.
    void addRoused(std::vector<BodyIndex>& stirring) {
        if (m_roused.empty()) return;
        std::sort(m_roused.begin(), m_roused.end());
        const auto end = static_cast<std::ptrdiff_t>(stirring.size());
        stirring.insert(stirring.end(), m_roused.begin(), m_roused.end());
        std::inplace_merge(stirring.begin(), stirring.begin() + end, stirring.end());
        m_roused.clear();
    }
    /// Takes from them those that settle: may(body) is asked of those that began and were not roused.
    template<class May>
    void settle(std::vector<BodyIndex>& stirring, const May& may) {
        std::erase_if(stirring, [&](BodyIndex i) {
            if (m_stage[i] != Stage::Begins) return false;
            const bool isSettled = may(i);
            m_stage[i] = isSettled ? Stage::Settled : Stage::Stirs;
            return isSettled;
        });
    }

  private:
    enum class Stage : std::uint8_t { Stirs, Begins, Settled };

    std::vector<Stage> m_stage;      // by body
    std::vector<BodyIndex> m_roused; // that were settled
};

} // namespace carom
