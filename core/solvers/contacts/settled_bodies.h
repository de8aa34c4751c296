// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

// The members of a substep of which nothing changes: bodies that stand still on the base path
// (still_bodies.h), where all that is computed of them in a substep is what it was in the one before. They
// keep it, so that a substep costs what those cost that are active:
//
//     active    all is computed of it in each substep
//     begins    it stood still when the first substep of a frame began, and nothing of it has changed since
//     settled   it began in that substep, and might settle at its end: not computed again
//
// Whoever changes something that is kept of a body wakes it: then it is active, from this substep on if it is
// still to be looked at, and in the next one anyway.

namespace carom {

class SettledBodies {
  public:
    explicit SettledBodies(std::size_t bodies) : m_stage(bodies, Stage::Active) {}

    bool has(BodyIndex body) const { return m_stage[body] == Stage::Settled; }
    /// The first substep of a frame begins, in which this one, which is active, stands still.
    void begin(BodyIndex body) { m_stage[body] = Stage::Begins; }
    void wake(BodyIndex body) {
        if (has(body)) m_woken.push_back(body);
        m_stage[body] = Stage::Active;
    }
    void wakeAll() {
        for (BodyIndex i = 0; i < m_stage.size(); ++i) wake(i);
    }
    /// Members that are active are `active`, ascending, from now on: those of all `members`, ascending.
    void list(std::span<const BodyIndex> members, std::vector<BodyIndex>& active) {
        m_woken.clear();
        active.clear();
        for (const BodyIndex i : members)
            if (!has(i)) active.push_back(i);
    }
    /// Adds to them those that were woken since, which must be members.
    void addWoken(std::vector<BodyIndex>& active) {
        if (m_woken.empty()) return;
        std::sort(m_woken.begin(), m_woken.end());
        const auto end = static_cast<std::ptrdiff_t>(active.size());
        active.insert(active.end(), m_woken.begin(), m_woken.end());
        std::inplace_merge(active.begin(), active.begin() + end, active.end());
        m_woken.clear();
    }
    /// Takes from them those that settle: may(body) is asked of those that began and were not woken.
    template<class May>
    void settle(std::vector<BodyIndex>& active, const May& may) {
        std::erase_if(active, [&](BodyIndex i) {
            if (m_stage[i] != Stage::Begins) return false;
            const bool isSettled = may(i);
            m_stage[i] = isSettled ? Stage::Settled : Stage::Active;
            return isSettled;
        });
    }

  private:
    enum class Stage : std::uint8_t { Active, Begins, Settled };

    std::vector<Stage> m_stage;     // by body
    std::vector<BodyIndex> m_woken; // that were settled
};

} // namespace carom
