// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/stepped_motion.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

// How bodies leave the base path: their forces become part of the manifolds again.

namespace carom {

void SteppedMotion::end(const SteppedInput& input, Manifolds& manifolds, std::vector<Entry>& entries) {
    m_pairs.handOver(input, m_islands, true, m_step, manifolds, entries);
    clear();
}

void SteppedMotion::leave(const SteppedInput& input, Manifolds& manifolds, NewNumbers& numbers,
                          std::vector<BodyIndex>& bodies, std::vector<Entry>& entries) {
    if (!m_islands.anyMarked()) return;
    m_islands.settle();
    m_pairs.handOver(input, m_islands, false, m_step, manifolds, entries);
    std::ranges::copy_if(m_islands.bodies(), std::back_inserter(bodies),
                         [this](BodyIndex body) { return m_islands.isMarked(body); });
    m_pairs.findLeaving(m_islands, numbers.entries);
    std::erase_if(m_links, [&](std::uint32_t link) {
        const SpringForce& spring = input.bodies.springs[link];
        return m_islands.isMarked(m_islands.numberAt(spring.from) != immobile ? spring.from : spring.to);
    });
    m_islands.leave(numbers.bodies);
    m_pairs.leave(numbers);
    m_bodies.leave(numbers.bodies, m_islands.numbers());
    m_still.leave(numbers.bodies, m_islands.numbers());
    m_isAfterKnown = m_weight.isKnown = false;
    m_rows.begin(m_islands.numbers(), immobile);
}

} // namespace carom
